"""What all tests share: how Hypothesis runs, and that nothing is skipped where everything must run."""

from __future__ import annotations

import os
import shutil
from collections import Counter
from collections.abc import Generator
from typing import TYPE_CHECKING, Any, TypeVar

import pytest
from hypothesis import settings

from crankwork.formula.expression import Formula
from rules import every_formula

if TYPE_CHECKING:
    from playwright.sync_api import Browser

Report = TypeVar("Report", pytest.TestReport, pytest.CollectReport)

# commands speak the language of the system, and tests expect English
os.environ.pop("LC_ALL", None)
os.environ.pop("LC_MESSAGES", None)
os.environ["LANG"] = "C.UTF-8"

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# what takes long or needs more than pip installs in a minute; `scripts/test --all` runs it
LATER = ("browser", "programs", "compiled", "data", "slow")
LEFT_OUT = pytest.StashKey[Counter[str]]()
IN_CI = os.environ.get("CI") == "true"

# Parallel tests share the processor, so a deadline would measure the neighbours.
settings.register_profile("crankwork", deadline=None, derandomize=IN_CI)
settings.load_profile("crankwork")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the choice of a part of the tests; without it all of them run."""
    parser.addoption("--part", choices=("light", "rest"), help="the tests of scripts/test, or the rest")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what needs a browser, and leave the other part out of what was asked for."""
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker("browser")
            item.add_marker(pytest.mark.flaky(reruns=1, only_rerun="TimeoutError: (Page|Locator)"))
    part = config.getoption("part")
    if part is None:
        return
    reasons = [[name for name in LATER if item.get_closest_marker(name)] for item in items]
    left_out = [item for item, why in zip(items, reasons, strict=True) if bool(why) == (part == "light")]
    if part == "light":
        config.stash[LEFT_OUT] = Counter(why[0] for why in reasons if why)
    kept = set(map(id, items)) - set(map(id, left_out))
    items[:] = [item for item in items if id(item) in kept]
    config.hook.pytest_deselected(items=left_out)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Hand what a worker left out to the process that leads."""
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["left_out"] = dict(session.config.stash.get(LEFT_OUT, Counter()))


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Take what a worker left out; every worker collects the same."""
    node.config.stash[LEFT_OUT] = Counter(getattr(node, "workeroutput", {}).get("left_out", {}))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Tell what was left out and which command runs it."""
    counts = config.stash.get(LEFT_OUT, Counter())
    if counts:
        what = ", ".join(f"{number} {name}" for name, number in counts.most_common())
        terminalreporter.write_line(f"not run: {counts.total()} tests ({what}); scripts/test --all runs them")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Turn a skipped test into a failure in CI."""
    return _without_skips((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Turn a skipped module into a failure in CI."""
    return _without_skips((yield))


def _without_skips(report: Report) -> Report:
    # an expected failure is reported as skipped too, and stays one
    if IN_CI and report.skipped and not hasattr(report, "wasxfail"):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else report.longrepr
        report.outcome = "failed"
        report.longrepr = f"A skip is a failure in CI: {reason}"
    return report


@pytest.fixture(scope="session")
def formulas() -> dict[str, Formula]:
    """Every registered formula by name."""
    return every_formula()


@pytest.fixture(scope="session")
def browser() -> Generator[Browser]:
    """A browser of this machine; there may be one in a process."""
    from playwright.sync_api import sync_playwright

    program = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if program is None:
        pytest.skip("chromium is not installed")
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield running
        running.close()

"""What all tests share: how Hypothesis runs, and that nothing is skipped where everything must run."""

from __future__ import annotations

import importlib
import os
import pkgutil
import shutil
from collections.abc import Generator
from typing import TypeVar

import pytest
from coverage import Coverage
from hypothesis import settings
from playwright.sync_api import Browser, sync_playwright

import crankwork
from crankwork.formula.expression import FORMULAS, Formula

Report = TypeVar("Report", pytest.TestReport, pytest.CollectReport)

# commands speak the language of the system, and tests expect English
os.environ.pop("LC_ALL", None)
os.environ.pop("LC_MESSAGES", None)
os.environ["LANG"] = "C.UTF-8"

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
MEASURED: set[str] = set()
IN_CI = os.environ.get("CI") == "true"

# Parallel tests share the processor, so a deadline would measure the neighbours.
settings.register_profile("crankwork", deadline=None, derandomize=IN_CI)
settings.load_profile("crankwork")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, bool, bool]:
    """Measure coverage in the first case of a test, none of Hypothesis: the others run the same lines twice as long."""
    test, measuring = item.nodeid.partition("[")[0], Coverage.current()
    drawn = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
    if measuring is None or not (drawn or test in MEASURED):
        MEASURED.add(test)
        return (yield)
    measuring.stop()
    try:
        return (yield)
    finally:
        measuring.start()


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
    for module in pkgutil.walk_packages(crankwork.__path__, "crankwork."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    return FORMULAS


@pytest.fixture(scope="session")
def browser() -> Generator[Browser]:
    """A browser of this machine; there may be one in a process."""
    program = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if program is None:
        pytest.skip("chromium is not installed")
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield running
        running.close()

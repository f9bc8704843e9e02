"""Tries every mutant of every formula on what could notice it, and counts those that nothing notices.

What could notice: a check of `results.checks` over the machine files (marker `checks`), which was met and is not any
more; a test marked `elsewhere`, whose expected values crankwork did not make. Each mutant lives in a process of its own
and is tried only on what executes its formula, by the map that `scripts/test` records (`campaigns/executed.py`).
`scripts/campaign mutants` runs all, `scripts/test --all` a tenth.
"""

from __future__ import annotations

import argparse
import contextlib
import datetime as dt
import functools
import gc
import hashlib
import os
import pickle
import runpy
import signal
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import hypothesis
import pytest
from _pytest.runner import runtestprotocol

from crankwork.formula.expression import FORMULAS, Formula

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tests"))
from campaigns.detection import Map  # noqa: E402 - the folder of tests is no package
from campaigns.faulty import in_turn  # noqa: E402
from campaigns.marked import SOURCE, prepare  # noqa: E402
from replaced import replaced_formula  # noqa: E402 - the folder of tests is no package
from rules import every_formula  # noqa: E402 - the folder of tests is no package

CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "crankwork" / "mutants"
SECONDS = 60
# of witnesses that take longer together only the first are asked [s]
PATIENCE = 20.0
WITNESSES = "checks or elsewhere"
Mutant, mutants = (runpy.run_path(str(HERE / "mutants.py"))[name] for name in ("Mutant", "mutants"))


@dataclass(frozen=True)
class Witness:
    """A test that may notice a mutant; `is_check`: by checks of machine files, not by a value from elsewhere."""

    name: str
    is_check: bool
    notices: Callable[[], bool]


@dataclass
class Verdict:
    """What became of a mutant: who noticed it, and how."""

    mutant: str
    witness: str = ""
    is_check: bool = False


def witnesses_of(session: pytest.Session) -> Iterator[Witness]:
    """Yield every test that was collected, but those of compiled steps, which are made of the source of formulas."""
    for item in session.items:
        if "compiled" not in item.name:
            yield Witness(item.nodeid, item.get_closest_marker("checks") is not None, _failed(item))


def _failed(item: pytest.Item) -> Callable[[], bool]:
    return lambda: any(report.failed for report in runtestprotocol(item, log=False, nextitem=None))


def tried(mutant: Any, witnesses: Sequence[Witness]) -> Verdict:
    """Return who notices a mutant first; who fails without it too does not notice it."""
    for witness in witnesses:
        forget()
        with replaced_formula(mutant.formula, mutant.function):
            try:
                noticed = witness.notices()
            except Exception:  # noqa: BLE001 - a mutant that cannot be computed is noticed
                noticed = True
        forget()
        if noticed and not witness.notices():
            return Verdict(mutant.name, witness.name, witness.is_check)
    return Verdict(mutant.name)


def forget() -> None:
    """Empty what tests and the source keep of machines that they have computed."""
    for name, module in [*sys.modules.items()]:
        folder = Path(getattr(module, "__file__", None) or "")
        if name.startswith("test_") or folder.is_relative_to(ROOT / "tests") or folder.is_relative_to(SOURCE):
            for kept in [*vars(module).values()]:
                if isinstance(kept, functools._lru_cache_wrapper):
                    kept.cache_clear()


def apart(tasks: Sequence[Callable[[], Any]], workers: int, seconds: int = SECONDS) -> Iterator[tuple[int, Any]]:
    """Yield what tasks return, each run in a process of its own, in the order in which they end; None of a hang."""
    waiting, running = list(enumerate(tasks)), {}
    waiting.reverse()
    gc.freeze()
    while waiting or running:
        while waiting and len(running) < workers:
            at, task = waiting.pop()
            out = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as its process
            pid = os.fork()
            if not pid:
                _child(task, out, seconds)
            running[pid] = at, out
        pid, status = os.wait()
        at, out = running.pop(pid)
        with out:
            out.seek(0)
            yield at, None if status else pickle.load(out)  # noqa: S301 - our own child wrote it


def _child(task: Callable[[], Any], out: Any, seconds: int) -> None:
    signal.alarm(seconds)
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    pickle.dump(task(), out)
    out.flush()
    os._exit(0)


def _patiently(names: Sequence[str], seconds: Mapping[str, float]) -> list[str]:
    taken, gone = [], 0.0
    for one in names:
        if not taken or gone + seconds[one] < PATIENCE:
            taken.append(one)
            gone += seconds[one]
    return taken


def recorded(folder: Path, witnesses: Mapping[str, Witness]) -> Map:
    """Return which test executes what: as it was recorded, if the source is still the same, or recorded now."""
    if (folder / "index").exists() and (folder / "index").read_text("utf-8") == str(prepare(folder)):
        known = Map.read(folder)
        if any(witnesses[name].is_check for name in witnesses.keys() & known.seconds.keys()):
            return known
    say("recording which test executes which formula")
    words = [sys.executable, "-m", "pytest", "-q", "-n", "auto", "--dist", "worksteal", "-m", WITNESSES]
    words += ["-p", "campaigns.executed", "--executed", str(folder), str(ROOT / "tests")]
    subprocess.run(words, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT / "tests")}, check=True)
    return Map.read(folder)


def calls(known: Map) -> dict[str, list[str]]:
    """Return the tests that execute each formula."""
    found = {}
    for name, formula in FORMULAS.items():
        code = formula.function.__code__
        file = Path(code.co_filename).relative_to(SOURCE).as_posix()
        inside = [at for at, (one, first, _) in enumerate(known.blocks) if one == file and first >= code.co_firstlineno]
        found[name] = known.tests.get(min(inside, key=lambda at: known.blocks[at][1]), []) if inside else []
    return found


class Campaign:
    """A plugin of pytest that tries mutants where tests would be run."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self.arguments = arguments
        self.failed = False

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Run the campaign instead of the tests."""
        # also of modules that only a test imports while it runs
        for formula in every_formula().values():
            # kept by the formula, and never what a mutant would be
            _ = formula.is_root
        witnesses = {one.name: one for one in witnesses_of(session)}
        known = recorded(self.arguments.executed.resolve(), witnesses)
        calling = {name: [one for one in tests if one in witnesses] for name, tests in calls(known).items()}
        called = {name for name, tests in calling.items() if any(witnesses[one].is_check for one in tests)}
        listed = tomllib.loads((HERE / "uncalled.toml").read_text("utf-8"))
        allowed = {name for one in listed.values() for name in one["formulas"]}
        for name in sorted(allowed & called | allowed - set(FORMULAS)):
            say(f"called now, or no formula any more, take it out of uncalled.toml: {name}")
        uncalled = sorted(set(FORMULAS) - called - allowed)
        for name in uncalled:
            say(f"error: no machine file calls {name}")
        survivors = self.report(self.verdicts(witnesses, calling, known.seconds))
        self.failed = bool(uncalled or survivors)
        return True

    def verdicts(
        self, witnesses: Mapping[str, Witness], calling: Mapping[str, Sequence[str]], seconds: Mapping[str, float]
    ) -> list[Verdict]:
        """Return what becomes of every mutant of the chosen formulas."""
        hints: dict[str, str] = {}
        with contextlib.suppress(FileNotFoundError):
            hints = pickle.loads((CACHE / "witnesses").read_bytes())  # noqa: S301 - written below
        all_mutants = [one for formula in self.chosen() for one in mutants(formula)]
        tasks = []
        for one in all_mutants:
            hint = hints.get(one.name)
            in_order = sorted(
                in_turn(calling.get(one.formula.name, ()), seconds), key=lambda who, hint=hint: who != hint
            )
            asked = [witnesses[who] for who in _patiently(in_order, seconds)]
            tasks.append(functools.partial(tried, one, asked))
        found = [
            verdict or Verdict(all_mutants[at].name, "a hang", is_check=True)
            for at, verdict in apart(tasks, self.arguments.workers)
        ]
        CACHE.mkdir(parents=True, exist_ok=True)
        (CACHE / "witnesses").write_bytes(pickle.dumps(hints | {one.mutant: one.witness for one in found}))
        return found

    def chosen(self) -> list[Formula]:
        """Return the formulas to try, spread evenly over the parts."""
        if self.arguments.formulas:
            return [FORMULAS[name] for name in self.arguments.formulas]
        at, parts = self.arguments.part
        chosen = [formula for name, formula in sorted(FORMULAS.items()) if _digest(name) % parts == at % parts]
        return chosen[: self.arguments.count]

    def report(self, verdicts: Sequence[Verdict]) -> list[str]:
        """Print what became of mutants; return the survivors that are no exceptions."""
        exceptions = tomllib.loads((HERE / "exceptions.toml").read_text("utf-8"))
        reasons = {f"{name}.{kind}" for name, one in exceptions.items() for kind in one["mutants"]}
        for name in sorted({one.partition(".")[0] for one in reasons} - set(FORMULAS)):
            say(f"no such formula any more, take it out of exceptions.toml: {name}")
        alive = sorted(one.mutant for one in verdicts if not one.witness)
        for one in sorted(verdicts, key=lambda one: one.mutant):
            if self.arguments.verbose and one.witness:
                say(f"{one.mutant}: {one.witness}")
            if one.witness and one.mutant in reasons:
                say(f"noticed now, take it out of exceptions.toml: {one.mutant}")
        survivors = [one for one in alive if one not in reasons]
        for one in survivors:
            say(f"survives: {one}")
        count = Counter("survive" if not one.witness else "check" if one.is_check else "test" for one in verdicts)
        share = 100 * len(set(alive) & reasons) / max(1, len(verdicts))
        say(
            f"{len({one.mutant.partition('.')[0] for one in verdicts})} formulas, {len(verdicts)} mutants: "
            f"{count['check']} noticed by a check, {count['test']} by a value from elsewhere, "
            f"{len(survivors)} survive, {len(alive) - len(survivors)} exceptions ({share:.1f} %)"
        )
        return survivors


def _digest(name: str) -> int:
    return int(hashlib.sha256(name.encode()).hexdigest(), 16)


def say(text: str) -> None:
    """Print a line at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def _part(text: str) -> tuple[int, int]:
    if text == "today":
        return dt.datetime.now(dt.UTC).toordinal() % 10, 10
    at, _, parts = text.partition("/")
    return int(at), int(parts)


def main() -> int:
    """Run the campaign; 1 if a formula is not called or a mutant survives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formulas", nargs="*", help="names; all otherwise")
    parser.add_argument("--part", type=_part, default=(0, 1), help="K/N, or today for a tenth by date")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--executed", type=Path, default=CACHE / "executed", help="the folder of a recorded map")
    parser.add_argument("--count", type=int, help="so many formulas at most")
    parser.add_argument("--verbose", action="store_true", help="tell who notices each mutant")
    arguments = parser.parse_args()
    # a mutant that only a rare example notices is not noticed
    few = {"max_examples": 3, "phases": [hypothesis.Phase.explicit, hypothesis.Phase.generate]}
    quick = {
        "deadline": None,
        "derandomize": True,
        "database": None,
        "suppress_health_check": list(hypothesis.HealthCheck),
    }
    hypothesis.settings.register_profile("mutants", **few, **quick)
    options = [
        "-q",
        "-o",
        "addopts=--import-mode=importlib",
        "-p",
        "no:cacheprovider",
        "--assert=plain",
        "-m",
        WITNESSES,
        "--tb=no",
    ]
    campaign = Campaign(arguments)
    os.chdir(ROOT)
    code = pytest.main([*options, str(ROOT / "tests")], plugins=[campaign])
    return int(code) or int(campaign.failed)


if __name__ == "__main__":
    sys.exit(main())

"""Tries every mutant of every formula on what could notice it, and counts those that nothing notices.

What could notice: a check of `results.checks` over the machine files, which was met and is not any more; a test marked
`elsewhere`, whose expected values crankwork did not make. Each mutant lives in a process of its own and is tried only
on what calls its formula. `scripts/mutants` runs all, continuous integration a tenth.
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
import sys
import tempfile
import time
import tomllib
import traceback
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import hypothesis
import numpy as np
import pytest
from _pytest.runner import runtestprotocol

import crankwork
from crankwork.formula.expression import FORMULAS, Formula, instead

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
MACHINES = (ROOT / "examples", ROOT / "src/crankwork/description/templates", ROOT / "tests/machines")
CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "crankwork" / "mutants"
METHODS = ("exact", "textbook", "series:4")
SECONDS = 60
# of witnesses that take longer together, as watched, only the first are asked
PATIENCE = 20.0
Mutant, mutants = (runpy.run_path(str(HERE / "mutants.py"))[name] for name in ("Mutant", "mutants"))


@dataclass(frozen=True)
class Witness:
    """What may notice a mutant: a test, or a machine file computed by a method."""

    name: str
    is_check: bool
    notices: Callable[[], bool] = field(compare=False)


@dataclass
class Account:
    """What a witness saw without mutants: seconds, the largest value of each formula called, and what went wrong."""

    seconds: float = 0.0
    largest: dict[str, float] = field(default_factory=dict)
    fault: str = ""


@dataclass
class Verdict:
    """What became of a mutant: who noticed it, and how."""

    mutant: str
    witness: str = ""
    is_check: bool = False


def machine_witnesses() -> Iterator[Witness]:
    """Yield every machine file with its own method and, for engines, the others."""
    for path in sorted(path for folder in MACHINES for path in folder.glob("*.toml")):
        machine = crankwork.read(path)
        names = METHODS if machine.lengths and machine.engine is None else (None,)
        for name in names:
            label = path.relative_to(ROOT).as_posix()
            yield Witness(f"{label}:{name}" if name else label, True, _checked(path, name))


def _checked(path: Path, method: str | None) -> Callable[[], bool]:
    def notices() -> bool:
        machine = crankwork.read(path)
        if method is not None:
            machine = crankwork.with_method(machine, method)
        results = crankwork.analyse(machine)
        # a residual that is no number is not below any bound either
        return bool(results.unmet) or not all(np.isfinite(one) for one in results.checks.values())

    return notices


def test_witnesses(session: pytest.Session) -> Iterator[Witness]:
    """Yield every test that was collected, but those of compiled steps, which are made of the source of formulas."""
    for item in session.items:
        if "compiled" not in item.name:
            yield Witness(item.nodeid, False, _failed(item))


def _failed(item: pytest.Item) -> Callable[[], bool]:
    return lambda: any(report.failed for report in runtestprotocol(item, log=False, nextitem=None))


def watched(witness: Witness) -> Account:
    """Return what a witness calls and how long it takes, without a mutant."""
    account = Account()

    def watch(formula: Formula) -> Callable[..., Any]:
        own = formula.function

        def called(*operands: Any) -> Any:
            value = own(*operands)
            # most calls have one number, and a formula may be asked for symbols
            if isinstance(value, float | int):
                size = abs(value)
            elif isinstance(value, np.ndarray):
                size = float(np.max(np.abs(value), initial=0.0))
            else:
                size = 0.0
            account.largest[formula.name] = max(account.largest.get(formula.name, 0.0), size)
            return value

        return called

    with contextlib.ExitStack() as stack:
        for formula in FORMULAS.values():
            stack.enter_context(instead(formula, watch(formula)))
        start = time.perf_counter()
        try:
            if witness.notices():
                account.fault = "fails without a mutant"
        except Exception:  # noqa: BLE001 - whatever goes wrong is told
            account.fault = traceback.format_exc(limit=-2)
        account.seconds = time.perf_counter() - start
    return account


def tried(mutant: Any, witnesses: Sequence[tuple[Witness, Account]]) -> Verdict:
    """Return who notices a mutant first."""
    for witness, account in witnesses:
        mutant.largest = account.largest[mutant.formula.name]
        with instead(mutant.formula, mutant.function):
            try:
                noticed = witness.notices()
            except Exception:  # noqa: BLE001 - a mutant that cannot be computed is noticed
                noticed = True
        if noticed:
            return Verdict(mutant.name, witness.name, witness.is_check)
    return Verdict(mutant.name)


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


def in_turn(witnesses: Sequence[Witness], accounts: Mapping[str, Account]) -> list[Witness]:
    """Return witnesses, quick ones first; of a test with many cases one before the next case of any."""
    cases: Counter[str] = Counter()
    turns = {}
    for one in sorted(witnesses, key=lambda one: accounts[one.name].seconds):
        test = one.name if one.is_check else one.name.partition("[")[0]
        turns[one.name] = (cases[test].bit_length(), accounts[one.name].seconds)
        cases[test] += 1
    return sorted(witnesses, key=lambda one: turns[one.name])


def _patiently(asked: Sequence[tuple[Witness, Account]]) -> list[tuple[Witness, Account]]:
    taken, seconds = [], 0.0
    for one in asked:
        if not taken or seconds + one[1].seconds < PATIENCE:
            taken.append(one)
            seconds += one[1].seconds
    return taken


class Campaign:
    """A plugin of pytest that tries mutants where tests would be run."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self.arguments = arguments
        self.failed = False

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Run the campaign instead of the tests."""
        witnesses = [*machine_witnesses(), *test_witnesses(session)]
        accounts = self.accounts(witnesses)
        faults = {name: account.fault for name, account in accounts.items() if account.fault}
        for name, fault in faults.items():
            say(f"error: {name}: {fault}")
        called = {name for one in witnesses if one.is_check for name in accounts[one.name].largest}
        listed = tomllib.loads((HERE / "uncalled.toml").read_text("utf-8"))
        allowed = {name for one in listed.values() for name in one["formulas"]}
        for name in sorted(allowed & called | allowed - set(FORMULAS)):
            say(f"called now, or no formula any more, take it out of uncalled.toml: {name}")
        uncalled = sorted(set(FORMULAS) - called - allowed)
        for name in uncalled:
            say(f"error: no machine file calls {name}")
        verdicts = self.verdicts([one for one in witnesses if one.name not in faults], accounts)
        survivors = self.report(verdicts)
        self.failed = bool(faults or uncalled or survivors)
        return True

    def accounts(self, witnesses: Sequence[Witness]) -> Mapping[str, Account]:
        """Return what each witness calls, remembered outside the repository while neither source nor tests change."""
        digest = hashlib.sha256(" ".join(one.name for one in witnesses).encode())
        for folder in (ROOT / "src", ROOT / "tests", ROOT / "examples"):
            for path in sorted([*folder.rglob("*.py"), *folder.rglob("*.toml")]):
                if path.name not in ("exceptions.toml", "uncalled.toml"):
                    digest.update(path.read_bytes())
        kept = CACHE / f"accounts-{digest.hexdigest()[:20]}"
        if kept.exists():
            kept_accounts: Mapping[str, Account] = pickle.loads(kept.read_bytes())  # noqa: S301 - written below
            return kept_accounts
        start = time.perf_counter()
        together = defaultdict(list)
        for one in witnesses:
            together[one.name.partition("::")[0]].append(one)
        groups = list(together.values())
        tasks = [lambda group=group: [watched(one) for one in group] for group in groups]
        accounts: dict[str, Account] = {}
        for at, found in apart(tasks, self.arguments.workers, 10 * SECONDS):
            names = [one.name for one in groups[at]]
            accounts |= zip(names, found or [Account(fault="hangs")] * len(names), strict=True)
        say(f"{len(witnesses)} witnesses watched in {time.perf_counter() - start:.0f} s")
        CACHE.mkdir(parents=True, exist_ok=True)
        kept.write_bytes(pickle.dumps(accounts))
        return accounts

    def verdicts(self, witnesses: Sequence[Witness], accounts: Mapping[str, Account]) -> list[Verdict]:
        """Return what becomes of every mutant of the chosen formulas."""
        calling = defaultdict(list)
        for one in witnesses:
            for name in accounts[one.name].largest:
                calling[name].append(one)
        hints: dict[str, str] = {}
        with contextlib.suppress(FileNotFoundError):
            hints = pickle.loads((CACHE / "witnesses").read_bytes())  # noqa: S301 - written below
        all_mutants = [one for formula in self.chosen() for one in mutants(formula)]
        tasks = []
        for one in all_mutants:
            hint = hints.get(one.name)
            in_order = sorted(in_turn(calling[one.formula.name], accounts), key=lambda who, hint=hint: who.name != hint)
            asked = [(who, accounts[who.name]) for who in in_order]
            tasks.append(functools.partial(tried, one, _patiently(asked)))
        found = [
            verdict or Verdict(all_mutants[at].name, "a hang", is_check=True)
            for at, verdict in apart(tasks, self.arguments.workers)
        ]
        (CACHE / "witnesses").write_bytes(pickle.dumps(hints | {one.mutant: one.witness for one in found}))
        return found

    def chosen(self) -> list[Formula]:
        """Return the formulas to try, spread evenly over the parts."""
        if self.arguments.formulas:
            return [FORMULAS[name] for name in self.arguments.formulas]
        at, parts = self.arguments.part
        return [formula for name, formula in sorted(FORMULAS.items()) if _digest(name) % parts == at % parts]

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
    """Run the campaign; 1 if a formula is not called, a witness fails by itself or a mutant survives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formulas", nargs="*", help="names; all otherwise")
    parser.add_argument("--part", type=_part, default=(0, 1), help="K/N, or today for a tenth by date")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
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
        "elsewhere",
        "--tb=no",
    ]
    campaign = Campaign(arguments)
    os.chdir(ROOT)
    code = pytest.main([*options, str(ROOT / "tests")], plugins=[campaign])
    return int(code) or int(campaign.failed)


if __name__ == "__main__":
    sys.exit(main())

"""Runs tests on faults: a plugin of pytest that forks a process for each fault and puts the fault into its functions.

A process that has collected the tests once forks for each fault. There the functions whose code the fault changes get
the changed code; the file on the disk of this copy of the repository is changed too, for programs that tests start; and
the tests that execute the place run until one fails. A fault outside functions, and one that no test found, is tried in
a process that begins with the changed file.
"""

from __future__ import annotations

import contextlib
import functools
import gc
import json
import os
import pickle
import signal
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import pytest
from _pytest.runner import runtestprotocol

from campaigns.faults import Fault
from campaigns.marked import SOURCE

# of one fault and one part of the tests, and of one test [s]
PATIENCE, HANG = 90, 60


def changed_codes(old: CodeType, new: CodeType) -> list[tuple[CodeType, CodeType]] | None:
    """Return the outermost functions that differ, or None if something outside functions does."""
    if _own(old) != _own(new):
        return None
    found: list[tuple[CodeType, CodeType]] = []
    for one, other in zip(_inner(old), _inner(new), strict=True):
        if one == other:
            continue
        if one.co_flags & 0x2:  # of a function, not of a class
            found.append((one, other))
        elif (inside := changed_codes(one, other)) is None:
            return None
        else:
            found += inside
    return found


def _inner(code: CodeType) -> list[CodeType]:
    return [one for one in code.co_consts if isinstance(one, CodeType)]


def _own(code: CodeType) -> tuple[Any, ...]:
    constants = [type(one) if isinstance(one, CodeType) else (type(one), repr(one)) for one in code.co_consts]
    return code.co_code, code.co_names, tuple(constants)


Functions = dict[tuple[str, str, int], list[FunctionType]]


def all_functions() -> Functions:
    """Return every function of the source that is loaded, by file, name and line."""
    found: Functions = {}
    for one in gc.get_objects():
        if isinstance(one, FunctionType) and one.__code__.co_filename.startswith(str(SOURCE)):
            code = one.__code__
            found.setdefault((code.co_filename, code.co_qualname, code.co_firstlineno), []).append(one)
    return found


def put_in_place(fault: Fault, functions: Functions) -> bool:
    """Let the functions of this process have the fault; False if it is outside functions or in none that is loaded."""
    path = SOURCE / fault.file
    if path.suffix != ".py":
        return False
    data = path.read_bytes()
    old, new = (compile(text, str(path), "exec", dont_inherit=True) for text in (data, fault.put_into(data)))
    pairs = changed_codes(old, new) or []
    places = [(functions.get((str(path), one.co_qualname, one.co_firstlineno)), other) for one, other in pairs]
    if not places or not all(loaded for loaded, _ in places):
        return False
    for loaded, other in places:
        for one in loaded or ():
            one.__code__ = other
    return True


def in_turn(names: Sequence[str], seconds: dict[str, float]) -> list[str]:
    """Return tests, quick ones first; of a test with many cases one before the next case of any."""
    cases: Counter[str] = Counter()
    turns = {}
    for name in sorted(names, key=lambda name: seconds.get(name, 1.0)):
        test = name.partition("[")[0]
        turns[name] = cases[test].bit_length(), seconds.get(name, 1.0)
        cases[test] += 1
    return sorted(names, key=lambda name: turns[name])


class Faulty:
    """The plugin: `work` holds faults with the tests to try, `out` gets a line of JSON for each."""

    def __init__(self, work: Path, out: Path, *, fresh: bool) -> None:
        self.work: list[tuple[Fault, list[str]]] = pickle.loads(work.read_bytes())  # noqa: S301 - our own
        self.out, self.fresh = out, fresh
        self.sound: dict[str, bool] = {}
        self.functions: Functions = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Try every fault instead of running the tests."""
        items = {item.nodeid: item for item in session.items}
        self.functions = all_functions()
        gc.freeze()
        for fault, names in self.work:
            asked = [items[name] for name in names if name in items]
            start = time.perf_counter()
            found = self._found(fault, asked)
            found |= {"fault": fault.name, "fresh": self.fresh, "seconds": round(time.perf_counter() - start, 2)}
            with self.out.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps(found) + "\n")
        return True

    def _found(self, fault: Fault, asked: list[pytest.Item]) -> dict[str, Any]:
        """Return which test finds a fault: one that fails again alone, and not without the fault."""
        path = SOURCE / fault.file
        before = path.read_bytes()
        while True:
            found = _forked(functools.partial(self._tried, fault, asked))
            path.write_bytes(before)
            test = found["by"]
            one = next((item for item in asked if item.nodeid == test), None)
            if one is None:
                return found
            again = _forked(functools.partial(self._tried, fault, [one]))
            path.write_bytes(before)
            if test not in self.sound:
                # a process that begins with the fault cannot do without it; who started it asks
                self.sound[test] = self.fresh or _forked(functools.partial(_first_failing, [one]))["by"] is None
            if self.sound[test] and again["by"] is not None:
                return found
            asked = [item for item in asked if item is not one]

    def _tried(self, fault: Fault, items: list[pytest.Item]) -> dict[str, Any]:
        if not self.fresh:
            data = (SOURCE / fault.file).read_bytes()
            if not put_in_place(fault, self.functions):
                return {"by": None, "tried": 0, "outside": True}
            (SOURCE / fault.file).write_bytes(fault.put_into(data))
        return _first_failing(items)


def _forked(task: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Return what a task finds in a process of its own."""
    read, write = os.pipe()
    pid = os.fork()
    if not pid:
        os.setsid()
        os.close(read)
        for stream in (1, 2):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        with os.fdopen(write, "w") as answer:
            answer.write(json.dumps(task()))
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as answer:
        text = answer.read()
    os.waitpid(pid, 0)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)  # what a test left running
    return json.loads(text) if text else {"by": "a process that ended", "tried": 0}


def _first_failing(items: list[pytest.Item]) -> dict[str, Any]:
    start, hangs = time.perf_counter(), []

    def hung(*_: object) -> None:
        hangs.append(1)
        raise TimeoutError("the fault makes it hang")

    signal.signal(signal.SIGALRM, hung)
    for at, item in enumerate(items):
        following = items[at + 1] if at + 1 < len(items) else None
        signal.alarm(HANG)
        try:
            reports = runtestprotocol(item, log=False, nextitem=following)
        except BaseException:  # noqa: BLE001 - whatever it is, somebody noticed
            return {"by": item.nodeid, "tried": at + 1}
        finally:
            signal.alarm(0)
        if hangs or any(report.failed for report in reports):
            return {"by": item.nodeid, "tried": at + 1}
        if time.perf_counter() - start > PATIENCE:
            return {"by": None, "tried": at + 1, "of": len(items)}
    return {"by": None, "tried": len(items)}


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add what the campaign hands over."""
    parser.addoption("--faults", nargs=2, metavar=("WORK", "OUT"))
    parser.addoption("--fresh", action="store_true", help="the file on the disk has the fault already")


def pytest_configure(config: pytest.Config) -> None:
    """Take the place of the loop that runs tests."""
    if asked := config.getoption("faults"):
        config.pluginmanager.register(Faulty(Path(asked[0]), Path(asked[1]), fresh=config.getoption("fresh")))

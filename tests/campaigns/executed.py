"""Records which test executes which block of the source: a plugin of pytest, `-p campaigns.executed --executed FOLDER`.

Every block of a function (its body, a branch, a loop, a handler) is compiled with one statement that sets a byte. The
bytes lie in a file that a worker shares with the processes which its tests start, so that commands and killed programs
count too. What a fixture or a cached function executed counts for every test that uses its result. Coverage with a
context for each test takes 1.7 times as long as the tests; this takes no longer than they do.
"""

from __future__ import annotations

import functools
import os
import sysconfig
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from campaigns import marked
from campaigns.marked import BYTES, INDEX, ROOT, SIZE, SOURCE, prepare, start

STARTER = "crankwork-executed.pth"


class Recorder:
    """The plugin: what is executed between two moments, by test, fixture and cached function."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.index = folder, prepare(folder)
        self.found: dict[str, Any] = {}
        self.seconds: dict[str, float] = {}
        self.of_fixture: dict[Any, Any] = {}
        # how often numbers were taken, so that a cached function counts once in between
        self.taken = 0
        name = folder / f"bytes-{os.getpid()}"
        name.write_bytes(bytes(SIZE))
        os.environ[BYTES], os.environ[INDEX] = str(name), str(self.index)
        self.view = np.frombuffer(start(), np.uint8)
        _start_with_python()
        self._record_caches()

    def take(self) -> Any:
        """Return the numbers of blocks executed since the last call."""
        # of a copy, because a program that a test started may still write
        numbers = np.flatnonzero(self.view.copy())
        self.view[numbers] = 0
        self.taken += 1
        return numbers

    def count(self, numbers: Any) -> None:
        """Count blocks as executed now."""
        self.view[numbers] = 1

    def _record_caches(self) -> None:
        own = functools.lru_cache

        def cached(maxsize: Any = 128, typed: bool = False) -> Any:
            if callable(maxsize):
                return recorded(maxsize, own(128, typed)(maxsize))
            return lambda function: recorded(function, own(maxsize, typed)(function))

        def recorded(function: Any, kept: Any) -> Any:
            if not _is_ours(function):
                return kept
            executed: dict[Any, Any] = {}
            counted: dict[Any, int] = {}

            @functools.wraps(function)
            def called(*arguments: Any, **named: Any) -> Any:
                key = (arguments, tuple(named.items())) if named else arguments
                if key in executed:
                    if counted.get(key) != self.taken:
                        self.count(executed[key])
                        counted[key] = self.taken
                    return kept(*arguments, **named)
                before = self.take()
                try:
                    return kept(*arguments, **named)
                finally:
                    executed[key] = self.take()
                    self.count(before)
                    self.count(executed[key])

            called.cache_info, called.cache_clear = kept.cache_info, kept.cache_clear  # type: ignore[attr-defined]
            return called

        functools.lru_cache = cached  # type: ignore[assignment]
        functools.cache = cached(None)  # type: ignore[assignment]

    def pytest_collection_finish(self) -> None:
        """Let every formula be read before a test begins: who first asks what it is would count as its caller."""
        from rules import every_formula

        for formula in every_formula().values():
            _ = formula.arguments, formula.is_root

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any) -> Generator[None, Any, Any]:
        """Keep what a fixture executes."""
        before = self.take()
        try:
            return (yield)
        finally:
            self.of_fixture[fixturedef] = own = self.take()
            self.count(before)
            self.count(own)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: Any) -> Generator[None, Any, Any]:
        """Keep what a test executes, with its fixtures."""
        self.take()
        result = yield
        info = getattr(item, "_fixtureinfo", None)
        for definitions in info.name2fixturedefs.values() if info else ():
            for one in definitions:
                self.count(self.of_fixture.get(one, _NONE))
        self.found[item.nodeid] = self.take()
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep how long a test takes."""
        self.seconds[report.nodeid] = self.seconds.get(report.nodeid, 0.0) + report.duration

    def pytest_sessionfinish(self) -> None:
        """Write what was found."""
        if not self.found:
            return
        names = sorted(self.found)
        blocks = [self.found[name] for name in names]
        np.savez_compressed(
            self.folder / f"part-{os.getpid()}",
            lengths=[len(one) for one in blocks],
            blocks=np.concatenate(blocks).astype(np.uint32),
            seconds=[self.seconds.get(name, 0.0) for name in names],
            tests=np.frombuffer("\n".join(names).encode(), np.uint8),
        )
        (self.folder / "index").write_text(str(self.index), "utf-8")


_NONE = np.empty(0, np.intp)


def _is_ours(function: Any) -> bool:
    file = getattr(getattr(function, "__code__", None), "co_filename", "")
    return file.startswith((str(SOURCE), str(ROOT / "tests")))


def _start_with_python() -> None:
    """Let the processes that tests start record too, as long as their environment names the file of bytes."""
    names = {"__name__": "crankwork_marked", "__file__": marked.__file__}
    code = f"import os; names = {names!r}; exec(open(names['__file__']).read(), names) or names['start']()"
    file = Path(sysconfig.get_path("purelib")) / STARTER
    file.write_text(f"import os; {BYTES!r} in os.environ and exec({code!r})\n", "utf-8")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the folder in which the records are kept."""
    parser.addoption("--executed", metavar="FOLDER", help="record which test executes which block of the source")


@pytest.hookimpl(tryfirst=True)
def pytest_load_initial_conftests(early_config: pytest.Config) -> None:
    """Begin before anything of ours is imported; the process that only leads others records nothing."""
    options = early_config.known_args_namespace
    leads = bool(getattr(options, "numprocesses", None)) and "PYTEST_XDIST_WORKER" not in os.environ
    if options.executed and not leads:
        folder = Path(options.executed).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        early_config.pluginmanager.register(Recorder(folder), "executed-recorder")


def parts(folder: Path) -> Iterator[tuple[str, Any, float]]:
    """Yield tests with the numbers of the blocks that they execute, and their seconds."""
    for path in sorted(folder.glob("part-*.npz")):
        with np.load(path) as kept:
            names = kept["tests"].tobytes().decode().split("\n")
            ends = np.cumsum(kept["lengths"])
            for name, end, length, seconds in zip(names, ends, kept["lengths"], kept["seconds"], strict=True):
                yield name, kept["blocks"][end - length : end], float(seconds)

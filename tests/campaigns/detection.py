"""Counts which of a few hundred faults the tests find: `scripts/campaign faults`.

Faults are drawn from the syntax tree with the commit as seed (`faults.py`). Each is tried on the tests that execute its
place (`executed.py`), first those of scripts/test, then the rest (`faulty.py`). What is found is kept at once, and a
campaign that was stopped goes on. `--tests REVISION` asks the tests of another revision about the same faults.
"""

from __future__ import annotations

import argparse
import functools
import json
import os
import pickle
import re
import shutil
import subprocess
import sys
import time
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from campaigns.executed import parts
from campaigns.faults import TEXT, Fault, drawn
from campaigns.faulty import PATIENCE, in_turn
from campaigns.marked import ROOT, SOURCE

CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "crankwork"
WORKERS = os.cpu_count() or 1
EQUIVALENT = Path(__file__).parent / "equivalent.toml"


class Map(NamedTuple):
    """Which tests execute which blocks, and how long they take."""

    blocks: list[tuple[str, int, int]]
    tests: dict[int, list[str]]
    seconds: dict[str, float]

    @classmethod
    def read(cls, folder: Path) -> Map:
        """Return the map that was recorded in a folder."""
        index = json.loads(Path((folder / "index").read_text("utf-8")).read_text("utf-8"))
        tests: dict[int, list[str]] = defaultdict(list)
        seconds = {}
        for name, numbers, length in parts(folder):
            seconds[name] = length
            for number in numbers:
                tests[int(number)].append(name)
        return cls([tuple(one) for one in index], tests, seconds)

    def of(self, fault: Fault) -> list[str]:
        """Return the tests that may find a fault: those that execute its innermost block, or anything of its file."""
        in_file = [(last - first, at) for at, (name, first, last) in enumerate(self.blocks) if name == fault.file]
        around = [(size, at) for size, at in in_file if self.blocks[at][1] <= fault.line <= self.blocks[at][2]]
        numbers = [min(around)[1]] if around else [at for _, at in in_file]
        found = {name for at in numbers for name in self.tests.get(at, ())}
        if not found:  # executed before a test begins, or by none
            found = {name for _, at in in_file for name in self.tests.get(at, ())}
        if not around:
            # who looks through tables and formulas calls none of them
            found |= {name for name in self.seconds if name.startswith("tests/architecture/")}
        # a table has no functions, and texts are read by whoever says something
        return in_turn(sorted(found) if numbers else sorted(self.seconds), self.seconds)


def copy_of(place: Path, tests: str | None) -> Path:
    """Return a copy of the repository, with the tests of another revision if one is named."""
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    ).stdout.decode()
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, place / name)
    if tests is not None:
        shutil.rmtree(place / "tests")
        with subprocess.Popen(["git", "archive", tests, "tests"], cwd=ROOT, stdout=subprocess.PIPE) as archive:
            subprocess.run(["tar", "x"], cwd=place, stdin=archive.stdout, check=True)
        shutil.copytree(ROOT / "tests/campaigns", place / "tests/campaigns", dirs_exist_ok=True)
    (place / ".venv").symlink_to(ROOT / ".venv")
    return place


def run(place: Path, work: Sequence[tuple[Fault, Sequence[str]]], out: Path, *, fresh: bool) -> subprocess.Popen[bytes]:
    """Start a process that tries faults in a copy of the repository."""
    handed = place / "work"
    handed.write_bytes(pickle.dumps([(fault, list(names)) for fault, names in work]))
    files = sorted({name.partition("::")[0] for _, names in work for name in names})
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "campaigns.faulty", "-n0", "--tb=no"]
    words += ["--faults", str(handed), str(out), *(["--fresh"] if fresh else []), *files]
    own = {"PYTHONPATH": f"{place / 'src'}:{place / 'tests'}", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    log = (place / "log").open("ab")
    return subprocess.Popen(words, cwd=place, env=os.environ | own, stdout=log, stderr=log, stdin=subprocess.DEVNULL)


class Campaign:
    """Faults, the tests that may find each, and what was found so far."""

    def __init__(self, folder: Path, faults: Sequence[Fault], known: Map, tests: str | None) -> None:
        self.folder, self.faults, self.known = folder, faults, known
        self.folder.mkdir(parents=True, exist_ok=True)
        self.copies = [copy_of(folder / f"copy-{number}", tests) for number in range(WORKERS)]

    def found(self) -> list[dict[str, Any]]:
        """Return what was found so far, with the part of the tests after which its file is named."""
        return [
            json.loads(line) | {"part": path.stem.partition("-")[0]}
            for path in sorted(self.folder.glob("*.jsonl"))
            for line in path.read_text("utf-8").splitlines()
        ]

    def by(self) -> dict[str, str]:
        """Return the part of the tests that finds each fault which is found."""
        return {line["fault"]: line["part"] for line in reversed(self.found()) if line["by"] is not None}

    def out(self, part: str) -> Path:
        """Return a new file for what is found on a part of the tests."""
        path = self.folder / f"{part}-{time.time_ns()}.jsonl"
        path.touch(exist_ok=False)
        return path

    def try_part(self, part: str, allowed: set[str]) -> None:
        """Try the faults that the parts before did not find on the tests of a part."""
        by, done = self.by(), {line["fault"] for line in self.found() if line["part"] == part}
        waiting = [one for one in self.faults if one.name not in by and one.name not in done]
        asked = {one.name: [name for name in self.known.of(one) if name in allowed] for one in self.faults}
        running = []
        for at, place in enumerate(self.copies):
            if mine := waiting[at::WORKERS]:
                out = self.out(part)
                running.append(run(place, [(one, asked[one.name]) for one in mine], out, fresh=False))
        if sum(process.wait() for process in running):
            raise SystemExit(f"the tests did not run; see {self.copies[0] / 'log'}")
        by, tried = self.by(), [line for line in self.found() if line["part"] == part]
        outside = {line["fault"] for line in tried if line.get("outside")} - {
            line["fault"] for line in tried if line["fresh"]
        }
        self._try_fresh(part, [one for one in self.faults if one.name in outside and one.name not in by], asked)

    def verify(self) -> None:
        """Try what nothing found once more on all tests, in processes that begin with the changed file."""
        by, done = self.by(), {line["fault"] for line in self.found() if line["part"] == "rest" and line["fresh"]}
        waiting = [one for one in self.faults if one.name not in by and one.name not in done]
        self._try_fresh("rest", waiting, {one.name: self.known.of(one) for one in waiting})

    def _try_fresh(self, part: str, waiting: Sequence[Fault], asked: Mapping[str, Sequence[str]]) -> None:
        """Try faults in processes that begin with the changed file, as many at once as there are copies."""
        tasks = [(one, self._at_first(one, asked[one.name])) for one in waiting]
        asked_of = {fault.name: names for fault, names in tasks}
        running: dict[int, tuple[subprocess.Popen[bytes], Fault, bytes, Path]] = {}
        while tasks or running:
            for at in set(range(WORKERS)) - running.keys():
                if not tasks:
                    break
                fault, names = tasks.pop(0)
                path = self.copies[at] / "src/crankwork" / fault.file
                before = path.read_bytes()
                path.write_bytes(fault.put_into(before))
                out = self.out(part)
                running[at] = run(self.copies[at], [(fault, names)], out, fresh=True), fault, before, out
            pid, _ = os.waitpid(-1, 0)
            at = next(number for number, (process, *_) in running.items() if process.pid == pid)
            _, fault, before, out = running.pop(at)
            (self.copies[at] / "src/crankwork" / fault.file).write_bytes(before)
            if not out.stat().st_size:  # nothing could be collected with it
                out.write_text(json.dumps({"fault": fault.name, "fresh": True, "by": "collection"}) + "\n", "utf-8")
                continue
            by = json.loads(out.read_text("utf-8"))["by"]
            if by in asked_of[fault.name] and not self._is_sound(by, at):
                out.unlink()
                asked_of[fault.name] = [name for name in asked_of[fault.name] if name != by]
                tasks.append((fault, asked_of[fault.name]))

    @functools.cache  # noqa: B019 - one campaign a process
    def _is_sound(self, test: str, at: int) -> bool:
        """Return whether a test passes in a copy without a fault."""
        place = self.copies[at]
        words = [sys.executable, "-m", "pytest", "-q", "-n0", "-p", "no:cacheprovider", test]
        own = {"PYTHONPATH": f"{place / 'src'}:{place / 'tests'}"}
        return not subprocess.run(words, cwd=place, env=os.environ | own, capture_output=True, check=False).returncode

    def _at_first(self, fault: Fault, names: Sequence[str]) -> list[str]:
        """Return the tests that are tried; who looks through all texts finds one that is missing."""
        told = [name for name in names if fault.kind == TEXT and "/locale/" in name]
        ordered, gone = [*told, *(name for name in names if name not in set(told))], 0.0
        taken = []
        for name in ordered:
            gone += self.known.seconds.get(name, 0.0) + 0.01
            if gone > PATIENCE and taken:
                break
            taken.append(name)
        return taken


def table(faults: Sequence[Fault], by: Mapping[str, str], rows: str) -> Iterator[str]:
    """Yield a table of who finds the faults, by `kind` or `package`."""
    yield f"| {rows} | faults | found by scripts/test | only by --all | by nothing | equivalent |"
    yield "|---|---|---|---|---|---|"
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for one in faults:
        counts[getattr(one, rows)][by[one.name]] += 1
        counts["all"][by[one.name]] += 1
    for name in [*sorted(counts.keys() - {"all"}), "all"]:
        found = counts[name]
        columns = (found.total(), found["light"], found["rest"], found[""], found["equivalent"])
        yield f"| {name} | " + " | ".join(map(str, columns)) + " |"


def recorded(folder: Path, tests: str | None) -> Path:
    """Return the folder of the map of the tests, recorded with all of them if it is not there."""
    if not (folder / "index").exists():
        place = copy_of(folder.parent / "recording", tests)
        words = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            "-n",
            str(WORKERS),
            "--dist",
            "worksteal",
        ]
        words += ["-p", "campaigns.executed", "--executed", str(folder)]
        own = {"PYTHONPATH": f"{place / 'src'}:{place / 'tests'}"}
        subprocess.run(words, cwd=place, env=os.environ | own, check=False, stdin=subprocess.DEVNULL)
    return folder


def light_tests(place: Path) -> set[str]:
    """Return the names of the tests of scripts/test."""
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-n0", "--collect-only", "--part", "light"]
    own = {"PYTHONPATH": f"{place / 'src'}:{place / 'tests'}"}
    told = subprocess.run(words, cwd=place, env=os.environ | own, capture_output=True, text=True, check=False)
    if told.returncode:
        raise SystemExit(f"the tests cannot be collected:\n{told.stdout}{told.stderr}")
    return {line for line in told.stdout.splitlines() if "::" in line}


def main() -> int:
    """Run or go on with a campaign; 1 if a fault is found by nothing and is not listed as equivalent."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200, help="faults at least")
    parser.add_argument("--seed", help="a commit; the newest otherwise")
    parser.add_argument("--tests", metavar="REVISION", help="ask the tests of another revision")
    parser.add_argument("--map", type=Path, help="the folder of a recorded map")
    parser.add_argument("--only", metavar="TEXT", help="faults whose names match, or a file with their names")
    parser.add_argument("--verbose", action="store_true", help="tell by which test each fault is found")
    arguments = parser.parse_args()
    newest = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    head = newest.stdout.strip()
    seed = arguments.seed or head
    faults = drawn(SOURCE, seed, arguments.count)
    if arguments.only:
        listed = Path(arguments.only)
        names = set(listed.read_text("utf-8").split()) if listed.is_file() else set()
        faults = [one for one in faults if one.name in names or (not names and re.search(arguments.only, one.name))]
    asked = (arguments.tests or head)[:12]
    known = Map.read(recorded(arguments.map or CACHE / f"executed-{asked}", arguments.tests))
    name = f"faults-{seed[:12]}" + (f"-{asked}" if arguments.tests else "")
    campaign = Campaign(CACHE / name, faults, known, arguments.tests)
    if arguments.tests:
        campaign.try_part("light", set(known.seconds))
    else:
        light = light_tests(campaign.copies[0])
        campaign.try_part("light", light)
        campaign.try_part("rest", set(known.seconds) - light)
        campaign.verify()
    equivalent = tomllib.loads(EQUIVALENT.read_text("utf-8")) if EQUIVALENT.exists() else {}
    found = campaign.by()
    by = {one.name: found.get(one.name, "equivalent" if one.name in equivalent else "") for one in faults}
    lines = [*table(faults, by, "kind"), "", *table(faults, by, "package"), ""]
    for one in faults:
        if not by[one.name]:
            before = (SOURCE / one.file).read_bytes()[one.start : one.end].decode()
            lines.append(f"found by nothing: {one.name}: {before} -> {one.instead}")
    if arguments.verbose:
        lines += [f"{line['fault']}: {line['part']}: {line['by']}" for line in campaign.found() if line["by"]]
    sys.stdout.write("\n".join(lines) + "\n")
    return int(not all(by.values()))


if __name__ == "__main__":
    sys.exit(main())

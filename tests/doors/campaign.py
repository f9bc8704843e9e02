"""Reads and analyses machine files by the thousand, hostile ones or plausible ones, and counts how they end.

`scripts/campaign hostile` and `plausible` run many of them, `test_campaign.py` a few.
"""

from __future__ import annotations

import argparse
import collections
import json
import multiprocessing
import re
import resource
import runpy
import signal
import sys
import time
import traceback
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import read_machine
from crankwork.errors import CrankworkError, InputError
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of, sheets_of, written_note
from crankwork.report.results_folder import results_folder
from crankwork.report.summary import description_text, summary_data, summary_text

hostile_file = runpy.run_path(str(Path(__file__).with_name("mutations.py")))["hostile_file"]
plausible_file = runpy.run_path(str(Path(__file__).with_name("plausible.py")))["plausible_file"]
NAME = "my.toml"
SECONDS, MEGABYTES = 10.0, 1000
# where progress is told
MOST_SECONDS = 120.0
_BEGAN = [0.0]
FAULTS = ("traceback", "warning", "hang", "memory", "silent", "message", "untold")
# of plausible files, every so many are written too: tables, figures, moving drawing, note
WRITTEN = 100
# what to write instead comes after a semicolon, or is said by an example
_FIX = re.compile(r"; |must (?:be|hold) .*(?:, for example|, like|in quotes|true or false)")
_ODD = re.compile(r"\b(?:nan|inf|None|NoneType|numpy|np\.|array)\b")


class Outcome(NamedTuple):
    """How a file ended: its kind, and what tells one fault from another."""

    kind: str
    detail: str = ""


class Hang(BaseException):
    """More processor time than a file may take; as with KeyboardInterrupt, nothing may catch it."""


def outcome(text: str, *, writes: bool = False) -> Outcome:
    """Read and analyse a machine file as the commands do, with warnings as errors and the clock running."""
    began = _peak()
    _BEGAN[0] = time.process_time()
    old = signal.signal(signal.SIGPROF, _alarm)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = _analysed(text)
            if writes and found.kind == "accepted":
                _write(text)
    except CrankworkError as error:
        found = _refused(error, text)
    except Hang as error:
        found = Outcome("hang", _where(error))
    except MemoryError as error:
        found = Outcome("memory", _where(error))
    except Warning as error:
        found = Outcome("warning", f"{_where(error)}: {error}")
    except Exception as error:  # noqa: BLE001 - this is what is looked for
        found = Outcome("traceback", f"{_where(error)}: {type(error).__name__}: {error}"[:200])
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, old)
    return Outcome("memory", "its peak") if _peak() > max(began, _AT_START + MEGABYTES) else found


def _peak() -> float:
    """The most memory that this process has had, in megabytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


_AT_START = _peak()


def _alarm(*_: object) -> None:
    raise Hang


def _goes_on(_: float) -> None:
    """Wait as long again from here, but not for ever: who sees progress may wait, or end it and keep what is there."""
    left = signal.getitimer(signal.ITIMER_PROF)[0]
    if left and time.process_time() - _BEGAN[0] < MOST_SECONDS:
        signal.setitimer(signal.ITIMER_PROF, SECONDS)


def plausible_outcome(seed: int, number: int) -> Outcome:
    """Read and analyse a plausible file; of one that locks or floats a part that does so must be told."""
    text, wrong, parts = plausible_file(seed, number)
    found = outcome(text, writes=number % WRITTEN == 0)
    if not wrong or found.kind in FAULTS:
        return found
    if found.kind != "refused":
        return Outcome("untold", f"{wrong}, and is {found.kind}")
    try:
        read_machine(text, NAME)
    except InputError as error:
        if not any(re.search(rf"\b{re.escape(part)}\b", line) for line in error.lines() for part in parts):
            return Outcome("untold", f"{wrong}: {_shape(error.lines()[0])}")
    return Outcome("refused", wrong)


def _analysed(text: str) -> Outcome:
    machine = read_machine(text, NAME)
    if machine.transfer is None:
        machine = replace(machine, table_step=30.0)
    results = analyse(machine, progress=_goes_on)
    description_text(results)
    summary_text(results)
    json.dumps(summary_data(results), allow_nan=False)
    wild = _not_finite(results)
    if wild and not results.notices:
        return Outcome("silent", f"not finite: {wild[0].partition('.')[0]}")
    unmet = getattr(results, "unmet", ())
    if unmet:
        return Outcome("not met", ", ".join(unmet))
    return Outcome("accepted")


def _write(text: str) -> None:
    """Write everything that there is of a machine, the slow drawings of a library not counted."""
    signal.setitimer(signal.ITIMER_PROF, 6 * SECONDS)
    results = analyse(read_machine(text, NAME))
    for _ in results_folder(results):
        pass
    for language in ("en", "ru"):
        options = NoteOptions(full=True, language=language)
        written_note(note_of(results, options), "note.html")
        # sheets show a turn of a crank
        if results.machine.mechanism.driver.law is None:
            sheets_of(results, replace(options, sheets=True))


def _not_finite(results: Results) -> list[str]:
    values: dict[str, Any] = {**results.columns, **results.summary, **results.checks}
    for name, listing in results.listings.items():
        values |= {f"{name} {key}": column for key, column in listing.columns.items()}
    return [
        key
        for key, one in values.items()
        if not np.all(np.isfinite(one) | (np.isnan(one) & any(part in key for part in _MAY_BE_ABSENT)))
    ]


# of bearings whose size is not stated, or with no rod along which their load reverses, of a link that never turns, of
# the last stage, behind which there is no cooler unless a final temperature is stated, of later stages whose clearance
# is not stated, of masses given by their moment, of the last disc, and where no torque is needed
_MAY_BE_ABSENT = (
    "bearing_loads bearing_pressure", "bearing_loads reversal_", "instant_centre_", "stages cooler_heat",
    "stages clearance_volumetric_efficiency", "planes plane_mass", "planes plane_radius", "holzer torsional_stiffness",
    "holzer shaft_twist",
    "instantaneous_efficiency",
)  # fmt: skip


def _refused(error: CrankworkError, text: str) -> Outcome:
    """A refusal names a place, says what is wrong, and what to write."""
    for line in error.lines() if isinstance(error, InputError) else [str(error)]:
        if re.fullmatch(rf"{NAME}: \d+ more mistakes; correct these first", line):
            continue
        if not re.match(rf"{NAME}:\d+: ", line):
            return Outcome("message", f"no place: {_shape(line)}")
        if not _FIX.search(line):
            return Outcome("message", f"no fix: {_shape(line)}")
        odd = _ODD.search(line)
        if odd and odd[0] not in text:
            return Outcome("message", f"odd word {odd[0]}: {_shape(line)}")
        if "\n" in line or len(line) > 1000:
            return Outcome("message", f"too long: {_shape(line)}")
    return Outcome("refused")


def _shape(line: str) -> str:
    """A message without place, names and numbers, which differ from file to file; of the key only its end."""
    key, mark, message = re.sub(rf"^{NAME}:\d+: ", "", line).partition(": ")
    key = re.sub(r"\[\d+\]", "[]", key) if mark else ""
    message = re.sub(r'"[^"]*"|-?\d[\d.e+-]*', "#", message or line)
    return f"{key.rpartition('.')[2]}: {message if len(message) < 80 else message[:40] + ' ... ' + message[-40:]}"


def _where(error: BaseException) -> str:
    """The innermost places of crankwork that an error came through."""
    frames = [one for one in traceback.extract_tb(error.__traceback__) if "crankwork" in Path(one.filename).parts]
    return " < ".join(
        f"{Path(one.filename).parent.name}/{Path(one.filename).name}:{one.lineno}" for one in frames[:-4:-1]
    )


def _limited() -> None:
    # what a file may take, and what the program and its libraries take before
    resource.setrlimit(resource.RLIMIT_DATA, ((MEGABYTES + 500) << 20, resource.RLIM_INFINITY))


def _case(which: tuple[bool, int, int]) -> tuple[int, Outcome, float]:
    started, (is_plausible, seed, number) = time.process_time(), which
    found = plausible_outcome(seed, number) if is_plausible else outcome(hostile_file(seed, number))
    return number, found, time.process_time() - started


def main() -> None:
    """Run many files, and keep the first of each class of fault."""
    parser = argparse.ArgumentParser(description="Read and analyse hostile machine files.")
    parser.add_argument("--plausible", action="store_true", help="random machines instead of mistakes")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first file")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for the first file of each class of fault")
    wanted = parser.parse_args()
    counts: collections.Counter[str] = collections.Counter()
    classes: collections.Counter[Outcome] = collections.Counter()
    slowest = (0.0, 0)
    started = time.monotonic()
    cases = [(wanted.plausible, wanted.seed, number) for number in range(wanted.first, wanted.first + wanted.count)]
    with multiprocessing.get_context("fork").Pool(wanted.workers, _limited, maxtasksperchild=500) as pool:
        for number, found, seconds in pool.imap_unordered(_case, cases, chunksize=10):
            counts[found.kind] += 1
            slowest = max(slowest, (seconds, number))
            if found.kind not in FAULTS and found.kind != "not met":
                continue
            classes[found] += 1
            if classes[found] == 1:
                sys.stdout.write(f"{found.kind} in file {number}: {found.detail}\n")
                sys.stdout.flush()
                if wanted.keep:
                    wanted.keep.mkdir(parents=True, exist_ok=True)
                    made = (
                        plausible_file(wanted.seed, number)[0]
                        if wanted.plausible
                        else hostile_file(wanted.seed, number)
                    )
                    name = f"{found.kind.replace(' ', '-')}-{number}.toml"
                    (wanted.keep / name).write_bytes(made.encode("utf-8", "surrogatepass"))
    sys.stdout.write("\nclasses\n" + "".join(f"{n:6} {one.kind}: {one.detail}\n" for one, n in classes.most_common()))
    sys.stdout.write("\noutcomes\n" + "".join(f"{n:6} {kind}\n" for kind, n in counts.most_common()))
    sys.stdout.write(f"slowest: file {slowest[1]}, {slowest[0]:.1f} s; all {time.monotonic() - started:.0f} s\n")
    sys.exit(any(counts[kind] for kind in FAULTS))


if __name__ == "__main__":
    main()

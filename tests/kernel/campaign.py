"""Compares compiled calculations with analyses, for machine files and for machines drawn by chance.

Some numbers of each machine are varied; every single value that compiles is compared at designs between those that
were traced. `test_campaign.py` runs a few; `scripts/campaign kernels --count 1000` many, `--rubbing` such with
friction, and `--known` machine files of the repository with numbers drawn by chance.
"""

from __future__ import annotations

import argparse
import collections
import math
import random
import runpy
import signal
import sys
import time
import tomllib
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import crankwork
from crankwork.analysis import Results, analyse
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.formula.cycle_interpolant import BEYOND
from crankwork.formula.replay import replay
from crankwork.formula.traced_value import (
    Arithmetic,
    FormulaCall,
    FunctionValue,
    ProcedureValue,
    Root,
    Sum,
    Tabulated,
    TracedValue,
    in_order,
)
from crankwork.kernel import compiled
from crankwork.kernel.compiled import CONVERGED, Kernel
from crankwork.kernel.lowering import DesignTraces, Lowering, NotCompiledError
from crankwork.kinematics.crank_grid import CrankGrid

_PLAUSIBLE = runpy.run_path(str(Path(__file__).parents[1] / "doors" / "plausible.py"))
plausible_file, written = _PLAUSIBLE["plausible_file"], _PLAUSIBLE["written"]
ROOT = Path(__file__).parents[2]
# of all tables: torsion, stages, measured pressure, clutches, friction
KNOWN = [
    path
    for folder in (
        ROOT / "examples",
        ROOT / "tests" / "machines",
        Path(crankwork.__file__).parent / "description" / "templates",
    )
    for path in sorted(folder.glob("*.toml"))
]
# how many numbers are varied, by how much of what they are, and how many designs are compared
FIELDS, PART, COMPARED = 2, 0.01, 3
# how far another design is from the stated one, in each number more
AWAY = 0.004
# How far values, sums over the cycle and angles of extremes or their ratios may be apart: beside their size, in rad.
LIMITS = {"value": 1e-12, "integral": 1e-10, "angle": 1e-7, "time": 1e-7, "iterated": 1e-9}
# how far a kernel may be from the designs that it was traced from, as in studies
SAME, NEAR_ANGLE = 1e-9, 1e-5
_INTEGRALS = ("flywheel", "excess", "energy", "rim", "whole_inertia", "work", "reduced_inertia_mean")
_SECONDS = 120
_NEAR_DEAD = 1e-6
# how far the angles at which laws end are from those of a design [deg]
_DECIMAL = 0.5e-9
_STEP = 1e-5


class Comparison(NamedTuple):
    """A machine compared: how many values compile, the worst of each kind, why the others do not.

    `left_out` and `near_dead` are designs left to analyses, and those nearer to a dead position than 1e-6; `values` how
    many were compared of each kind.
    """

    name: str
    compiled: int = 0
    worst: Mapping[str, tuple[float, str]] = {}
    left_out: int = 0
    reasons: Mapping[str, str] = {}
    absent: str = ""
    near_dead: int = 0
    values: Mapping[str, int] = {}

    @property
    def is_same(self) -> bool:
        """Whether all values are near enough."""
        return all(apart <= LIMITS[kind] for kind, (apart, _) in self.worst.items())


def numbers(description: Description) -> Iterator[tuple[str, NumericField]]:
    """Yield the numbers of a machine file that may vary, by their keys."""

    def leaves(of: Any, key: str) -> Iterator[str]:
        if isinstance(of, dict):
            for name, one in of.items():
                yield from leaves(one, f"{key}.{name}" if key else name)
        elif not isinstance(of, list):
            yield key

    values = description.values_with(())
    for key in leaves(values, ""):
        try:
            found = numeric_field(values, key)
        except (CrankworkError, ValueError):
            continue
        # between whole ratios a machine never returns to where it was, and has no harmonics
        if found.now and not (key.startswith("geared.") and key.endswith(".ratio")):
            yield key, found


def rubbing_text(seed: int, number: int) -> str:
    """Return a machine drawn by chance, with friction in some of its pins and guides that may lock it."""
    text = plausible_file(seed, number).text
    draw = random.Random(f"rubbing {seed}:{number}")  # noqa: S311 - the same every time
    try:
        summary = analyse(Description(text).machine()).summary
    except CrankworkError:
        return str(text)
    values = tomllib.loads(text)
    pins = [key.partition(".")[2] for key in summary if key.startswith("joint_force_max.")]
    sliders = ["piston"] if "rod" in values else list(values.get("sliders", {}))
    size = next((value for key, value in summary.items() if key.startswith("crank_radius")), 0.1)
    size = float(str(values.get("crank", {}).get("radius", f"{size * 1e3} mm")).split()[0])

    def some(names: Sequence[str]) -> list[str]:
        return draw.sample(names, min(len(names), draw.choice((1, 1, 2, 4))))

    def coefficient() -> float:
        return round(10 ** draw.uniform(-2.5, -0.3), 4)

    rubbing: dict[str, dict[str, Any]] = {
        "pins": {
            name: {"coefficient": coefficient(), "radius": f"{draw.uniform(0.02, 0.3) * size:.6g} mm"}
            | ({"moment": "0.2 N*m"} if draw.random() < 0.2 else {})
            for name in some(pins)
        },
        "sliders": {
            name: {"coefficient": coefficient()}
            | ({"length": f"{draw.uniform(0.3, 3) * size:.6g} mm"} if draw.random() < 0.5 else {})
            | ({"force": "15 N"} if draw.random() < 0.2 else {})
            for name in some(sliders)
        },
    }
    if draw.random() < 0.3:
        rubbing["circle"] = "sine"  # type: ignore[assignment]
    return str(written({**values, "friction": {key: one for key, one in rubbing.items() if one}}))


class Machine:
    """A machine and some of its numbers that vary: those named, or some drawn by chance.

    `part`: by how much of what they are; `away`: how far the design that they are varied from is from the stated one.
    """

    def __init__(
        self,
        description: Description,
        draw: random.Random,
        named: Sequence[str] = (),
        part: float = PART,
        away: float = 0.0,
    ) -> None:
        self.description, self.part = description, part
        self.stated = analyse(description.machine())
        self.fields: dict[str, NumericField] = {}
        self.traced = [self.stated]
        every = [one for one in numbers(description) if not named or one[0] in named]
        draw.shuffle(every)
        moved = {key: (number.now or 0) * (1 + away * (1 + index)) for index, (key, number) in enumerate(every)}
        self.moved = moved = moved if away else {}
        for key, number in every:
            self.fields[key] = number
            stated = moved.get(key, number.now or 0)
            try:
                self.traced += [self.results({**moved, key: stated * (1 + sign * part)}) for sign in (-1, 1)]
            except CrankworkError:
                del self.fields[key]
            if not named and len(self.fields) == FIELDS:
                break
        self.now = np.array([moved.get(key, one.now) for key, one in self.fields.items()])
        if away:
            self.stated = self.traced[0] = self.results(moved)

    def results(self, design: Mapping[str, float]) -> Results:
        """Return what an analysis gives for a design."""
        values = self.description.values_with(())
        settings = [Setting(key, key, numeric_field(values, key).written(value)) for key, value in design.items()]
        return analyse(self.description.machine(settings))

    @property
    def rows(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """What the numbers are in each design that is traced."""
        moved = [self.now * (1 + sign * self.part * one) for one in np.eye(self.now.size) for sign in (-1, 1)]
        return np.array([self.now, *moved])


def compared(name: str, text: str, seed: int = 1, named: Sequence[str] = ()) -> Comparison:
    """Compare what is compiled of a machine with analyses.

    Where designs around the stated one have other laws, designs close to another one are compared, as studies do.
    """
    found = _compared(name, text, seed, named)
    if not any(reason.startswith("ways") for reason in found.reasons.values()):
        return found
    elsewhere = _compared(name, text, seed, named, PART / 100, AWAY)
    return elsewhere if elsewhere.compiled > found.compiled else found


def _compared(
    name: str, text: str, seed: int, named: Sequence[str], part: float = PART, away: float = 0.0
) -> Comparison:
    try:
        drawn = random.Random(f"{name}:{seed}")  # noqa: S311 - the same every time
        machine = Machine(Description(text), drawn, named, part, away)
    except CrankworkError as error:
        return Comparison(name, absent=str(error).splitlines()[0])
    if not machine.fields:
        return Comparison(name, absent="no number that may vary")
    if any("crank_range" in one.summary for one in machine.traced):
        return Comparison(name, absent="turns back")
    traces, reasons = [one.trace for one in machine.traced], dict[str, str]()
    cycle, looked = machine.stated.machine.cycle, np.arange(0.5, 360, 7.0)
    designs = DesignTraces(traces, machine.rows, ())
    trace = Lowering(designs, CrankGrid.from_degrees, looked, is_shifted=True)
    for key in machine.stated.summary:
        try:
            designs.add(key)
            trace.value(traces[0][key])
        except NotCompiledError as error:
            reasons[key] = f"{error.reason}: {error.key}"
    keys = [key for key in machine.stated.summary if key not in reasons]
    if not keys:
        return Comparison(name, reasons=reasons)
    try:
        kernel = Kernel(traces, machine.rows, keys, CrankGrid.from_degrees, cycle=cycle)
    except NotCompiledError as error:
        # such designs are analysed one by one
        return Comparison(name, reasons=reasons | dict.fromkeys(keys, f"{error.reason}: {error.key}"))
    # studies look at such designs first, and analyse all others one by one where they differ
    unlike = _unlike(machine, kernel)
    reasons.update({key: f"differs: {key}" for key in unlike})
    known = Comparison(name, len(keys) - len(unlike), reasons=reasons)
    return _worst(known, machine, kernel, np.random.default_rng(seed), unlike)


def _unlike(machine: Machine, kernel: Kernel) -> set[str]:
    """Return the keys whose compiled values differ from the analyses that the kernel was traced from."""
    bulk, unlike = kernel(machine.rows.T), set[str]()
    limits = [NEAR_ANGLE if _kind(key) == "angle" else SAME for key in kernel.keys]
    size = np.nanmax(np.abs(bulk.values), axis=1) * limits
    for at, results in enumerate(machine.traced):
        if bulk.truncation_error[at] <= CONVERGED:
            for key, value, limit in zip(kernel.keys, bulk.values[:, at].tolist(), size.tolist(), strict=True):
                apart = _difference(key, value, results.summary.get(key, np.nan))
                # of a small difference of large numbers rounding is left
                if apart > limit and (_kind(key) != "value" or apart > SAME * _size_of(results.trace[key], results)):
                    unlike.add(key)
    return unlike


def _worst(  # noqa: C901 - what is left out, and what explains a difference
    found: Comparison, machine: Machine, kernel: Kernel, draw: np.random.Generator, left: Collection[str] = ()
) -> Comparison:
    """Return how far designs between those traced are apart at most."""
    designs = machine.now * (1 + machine.part * draw.uniform(-1, 1, (COMPARED, machine.now.size)))
    bulk, worst, left_out = kernel(designs.T), dict[str, tuple[float, str]](), 0
    near_dead, counted = 0, collections.Counter[str]()
    for at, design in enumerate(designs):
        if bulk.truncation_error[at] > CONVERGED or not np.isfinite(bulk.values[:, at]).all():
            left_out += 1
            continue
        try:
            results = machine.results(machine.moved | dict(zip(machine.fields, design.tolist(), strict=True)))
        except CrankworkError:
            continue
        if _from_dead_position(results.summary) < _NEAR_DEAD:
            near_dead += 1
            continue
        for key, value in zip(kernel.keys, bulk.values[:, at].tolist(), strict=True):
            if key in left:
                continue
            kind, summary = _kind(key), results.summary
            apart, size = _difference(key, value, summary.get(key, np.nan)), _size(key, summary)
            if not apart <= LIMITS[kind] * size:
                # of a small difference of large numbers rounding is left, and analyses stand a little behind a jump
                size = max(size, _size_of(results.trace[key], results))
                apart = max(apart - _behind_a_jump(results.trace[key]), 0.0)
            apart /= size
            if kind in ("angle", "time") and "ratio" not in key and not apart <= LIMITS[kind]:
                apart = _missed(key, value, results)
            if kind == "value" and not apart <= LIMITS[kind] and _is_iterated(results.trace[key]):
                kind = "iterated"
            counted[kind] += 1
            if not apart <= worst.get(kind, (-1.0, ""))[0]:
                worst[kind] = apart, f"{key}: {summary.get(key)!r} and {value!r}"
    return found._replace(worst=worst, left_out=left_out, near_dead=near_dead, values=counted)


def _difference(key: str, value: float, expected: float) -> float:
    """Return how far a value is from another; half a turn forward is half a turn back."""
    apart = abs(value - expected)
    return abs(math.remainder(apart, 2 * math.pi)) if key.endswith("_angle") and math.isfinite(apart) else apart


def _from_dead_position(summary: Mapping[str, float]) -> float:
    """Return how far a linkage stays from links in line, and from a guide across its link. [rad]"""
    away = [min(value, math.pi - value) for key, value in summary.items() if key.startswith("transmission_angle")]
    away += [math.pi / 2 - value for key, value in summary.items() if key.startswith("pressure_angle")]
    return min(away, default=math.inf)


def _size_of(known: TracedValue, results: Results) -> float:
    """Return the size of the numbers that a single value is the sum or difference of: what rounding goes by."""
    node = known.node
    match node:
        case ProcedureValue(operands=operands) if any(one.varies for one in operands):
            sizes = [float(np.max(np.abs(replay(one, results.grid) if one.varies else one.value))) for one in operands]
            # what a function finds has a unit of its own
            return abs(known.value) if isinstance(node, FunctionValue) else math.prod(sizes)
        case ProcedureValue(general_form=TracedValue() as formed):
            return _size_of(formed, results)
        case ProcedureValue(operands=operands):
            return max([abs(known.value), *(_size_of(one, results) for one in operands)])
        case FormulaCall() | Arithmetic():
            function = node.formula.function if isinstance(node, FormulaCall) else node.function
            inputs = [one.value if isinstance(one, TracedValue) else one for one in node.inputs]
            found = abs(known.value)
            for at, one in enumerate(node.inputs):
                if isinstance(one, TracedValue):
                    beside = [value + 1e-30j * (at == place) for place, value in enumerate(inputs)]
                    found += abs(np.imag(function(*beside)) / 1e-30) * _size_of(one, results)
            return float(found)
        case Sum(operands=operands):
            return sum(_size_of(one, results) for one in operands)
    return 0.0 if known.varies else abs(known.value)


def _is_iterated(known: TracedValue) -> bool:
    """Return whether a value follows from forces with friction or from a pressure calculated step by step."""
    return any(isinstance(one.node, Root | Tabulated) for one in in_order([known]))


def _behind_a_jump(known: TracedValue) -> float:
    """Return by how much an extreme may change where an analysis stands beside the angle at which a law begins."""
    node = known.node
    if not isinstance(node, ProcedureValue) or node.at is None or node.word not in ("max", "min"):
        return 0.0
    before, there, behind = replay(
        node.operands[0], CrankGrid.from_degrees([node.at - _STEP, node.at, node.at + _STEP])
    ).tolist()
    # it is behind an end, which has so many decimals
    return (abs(behind - there) * 2 * BEYOND + max(abs(before - there), abs(behind - there)) * _DECIMAL) / _STEP


def _kind(key: str) -> str:
    word = key.partition(".")[0]
    if word.endswith(("_max_angle", "_min_angle", "time_ratio")):
        return "angle"
    if word.endswith(("_max_time", "_min_time")):
        return "time"
    return "integral" if word.startswith(_INTEGRALS) else "value"


def _size(key: str, summary: Mapping[str, float]) -> float:
    """Return the size of a value: that of the column whose largest or least it is."""
    if _kind(key) == "angle":
        return 1.0
    word, dot, name = key.partition(".")
    ends = [word.removesuffix(one) for one in ("_max", "_min") if word.endswith(one)]
    both = [f"{one}_{end}{dot}{name}" for one in ends for end in ("max", "min")]
    return max((abs(summary[one]) for one in (*both, key) if one in summary), default=0.0) or 1.0


def _missed(key: str, angle: float, results: Results) -> float:
    """Return how far the largest of a column is from its value at another angle or time."""
    word, dot, name = key.partition(".")
    place = angle if word.endswith("_time") else math.degrees(angle)
    word = word.removesuffix("_angle").removesuffix("_time")
    end, extreme = word.rpartition("_")[0], f"{word}{dot}{name}"
    return abs(results.value(f"{end}{dot}{name}", place) - results.summary[extreme]) / _size(extreme, results.summary)


def _plain_text(seed: int, number: int) -> str:
    return str(plausible_file(seed, number).text)


def told(*what: object) -> None:
    """Write a line, at once."""
    sys.stdout.write(" ".join(map(str, what)) + "\n")
    sys.stdout.flush()


def _late(*_: object) -> None:
    raise TimeoutError


def main() -> int:  # noqa: C901 - options, and what is counted
    """Compare many, print what is apart, and return how many are."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*")
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--vary", type=lambda one: one.split(","), default=(), help="numbers by key, commas between")
    parser.add_argument("--rubbing", action="store_true", help="with friction")
    parser.add_argument("--known", action="store_true", help="machine files of the repository, their numbers by chance")
    parser.add_argument("--arrays", action="store_true", help="do not compile the loops")
    parser.add_argument("--reasons", action="store_true", help="print why values are not compiled")
    asked = parser.parse_args()
    if asked.arrays:
        compiled.compiles = lambda: False
    jobs: list[tuple[str, Callable[[], str]]] = [(one, Path(one).read_text) for one in asked.files]
    for at in range(asked.first, asked.count):
        path = KNOWN[at % len(KNOWN)]
        name = f"{asked.seed}:{at}" + f" {path.stem}" * asked.known
        text = path.read_text if asked.known else partial(rubbing_text, asked.seed, at)
        jobs.append((name, text if asked.known or asked.rubbing else partial(_plain_text, asked.seed, at)))
    counted, reasons, apart = collections.Counter[str](), collections.Counter[str](), 0
    worst = dict[str, tuple[float, str]]()
    warnings.simplefilter("ignore")
    # of this process, whatever else the machine does
    signal.signal(signal.SIGPROF, _late)
    began = time.monotonic()
    for name, text in jobs:
        signal.setitimer(signal.ITIMER_PROF, _SECONDS)
        try:
            found = compared(name, text(), asked.seed, asked.vary)
        except (Exception, TimeoutError) as error:  # noqa: BLE001 - counted and told
            found = Comparison(name, worst={"value": (np.inf, f"{type(error).__name__}: {error}")})
        signal.setitimer(signal.ITIMER_PROF, 0)
        counted["absent" if found.absent else "compiled" if found.compiled else "not compiled"] += 1
        counted.update({"keys": found.compiled, "other keys": len(found.reasons), "left out": found.left_out})
        counted.update({"near dead": found.near_dead, **found.values})
        for kind, one in found.worst.items():
            if found.is_same:
                worst[kind] = max(worst.get(kind, (0.0, "")), (one[0], f"{name} {one[1]}"))
        reasons.update({one.partition(":")[0] for one in found.reasons.values()})
        if not found.is_same or asked.files:
            apart += not found.is_same
            told(name, found.absent, found.compiled, len(found.reasons), found.left_out, dict(found.worst))
        if asked.reasons:
            for key, reason in found.reasons.items():
                told("   ", key, reason)
    for kind, one in worst.items():
        told(kind, *one)
    told(f"{len(jobs)} machines in {time.monotonic() - began:.0f} s, {apart} apart; {dict(counted)}; {dict(reasons)}")
    return min(apart, 100)


if __name__ == "__main__":
    sys.exit(main())

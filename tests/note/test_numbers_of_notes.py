"""Every number that a note prints in a table or an equation is one that the results hold."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

import numpy as np
import pytest

from crankwork.analysis import Results
from crankwork.analysis.all_cylinders import with_engine_results
from crankwork.analysis.rounding_noise import summary_without_rounding
from crankwork.formula.calculation_lines import FormulaLine, Snapshot
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Piecewise, ProcedureValue, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.document import Equation, Note, Table
from crankwork.note.material import Material
from crankwork.note.options import NoteOptions
from crankwork.note.tables import folded
from crankwork.quantities import QUANTITIES, base_key
from crankwork.report.display import key_unit, reader_units
from crankwork.units import from_si, use_units
from note.built import broken, every_machine, note, results, schools, traced

NUMBER = re.compile(r"[-−]?\d+([.,]\d+)?(·10\^?\{?[-−]?\d+\}?|[eE][-+−]?\d+)?")
# numbers of rows, that is of positions and cylinders, and columns too short to tell one from another
SHORT = 3
# Tables whose numbers no memory holds yet, by their label, and why. The list only shrinks.
NOT_HELD = {
    "t:compared_velocities": "what is read on a plan, and lengths on paper",
    "t:compared_accelerations": "what is read on a plan, and lengths on paper",
    "gear_ratios": "speeds of motors, which test_gear_ratios_are_those_of_motors_with_slip holds",
    "t:plan_velocities": "lengths on paper",
    "t:plan_accelerations": "lengths on paper",
    "transfer": "sizes of transfer functions are made for the table from those of the points",
    "t:transfer": "as they are given, in metres",
    "reduced": "the parts of a tabulated reduced inertia are unnamed terms of one sum",
    "t:inertia_loads": "sizes of forces with parts along axes; test_inertia_forces_are_masses_times_accelerations",
    "t:polytropes": "the polytropes run over the volume, not over the crank angle",
    "t:on_journal": "forces on throws at one angle, and their shares",
    "t:errors": "an error as a share of the largest value",
    "t:total": "the total torque as a tangential force per piston area",
    "t:cycle_data": "heat release is integrated, not remembered",
}
# in SI, or of the largest operand beside it: what is printed as zero
NOISE = 1e-15


def read(cell: object) -> tuple[float, float] | None:
    """Return a printed number and half a unit of its last place."""
    if not isinstance(cell, str) or not NUMBER.fullmatch(cell.strip()):
        return None
    written = re.sub(r"·10\^?\{?([-−]?\d+)\}?", r"e\1", cell.strip()).replace("−", "-").replace(",", ".")
    mantissa, _, power = written.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(written), 0.5 * 10.0 ** (int(power or 0) - decimals) * (1 + 1e-9)


def printed_columns(table: Table) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield the columns of a table that hold numbers only, as printed, with half a unit of the last place."""
    for cells in zip(*table.rows, strict=True):
        found = [read(one) for one in cells if one != ""]
        if len(found) > SHORT and all(one is not None for one in found):
            values, halves = np.array(found, dtype=float).T
            yield values, halves


def in_units(key: str, value: np.ndarray, area: float | None) -> Iterator[np.ndarray]:
    """Yield values in the unit of tables, and that per piston area; as they are what has no unit."""
    if base_key(key) not in QUANTITIES:
        yield value
    else:
        yield from_si(value, key_unit(key))
        if area is not None:
            yield from_si(value / area, key_unit(key, per_area=True))


class Held:
    """Everything that results hold: columns at the crank angles of tables, and single values."""

    def __init__(self, results: Results) -> None:
        area = results.trace["piston_area"].value if "piston_area" in results.trace else None
        known = {one.key: one for one in in_order(results.trace.values())} | dict(results.trace)
        varying = {key: one for key, one in known.items() if one.varies and key.partition(".")[0] in QUANTITIES}
        listed = [one for listing in results.listings.values() for one in listing.columns.items()]
        listed += results.columns.items()
        if not results.has_positions:
            whole = range(0, round(results.machine.cycle) + 1, 30)
            grids = [results.grid, CrankGrid.from_degrees(list(whole))]
            if getattr(results.solved, "space", None) is not None:
                named = sorted(results.solved.space.diagram.named.values())
                grids.append(CrankGrid.from_degrees([at for at, _ in named]))
                # where a pressure jumps a point has that before it
                listed.append(("diagram_pressure", np.array([pressure for _, pressure in named])))
            for grid in grids:
                listed += Program(varying)(grid).items()
            listed += [("crank_angle", grid.angle) for grid in grids]
        columns = [one for key, column in listed for one in in_units(key, np.asarray(column, dtype=float), area)]
        # one below the other, with where each ends
        self.column, sizes = np.concatenate(columns), [one.size for one in columns]
        self.ends = np.repeat(np.cumsum(sizes), sizes)
        every = list(in_order(results.trace.values()))
        single = [(one.key, one.value) for one in every if not one.varies]
        reached = [one.node.at for one in every if isinstance(one.node, ProcedureValue)]
        single += [("", at) for at in reached if at is not None]
        laws = [one.node for one in every if isinstance(one.node, Piecewise)]
        single += [("", end) for law in laws for end in (0.0, *law.ends.tolist(), results.machine.cycle)]
        single += [*results.summary.items(), *results.checks.items()]
        single += [("", 100 * one) for key, one in results.summary.items() if key.startswith("heat_share")]
        single += [
            (key, one) for listing in results.listings.values() for key, some in listing.columns.items() for one in some
        ]
        shown = (np.atleast_1d(one) for key, value in single for one in in_units(key, np.float64(value), area))
        self.values = np.sort(np.concatenate(list(shown)))

    def has(self, values: np.ndarray, halves: np.ndarray) -> bool:
        """Return whether printed numbers are a stretch of a column, single values each, or numbers of rows."""
        if np.all(values == values[0] + np.arange(values.size)) and values[0] in (0, 1, 2):
            return True
        starts = np.flatnonzero(np.abs(self.column - values[0]) <= halves[0])
        for start in starts[starts + values.size <= self.ends[starts]]:
            if np.all(np.abs(self.column[start : start + values.size] - values) <= halves):
                return True
        near = np.searchsorted(self.values, [values - halves, values + halves])
        return bool(np.all(near[1] > near[0]))


def not_held_in_tables(case: str) -> list[tuple]:
    """Return the columns of tables that the results do not hold, as two schools have them."""
    found = results(case)
    with use_units(reader_units(found)):
        held, unknown, label = Held(with_engine_results(found)), set(), ""
    for language in schools(case):
        for table in note(case, language).blocks:
            # a table that goes on has no label of its own
            label = getattr(table, "label", "") or label
            if isinstance(table, Table) and label not in NOT_HELD:
                columns = list(printed_columns(table))
                unknown |= {(language, label, *one[:6].tolist()) for one, half in columns if not held.has(one, half)}
    return sorted(unknown)


@every_machine
def test_the_numbers_of_tables_are_those_of_the_results(cases):
    assert broken(not_held_in_tables, cases) == {}


def test_gear_ratios_are_those_of_motors_with_slip():
    """Synchronous speeds of 1 to 4 pole pairs at 50 Hz, less 4 %, over 30 rpm of the crank."""
    found = note("punching-machine", "en")
    (table,) = (one for one in found.blocks if isinstance(one, Table) and one.label == "gear_ratios")
    crank = results("punching-machine").summary["rotational_speed"] * 30 / np.pi
    for pairs, row in enumerate(table.rows, start=1):
        synchronous, rated, ratio = (float(str(cell).replace("\N{NARROW NO-BREAK SPACE}", "")) for cell in row)
        assert synchronous == 3000 / pairs
        assert rated == 0.96 * 3000 / pairs
        assert ratio == pytest.approx(0.96 * 3000 / pairs / crank, rel=5e-4)


def moments(results: Results) -> list[Snapshot]:
    """Return the crank angles at which a note works something; of a table all of its positions."""
    if results.has_positions:
        degrees = results.grid.degrees.tolist()
    else:
        groups = Material(results, NoteOptions(full=True, figures=False)).groups.values()
        degrees = {one.degrees for one in groups if one.degrees is not None}
    return [Snapshot(CrankGrid.from_degrees, one) for one in degrees] or [Snapshot(CrankGrid.from_degrees, 0.0)]


def is_same(value: float, step: FormulaLine) -> bool:
    if value == step.value or abs(value - step.value) <= 2 * math.ulp(step.value):
        return True
    operands = step.values.values() if isinstance(step, FormulaLine) else ()
    return step.value == 0 and abs(value) < NOISE * max([1.0, *map(abs, operands)])


def not_held(results: Results, note: Note) -> set[str]:
    """Return the quantities of which an equation prints a number that the results do not hold."""
    at, known, found, printed = moments(results), defaultdict(list), set(), summary_without_rounding(results)
    for one in traced(results):
        known[one.key].append(one)
    rows = defaultdict(list)
    for listing in results.listings.values():
        for key, column in listing.columns.items():
            rows[base_key(key)] += column.tolist()
    for block in note.blocks:
        step = block.step if isinstance(block, Equation) else None
        # numbers of vector equations are those of a plan, which tests of these hold
        if not hasattr(step, "value") or block.printed is not None:
            continue
        held = [*(summary.get(step.key, math.nan) for summary in (results.summary, printed)), *rows[base_key(step.key)]]
        # a cylinder with an articulated rod has a mark in its lines
        names = (step.key, step.key.rpartition(".")[0])
        kept = [one for name in names if name for one in known.get(name, ())]
        found_there = (moment.value(one) for one in kept for moment in (at if one.varies else at[:1]))
        if not any(is_same(value, step) for value in chain(held, found_there)):
            found.add(base_key(step.key))
    return found


def not_held_in_equations(case: str) -> set[str]:
    return not_held(with_engine_results(results(case)), note(case))


@pytest.mark.slow
@every_machine
def test_a_printed_number_is_one_that_the_analysis_holds(cases):
    assert broken(not_held_in_equations, cases) == {}


def test_a_number_that_nobody_holds_is_found():
    blocks = [
        replace(one, step=one.step._replace(value=one.step.value * (1 + 1e-14)))
        if isinstance(one, Equation) and getattr(one.step, "key", "") == "piston_velocity"
        else one
        for one in note("slider-crank").blocks
    ]
    wrong = replace(note("slider-crank"), blocks=tuple(blocks))
    assert not_held(with_engine_results(results("slider-crank")), wrong) == {"piston_velocity"}


def test_a_long_narrow_table_stands_side_by_side_and_loses_nothing():
    rows = [(str(k), f"{k}.5") for k in range(100)]
    table = folded(Table("long", (("a",), ("b",)), rows, align="cr"))
    assert len(table.headings) == 6
    assert len(table.rows) == 34
    beside = [row[part : part + 2] for part in (0, 2, 4) for row in table.rows]
    assert [one for one in beside if one != ("", "")] == rows
    short = Table("short", (("a",),), [("1",)] * 24, align="c")
    assert folded(short) is short

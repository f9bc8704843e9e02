"""Every number that an equation of a note prints is held by the analysis: in its memory, summary or a listing."""

from __future__ import annotations

import functools
import math
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import pytest

from crankwork.analysis import analyse, with_method
from crankwork.analysis.whole_engine import as_engine
from crankwork.description.machine_file import read, read_machine, template, template_names
from crankwork.formula.lines import FormulaLine, Moment
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note import engine_material, linkage_material
from crankwork.note.contents import note_of
from crankwork.note.document import Equation
from crankwork.note.options import NoteOptions
from crankwork.quantities import base_key

EXAMPLES = sorted(Path(__file__).parents[2].joinpath("examples").glob("*.toml"))
FILES = [one.stem for one in EXAMPLES] + [f"{name} template" for name in template_names()]
OPTIONS = NoteOptions(figures=False)
# in SI, or of the largest operand beside it: what is printed as zero
NOISE = 1e-15


def machine_of(name):
    kind, is_template, _ = name.partition(" template")
    return read_machine(template(kind)) if is_template else read(EXAMPLES[FILES.index(name)])


@functools.cache
def analysed(name, method):
    machine = machine_of(name)
    results = analyse(with_method(machine, method))
    return as_engine(results), note_of(results, OPTIONS)


CASES = [(name, "exact") for name in FILES]
CASES += [(name, "textbook") for name in FILES if machine_of(name).lengths]


def named(results):
    """Yield everything that is remembered under each of its names."""
    stack, seen = [known.named(key) for key, known in results.memory.items()], set()
    while stack:
        one = stack.pop()
        if (id(one.node), one.key) not in seen:
            seen.add((id(one.node), one.key))
            yield one
            stack.extend(one.node.operands)


def moments(results):
    """Return the crank angles at which a note works something; of a table all of its positions."""
    if results.has_positions:
        degrees = results.grid.degrees.tolist()
    else:
        material = engine_material if "piston_displacement" in results.columns else linkage_material
        groups = material.Material(results, OPTIONS).groups.values()
        degrees = {one.degrees for one in groups if one.degrees is not None}
    return [Moment(CrankGrid.from_degrees, one) for one in degrees] or [Moment(CrankGrid.from_degrees, 0.0)]


def is_same(value, step):
    if value == step.value or abs(value - step.value) <= 2 * math.ulp(step.value):
        return True
    operands = step.values.values() if isinstance(step, FormulaLine) else ()
    return step.value == 0 and abs(value) < NOISE * max([1.0, *map(abs, operands)])


def not_held(results, note):
    """Return the quantities of which an equation prints a number that the results do not hold."""
    at, known, found = moments(results), defaultdict(list), set()
    for one in named(results):
        known[one.key].append(one)
    rows = defaultdict(list)
    for listing in results.listings.values():
        for key, column in listing.columns.items():
            rows[base_key(key)] += column.tolist()
    for block in note.blocks:
        step = block.step if isinstance(block, Equation) else None
        if not hasattr(step, "value"):
            continue
        held = [results.summary[step.key]] if step.key in results.summary else []
        held += rows[base_key(step.key)]
        # a cylinder with an articulated rod has a mark in its lines
        names = (step.key, step.key.rpartition(".")[0])
        kept = [one for name in names if name for one in known.get(name, ())]
        held += [moment.value(one) for one in kept for moment in (at if one.varies else at[:1])]
        if not any(is_same(value, step) for value in held):
            found.add(base_key(step.key))
    return found


@pytest.mark.parametrize(("name", "method"), CASES)
def test_a_printed_number_is_one_that_the_analysis_holds(name, method):
    assert not_held(*analysed(name, method)) == set()


def test_a_number_that_nobody_holds_is_found():
    results, note = analysed("slider-crank", "exact")
    wrong = [
        replace(one, step=one.step._replace(value=one.step.value * (1 + 1e-14)))
        if isinstance(one, Equation) and getattr(one.step, "key", "") == "piston_velocity"
        else one
        for one in note.blocks
    ]
    assert not_held(results, note) == set()
    assert not_held(results, replace(note, blocks=tuple(wrong))) == {"piston_velocity"}

"""What an explanation says to be given is what the file states where it is said to stand."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest

import crankwork
from crankwork.description.document import origins
from crankwork.formula.calculation_lines import ValueLine
from crankwork.formula.replay import replay
from crankwork.formula.traced_value import AngleFunction, Input, Tabulated, TracedValue, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.equations import shown_values
from crankwork.quantities import QUANTITIES, base_key
from crankwork.units import UNITS, parse, to_si
from note.built import EXAMPLES, ROOT, TEMPLATES, broken, looked_at

FILES = [one for folder in (EXAMPLES, TEMPLATES, ROOT / "tests/machines") for one in sorted(folder.glob("*.toml"))]
SLOW = {"knuckle-press", "two-stroke", "andrews-squeezer", "rubbing-swing", "wiebe", "boom"}
NAMES = {"/".join(one.parts[-2:]).removesuffix(".toml"): one for one in FILES if one.stem not in SLOW}
SOME = [name for name in NAMES if name.startswith("examples/")]
OTHERS = [*(set(NAMES) - set(SOME)), "examples/spark-engine: exact", "examples/v8-diesel: textbook"]
DIMENSIONS = tuple({one.dimension for one in UNITS.values()})
# what no key of a file states; a crank with no engine has one cylinder
CONSTANTS = {
    "branch", "compressor_exponent", "cooler_drop", "cooling_exponent", "cooling_factor", "cycle_angle",
    "cylinder_count", "exhaust_exponent", "gas_speed_factor", "gear_meshes", "heat_zero_temperature", "hydrogen_share",
    "lower_pairs", "molar_gas_constant",
    "moving_links", "pole_pairs", "polytropic_exponent", "specific_gas_constant",
}  # fmt: skip


@cache
def traced(case: str) -> tuple[crankwork.Results, list[TracedValue]]:
    name, _, method = case.partition(": ")
    found = crankwork.analyse(crankwork.read(NAMES[name], [f"method.kinematics={method}"] if method else []))
    return found, list(in_order(found.trace.values()))


def numbers_of(known: TracedValue) -> list[float]:
    """Return the number of a leaf in SI, and as it may be printed without a unit."""
    unit = known.node.unit
    if unit:
        return [float(to_si(known.value, unit)), known.value]
    return [known.value, *(number for number, _ in shown_values(ValueLine(known.key, known.value)))]


def stated(values, path: str):
    """Return what a file states at a path, read by nothing of crankwork but the table of units."""
    for name in re.split(r"[.\[]", path):
        values = values[int(name[:-1]) - 1] if name.endswith("]") else values[name]
    return values


def misstated(case: str) -> list[str]:
    """Return the leaves of a machine that do not stand in its file where they are said to."""
    file = NAMES[case.partition(": ")[0]]
    source = file.read_text(encoding="utf-8")
    values, lines, origin, wrong = tomllib.loads(source), source.splitlines(), origins(file), []
    for known in (one for one in traced(case)[1] if isinstance(one.node, Input) and not one.is_absent):
        key, path, numbers = known.key, known.node.path, numbers_of(known)
        if base_key(key) not in QUANTITIES:
            wrong.append(f"{path or known.value}: no quantity is called {key!r}")
        if not path:
            wrong += [] if key in CONSTANTS else [f"{key}: comes from nowhere"]
            continue
        where = origin(path, numbers)
        if where.kind != "line":
            # what follows from a key stands in the file, and a default does not
            wrong += [] if where.kind == ("follows_line" if where.line else "default") else [f"{key}: {where}"]
            continue
        text = stated(values, where.path)
        number = parse(text, DIMENSIONS)[0] if isinstance(text, str) else text
        if not any(math.isclose(number, one, rel_tol=1e-9) for one in numbers):
            wrong.append(f"{key} = {numbers}: {where.path} is {text}")
        name = re.sub(r"(\[\d+\])+$", "", where.path).rpartition(".")[2]
        if name not in "".join(lines[int(where.line) - 1 : int(where.line)]) and "[" not in where.path:
            wrong.append(f"{key}: line {where.line} does not state {where.path}")
    return wrong


@pytest.mark.slow
@looked_at(SOME, OTHERS)
def test_a_given_value_is_what_the_file_states(cases):
    assert broken(misstated, cases) == {}


def wrong_curves(case: str) -> Iterator[str]:
    """Yield the values of curves that are not those between their points."""
    results, every = traced(case)
    for node in (one.node for one in every):
        if not isinstance(node, Tabulated) or node.by is not None or not hasattr(node.function, "between"):
            continue
        inside = [one for one in results.grid.degrees if not node.knots or node.knots[0] <= one <= node.knots[-1]]
        for degrees in map(float, (*inside[::7], *node.knots[:3])):
            spelt = node.function.between(degrees, TracedValue(AngleFunction("angle"), "crank_angle"))
            table = float(node.function(np.array([degrees]))[0])
            if float(replay(spelt, CrankGrid.from_degrees([degrees]))[0]) != pytest.approx(table, rel=1e-9):
                yield f"{node} at {degrees:g}"


@pytest.mark.slow
@looked_at(SOME, OTHERS)
def test_a_value_of_a_curve_is_that_of_its_points(cases):
    assert broken(lambda case: list(wrong_curves(case)), cases) == {}

"""What an explanation says to be given is what the file states where it is said to stand."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path

import pytest

import crankwork
from crankwork.description.origins import origins
from crankwork.errors import CrankworkError
from crankwork.formula.known import Given, in_order
from crankwork.formula.lines import ValueLine
from crankwork.note.equations import shown_values
from crankwork.quantities import QUANTITIES, base_key
from crankwork.units import UNITS, parse, to_si

TEMPLATES = Path(crankwork.__file__).parent / "description" / "templates"
FILES = [*sorted(Path("examples").glob("*.toml")), *sorted(TEMPLATES.glob("*.toml"))]
CASES = [(file, way) for file in FILES for way in ("exact", "textbook")]
DIMENSIONS = tuple({one.dimension for one in UNITS.values()})
# what no key of a file states
CONSTANTS = {
    "cooling_exponent", "cooling_factor", "cycle_angle", "exhaust_exponent", "heat_zero_temperature",
    "hydrogen_share", "lower_pairs", "molar_gas_constant", "moving_links", "polytropic_exponent",
    "specific_gas_constant",
}  # fmt: skip


def leaves(file, way):
    try:
        results = crankwork.analyse(crankwork.read(file, [f"method.kinematics={way}"]))
    except CrankworkError:
        assert way == "textbook"
        return
    for known in in_order(results.memory.values()):
        if isinstance(known.node, Given) and not known.is_absent:
            yield known


def numbers_of(known):
    """Return the number of a leaf in SI, and as it may be printed without a unit."""
    unit = known.node.unit
    if unit:
        return [float(to_si(known.value, unit)), known.value]
    return [known.value, *(number for number, _ in shown_values(ValueLine(known.key, known.value)))]


def stated(values, path):
    """Return what a file states at a path, read by nothing of crankwork but the table of units."""
    for name in re.split(r"[.\[]", path):
        values = values[int(name[:-1]) - 1] if name.endswith("]") else values[name]
    return values


@pytest.mark.parametrize(
    ("file", "way"), CASES, ids=lambda one: "/".join(one.parts[-2:]) if isinstance(one, Path) else one
)
def test_a_given_value_is_what_the_file_states(file, way):
    source = file.read_text(encoding="utf-8")
    values, lines, origin = tomllib.loads(source), source.splitlines(), origins(file)
    wrong = []
    for known in leaves(file, way):
        key, path, numbers = known.key, known.node.path, numbers_of(known)
        if base_key(key) not in QUANTITIES:
            wrong.append(f"{path or known.value}: no quantity is called {key!r}")
        if not path:
            wrong += [] if key in CONSTANTS else [f"{key}: comes from nowhere"]
            continue
        where = origin(path, numbers)
        if where.kind != "line":
            # what follows from a key stands in the file, and a default does not
            assert where.kind == ("follows_line" if where.line else "default")
            continue
        text = stated(values, where.path)
        number = parse(text, DIMENSIONS)[0] if isinstance(text, str) else text
        if not any(math.isclose(number, one, rel_tol=1e-9) for one in numbers):
            wrong.append(f"{key} = {numbers}: {where.path} is {text}")
        name = re.sub(r"(\[\d+\])+$", "", where.path).rpartition(".")[2]
        if name not in "".join(lines[int(where.line) - 1 : int(where.line)]) and "[" not in where.path:
            wrong.append(f"{key}: line {where.line} does not state {where.path}")
    assert wrong == []

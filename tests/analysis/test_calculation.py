"""What values are made of: under names of the right dimension, and by the formulas that calculation.txt lists."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest

import crankwork
from crankwork.formula.traced_value import Arithmetic, FormulaCall, Input, TracedValue, in_order
from crankwork.notation import argument_unit
from crankwork.quantities import QUANTITIES, base_key
from test_dimensions import dimension

ROOT = Path(__file__).parents[2]
# written anew by this module when it is run as a program: what has changed is for a reader to judge
STORED = Path(__file__).with_name("calculation.txt")
FILES = [one for folder in ("examples", "tests/machines") for one in sorted((ROOT / folder).glob("*.toml"))]
# of each kind one that does not take long
SOME = [
    one
    for one in FILES
    if one.stem in {
        "crank-by-table", "cylinder-between-links", "diesel-linear", "elbow", "gas-by-law", "heavy-boom",
        "loaded-shaper", "press", "press-geometry", "punching-machine", "radial-five", "spark-engine", "table-forward",
        "turning-given-rim", "turning-scales", "turning-strokes", "v-two", "valves-compressor", "valves-pump",
    }
]  # fmt: skip
# in a unit that the formula states, or of a driver that turns or slides
STATED = {"wittenbauer_slope", "product_heat_slope", "compression_celsius", "combustion_celsius", "gas_celsius"}
EITHER = "driver_"


@cache
def traced(file: Path) -> tuple[TracedValue, ...]:
    return tuple(in_order(crankwork.analyse(crankwork.read(file)).trace.values()))


@cache
def measures(unit: str) -> str:
    """Return what a unit measures, in base units."""
    return repr(dimension(unit))


def named_wrongly(file: Path) -> set[str]:
    """Return the values of a machine whose names have another dimension than what gives them or takes them."""
    wrong = set()
    for known in traced(file):
        if isinstance(use := known.node, FormulaCall):
            taken = zip(use.inputs, map(argument_unit, use.formula.arguments), strict=True)
            units = [(known, use.formula.unit), *((one, unit) for one, unit in taken if isinstance(one, TracedValue))]
            for one, unit in units:
                kind = base_key(one.key)
                if not one.key or kind in STATED or kind.startswith(EITHER):
                    continue
                if measures(QUANTITIES[kind].si_unit) != measures(unit):
                    wrong.add(f"{one.key} [{QUANTITIES[kind].si_unit}] in {use.formula.name} [{unit}]")
    return wrong


@pytest.mark.parametrize("files", [SOME, pytest.param(FILES, marks=pytest.mark.slow)], ids=["some", "all"])
def test_values_have_the_dimension_of_what_gives_them_and_what_takes_them(files: list[Path]) -> None:
    assert {one.stem: wrong for one in files if (wrong := named_wrongly(one))} == {}


def made_of(known: TracedValue) -> str:
    """Return what a value is made of: a formula or a procedure, with the quantities that it takes."""
    node = known.node
    if isinstance(node, Input):
        return "absent" if node.is_absent else f"given at {node.path.rpartition('.')[2].partition('[')[0]}"
    if isinstance(node, FormulaCall | Arithmetic):
        how = node.formula.name if isinstance(node, FormulaCall) else node.function.__name__
        taken: Iterable[object] = node.inputs
    else:
        how, taken = getattr(node, "word", "") or type(node).__name__, node.operands
    names = (one.key.partition(".")[0] or "?" if isinstance(one, TracedValue) else f"{one:.6g}" for one in taken)
    return f"{how}({', '.join(dict.fromkeys(names))})"


def listed(files: Iterable[Path]) -> set[str]:
    """Return for each quantity of some machines what it is made of, a line each."""
    found = defaultdict(set)
    for file in files:
        for known in traced(file):
            if known.key:
                found[known.key.partition(".")[0]].add(made_of(known))
    return {f"{key}: {way}" for key, ways in found.items() for way in ways}


def stored() -> tuple[set[str], set[str]]:
    some, _, others = STORED.read_text("utf-8").partition("\n\n")
    return set(some.splitlines()), set(others.splitlines())


def test_values_are_made_of_what_is_listed() -> None:
    assert listed(SOME) == stored()[0]


@pytest.mark.slow
def test_values_of_all_machines_are_made_of_what_is_listed() -> None:
    assert listed(FILES) == stored()[0] | stored()[1]


if __name__ == "__main__":
    of_some = listed(SOME)
    STORED.write_text("\n".join([*sorted(of_some), "", *sorted(listed(FILES) - of_some)]) + "\n", "utf-8")

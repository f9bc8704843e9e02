"""A small part of the campaign, and faults that it found."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

import crankwork
from crankwork.kernel import compiled

CAMPAIGN = runpy.run_path(str(Path(__file__).with_name("campaign.py")))
compared, plausible_file = CAMPAIGN["compared"], CAMPAIGN["plausible_file"]
MACHINES = Path(__file__).parents[1] / "machines"
TEMPLATES = Path(crankwork.__file__).parent / "description" / "templates"
EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(autouse=True)
def by_arrays(monkeypatch):
    monkeypatch.setattr(compiled, "compiles", lambda: False)


def few_and_more(few, more):
    """Give a test a few machines, and more that take longer."""
    return pytest.mark.parametrize("machines", [few, pytest.param(more, marks=pytest.mark.slow)], ids=["few", "more"])


def apart(machines, least):
    """Return comparisons of machines, and of them those not the same, with too few values or with some left out."""
    found = {}
    for of, *named in machines:
        drawn = isinstance(of, int)
        text = plausible_file(5, of).text if drawn else of.read_text(encoding="utf-8")
        name, seed = (f"5:{of}", 5) if drawn else (of.stem, 1)
        found[name, *named] = compared(name, text, seed, named)
    wrong = {name: one for name, one in found.items() if not one.is_same or one.compiled <= least or one.left_out}
    return found, wrong


@few_and_more([(5,), (59,)], [(16,), (47,)])
def test_machines_drawn_by_chance_are_compiled_to_what_analyses_give(machines):
    """Among them flywheels by tangents (16, 47), a column of the angle alone read at other angles (59)."""
    assert apart(machines, 20)[1] == {}


@few_and_more(
    [(EXAMPLES / "beta-stirling.toml",), (EXAMPLES / "press-geometry.toml",)],
    [(EXAMPLES / "andrews-squeezer.toml",), (MACHINES / "gas-by-law.toml", "links.arm.length")],
)
def test_examples_are_compiled_to_what_analyses_give(machines):
    """Among them gas whose work follows from a table over time, which has no slope (gas by law)."""
    assert apart(machines, 40)[1] == {}


@pytest.mark.slow
@few_and_more(
    [
        (MACHINES / "dual.toml", "cylinder.compression_ratio", "cycle.pressure_ratio", "cycle.heat"),
        (MACHINES / "ideal-diesel-cut-off.toml", "cycle.cut_off", "cycle.adiabatic_exponent", "crank.radius"),
        (MACHINES / "diesel-linear.toml", "cylinder.compression_ratio", "cycle.excess_air", "rod.length"),
        (MACHINES / "two-stroke-ports.toml", "cycle.excess_air", "cycle.intake_pressure"),
    ],
    [
        (EXAMPLES / "petrol-four.toml", "cylinder.compression_ratio", "cycle.excess_air", "cycle.intake_pressure"),
        (EXAMPLES / "v8-diesel.toml", "cylinder.compression_ratio", "cycle.pressure_ratio", "cycle.charge_pressure"),
    ],
)
def test_calculated_cycles_are_compiled_to_what_analyses_give(machines):
    """A law ends where a volume is reached (diesel, ports), at valves and where burning ends (corners rounded)."""
    found, wrong = apart(machines, 65)
    assert wrong == {}
    assert {name: one.reasons for name, one in found.items() if one.reasons} == {}


@pytest.mark.slow
@few_and_more(
    [
        (EXAMPLES / "spark-engine.toml", "crank.radius", "gas.points.c1.angle"),
        (EXAMPLES / "spark-engine.toml", "crank.radius", "gas.points.a.pressure"),
        (TEMPLATES / "compressor.toml", "rod.length", "gas.valves.discharge"),
    ],
    [(MACHINES / "four-stroke-linkage.toml",)],
)
def test_pressures_through_points_are_compiled_to_what_analyses_give(machines):
    """Curves whose ends follow from polytropes, laws that end where a pressure or a share of the stroke is reached.

    A chamber that is least elsewhere in other designs, a point that a constant law comes to and that has a pressure.
    """
    found, wrong = apart(machines, 50)
    assert wrong == {}
    reasons = {one.partition(":")[0] for each in found.values() for one in each.reasons.values()}
    assert reasons <= {"procedure", "absent"}

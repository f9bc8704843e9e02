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


# flywheels by tangents (16, 47), a column of the angle alone read at other angles (59)
@pytest.mark.parametrize("number", [5, 16, 47, 59])
def test_machines_drawn_by_chance_are_compiled_to_what_analyses_give(number):
    found = compared(f"5:{number}", plausible_file(5, number).text, 5)
    assert found.compiled > 20, found
    assert found.is_same, found.worst


@pytest.mark.parametrize("name", ["beta-stirling", "press-geometry", "andrews-squeezer"])
def test_examples_are_compiled_to_what_analyses_give(name):
    found = compared(name, (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    assert found.compiled > 40, found
    assert found.is_same, found.worst


# of a cycle: a law ends where a volume is reached (diesel, ports), at valves and where burning ends (corners rounded)
@pytest.mark.parametrize(
    ("file", "fields"),
    [
        (EXAMPLES / "petrol-four.toml", ("cylinder.compression_ratio", "cycle.excess_air", "cycle.intake_pressure")),
        (EXAMPLES / "v8-diesel.toml", ("cylinder.compression_ratio", "cycle.pressure_ratio", "cycle.charge_pressure")),
        (MACHINES / "dual.toml", ("cylinder.compression_ratio", "cycle.pressure_ratio", "cycle.heat")),
        (MACHINES / "ideal-diesel-cut-off.toml", ("cycle.cut_off", "cycle.adiabatic_exponent", "crank.radius")),
        (MACHINES / "diesel-linear.toml", ("cylinder.compression_ratio", "cycle.excess_air", "rod.length")),
        (MACHINES / "two-stroke-ports.toml", ("cycle.excess_air", "cycle.intake_pressure")),
    ],
    ids=lambda one: one.stem if isinstance(one, Path) else "",
)
def test_calculated_cycles_are_compiled_to_what_analyses_give(file, fields):
    found = compared(file.stem, file.read_text(encoding="utf-8"), named=fields)
    assert found.compiled > 65, found
    assert not found.reasons
    assert not found.left_out
    assert found.is_same, found.worst


# curves whose ends follow from polytropes, laws that end where a pressure or a share of the stroke is reached, and a
# chamber that is least elsewhere in other designs
@pytest.mark.parametrize(
    ("file", "fields"),
    [
        (EXAMPLES / "spark-engine.toml", ("crank.radius", "gas.points.c1.angle")),
        # a point that a constant law comes to, and that has a pressure of its own
        (EXAMPLES / "spark-engine.toml", ("crank.radius", "gas.points.a.pressure")),
        (TEMPLATES / "compressor.toml", ("rod.length", "gas.valves.discharge")),
        (EXAMPLES / "double-acting-steam.toml", ()),
        (MACHINES / "four-stroke-linkage.toml", ()),
    ],
    ids=lambda one: one.stem if isinstance(one, Path) else "-".join(one),
)
def test_pressures_through_points_are_compiled_to_what_analyses_give(file, fields):
    found = compared(file.stem, file.read_text(encoding="utf-8"), named=fields)
    assert {one.partition(":")[0] for one in found.reasons.values()} <= {"procedure", "absent"}, found.reasons
    assert found.compiled > 50, found
    assert not found.left_out
    assert found.is_same, found.worst

"""Forces in the joints of crank gears by the names of linkages, against one linear system of all links."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinder_forces import traced_cylinder
from crankwork.analysis.second_routes import _bodies, _running
from crankwork.description.shorthand import crank_mechanisms, expanded
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.kinematics.piston import only_rod
from crankwork.mechanism.mechanism import body_at

ROOT = Path(__file__).parents[2]
FOUR = (ROOT / "examples/petrol-four.toml").read_text("utf-8")
DEGREES = np.arange(3.5, 720.0, 15.0)
LEANING = ["cylinder.inclination=30 deg", "method.weights=true", "crank.angular_acceleration=200 rad/s2"]


@pytest.mark.parametrize("settings", [LEANING, ["engine.misfire=[1]"], ["cylinder.offset=8 mm"]])
def test_they_are_those_of_the_linkage(settings):
    machine = crankwork.read_machine(FOUR, overrides=settings)
    results, solved = crankwork.analyse(machine), traced_cylinder(machine, machine.method)
    grid = crankwork.CrankGrid.from_degrees(DEGREES)
    keys = [f"joint_force{part}.{pin}" for part in ("_x", "_y", "") for pin in ("crank_pin", "piston_pin")]
    found = results.columns_at(DEGREES, [*keys, "normal_force.piston_pin", "gas_force"])
    rod, masses = only_rod(machine.mechanism), machine.masses or CrankGearMasses()
    crank = machine.mechanism.crank
    bodies = (body_at(crank.link, masses.crank, 0.0, crank.pin), *_bodies(rod, masses))
    mechanism = replace(machine.mechanism, bodies=bodies)
    gas = {rod.slider: found["gas_force"]}
    system = system_joint_forces(_running(solved, mechanism, gas, grid, machine.inclination))
    largest = max(float(np.max(one.resultant)) for one in system.pins.values())
    for name in ("crank_pin", "piston_pin"):
        pin = system.pins[name]
        for key, values in (("_x", pin.x), ("_y", pin.y), ("", pin.resultant)):
            assert found[f"joint_force{key}.{name}"] == pytest.approx(values, abs=1e-12 * largest)
    assert found["normal_force.piston_pin"] == pytest.approx(system.guides["piston_pin"].normal, abs=1e-12 * largest)


def test_they_are_no_further_columns_and_every_cylinder_has_its_own():
    results = crankwork.analyse(crankwork.read_machine(FOUR, overrides=["engine.misfire=[3]"]))
    assert not any(key.startswith("joint_force") for key in results.columns)
    load = results.value("crankpin_load.1", 390.0)
    assert results.value("joint_force.crank_pin", 390.0) == pytest.approx(load, rel=1e-13)
    assert results.value("joint_force.crank_pin.3", 570.0) == pytest.approx(results.value("crankpin_load.3", 570.0))


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        pytest.param("examples/radial-five", [], marks=pytest.mark.slow),
        pytest.param("examples/radial-five", ["engine.misfire=[1]"], marks=pytest.mark.slow),
        ("tests/machines/radial-heavy", []),
    ],
)
def test_those_of_articulated_rods_are_those_of_the_linkage_that_they_are(tmp_path, name, settings):
    """The master's joints bear what the others pass on; x and y are those of each cylinder."""
    path = ROOT / f"{name}.toml"
    (tmp_path / "linkage.toml").write_text(expanded(path, settings), "utf-8")
    machine = crankwork.read(path, settings)
    engine, linkage = (crankwork.analyse(one) for one in (machine, crankwork.read(tmp_path / "linkage.toml")))
    for gear in crank_mechanisms(machine):
        number = gear.place.number
        own = f".{number}" if number > 1 else ""
        upright = np.exp(1j * np.radians(gear.head - 90))
        for pin, joint in (("knuckle_pin" if own else "crank_pin", gear.joint), ("piston_pin", gear.pin)):
            force = _column(linkage, f"joint_force_x.{joint}") + 1j * _column(linkage, f"joint_force_y.{joint}")
            size = np.max(np.abs(force))
            for key, wanted in (("_x", (force / upright).real), ("_y", (force / upright).imag), ("", np.abs(force))):
                assert _column(engine, f"joint_force{key}.{pin}{own}") == pytest.approx(wanted, abs=1e-9 * size)
        # the guide of the linkage goes downwards
        normal = _column(linkage, f"normal_force.piston_{number}")
        found = _column(engine, f"normal_force.piston_pin{own}")
        assert found == pytest.approx(-normal, abs=1e-9 * np.max(np.abs(normal)))


def _column(results, key):
    return results.columns_at(DEGREES, [key])[key]

"""The reduced moment of inertia of crank gears against the kinetic energy of points."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.dynamics.masses import CrankGearMasses

ROOT = Path(__file__).parents[2]
ENGINE = crankwork.read(ROOT / "examples/spark-engine.toml")
DEGREES = np.arange(3.0, 720.0, 11.0)


@pytest.mark.elsewhere
def test_the_energy_of_a_rigid_rod_is_that_of_a_bar_between_its_pins():
    """A bar of length l with mass m: (v_A^2 + v_A v_B + v_B^2) m / 6, by the places of its ends a moment apart."""
    mass, piston, crank = 1.7, 0.8, 0.3
    exact = replace(ENGINE.method, kinematics="exact", rod="rigid", inertia_rod_ratio=None)
    lengths = ENGINE.mechanism.crank.radius, ENGINE.mechanism.dyads[0].length
    bar = CrankGearMasses(piston, mass / 2, mass / 2, crank, mass * lengths[1] ** 2 * (1 / 12 - 1 / 4))
    results = crankwork.analyse(replace(ENGINE, method=exact, masses=bar, gas=None, engine=None))

    def ends(degrees):
        phi, (r, l) = np.radians(degrees), lengths  # noqa: E741
        pin = r * np.exp(1j * phi)
        return pin, pin.real + np.sqrt(l**2 - pin.imag**2)

    step = 1e-3
    v_a, v_b = ((ahead - behind) / (2 * np.radians(step)) for ahead, behind in
                zip(ends(DEGREES + step), ends(DEGREES - step), strict=True))  # fmt: skip
    twice = mass / 3 * (np.abs(v_a) ** 2 + (v_a * np.conj(v_b)).real + np.abs(v_b) ** 2)
    expected = twice + piston * np.abs(v_b) ** 2 + crank * lengths[0] ** 2
    found = results.columns_at(DEGREES, ["reduced_inertia", "reduced_inertia_1"])
    assert found["reduced_inertia"] == pytest.approx(expected, rel=1e-8)
    ahead, behind = (results.columns_at(DEGREES + by, ["reduced_inertia"])["reduced_inertia"] for by in (0.01, -0.01))
    assert found["reduced_inertia_1"] == pytest.approx((ahead - behind) / np.radians(0.02), abs=1e-7 * expected.max())


def test_the_engine_has_the_energy_of_its_cylinders_and_of_what_turns_with_the_crank():
    results = crankwork.analyse(crankwork.read(ROOT / "examples/petrol-four.toml"))
    own = results.columns_at(np.mod(np.add.outer([0, 180, 360, 540], DEGREES), 720).ravel(), ["reduced_inertia.1"])
    expected = own["reduced_inertia.1"].reshape(4, -1).sum(axis=0) + results.machine.drive.inertia
    found = results.columns_at(DEGREES, ["reduced_inertia"])["reduced_inertia"]
    assert found == pytest.approx(expected, rel=1e-13)


def test_torque_is_what_gas_and_weights_do_less_the_change_of_energy():
    names = "examples/v8-diesel", "examples/radial-five", "tests/machines/radial-heavy"
    checks = {name: crankwork.analyse(crankwork.read(ROOT / f"{name}.toml")).checks for name in names}
    assert {name: one for name in names if not (one := checks[name]["torque_of_energy"]) < 1e-14} == {}

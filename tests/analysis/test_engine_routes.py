"""The forces of a crank gear against those of the same links as any linkage: what goes wrong in one shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.formula.expression import FORMULAS, instead

MACHINES = Path(__file__).parents[1] / "machines"
EXAMPLES = Path(__file__).parents[2] / "examples"
CHAIN = (
    "rod_sine", "rod_cosine", "piston_transfer_1", "piston_transfer_2", "crank_rod_sine",
    "inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque", "weight_force",
    "transverse_weight", "rotating_torque", "piston_acceleration", "correction_couple",
)  # fmt: skip


@pytest.mark.parametrize(
    "file", [EXAMPLES / "v8-diesel.toml", MACHINES / "leaning-compressor.toml"], ids=lambda one: one.stem
)
def test_torque_and_side_force_are_those_of_the_linkage(file):
    checks = crankwork.analyse(crankwork.read(file)).checks
    assert checks["joint_torque"] < 1e-14
    assert checks["joint_side_force"] < 1e-14


def test_a_rod_of_inertia_without_mass_loads_the_joints_by_its_couple():
    checks = crankwork.analyse(crankwork.read(EXAMPLES / "two-stroke.toml", ["rod.mass=0 kg"])).checks
    assert checks["joint_torque"] < 1e-14
    assert checks["joint_side_force"] < 1e-14


def test_a_rod_that_pushes_no_piston_is_measured_by_its_own_forces():
    machine = crankwork.with_method(crankwork.read(EXAMPLES / "spark-engine.toml"), "exact")
    masses = CrankGearMasses(rod_small_end=3e-10, rod_big_end=1.2)
    results = crankwork.analyse(replace(machine, gas=None, masses=masses))
    assert 0 < np.max(np.abs(results["side_force"])) < 1e-6
    assert not results.unmet


@pytest.mark.parametrize("name", CHAIN)
def test_a_wrong_formula_of_the_chain_is_told(name):
    entry = FORMULAS[name]
    own = entry.function
    # with weight, a changing speed and a leaning cylinder every term is there
    machine = crankwork.read(MACHINES / "leaning-compressor.toml")
    with instead(entry, lambda *operands: 1.001 * own(*operands)):
        assert crankwork.analyse(machine).unmet


def test_an_approximate_method_is_not_compared_with_exact_joint_forces():
    machine = crankwork.read(EXAMPLES / "v8-diesel.toml", ["method.kinematics=textbook"])
    assert "joint_torque" not in crankwork.analyse(machine).checks

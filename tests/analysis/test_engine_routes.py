"""The forces of a crank gear against those of the same links as any linkage: what goes wrong in one shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

import crankwork
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.formula.expression import FORMULAS
from replaced import replaced_formula

MACHINES = Path(__file__).parents[1] / "machines"
EXAMPLES = Path(__file__).parents[2] / "examples"
CHAIN = (
    "rod_sine", "rod_cosine", "piston_transfer_1", "piston_transfer_2", "crank_rod_sine",
    "inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque", "weight_force",
    "transverse_weight", "rotating_torque", "piston_acceleration", "correction_couple",
)  # fmt: skip


def test_torque_and_side_force_are_those_of_the_linkage():
    """And those of a rod of inertia without mass, which loads the joints by its couple."""
    apart = {}
    for file, *settings in (
        (EXAMPLES / "v8-diesel.toml",),
        (MACHINES / "leaning-compressor.toml",),
        (EXAMPLES / "two-stroke.toml", "rod.mass=0 kg"),
    ):
        checks = crankwork.analyse(crankwork.read(file, settings)).checks
        apart |= {(file.stem, key): checks[key] for key in ("joint_torque", "joint_side_force")}
    assert {name: one for name, one in apart.items() if not one < 1e-14} == {}


def test_a_rod_that_pushes_no_piston_is_measured_by_its_own_forces():
    machine = crankwork.with_method(crankwork.read(EXAMPLES / "spark-engine.toml"), "exact")
    masses = CrankGearMasses(rod_small_end=3e-10, rod_big_end=1.2)
    results = crankwork.analyse(replace(machine, gas=None, masses=masses))
    assert 0 < np.max(np.abs(results["side_force"])) < 1e-6
    assert not results.unmet


def test_a_wrong_formula_of_the_chain_is_told():
    # with weight, a changing speed and a leaning cylinder every term is there
    machine, unnoticed = crankwork.read(MACHINES / "leaning-compressor.toml"), []
    for name in CHAIN:
        with replaced_formula(FORMULAS[name], lambda *operands, own=FORMULAS[name].function: 1.001 * own(*operands)):
            if not crankwork.analyse(machine).unmet:
                unnoticed.append(name)
    assert unnoticed == []


def test_an_approximate_method_is_not_compared_with_exact_joint_forces():
    machine = crankwork.read(EXAMPLES / "v8-diesel.toml", ["method.kinematics=textbook"])
    assert "joint_torque" not in crankwork.analyse(machine).checks

"""The equations of moments of groups give what the whole system of equilibrium gives."""

from __future__ import annotations

import numpy as np

from crankwork.analysis.force_plans import force_plans, moment_equations
from each import for_each
from notes import results

CASES = [
    "press-geometry", "knuckle-press", "whitworth", "crank-shaper", "watt-six-bar", "stephenson-six-bar", "four-bar",
    "andrews-squeezer",
]  # fmt: skip


@for_each("name", CASES)
def test_what_moments_give_across_a_link_is_a_part_of_its_reaction(name):
    """What is left of the reaction lies along the link, so that it is square to the part across it."""
    for degrees in (20.0, 130.0, 290.0):
        forces = [force for plan in force_plans(results(name), degrees) for force in plan.forces]
        parts = [force for force in forces if force.across and any(force.across)]
        assert parts or name == "whitworth"
        for force in parts:
            across, whole = complex(*force.across), complex(force.x, force.y)
            assert abs(((whole - across) * across.conjugate()).real) < 1e-9 * abs(whole) ** 2


@for_each("name", CASES)
def test_moments_about_the_pivots_of_crank_and_lever_give_torque_and_reaction(name):
    for degrees in (20.0, 130.0, 290.0):
        keys = ["balancing_torque"] + [key for key in results(name).columns if key.startswith("normal_force.")]
        known = results(name).columns_at(np.array([degrees]), keys)
        equations = moment_equations(results(name), degrees)
        solved = {"balancing_torque" if e.kind == "driver" else f"normal_force.{e.unknown}": e.value
                  for e in equations if e.kind != "pin"}  # fmt: skip
        assert "balancing_torque" in solved
        for key, value in solved.items():
            np.testing.assert_allclose(value, known[key][0], rtol=1e-7)


def test_a_press_worked_by_hand():
    """Half way along a rod at 21.34 degrees acts a force at 359.6 degrees: its arm is 0.3 m times the sine between."""
    rod = next(equation for equation in moment_equations(results("press-geometry"), 30.0) if equation.link == "rod")
    ((force, arm),), (torque,) = rod.terms, rod.torques
    assert (rod.point, rod.end, round(rod.arm, 9)) == ("B", "A", 0.6)
    lever = 0.3 * np.sin(np.radians(21.34 + 0.4))
    np.testing.assert_allclose([force.size, arm], [255.1 * 10.21, lever], rtol=2e-3)
    np.testing.assert_allclose(rod.value, -(255.1 * 10.21 * lever + 7.653 * 6.636) / 0.6, rtol=2e-3)
    assert torque.kind == force.kind == "inertia"

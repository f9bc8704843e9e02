"""Kernels of forces with friction: of a guide that is worked out by hand, and of machines against analyses."""

import math
from pathlib import Path

import numpy as np
import pytest

from crankwork import template
from crankwork.dynamics.friction import pressing_force
from crankwork.formula.traced_value import (
    Component,
    ProcedureValue,
    Root,
    Tabulated,
    TracedAngle,
    TracedValue,
    absent,
    given,
    reached,
)
from crankwork.kernel import compiled as compiled_kernels
from crankwork.kernel.compiled import CONVERGED, Kernel
from crankwork.kernel.lowering import DesignTraces, Lowering, NotCompiledError
from crankwork.kinematics.crank_grid import CrankGrid
from varied import Varied

PINS = """
[friction.pins]
O = { coefficient = 0.1, radius = "25 mm" }
A = { coefficient = 0.1, radius = "20 mm" }
B = { coefficient = 0.1, radius = "10 mm" }
"""
GUIDE = '[friction.sliders.piston]\ncoefficient = 0.1\nlength = "80 mm"\n'
ROOT = Path(__file__).parents[2]
KEYS = ("torque_with_friction_max", "torque_with_friction_max_angle", "mean_friction_power", "mean_efficiency")
MACHINES = {
    "pins of a slider-crank": (template("slider-crank") + PINS, ("crank.radius", "piston.mass"), 0.02),
    "guide that tilts": (template("slider-crank") + PINS + GUIDE, ("crank.radius", "crank.speed"), 0.01),
    "knuckle press": (
        (ROOT / "examples" / "knuckle-press.toml").read_text("utf-8"),
        ("crank.radius", "friction.sliders.ram.coefficient"),
        0.0003,
    ),
}


@pytest.fixture(autouse=True)
def by_arrays(monkeypatch):
    monkeypatch.setattr(compiled_kernels, "compiles", lambda: False)


def guide(share, friction, amplitude=2.0):
    """Return the trace of a piece pressed by a force, and by a part of its own friction.

    The normal force N = a cos x + c + f |N|, c a share of a, is linear on either side: (a cos x + c) / (1 - f) above
    zero and (a cos x + c) / (1 + f) below it.
    """
    a, c, f = (given(key, value, key) for key, value in {"a": amplitude, "c": share * amplitude, "f": friction}.items())

    def solve(grid):
        force = amplitude * (grid.cos + share)
        return np.where(force > 0, force / (1 - friction), -force / (1 + friction))[None]

    root = Root(solve)
    pressing = TracedValue(Component(root, 0), "pressing_force")
    normal = a * TracedAngle().cos + c + f * pressing
    root.residuals = (pressing - pressing_force(normal, absent("tilting_force")),)
    if abs(share) < 1:
        corner = math.degrees(math.acos(-share))
        root.knots = corner, 360 - corner
        root.sides = ((normal, tuple(reached(normal, end) for end in root.knots)),)
    return {word: TracedValue(ProcedureValue(1.0, word, (pressing,)), word) for word in ("max", "mean")}


def test_a_guide_has_the_forces_that_are_worked_out_by_hand_on_both_sides():
    rows = np.array([[0.3, 0.2], [0.1, 0.2], [0.5, 0.2], [0.3, 0.1], [0.3, 0.4]])
    kernel = Kernel([guide(*row) for row in rows], rows, ("max", "mean"), CrankGrid.from_degrees, cycle=360.0)
    designs = np.random.default_rng(4).uniform(rows.min(axis=0), rows.max(axis=0), (40, 2))
    found, (share, f) = kernel(designs.T), designs.T
    assert np.all(found.truncation_error <= CONVERGED)
    corner = np.arccos(-share)
    above, below = np.sin(corner) + share * corner, np.sin(corner) - share * (np.pi - corner)
    np.testing.assert_allclose(found.values[0], 2 * (1 + share) / (1 - f), rtol=1e-12)
    np.testing.assert_allclose(found.values[1], 2 * (above / (1 - f) + below / (1 + f)) / np.pi, rtol=1e-12)


def test_a_guide_that_locks_or_never_leaves_one_side_is_left_to_an_analysis():
    rows = np.array([[0.3, 0.2], [0.1, 0.2], [0.5, 0.2], [0.3, 0.1], [0.3, 0.4]])
    kernel = Kernel([guide(*row) for row in rows], rows, ("max", "mean"), CrankGrid.from_degrees, cycle=360.0)
    errors = kernel(np.array([[0.3, 0.2], [0.3, 1.1], [1.2, 0.2], [-1.2, 0.2]]).T).truncation_error
    assert (errors <= CONVERGED).tolist() == [True, False, False, False]
    # pressed to the other side a piece that locks would be in balance, with more friction than pushes it
    rows[:, 0] -= 2
    kernel = Kernel([guide(*row) for row in rows], rows, ("max", "mean"), CrankGrid.from_degrees, cycle=360.0)
    errors = kernel(np.array([[-1.7, 0.9], [-1.7, 1.3]]).T).truncation_error
    assert (errors <= CONVERGED).tolist() == [True, False]


def test_what_follows_from_forces_that_are_no_formulas_is_refused_every_time():
    def traces(f):
        trace = guide(0.3, f)
        root = trace["max"].node.operands[0].node.operands[0].node
        root.residuals = (root.residuals[0] + TracedValue(Tabulated(lambda degrees: f * degrees, "table")),)
        twice = 2.0 * trace["max"].node.operands[0]
        return trace | {"twice": TracedValue(ProcedureValue(1.0, "max", (twice,)), "twice")}

    designs = DesignTraces([traces(f) for f in (0.2, 0.1, 0.4)], np.array([[0.2], [0.1], [0.4]]), ())
    lowering = Lowering(designs, CrankGrid.from_degrees, np.arange(0.0, 360.0, 7.0), is_shifted=True)
    for key in ("max", "twice", "mean"):
        designs.add(key)
        with pytest.raises(NotCompiledError, match="table"):
            lowering.value(designs.traces[0][key])


def test_links_whose_places_are_found_together_are_left_to_analyses():
    """A root that gives places and their derivatives: Newton's method from nothing would find others, or none."""

    def traces(length):
        root = Root(lambda grid: np.stack([length + grid.cos, -grid.sin, -grid.cos]))
        root.residuals = (TracedValue(Component(root, 0)) - (given("length", length, "length") + TracedAngle().cos),)
        places = (TracedValue(Component(root, index), f"place_{index}") for index in range(3))
        return {known.key: TracedValue(ProcedureValue(1.0, "max", (known,)), known.key) for known in places}

    keys = [f"place_{index}" for index in range(3)]
    designs = DesignTraces([traces(length) for length in (3.0, 2.9, 3.1)], np.array([[3.0], [2.9], [3.1]]), keys)
    lowering = Lowering(designs, CrankGrid.from_degrees, np.arange(0.0, 360.0, 7.0), is_shifted=True)
    for key in keys:
        with pytest.raises(NotCompiledError, match="solved"):
            lowering.value(designs.traces[0][key])


@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_machines_with_friction_have_the_values_of_analyses(name):
    study = Varied(*MACHINES[name])
    keys = [key for key in KEYS if key in study.summary]
    designs = study.drawn(24, MACHINES[name][2])
    found = study.kernel(keys)(designs)
    is_known = found.truncation_error <= CONVERGED
    assert np.mean(is_known) > 0.8
    for index in np.flatnonzero(is_known)[:5]:
        summary = study.results(designs[:, index]).summary
        np.testing.assert_allclose(found.values[:, index], [summary[key] for key in keys], rtol=1e-9)


@pytest.mark.slow
def test_friction_that_locks_a_machine_in_some_designs_is_marked_there():
    text = (ROOT / "tests" / "machines" / "overhung-slide.toml").read_text("utf-8")
    study = Varied(text, ("friction.sliders.slide.coefficient",), 0.02)
    designs = study.middle[:, None] * np.array([[1.0, 1.01, 8.0, 8.2]])
    found = study.kernel(KEYS[:1])(designs)
    is_free = ["torque_with_friction_max" in study.results(design).summary for design in designs.T]
    assert is_free == [True, True, False, False]
    assert (found.truncation_error <= CONVERGED).tolist() == is_free

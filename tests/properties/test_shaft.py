"""What holds for every machine: energy balances, steady motion repeats, the flywheel gives what was asked."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.errors import MethodError
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import excess_work, true_speed
from crankwork.shaft.piecewise_fit import fit_piecewise
from crankwork.shaft.steady_speed import ReducedMachine, steady_speed
from crankwork.shaft.transient import Integrator, TransientSystem
from flywheels import WAYS, flywheel
from motors import LinearMotor, missed

TURN = 2 * math.pi
FEW, MANY = settings(max_examples=12), settings(max_examples=40)
small = st.floats(-0.3, 0.3)


@st.composite
def inertias(draw):
    size, orders = draw(st.floats(0.1, 10)), [(order, draw(small), draw(small)) for order in (1, 2, 3)]
    curve = Curve.fitted(
        lambda phi: size * (1 + sum(a * np.cos(k * phi) + b * np.sin(k * phi) for k, a, b in orders) / 2), [0.0, TURN]
    )
    assume(curve.extremes().least > 0.05 * size)
    return curve


@st.composite
def torques(draw):
    """Broken lines with up to eight corners, and jumps."""
    inner = sorted(draw(st.lists(st.integers(1, 359), min_size=1, max_size=8)))
    values = draw(st.lists(st.floats(-100, 100), min_size=len(inner) + 2, max_size=len(inner) + 2))
    curve = Curve.linear(np.radians([0, *inner, 360]), values)
    assume(excess_work(curve).work > 1)
    return curve


fluctuations = st.floats(0.002, 0.3)


@MANY
@given(inertias(), torques(), fluctuations, st.floats(1, 200))
def test_the_exact_flywheel_gives_the_fluctuation_asked_for(inertia, torque, delta, speed):
    found = flywheel(inertia, torque, speed, delta)
    assume(found > -inertia.extremes().least + 1e-6)
    assert true_speed(inertia + found, torque, speed).fluctuation == pytest.approx(delta, abs=1e-9)


@MANY
@given(st.floats(0.0, 5.0), torques(), fluctuations)
def test_constant_inertia_makes_all_ways_the_same(inertia, torque, delta):
    found = [flywheel(Curve.constant(inertia), torque, 10.0, delta, way) for way in WAYS]
    assert found == pytest.approx([found[0]] * 4, rel=1e-9, abs=1e-9)


@MANY
@given(inertias(), torques())
def test_the_other_ways_tend_to_the_exact_one(inertia, torque):
    delta, speed = 1e-4, 10.0
    mertsalov, wittenbauer, exact = (flywheel(inertia, torque, speed, delta, way) for way in WAYS[1:])
    swing = inertia.extremes().largest
    assert abs(mertsalov - exact) <= 2 * swing
    assert abs(wittenbauer - exact) <= delta * swing


@MANY
@given(inertias(), torques(), st.floats(5, 50))
def test_kinetic_energy_gained_is_work_done(inertia, torque, speed):
    total = inertia + 50.0
    found = true_speed(total, torque, speed)
    angle = np.linspace(0, TURN, 73)
    energy = kinetic_energy(total(angle), found.speed(angle))
    work = (torque - torque.mean).integral(angle)
    assert energy - energy[0] == pytest.approx(work - work[0], abs=1e-12 * float(np.max(energy)))
    fine = np.linspace(0, TURN, 20001)
    assert TURN / np.trapezoid(1 / found.speed(fine), fine) == pytest.approx(speed, rel=1e-6)


@MANY
@given(torques(), st.floats(0, TURN))
def test_where_the_cycle_begins_does_not_matter(torque, by):
    """Mean and excess work of a torque that comes later."""
    later = torque.delayed(by)
    assert later.mean == pytest.approx(torque.mean, rel=1e-9, abs=1e-9)
    assert excess_work(later).work == pytest.approx(excess_work(torque).work, rel=1e-9)


@FEW
@given(inertias(), torques(), st.floats(5, 40), st.floats(0.5, 20))
def test_steady_motion_repeats_and_balances(inertia, torque, speed, stiffness):
    motor = LinearMotor(stiffness, speed - torque.mean / stiffness)
    machine = ReducedMachine.of_curves(inertia, torque, motor, flywheel=100.0)
    found = steady_speed(machine, speed)
    assume(found is not None)
    assert found.speed[-1] == pytest.approx(found.speed[0], rel=1e-13)
    assert missed(machine, found) < 1e-9


@FEW
@given(st.floats(0.1, 10), st.floats(0.5, 50), st.just(0.0) | st.floats(0.001, 2.0), st.floats(1, 50))
def test_run_down_takes_the_time_of_the_closed_form(inertia, dry, viscous, speed):
    assume(inertia * speed**2 / dry < 5000)
    closed = inertia * speed / dry if viscous == 0 else inertia / viscous * math.log1p(viscous * speed / dry)
    rows = np.array([inertia, 0.0, -dry, dry, viscous, 1.0, 0.0, 0.0])[:, None]
    reduced = fit_piecewise(lambda q: rows + 0 * q, np.array([0.0, TURN]), 1.0, TURN, groups=range(8))
    course = Integrator(TransientSystem(reduced, (0.0, TURN)), 0.3, -speed).until(2 * closed)
    (rested,) = course.events
    assert rested.word == "comes_to_rest"
    assert rested.time == pytest.approx(closed, rel=1e-9)
    assert course.at(np.array([2 * closed]))[1] == 0.0


def test_what_cannot_be_is_refused():
    with pytest.raises(MethodError):
        true_speed(Curve.constant(0.01), Curve.linear([0, 3, 3, TURN], [9, 9, -9, -9]), 0.1)

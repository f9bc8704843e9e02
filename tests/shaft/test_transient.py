"""Machines let go, as their coordinate feels it: starts, run-downs, oscillations, stops, against closed forms."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from crankwork.shaft.compiled_integrator import CompiledIntegrator
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor
from crankwork.shaft.piecewise_fit import fit_piecewise
from crankwork.shaft.transient import Integrator, TransientSystem

pytestmark = pytest.mark.elsewhere
TURN = 2 * math.pi
MOTOR = GearedMotor(AsynchronousMotor.of_catalogue(750.0, 148.0, 2.2), 14.0, 0.002)


def free(inertia=2.0, potential=None, grows=0.0, falls=0.0, damping=0.0, breaks=(0.0, TURN), **other):
    """A machine of constant inertia and damping on a circle: torques one way and the other, and a potential."""
    energy, slope = potential or (np.zeros_like, np.zeros_like)

    def columns(q):
        rows = (inertia, energy(q), grows(q) if callable(grows) else grows, falls, damping, 1.0, 0.0, slope(q))
        return np.stack([np.broadcast_to(one, q.shape) for one in rows])

    reduced = fit_piecewise(columns, np.array(breaks), 0.5, TURN, groups=(0, 1, 1, 1, 2, 3, 0, 1))
    return TransientSystem(reduced, breaks, **other)


@pytest.fixture(
    params=[Integrator, pytest.param(CompiledIntegrator, marks=pytest.mark.compiled)], ids=["arrays", "compiled"]
)
def run(request):
    """Steps of arrays, and the same steps compiled."""
    return request.param


def words(course):
    return [one.word for one in course.events]


class TestRunDown:
    def test_dry_friction(self, run):
        """J w / M seconds, J w^2 / (2 M) radians; then it stays."""
        course = run(free(grows=-4.0, falls=4.0), 0.3, 20.0).until(15.0)
        assert words(course) == ["comes_to_rest"]
        assert course.events[-1].time == pytest.approx(10.0, rel=1e-13)
        q, v, a = course.at(np.array([10.0, 12.0, 15.0]))
        assert q == pytest.approx([100.3] * 3, rel=1e-14)
        assert v == pytest.approx([0.0] * 3, abs=1e-13)
        assert not a[1:].any()

    def test_viscous_damping_never_stops(self, run):
        course = run(free(damping=0.5), 0.0, 20.0).until(10.0)
        q, v, _ = course.at(np.array([4.0, 10.0]))
        assert v == pytest.approx(20 * np.exp(-0.25 * np.array([4.0, 10.0])), rel=1e-13)
        assert q == pytest.approx(80 * (1 - np.exp(-0.25 * np.array([4.0, 10.0]))), rel=1e-13)

    def test_a_stiff_damper(self, run):
        """A time constant of a hundred thousandth of the time that it is followed."""
        course = run(free(damping=2e4, grows=1.0, falls=1.0), 0.0, 1.0).until(10.0)
        assert course.at(np.array([10.0]))[1] == pytest.approx(5e-5, rel=1e-9)
        assert len(course.steps) < 400


STIFFNESS = 50.0
SPRING = (lambda q: STIFFNESS * (q - 3.0) ** 2 / 2, lambda q: STIFFNESS * (q - 3.0))
HILLS = (np.cos, lambda q: -np.sin(q))


class TestOscillation:
    def test_a_spring_with_dry_friction_loses_the_same_way_each_time(self, run):
        """x_n = x_0 - 2 n M / c, at multiples of half the period; it rests where the spring no longer moves it."""
        c, dry = STIFFNESS, 4.0
        course = run(free(potential=SPRING, grows=-dry, falls=dry), 4.0, 0.0).until(10.0)
        assert words(course) == ["turns_back"] * (len(course.events) - 1) + ["comes_to_rest"]
        back = course.events
        half = math.pi * math.sqrt(2.0 / c)
        assert [one.time for one in back] == pytest.approx(half * np.arange(1, len(back) + 1), rel=1e-11)
        ways = [(-1) ** k * (1.0 - 2 * k * dry / c) for k in range(1, len(back) + 1)]
        assert [one.coordinate - 3.0 for one in back] == pytest.approx(ways, abs=1e-12)
        assert abs(back[-1].coordinate - 3.0) <= dry / c < abs(back[-2].coordinate - 3.0)

    def test_damped_vibration(self, run):
        c, d = STIFFNESS, 2.0
        course = run(free(potential=SPRING, damping=d), 4.0, 0.0).until(5.0)
        decay, rate = d / 4.0, math.sqrt(c / 2 - (d / 4.0) ** 2)
        time = np.linspace(0, 5, 41)
        exact = np.exp(-decay * time) * (np.cos(rate * time) + decay / rate * np.sin(rate * time))
        assert course.at(time)[0] - 3.0 == pytest.approx(exact, abs=1e-12)

    def test_a_stop_gives_back_its_part_of_the_speed(self, run):
        """A weight that falls: each bounce takes the part of the time of the one before it, and in the end it lies."""
        e, g = 0.5, 3.0
        course = run(free(grows=-2 * g, falls=-2 * g, stops=(1.0, math.inf), restitution=e), 2.0, 0.0).until(10.0)
        hits = [one for one in course.events if one.word == "stop"]
        first = math.sqrt(2 / g)
        expected = first + 2 * first * np.cumsum(e ** np.arange(1, 12))
        assert [one.time for one in hits[:12]] == pytest.approx([first, *expected], rel=1e-12)
        assert words(course)[-1] == "comes_to_rest"
        assert course.at(np.array([10.0]))[0] == pytest.approx(1.0, abs=1e-12)

    def test_one_that_starts_against_its_stop_is_given_back_at_once(self, run):
        course = run(free(stops=(-1.0, 1.0), restitution=1.0), 1.0, 2.0).until(2.5)
        assert [one.coordinate for one in course.events] == pytest.approx([1.0, -1.0, 1.0])
        assert [one.time for one in course.events] == pytest.approx([0.0, 1.0, 2.0], abs=1e-12)

    def test_on_top_of_a_hill_it_stays(self, run):
        course = run(free(potential=HILLS), math.pi * 2, 0.0).until(100.0)
        assert words(course) == ["comes_to_rest"]

    def test_the_smallest_oscillation_is_one(self, run):
        """A thousand-millionth of a radian about the bottom."""
        course = run(free(potential=HILLS), math.pi + 1e-9, 0.0).until(20.0)
        time = np.linspace(0, 20, 50)
        assert course.at(time)[0] - math.pi == pytest.approx(1e-9 * np.cos(time / math.sqrt(2)), abs=1e-14)
        assert len(course.steps) < 100


class TestMotor:
    def test_a_start_against_another_solver(self):
        """Load in corners, over two turns of a crank: SciPy's DOP853 from corner to corner."""
        breaks = tuple(np.radians([0.0, 40.0, 80.0, 120.0, 360.0]))
        load = lambda q: np.interp(q, breaks, [-5.0, -5.0, -100.0, -5.0, -5.0])  # noqa: E731
        machine = free(grows=load, falls=0.0, breaks=breaks, motor=MOTOR)
        course = Integrator(machine, 0.0, 0.0).until(2.0)

        def rate(_, state):
            return [state[1], (load(state[0] % TURN) + float(MOTOR.torque(state[1]))) / 2.0]

        time, state = 0.0, [0.0, 0.0]
        while time < 2.0:
            ahead = next(one + TURN * k for k in range(9) for one in breaks[1:] if one + TURN * k > state[0] + 1e-9)
            corner = lambda _, y, at=ahead: y[0] - at  # noqa: E731
            corner.terminal = True
            part = solve_ivp(rate, (time, 2.0), state, "DOP853", rtol=3e-14, atol=1e-15, events=corner)
            time, state = part.t[-1], part.y[:, -1]
        q, v, _ = course.at(np.array([2.0]))
        assert (q[0], v[0]) == pytest.approx(tuple(state), rel=1e-9)

    def test_a_load_too_heavy_to_start(self):
        course = Integrator(free(grows=-400.0, falls=400.0, motor=MOTOR), 0.0, 0.0).until(5.0)
        assert words(course) == ["comes_to_rest"]
        assert course.at(np.array([5.0]))[0] == 0.0

    def test_a_speed_is_told_when_it_is_reached(self):
        course = Integrator(free(torque=4.0), 0.0, 0.0).until(5.0, watched=[6.0])
        (event,) = course.events
        assert (event.word, event.rate) == ("reaches_speed", pytest.approx(6.0, rel=1e-13))
        assert event.time == pytest.approx(3.0, rel=1e-13)
        assert event.coordinate == pytest.approx(9.0, rel=1e-13)


class TestBounds:
    def test_interrupted_it_keeps_what_it_has(self):
        seen = []

        def impatient(run):
            seen.append(run.time)
            if len(seen) == 5:
                raise KeyboardInterrupt
            return False

        course = Integrator(free(potential=HILLS), 1.0, 0.0).until(100.0, each=impatient)
        assert words(course)[-1] == "interrupted"
        assert course.end == seen[-1]

    def test_too_many_steps_are_told(self, monkeypatch):
        monkeypatch.setattr("crankwork.shaft.transient.MOST_STEPS", 20)
        course = Integrator(free(potential=HILLS), 1.0, 0.0).until(100.0)
        assert words(course)[-1] == "many_steps"
        assert course.end < 100.0

"""Plans constructed on paper: exact without rounding, off by what is rounded with it."""

import numpy as np
import pytest

from crankwork.analysis.drawn_plans import PlanScales, constructed_plans
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.vector_polygons import accelerations, driver_rates, velocities
from each import for_each
from notes import results

SCALES = PlanScales(0.004, 0.01, 0.1)
# of every kind of group: two links, a link and a slider, a lever and a block, two blocks, a yoke and a block
MACHINES = ["press-geometry", "crank-shaper", "toggle-press", "scotch-yoke", "whitworth", "stephenson-six-bar"]


def equations(plans):
    """Return the equations of both plans with the scale of each."""
    return [
        (scale, one) for scale, plan in zip(SCALES[1:], plans, strict=True) for group in plan.groups for one in group
    ]


@for_each("name", MACHINES)
def test_exact_plans_are_those_of_the_transfer_functions(name):
    whole = results(name)
    for degrees in (40.0, 130.0, 250.0):
        plans = constructed_plans(whole, degrees, SCALES, 0.0)
        moved, mechanism = sample_motion(whole.machine.mechanism, [degrees]), whole.machine.mechanism
        rates = driver_rates(whole, whole.columns_at(np.array([degrees])))
        first, second = float(rates.first[0]), float(rates.second[0])
        outside = velocities(mechanism, moved, 0, first), accelerations(mechanism, moved, 0, first, second)
        for plan, other, scale in zip(plans, outside, SCALES[1:], strict=True):
            known = {(one.name, one.kind): one.length for one in other.vectors}
            parts = [part for group in plan.groups for one in group for part in (one.left, *one.right)]
            largest = max(known.values())
            shared = [part for part in (*parts, *plan.similar) if (part.name, part.kind) in known]
            assert len(shared) >= 3
            for part in shared:
                assert scale * abs(part.drawn) == pytest.approx(known[part.name, part.kind], abs=1e-11 * largest), part
            for link, rate in plan.turning.items():
                assert rate == pytest.approx(
                    other.turning[link], abs=1e-10 * max(map(abs, other.turning.values()), default=1)
                )


@for_each(("name", "precision"), [(name, precision) for name in MACHINES for precision in (0.0, 0.5)])
def test_the_vectors_of_an_equation_add_up(name, precision):
    for _, one in equations(constructed_plans(results(name), 40.0, SCALES, precision)):
        if one.right:
            assert sum(part.drawn for part in one.right) == pytest.approx(one.left.drawn, abs=1e-9)


def largest_difference(name, precision):
    exact, drawn = (equations(constructed_plans(results(name), 40.0, SCALES, one)) for one in (0.0, precision))
    return max(
        abs(part.drawn - other.drawn)
        for (_, one), (_, two) in zip(exact, drawn, strict=True)
        for part, other in zip((one.left, *one.right), (two.left, *two.right), strict=True)
    )


@for_each("name", MACHINES)
def test_differences_are_of_the_size_of_what_is_rounded(name):
    # a point is off by up to 0.7 of the precision, and errors grow from one vector to the next
    for precision in (0.5, 0.1):
        assert 0.2 * precision < largest_difference(name, precision) < 40 * precision
    assert largest_difference(name, 1e-9) < 1e-6


def test_the_velocity_of_the_shaper_is_that_of_its_lever():
    # crank 50 mm at 60 rpm, pivot 150 mm below; the crank at 90 deg + 40 deg
    (plan, _), angle, turn = constructed_plans(results("crank-shaper"), 40.0, SCALES, 0.0), np.radians(130.0), 2 * np.pi
    pin = 0.05 * np.exp(1j * angle)
    lever = pin + 0.15j
    velocity = 1j * turn * pin
    along = (velocity * np.conj(lever)).real / abs(lever)
    rate = (np.conj(lever) * velocity).imag / abs(lever) ** 2
    parts = {(part.name, part.kind): SCALES.velocity * abs(part.drawn) for one in plan.groups[0] for part in one.right}
    assert parts["AA2", "sliding"] == pytest.approx(abs(along), rel=1e-12)
    assert parts["A2B", "relative"] == pytest.approx(abs(rate) * abs(lever), rel=1e-12)
    assert plan.turning[2] == pytest.approx(rate, rel=1e-12)


def test_groups_of_a_higher_class_are_not_constructed():
    assert constructed_plans(results("excavator-boom"), 0.0, SCALES, 0.5) is None

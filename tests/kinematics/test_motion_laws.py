"""Motion laws: they keep their places, their rates are derivatives, and they are smooth where they promise it."""

from pathlib import Path

import numpy as np
import pytest

from crankwork import analyse, read, read_machine
from crankwork.errors import CrankworkError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import breakpoints_of
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion_laws import clock, extent, law_at, traced_law
from crankwork.mechanism.driver import Law, Segment
from each import for_each

KINDS = (
    "constant", "parabolic", "trapezoidal", "modified-trapezoidal", "cubic", "3-4-5", "4-5-6-7", "harmonic",
    "cycloidal", "modified-sine",
)  # fmt: skip
THERE_AND_BACK = {
    kind: Law((Segment(kind, 0.3, 0.4, 0.25), Segment("dwell", 0.3, 0.1), Segment(kind, 0.05, 0.5, 0.25)), 2.5, 0.05)
    for kind in KINDS
}
TABLE = Law((Segment("table", 0.1, 1.0, points=((0.15, 0.2), (0.4, 0.35), (0.8, 0.05))),), 4.0, 0.1)
ONE_WAY = Law((Segment("dwell", 0.0, 0.2), Segment("table", 0.4, 0.8, points=((0.5, 0.3),))), 2.0, 0.0)
LAWS = [*THERE_AND_BACK.values(), TABLE, ONE_WAY]


def at(law, degrees):
    """Return coordinate and rates at angles of the period."""
    return law_at(law, CrankGrid.from_degrees(degrees))


@for_each("law", LAWS, ids=[*KINDS, "table", "one way"])
def test_rates_are_derivatives_by_time(law):
    degrees = np.random.default_rng(3).uniform(1.0, 359.0, 400)
    edges = breakpoints_of(traced_law(law, turns=False), 360.0)
    degrees = degrees[np.min(np.abs(degrees[:, None] - edges), axis=1) > 0.1]
    step = 1e-3
    per_second = law.period / 360.0
    (before, rate_before, _), (_, rate, second), (after, rate_after, _) = (
        at(law, degrees + d) for d in (-step, 0, step)
    )
    assert (after - before) / (2 * step * per_second) == pytest.approx(rate, abs=2e-6)
    assert (rate_after - rate_before) / (2 * step * per_second) == pytest.approx(second, abs=2e-6)


@for_each("kind", KINDS)
def test_segments_end_where_they_are_sent(kind):
    law = THERE_AND_BACK[kind]
    found = at(law, [0.0, 144.0, 150.0, 180.0, 360.0]).position
    assert found == pytest.approx([0.05, 0.3, 0.3, 0.3, 0.05], abs=1e-15)
    assert law.segments[-1].to == law.start


@for_each("kind", [one for one in KINDS if one != "constant"])
def test_rates_have_no_jumps(kind):
    law = THERE_AND_BACK[kind]
    edges = breakpoints_of(traced_law(law, turns=False), 360.0)[1:-1]
    before, after = (at(law, edges + d) for d in (-1e-9, 1e-9))
    assert before.position_1 == pytest.approx(after.position_1, abs=1e-9)
    if kind not in ("parabolic", "trapezoidal", "cubic", "harmonic"):
        assert before.position_2 == pytest.approx(after.position_2, abs=1e-7)


def test_a_table_is_smooth_through_its_points():
    shares, places = np.array([0.0, 0.15, 0.4, 0.8, 1.0]), [0.1, 0.2, 0.35, 0.05, 0.1]
    assert at(TABLE, 360.0 * shares).position == pytest.approx(places, abs=1e-14)
    before, after = (at(TABLE, 360.0 * shares[1:-1] + d) for d in (-1e-9, 1e-9))
    assert before.position_2 == pytest.approx(after.position_2, abs=1e-7)
    # what returns is smooth over its end too
    for order in (1, 2):
        first, last = at(TABLE, [1e-9, 360.0])[order]
        assert first == pytest.approx(last, abs=1e-7)
    assert at(ONE_WAY, [72.0 + 1e-9, 360.0]).position_1 == pytest.approx([0.0, 0.0], abs=1e-7)


def test_extremes_and_time_of_a_law():
    law = THERE_AND_BACK["3-4-5"]
    q, velocity, acceleration = traced_law(law, turns=True)
    over = CycleInterpolant({"q": q, "v": velocity, "a": acceleration, "t": clock(law)}, CrankGrid.from_degrees, 360.0)
    found = over.extreme_points
    # the rise takes 1 s and 250 mm, the return 1.25 s
    assert found["v"][0].value == pytest.approx(1.875 * 0.25, rel=1e-12)
    assert found["v"][1].value == pytest.approx(-1.875 * 0.25 / 1.25, rel=1e-12)
    assert found["a"][0].value == pytest.approx(10 / 3**0.5 * 0.25, rel=1e-12)
    assert found["t"][0].value == 2.5
    assert q.key == "driver_angle"


def test_the_extent_of_a_law_is_that_between_all_angles():
    points = ((0.3, 0.17), (0.55, 0.18), (0.8, 0.11))
    law = Law((Segment("table", 0.19, 0.29, points=points), Segment("cycloidal", 0.165, 0.71)), 6.9, 0.165)
    segments_end, finely = 360.0 * 0.29, law_at(law, CrankGrid.steps(1e-3, 360.0)).position
    assert extent(law) == pytest.approx((finely.min(), finely.max()), abs=1e-11)
    # an end between two steps of a degree, and an overshoot of the table
    assert law_at(law, CrankGrid.from_degrees([segments_end])).position[0] == pytest.approx(extent(law)[1], abs=1e-12)
    assert extent(law)[0] < 0.11 - 1e-4


def test_the_extent_of_a_rest_is_one_place():
    assert extent(Law((Segment("dwell", 0.4, 0.5), Segment("table", 0.4, 0.5, points=((0.5, 0.4),))), 1.0, 0.4)) == (
        0.4,
        0.4,
    )


class Swing:
    """The law called harmonic, of one's own."""

    breaks = ()

    def ways(self, share):
        angle = np.pi * share
        return (1 - np.cos(angle)) / 2, np.pi / 2 * np.sin(angle), np.pi**2 / 2 * np.cos(angle)


class Halves:
    """The law called parabolic."""

    breaks = (0.5,)

    def ways(self, share):
        rises, left = share < 0.5, 1 - share
        return (
            np.where(rises, 2 * share**2, 1 - 2 * left**2),
            np.where(rises, 4 * share, 4 * left),
            np.where(rises, 4.0, -4.0),
        )


class Beyond:
    """Half a way further than it is to go, and back: 6 z^2 - 5 z^3."""

    breaks = ()

    def ways(self, share):
        return 6 * share**2 - 5 * share**3, 12 * share - 15 * share**2, 12 - 30 * share


@for_each(("own", "kind"), [(Swing(), "harmonic"), (Halves(), "parabolic")])
def test_a_law_of_ones_own_moves_a_machine_as_the_same_law_of_ours(own, kind):
    machine = read(Path(__file__).parents[1] / "machines" / "driven-slider.toml")
    start, period = machine.mechanism.driver.law.start, 2.0
    to = start + 0.02

    def driven(law):
        return analyse(
            machine.driven_by(
                Law((Segment(law, to, 0.5), Segment("dwell", to, 0.1), Segment(law, start, 0.4)), period, start)
            )
        )

    ours, own = driven(kind), driven(own)
    for key, column in ours.columns.items():
        assert own[key] == pytest.approx(column, rel=1e-9, abs=1e-9 * np.nanmax(np.abs(column)), nan_ok=True), key
    for key, value in ours.summary.items():
        assert own.value(key) == pytest.approx(value, rel=1e-9, abs=1e-9), key
    assert not own.unmet


def test_a_law_of_ones_own_may_go_beyond_its_end():
    """At z = 0.8 it has gone 6 (0.64) - 5 (0.512) = 1.28 of its way."""
    law = Law((Segment(Beyond(), 0.1, 0.5), Segment("cubic", 0.0, 0.5)), 1.0, 0.0)
    assert extent(law) == pytest.approx((0.0, 0.128), abs=1e-15)


@for_each(
    ("ways", "breaks", "told"),
    [
        (lambda z: (2 * z, 0 * z + 2, 0 * z), (), "from 0 to 2"),
        (lambda z: (z, 0 * z + 1.1, 0 * z), (), "derivative 1"),
        (lambda z: (z**2, 2 * z, 0 * z), (), "derivative 2"),
        (lambda z: (z, 0 * z + 1), (), "three arrays"),
        (lambda z: (z, 0 * z + 1, np.log(z - 2)), (), "three arrays"),
        (lambda z: (z, 0 * z + 1, 0 * z), (0.4, 0.2), "breaks"),
        (lambda z: (z, 0 * z + 1, 0 * z), (1.0,), "breaks"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_law_of_ones_own_that_is_none_is_refused(ways, breaks, told):
    own = type("Mine", (), {"ways": lambda _, share: ways(share), "breaks": breaks})()
    with pytest.raises(CrankworkError, match=told) as refused:
        at(Law((Segment(own, 0.1, 1.0),), 1.0, 0.0), [0.0, 90.0])
    assert "Mine" in str(refused.value)


def test_a_machine_without_a_law_is_driven_by_none():
    machine = read(Path(__file__).parents[2] / "examples" / "press-geometry.toml")
    with pytest.raises(CrankworkError, match="driver"):
        machine.driven_by(TABLE)


# a crank braked evenly from 25 rad/s, which turns back: angle 25 t - 125 t^2 from its start, exact at every point
BRAKED = tuple((k / 10, 25 * k / 50 - 125 * (k / 50) ** 2) for k in range(1, 10))


@pytest.mark.parametrize(
    "segment",
    [
        Segment("constant-acceleration", 0.0, 1.0, rates=(25.0, 0.0)),
        Segment("table", 0.0, 1.0, points=BRAKED, rates=(25.0, -25.0)),
        Segment("table", 0.0, 1.0, points=BRAKED, rates=(None, None)),
    ],
)
def test_even_braking_is_found_from_its_speed_and_from_its_points(segment):
    q, rate, second = law_at(Law((segment,), 0.2, 0.0), CrankGrid.from_degrees(np.linspace(0.0, 360.0, 37)))
    time = np.linspace(0.0, 0.2, 37)
    assert q == pytest.approx(25 * time - 125 * time**2, abs=1e-12)
    assert rate == pytest.approx(25 - 250 * time, abs=1e-10)
    assert second == pytest.approx(np.full(37, -250.0), rel=1e-9)
    assert extent(Law((segment,), 0.2, 0.0)) == pytest.approx((0.0, 1.25))


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_natural_ends_repeat_the_polynomial_of_few_points(count):
    polynomial = np.polynomial.Polynomial([0.0, 3.0, *[-2.0, 0.7][: max(count, 0)]])
    shares = np.linspace(0.0, 1.0, count + 2)[1:-1]
    table = Segment(
        "table", polynomial(1.0), 1.0, points=tuple(zip(shares, polynomial(shares), strict=True)), rates=(None, None)
    )
    grid = CrankGrid.from_degrees(np.linspace(0.0, 350.0, 36))
    assert law_at(Law((table,), 1.0, 0.0), grid)[0] == pytest.approx(polynomial(np.linspace(0.0, 350 / 360, 36)))


def test_points_of_an_even_braking_are_at_rest_at_their_ends_unless_the_file_says_otherwise():
    values = ", ".join(f'"{np.degrees(q) - 90:.9f} deg"' for _, q in BRAKED)
    law = f'{{ kind = "table", to = "-90 deg", over = "0.2 s", at = {[z for z, _ in BRAKED]}, values = [{values}] }}'
    text = f"""
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "300 mm"
[driver]
start = "-90 deg"
law = [{law}]
[links]
rod = {{ joins = ["A", "B"], length = "700 mm", mass = "2 kg", inertia = "0.05 kg*m2", centre = ["300 mm", "0 mm"] }}
[guides]
bed = {{ through = "O", angle = "0 deg" }}
[sliders]
block = {{ guide = "bed", pin = "B", mass = "1.5 kg" }}
[positions]
B = ["632 mm", "0 mm"]
[table]
step = "5 ms"
"""
    at_rest, stated = (
        analyse(read_machine(file)) for file in (text, text.replace("over =", 'ends = "natural", over ='))
    )
    assert any("driver.law[1].ends" in item.keys for item in at_rest.assumptions)
    assert not any("driver.law[1].ends" in item.keys for item in stated.assumptions)
    # the exact parabola
    assert max(np.abs(stated["driver_torque"])) == pytest.approx(115.09, abs=0.01)
    assert stated.columns_at([0.0, 72.0, 144.0], ["driver_torque"])["driver_torque"] == pytest.approx(
        [-15.857, -102.759, -35.339], abs=1e-3
    )

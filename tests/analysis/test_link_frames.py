"""The frame of a link leads from the first joint that it joins to the second, in whatever order it is solved."""

from __future__ import annotations

import math
from itertools import permutations

import numpy as np
import pytest

import crankwork
from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.motion import linkage_motion
from each import for_each
from machine_texts import analysed

# G lies 100 mm from B towards A and 30 mm to the left of that
FOUR_BAR = """
fixed_points = {{ O = ["0 mm", "0 mm"], E = ["300 mm", "20 mm"] }}
crank = {{ pivot = "O", pin = "A", radius = "60 mm", speed = "60 rpm" }}
[links.coupler]
joins = {coupler}
length = "280 mm"
points = {{ G = {G} }}
mass = "2 kg"
inertia = "0.02 kg*m2"
centre = {G}
[links.rocker]
joins = {rocker}
length = "200 mm"
mass = "1 kg"
centre = ["100 mm", "0 mm"]
[positions]
B = ["230 mm", "200 mm"]
"""
REVERSED = FOUR_BAR.format(coupler='["B", "A"]', rocker='["B", "E"]', G='["100 mm", "30 mm"]')
FORWARD = FOUR_BAR.format(coupler='["A", "B"]', rocker='["E", "B"]', G='["180 mm", "-30 mm"]')

# a rocker of three joints, with a slot for the ram beside it
SIX_BAR = """
fixed_points = { O = ["0 mm", "0 mm"], E = ["300 mm", "20 mm"], H = ["500 mm", "50 mm"] }
crank = { pivot = "O", pin = "A", radius = "60 mm", speed = "60 rpm" }
links.coupler = { joins = ["A", "B"], length = "280 mm" }
links.plate = { joins = JOINS, points = { G = ["40 mm", "25 mm"] }, mass = "3 kg", centre = "G" }
links.second = { joins = ["D", "C"], mass = "1 kg", centre = ["20 mm", "-5 mm"] }
links.output = { joins = ["H", "D"] }
guides.rail = { link = "plate", through = ["10 mm", "15 mm"], angle = "20 deg" }
sliders.block = { guide = "rail", pin = "P", mass = "0.5 kg" }
links.tie = { joins = ["P", "H"], length = "700 mm" }
positions = { B = ["230 mm", "200 mm"], C = ["330 mm", "150 mm"], D = ["450 mm", "180 mm"], P = ["170 mm", "180 mm"] }
"""

ROD = """
fixed_points = { O = ["0 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "60 mm", speed = "60 rpm" }
links.rod = { joins = ["B", "A"], length = "220 mm", points = { G = ["70 mm", "10 mm"] }, mass = "1 kg", centre = "G" }
guides.bed = { through = ["0 mm", "15 mm"] }
sliders.piston = { pin = "B", guide = "bed", mass = "2 kg" }
positions.B = ["270 mm", "15 mm"]
"""

# a motor in the pin C of two links, the second of which moves a rocker
ELBOW = """
fixed_points = { O = ["0 mm", "0 mm"], E = ["600 mm", "100 mm"] }
[links]
upper = { joins = ["C", "O"], length = "500 mm" }
lower = { joins = ["D", "C"], length = "400 mm", points = { G = ["150 mm", "20 mm"] } }
rocker = { joins = ["D", "E"], length = "600 mm" }
[positions]
C = ["-80 mm", "493 mm"]
D = ["300 mm", "620 mm"]
[driver]
between = ["upper", "lower"]
start = "0 deg"
law = [{ kind = "cubic", to = "20 deg", over = "2 s" }, { kind = "harmonic", to = "0 deg", over = "2 s" }]
"""


def direction(results: crankwork.Results, first: str, second: str) -> np.ndarray:
    """The direction from one point to another, of the table of points. [rad]"""
    fixed = results.machine.mechanism.ground
    (x, y), (u, v) = (
        fixed.get(name, (results.columns.get(f"point_x.{name}"), results.columns.get(f"point_y.{name}")))
        for name in (first, second)
    )
    return np.arctan2(v - y, u - x)


def apart(angle: np.ndarray, other: np.ndarray) -> float:
    """How far directions are apart, but for whole turns. [rad]"""
    return float(np.max(np.abs((angle - other + np.pi) % (2 * np.pi) - np.pi)))


def along(results: crankwork.Results, link: str, first: str, u: float, v: float) -> tuple[np.ndarray, np.ndarray]:
    """Where a point of a link is, by its coordinates from its first joint. [m]"""
    columns, angle = results.columns, results.columns[f"link_angle.{link}"]
    x, y = results.machine.mechanism.ground.get(
        first, (columns.get(f"point_x.{first}"), columns.get(f"point_y.{first}"))
    )
    return x + u * np.cos(angle) - v * np.sin(angle), y + u * np.sin(angle) + v * np.cos(angle)


@pytest.mark.elsewhere
def test_a_link_that_joins_b_and_a_points_from_b_to_a() -> None:
    """At 0 degrees A and E are the root of 58000 mm apart; the law of cosines gives the angle at A between E and B."""
    results = analysed(REVERSED)
    angle, base = results.columns["link_angle.coupler"], math.sqrt(58000)
    from_a = math.atan2(20, 240) + math.acos((280**2 + base**2 - 200**2) / (2 * 280 * base))
    assert math.degrees(from_a) == pytest.approx(49.138, abs=1e-3)
    assert angle[0] == pytest.approx(from_a - math.pi, abs=1e-13)
    assert np.max(np.abs(np.diff(angle))) < 0.1
    for link, joins in (("coupler", "BA"), ("rocker", "BE")):
        assert apart(results.columns[f"link_angle.{link}"], direction(results, *joins)) < 1e-13, link
    x, y = along(results, "coupler", "B", 0.1, 0.03)
    assert results.columns["point_x.G"] == pytest.approx(x, abs=1e-14)
    assert results.columns["point_y.G"] == pytest.approx(y, abs=1e-14)
    assert results.summary["link_angle_max.rocker"] == pytest.approx(
        results.columns["link_angle.rocker"].max(), abs=1e-3
    )


def test_the_order_of_joints_turns_a_link_by_half_a_turn_and_nothing_else() -> None:
    one, other = analysed(REVERSED), analysed(FORWARD)
    for key, column in other.columns.items():
        if key.startswith("link_angle."):
            assert apart(one.columns[key], column + np.pi) < 1e-13, key
        else:
            assert one.columns[key] == pytest.approx(column, rel=1e-9, abs=1e-12 * (1 + np.abs(column).max())), key
    assert one.summary["link_swing.rocker"] == pytest.approx(other.summary["link_swing.rocker"], rel=1e-12)
    assert max(one.checks.values()) < 1e-12


@pytest.mark.elsewhere
@for_each("joins", [list(some) for some in permutations("BCE")], ids=["".join(some) for some in permutations("BCE")])
def test_a_link_of_three_joints_has_the_frame_of_its_first_two(joins: list[str]) -> None:
    results = analysed(SIX_BAR.replace("JOINS", str(joins)))
    assert apart(results.columns["link_angle.plate"], direction(results, *joins[:2])) < 1e-12
    assert apart(results.columns["link_angle.second"], direction(results, "D", "C")) < 1e-12
    x, y = along(results, "plate", joins[0], 0.04, 0.025)
    assert results.columns["point_x.G"] == pytest.approx(x, abs=1e-13)
    assert results.columns["point_y.G"] == pytest.approx(y, abs=1e-13)
    # where the block is on its rail, by the coordinates of the rail in the frame
    slid = results.columns["slider_displacement.block"]
    cos, sin = math.cos(math.radians(20)), math.sin(math.radians(20))
    x, y = along(results, "plate", joins[0], 0.01 + slid * cos, 0.015 + slid * sin)
    assert results.columns["point_x.P"] == pytest.approx(x, abs=1e-12)
    assert results.columns["point_y.P"] == pytest.approx(y, abs=1e-12)
    assert max(results.checks.values()) < 1e-9
    # solved all at once from where the frames are it moves alike
    mechanism = results.machine.mechanism
    grid = crankwork.CrankGrid.from_degrees(np.arange(0.0, 91.0))
    moved = linkage_motion(mechanism, grid)
    chains = tuple(as_chain(one, moved.frames, 0.0, mechanism.bars) for one in mechanism.dyads)
    found = linkage_motion(crankwork.Mechanism(mechanism.driver, chains, (), mechanism.ground, mechanism.points), grid)
    assert found.links["plate"].position == pytest.approx(moved.links["plate"].position, abs=1e-9)
    assert found.points["D"].x.position == pytest.approx(moved.points["D"].x.position, abs=1e-10)


@pytest.mark.elsewhere
def test_a_rod_named_from_its_piston() -> None:
    results = analysed(ROD)
    assert apart(results.columns["link_angle.rod"], direction(results, "B", "A")) < 1e-13
    x, _ = along(results, "rod", "B", 0.07, 0.01)
    assert results.columns["point_x.G"] == pytest.approx(x, abs=1e-14)
    assert max(results.checks.values()) < 1e-12


@pytest.mark.elsewhere
def test_links_that_a_motor_opens() -> None:
    results = analysed(ELBOW)
    for link, joins in (("upper", "CO"), ("lower", "DC"), ("rocker", "DE")):
        assert apart(results.columns[f"link_angle.{link}"], direction(results, *joins)) < 1e-12, link
    x, y = along(results, "lower", "D", 0.15, 0.02)
    assert results.columns["point_x.G"] == pytest.approx(x, abs=1e-13)
    assert results.columns["point_y.G"] == pytest.approx(y, abs=1e-13)


def test_many_designs_have_the_same_frames() -> None:
    """With the length of the coupler and the place of its point varied at once, which both stand in the file."""
    description = crankwork.Description(REVERSED)
    lengths, places = np.array([0.27, 0.28, 0.29]), np.array([0.08, 0.1, 0.12])
    fields = {"links.coupler.length": lengths, "links.coupler.points.G[1]": places}
    keys = ("link_angle_max.rocker", "joint_force_max.B")
    swept = crankwork.sweep(description, fields, keys)
    assert not swept.reason
    for at, (length, place) in enumerate(zip(lengths, places, strict=True)):
        text = REVERSED.replace('"280 mm"', f'"{length} m"').replace(
            'points = { G = ["100 mm"', f'points = {{ G = ["{place} m"'
        )
        summary = analysed(text).summary
        for key in keys:
            assert swept.values[key][at] == pytest.approx(summary[key], rel=1e-9), key

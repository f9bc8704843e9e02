"""Articulated rods: a cylinder whose rod turns on a knuckle pin of another cylinder's rod, the master rod.

Everything is seen from the cylinder of the articulated rod: crank angle phi from its own axis, x along the axis towards
the head, y towards the crankpin at 90 degrees. The knuckle pin stands at the angle delta from the axis, as seen from
the crankpin: delta = knuckle angle - axis - beta of the master rod.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from crankwork.cylinders.layout import Layout
from crankwork.dynamics.piston_forces import rod_force, side_force
from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, given, is_traced, named, to_number
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.slider_crank import (
    RodSwing,
    SliderCrank,
    check_slider_crank,
    rod_angle,
    rod_swing,
    rod_transfer_1,
    rod_transfer_2,
)
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism

# Rounding of sums of lengths, relative to the rod length.
_ROUNDING = 1e-12
# Equal steps of a turn, each with one extreme at most.
_SCAN = 180
_MAX_STEPS = 60
# An extreme is flat: a step as small as this changes nothing there. [deg]
_ROOT_TOLERANCE = 1e-11


@formula("knuckle_x", "taylor_1985, ch. 8")
def knuckle_along(r: Value, cos_phi: Value, r_a: Value, cos_delta_a: Value) -> Value:
    """Distance of the knuckle pin from the crankshaft along the cylinder axis."""
    return r * cos_phi + r_a * cos_delta_a


@formula("knuckle_y", "taylor_1985, ch. 8")
def knuckle_across(r: Value, sin_phi: Value, r_a: Value, sin_delta_a: Value) -> Value:
    """Distance of the knuckle pin from the crankshaft across the cylinder axis."""
    return r * sin_phi + r_a * sin_delta_a


@formula("rod_sine", "taylor_1985, ch. 8")
def articulated_rod_sine(y_A: Value, e: Value, l_a: Value) -> Value:
    """Sine of the angle of the articulated rod."""
    return (y_A - e) / l_a


@formula("piston_transfer_1", "artobolevsky_1988, ch. 4")
def articulated_transfer_1(x_A1: Value, y_A1: Value, sin_beta_a: Value, cos_beta_a: Value) -> Value:
    """First transfer function of the piston of an articulated rod, dx/dphi."""
    return y_A1 * sin_beta_a / cos_beta_a - x_A1


@formula("piston_transfer_2", "artobolevsky_1988, ch. 4")
def articulated_transfer_2(
    x_A2: Value, y_A2: Value, y_A1: Value, beta_a1: Value, sin_beta_a: Value, cos_beta_a: Value
) -> Value:
    """Second transfer function of the piston of an articulated rod, d2x/dphi2."""
    return y_A2 * sin_beta_a / cos_beta_a + y_A1 * beta_a1 / cos_beta_a**2 - x_A2


def _printed_cosine(sin_beta_a: Value) -> Value:
    return np.sqrt(1 - sin_beta_a**2)


@formula("rod_cosine", "artobolevsky_1988, ch. 4", printed=_printed_cosine)
def articulated_rod_cosine(sin_beta_a: Value, y_A: Value, e: Value, l_a: Value) -> Value:  # noqa: ARG001 - the sine is what books print it from
    """Cosine of the angle of the articulated rod, without cancellation."""
    return np.sqrt((l_a - (y_A - e)) * (l_a + (y_A - e))) / l_a


@formula("rod_transfer_1", "artobolevsky_1988, ch. 4")
def articulated_rod_transfer_1(y_A1: Value, l_a: Value, cos_beta_a: Value) -> Value:
    """First derivative of the angle of the articulated rod by the crank angle."""
    return y_A1 / (l_a * cos_beta_a)


@formula("rod_transfer_2", "artobolevsky_1988, ch. 4")
def articulated_rod_transfer_2(y_A2: Value, l_a: Value, beta_a1: Value, sin_beta_a: Value, cos_beta_a: Value) -> Value:
    """Second derivative of the angle of the articulated rod by the crank angle."""
    return (y_A2 / l_a + beta_a1**2 * sin_beta_a) / cos_beta_a


class ArticulatedRod(NamedTuple):
    """An articulated rod, with the positions of its knuckle pin and its cylinder."""

    # Between knuckle pin and piston pin; from the crankpin to the knuckle pin [m]
    length: float
    knuckle_radius: float
    # From the axis of the master rod to the knuckle pin, seen from the crankpin, positive with the rotation [deg]
    knuckle_angle: float
    axis: float  # From the axis of the master cylinder to its own, positive with the rotation [deg]
    offset: float = 0.0  # Of its cylinder axis from the crankshaft, positive towards the crankpin at 90 degrees [m]


class ArticulatedMotion(NamedTuple):
    """Motion of an articulated rod and its piston over the crank angle of its own cylinder, arrays of shape (n,).

    `piston`, `rod` and `swing` are those of `kinematics.piston.PistonMotion`, counted from its own top dead centre [m];
    `knuckle` is the knuckle pin [m], `sin` and `cos` its direction from the crankpin, `master` the swing of the master
    rod at the same instant [-]; `own` is its rod, traced if the motion is, then with angles in radians.
    """

    piston: Transfer
    rod: Transfer
    swing: RodSwing
    knuckle: PointMotion
    sin: Value
    cos: Value
    master: RodSwing
    own: ArticulatedRod


class ArticulatedStroke(NamedTuple):
    """Dead centres of an articulated rod: crank angles from its own axis [deg], and positions of its piston pin [m]."""

    top_angle: float
    bottom_angle: float
    top: float
    bottom: float

    @property
    def stroke(self) -> float:
        """Distance between the dead centres. [m]"""
        return self.top - self.bottom


def articulated_motion(lengths: SliderCrank, rod: ArticulatedRod, grid: CrankGrid) -> ArticulatedMotion:
    """Return the exact motion of an articulated rod and its piston.

    Displacement from its own top dead centre and derivatives [m]; angle and derivatives of the rod [rad]. `lengths`:
    crank and master rod, with the offset of the master cylinder [m]; `grid`: crank angles from the axis of its own
    cylinder [rad]. Source: taylor_1985, ch. 8; artobolevsky_1988, ch. 4.
    """
    top: Value = articulated_stroke(SliderCrank(*map(to_number, lengths)), rod).top
    motion = _motion(lengths, rod, grid)
    if is_traced(*lengths):
        largest = TracedValue(ProcedureValue(top, "max", (motion.piston.position,)))
        top = TracedValue(ProcedureValue(top, "dead_centre", lengths, argument=largest), "pin_distance.top")
    x = top - motion.piston.position
    return motion._replace(piston=Transfer(x, *motion.piston[1:]))


def _motion(lengths: SliderCrank, rod: ArticulatedRod, grid: CrankGrid) -> ArticulatedMotion:
    """Return the motion, with the distance of the piston pin from the crankshaft in place of the displacement."""
    own = _traced(rod) if is_traced(*lengths) else rod
    r, r_a, l_a, e = lengths.crank_radius, own.knuckle_radius, own.length, own.offset
    sin, cos, (delta_1, delta_2), master = _knuckle_direction(lengths, rod, grid, own.knuckle_angle - own.axis)
    x = knuckle_along(r, grid.cos, r_a, cos)
    y = knuckle_across(r, grid.sin, r_a, sin)
    x_1 = named(-r * grid.sin - r_a * delta_1 * sin, "knuckle_x_1")
    y_1 = named(r * grid.cos + r_a * delta_1 * cos, "knuckle_y_1")
    x_2 = named(-r * grid.cos - r_a * (delta_2 * sin + delta_1 * delta_1 * cos), "knuckle_x_2")
    y_2 = named(-r * grid.sin + r_a * (delta_2 * cos - delta_1 * delta_1 * sin), "knuckle_y_2")
    sin_rod = named(articulated_rod_sine(y, e, l_a), "rod_sine.articulated")
    with np.errstate(invalid="ignore", divide="ignore"):
        cos_rod = named(articulated_rod_cosine(sin_rod, y, e, l_a), "rod_cosine.articulated")
        beta_1 = named(articulated_rod_transfer_1(y_1, l_a, cos_rod), "rod_transfer_1.articulated")
        beta_2 = articulated_rod_transfer_2(y_2, l_a, beta_1, sin_rod, cos_rod)
        piston = Transfer(
            x + l_a * cos_rod,
            articulated_transfer_1(x_1, y_1, sin_rod, cos_rod),
            articulated_transfer_2(x_2, y_2, y_1, beta_1, sin_rod, cos_rod),
        )
    swing = RodSwing(sin_rod, cos_rod, grid.sin * cos_rod + grid.cos * sin_rod, grid.cos * cos_rod - grid.sin * sin_rod)
    knuckle = PointMotion(Transfer(x, x_1, x_2), Transfer(y, y_1, y_2))
    angle = Transfer(rod_angle(sin_rod, cos_rod), beta_1, beta_2)
    return ArticulatedMotion(piston, angle, swing, knuckle, sin, cos, master, own)


def _traced(rod: ArticulatedRod) -> ArticulatedRod:
    """Return a rod of inputs, its angles in radians."""
    table = "engine.articulated"
    angle, axis = math.radians(rod.knuckle_angle), math.radians(rod.axis)
    known: tuple[Any, ...] = (
        given("articulated_rod_length", rod.length, f"{table}.rod_length"),
        given("knuckle_radius", rod.knuckle_radius, f"{table}.knuckle_radius"),
        given("knuckle_angle", angle, f"{table}.knuckle_angles"),
        given("articulated_axis", axis, "engine.layout"),
        given("offset.articulated", rod.offset, "engine") if rod.offset else absent("offset"),
    )
    return ArticulatedRod(*known)


class _MasterAngle(NamedTuple):
    """Functions of the crank angle from the axis of the master cylinder."""

    sin: Value
    cos: Value
    one_minus_sin: Value
    one_plus_sin: Value


def _knuckle_direction(
    lengths: SliderCrank, rod: ArticulatedRod, grid: CrankGrid, ahead: Value
) -> tuple[Value, Value, tuple[Value, Value], RodSwing]:
    """Return sine and cosine of delta, its two derivatives, and the swing of the master rod."""
    turned = grid.shifted(rod.axis)
    sin, cos = named(turned.sin, "master_sine"), named(turned.cos, "master_cosine")
    of_master: Value = _MasterAngle(sin, cos, turned.one_minus_sin, turned.one_plus_sin)
    lam = named(lengths.rod_ratio, "rod_ratio.master")
    master = rod_swing(lengths, of_master, lam, part=".master")
    beta_1 = named(rod_transfer_1(lam, of_master.cos, master.cos), "rod_transfer_1.master")
    beta_2 = rod_transfer_2(beta_1, lam, of_master.sin, master.sin, master.cos)
    beta_2 = named(beta_2, "rod_transfer_2.master")
    fixed = named(ahead, "knuckle_direction.start")
    ahead_sin, ahead_cos = sine_and_cosine(
        rod.knuckle_angle - rod.axis, fixed, ("knuckle_sine.start", "knuckle_cosine.start")
    )
    sin = named(ahead_sin * master.cos - ahead_cos * master.sin, "knuckle_sine")
    cos = named(ahead_cos * master.cos + ahead_sin * master.sin, "knuckle_cosine")
    return sin, cos, (named(-beta_1, "knuckle_direction_1"), named(-beta_2, "knuckle_direction_2")), master


def sine_and_cosine(degrees: float, angle: Value, keys: tuple[str, str]) -> tuple[Value, Value]:
    """Return sine and cosine of a constant angle, exact at multiples of 90 degrees, traced if the angle is."""
    grid = CrankGrid.from_degrees(degrees)
    sin, cos = float(grid.sin), float(grid.cos)
    if not is_traced(angle):
        return sin, cos
    return TracedValue(ProcedureValue(sin, "sine", [angle]), keys[0]), TracedValue(
        ProcedureValue(cos, "cosine", [angle]), keys[1]
    )


@lru_cache(maxsize=256)
def articulated_stroke(lengths: SliderCrank, rod: ArticulatedRod) -> ArticulatedStroke:
    """Return the dead centres of an articulated rod.

    Angles of the dead centres from its own axis [deg] and distances of the piston pin there [m]. Source: taylor_1985,
    ch. 8; roots of dx/dphi.
    """
    check_articulated_rod(lengths, rod)
    return _stroke(lengths, rod)


def _stroke(lengths: SliderCrank, rod: ArticulatedRod) -> ArticulatedStroke:
    angles = _extremes(lambda degrees: _motion(lengths, rod, CrankGrid.from_degrees(degrees)).piston, -90.0)
    distance = _motion(lengths, rod, CrankGrid.from_degrees(angles)).piston.position
    top, bottom = int(np.argmax(distance)), int(np.argmin(distance))
    return ArticulatedStroke(float(angles[top]), float(angles[bottom]), float(distance[top]), float(distance[bottom]))


def _extremes(motion: Callable[[Array], Transfer], start: float) -> Array:
    """Return the angles of a turn where a coordinate is extreme, by Newton's method between changes of sign. [deg]"""
    edges = start + np.linspace(0.0, 360.0, _SCAN + 1)
    slope = motion(edges).position_1
    left = np.flatnonzero((slope[:-1] < 0) != (slope[1:] < 0))
    low, high, falls = edges[left], edges[left + 1], slope[left] >= 0
    angles = (low + high) / 2
    for _ in range(_MAX_STEPS):
        _, first, second = motion(angles)
        before = (first >= 0) == falls
        low, high = np.where(before, angles, low), np.where(before, high, angles)
        # both derivatives change sign with the sense of x, their ratio does not
        step = np.degrees(np.divide(first, np.abs(second), out=np.zeros_like(angles), where=second != 0))
        if np.all(np.abs(step) <= _ROOT_TOLERANCE):
            break
        moved = angles + np.where(falls, step, -step)
        angles = np.where((moved > low) & (moved < high), moved, (low + high) / 2)
    return angles


def check_articulated_rod(lengths: SliderCrank, rod: ArticulatedRod) -> None:
    """Raise if crank, master rod and articulated rod cannot turn fully."""
    check_slider_crank(lengths)
    if rod.length <= 0 or rod.knuckle_radius < 0:
        raise GeometryError(ErrorMessage("articulated_zero"))

    def across(degrees: Array) -> Transfer:
        return _motion(lengths, rod, CrankGrid.from_degrees(degrees)).knuckle.y

    angles = _extremes(across, 0.0)
    away = np.abs(across(angles).position - rod.offset)
    worst = int(np.argmax(away))
    if away[worst] >= rod.length * (1 - _ROUNDING):
        raise GeometryError(
            ErrorMessage(
                "articulated_short",
                length=rod.length * 1e3,
                angle=angles[worst] % 360,
                away=away[worst] * 1e3,
                missing=(away[worst] - rod.length) * 1e3,
            )
        )


@formula("knuckle_acceleration_x", "artobolevsky_1988, ch. 5")
def knuckle_acceleration_along(x_A2: Value, w: Value, x_A1: Value, eps: Value) -> Value:
    """Acceleration of the knuckle pin along the cylinder axis, positive towards the head."""
    return x_A2 * w**2 + x_A1 * eps


@formula("knuckle_acceleration_y", "artobolevsky_1988, ch. 5")
def knuckle_acceleration_across(y_A2: Value, w: Value, y_A1: Value, eps: Value) -> Value:
    """Acceleration of the knuckle pin across the cylinder axis."""
    return y_A2 * w**2 + y_A1 * eps


@formula("knuckle_force_x", "taylor_1985, ch. 8")
def knuckle_force_along(P: Value, m_2a: Value, a_Ax: Value, g: Value, cos_theta: Value) -> Value:
    """Force of the articulated rod on its knuckle pin along the cylinder axis, positive towards the head."""
    return -P - m_2a * (a_Ax + g * cos_theta)


@formula("knuckle_force_y", "taylor_1985, ch. 8")
def knuckle_force_across(  # noqa: PLR0913 - one argument per symbol
    P: Value, sin_beta_a: Value, cos_beta_a: Value, dN: Value, m_2a: Value, a_Ay: Value, g: Value, sin_theta: Value
) -> Value:
    """Force of the articulated rod on its knuckle pin across the cylinder axis."""
    return P * sin_beta_a / cos_beta_a + dN - m_2a * (a_Ay - g * sin_theta)


@formula("knuckle_couple", "taylor_1985, ch. 8")
def couple_of_knuckle(r_a: Value, Y_A: Value, cos_delta_a: Value, X_A: Value, sin_delta_a: Value) -> Value:
    """Moment of the force on the knuckle pin about the crankpin, which bends the master rod."""
    return r_a * (Y_A * cos_delta_a - X_A * sin_delta_a)


@formula("knuckle_side_force", "taylor_1985, ch. 8")
def side_force_on_master(M_a: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Side force of the master piston that holds the moment of the force on a knuckle pin."""
    return -M_a / (l * cos_beta)


class KnuckleMass(NamedTuple):
    """The mass of an articulated rod at its knuckle pin, with the motion of that pin.

    `mass` at the knuckle pin [kg], its acceleration along and across the axis of the cylinder [m/s2]; `gravity` [m/s2]
    with cosine and sine of the inclination of the cylinder; `couple`, side force of a rod that is not two masses [N];
    `transverse_weight` of the reciprocating mass [N].
    """

    mass: Value = 0.0
    along: Value = 0.0
    across: Value = 0.0
    gravity: Value = 0.0
    lean_cos: Value = 1.0
    lean_sin: Value = 0.0
    couple: Value = 0.0
    transverse_weight: Value = 0.0


_MASSLESS = KnuckleMass()


class ArticulatedForces(NamedTuple):
    """Forces due to the piston force of an articulated rod, arrays of shape (n,).

    `side` on its own wall and `along` its rod; `knuckle`, force on its knuckle pin along and across its axis; `couple`
    on the master rod about the crankpin; `master_side`, addition to the side force of the master piston; `x`, `y` on
    the crankpin in the axes of its own cylinder; `radial`, `tangential` on the crankpin by the crank, the same for
    every cylinder. [N], [N m]
    """

    side: Value
    along: Value
    knuckle: tuple[Value, Value]
    couple: Value
    master_side: Value
    x: Value
    y: Value
    radial: Value
    tangential: Value


def articulated_forces(
    P: Value,
    lengths: SliderCrank,
    rod: ArticulatedRod,
    grid: CrankGrid,
    motion: ArticulatedMotion,
    held: KnuckleMass = _MASSLESS,
) -> ArticulatedForces:
    """Return the forces that an articulated rod passes to the master rod and with it to the crankpin. [N]

    Forces and couple; tangential force times crank radius is the torque. `P`: force on its piston pin along its
    cylinder axis, positive towards the crankshaft [N]; `grid`: crank angles from the axis of its own cylinder [rad].
    Source: taylor_1985, ch. 8; moments on the master rod about the crankpin, then its forces.
    """
    sin_rod, cos_rod = motion.swing.sin, motion.swing.cos
    side = side_force(P, sin_rod, cos_rod, held.couple, held.transverse_weight)
    X = knuckle_force_along(P, held.mass, held.along, held.gravity, held.lean_cos)
    Y = knuckle_force_across(P, sin_rod, cos_rod, held.couple, held.mass, held.across, held.gravity, held.lean_sin)
    couple = couple_of_knuckle(motion.own.knuckle_radius, Y, motion.cos, X, motion.sin)
    wall = side_force_on_master(couple, lengths.rod_length, motion.master.cos)
    # the wall of the master cylinder answers across the master's axis, which stands at -axis here
    axis_sin, axis_cos = sine_and_cosine(rod.axis, motion.own.axis, ("axis_sine", "axis_cosine"))
    x, y = wall * axis_sin + X, Y + wall * axis_cos
    return ArticulatedForces(
        side,
        rod_force(P, cos_rod, held.couple, sin_rod),
        (X, Y),
        couple,
        wall,
        x,
        y,
        -(x * grid.cos + y * grid.sin),
        y * grid.cos - x * grid.sin,
    )


_UP = math.pi / 2


def throw_mechanism(
    layout: Layout,
    lengths: SliderCrank,
    articulated_rods: Sequence[ArticulatedRod | None] = (),
    offsets: Sequence[float] = (),
    crankpin: int | None = None,
) -> Mechanism:
    """Return the mechanism of a crankpin, by default that of cylinder 1, with the crank turning clockwise.

    Crankpin A, piston pins B1, B2 ... and knuckle pins C2, C3 ... by the numbers of the cylinders; at a crank angle
    of zero the crank of cylinder 1 lies along its axis. `lengths`: crank, rod and offset of every cylinder, of the
    master for articulated rods [m]; `articulated_rods`: that of each cylinder that has one; `offsets`: of
    each cylinder, if they differ [m].
    """
    first = layout.places[0]
    wanted = first.crankpin if crankpin is None else crankpin
    # a master rod comes before the rods that it carries
    on_pin = (candidate for candidate in layout.places if candidate.crankpin == wanted)
    places = sorted(on_pin, key=lambda candidate: candidate.master > 0)
    points, rods = [], []
    for place in places:
        articulated = articulated_rods[place.number - 1] if articulated_rods else None
        axis = math.radians(place.axis)
        joint, length = "A", lengths.rod_length
        offset = offsets[place.number - 1] if offsets else lengths.offset
        if articulated is not None:
            angle = math.radians(articulated.knuckle_angle)
            joint, length, offset = f"C{place.number}", articulated.length, articulated.offset
            along, across = articulated.knuckle_radius * math.cos(angle), -articulated.knuckle_radius * math.sin(angle)
            points.append(LinkPoint(joint, f"rod {place.master}", along, across))
        guide_point = (offset * math.cos(axis), -offset * math.sin(axis))
        pin, name = f"B{place.number}", f"rod {place.number}"
        rods.append(RRP(joint, pin, name, length, guide_point=guide_point, guide_angle=_UP - axis))
    start = _UP - math.radians(first.axis + places[0].pin_angle)
    crank = Crank(lengths.crank_radius, start=start, direction=-1, pin="A")
    return Mechanism(crank, tuple(rods), points=tuple(points))

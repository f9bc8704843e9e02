"""The flywheel that keeps the speed within a required fluctuation, by four methods side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.locale import ErrorMessage
from crankwork.shaft.curve import Curve, extremes_of
from crankwork.shaft.fluctuation import ExcessWork, excess_work

FlywheelMethod = Literal["energy", "mertsalov", "wittenbauer", "exact"]
FLYWHEEL_METHODS: tuple[FlywheelMethod, ...] = ("energy", "mertsalov", "wittenbauer", "exact")


@formula("flywheel_inertia", "artobolevsky_1988, ch. 16")
def inertia_for_fluctuation(L_exc: Value, delta: Value, w: Value) -> Value:
    """Moment of inertia that keeps the speed within a fluctuation."""
    return L_exc / (delta * w**2)


@formula("inertia_on_crank", "artobolevsky_1988, ch. 16")
def inertia_on_other_shaft(J_f: Value, i_g: Value) -> Value:
    """Moment of inertia that acts on the crank like a body on a shaft that turns i times as fast."""
    return J_f * i_g**2


@formula("wittenbauer_slope", "artobolevsky_1988, ch. 16", unit="J/(kg*m2)")
def slope_of_mean_speed(w: Value) -> Value:
    """Slope of both tangents of the mass-energy curve where the speed is taken to be its mean."""
    return w**2 / 2


@formula("wittenbauer_slope", "wittenbauer_1923", unit="J/(kg*m2)")
def wittenbauer_slope_largest(w: Value, delta: Value) -> Value:
    """Slope of the upper tangent of the mass-energy curve, with the square of delta left out."""
    return w**2 / 2 * (1 + delta)


@formula("wittenbauer_slope", "wittenbauer_1923", unit="J/(kg*m2)")
def wittenbauer_slope_least(w: Value, delta: Value) -> Value:
    """Slope of the lower tangent of the mass-energy curve, with the square of delta left out."""
    return w**2 / 2 * (1 - delta)


@formula("wittenbauer_slope", "artobolevsky_1988, ch. 16", unit="J/(kg*m2)")
def slope_largest(w: Value, delta: Value) -> Value:
    """Slope of the upper tangent of the mass-energy curve, exact."""
    return w**2 / 2 * (1 + delta / 2) ** 2


@formula("wittenbauer_slope", "artobolevsky_1988, ch. 16", unit="J/(kg*m2)")
def slope_least(w: Value, delta: Value) -> Value:
    """Slope of the lower tangent of the mass-energy curve, exact."""
    return w**2 / 2 * (1 - delta / 2) ** 2


class Flywheel(NamedTuple):
    """A flywheel by one of the four methods."""

    method: FlywheelMethod
    inertia: float  # Moment of inertia of the flywheel on the crank; negative where the machine needs none [kg m2]
    excess: float  # Excess work in the sense of this way, which over delta w^2 gives the inertia [J]


def flywheel(
    inertia: Curve, torque: Curve, mean_speed: float, fluctuation: float, method: FlywheelMethod = "exact"
) -> Flywheel:
    """Return the flywheel for a wanted fluctuation of the speed, where all torques depend on the angle alone.

    The inertia given is that of the machine without the flywheel, the torque that of engine or load (negative), which a
    constant torque balances; the mean speed is that of the extremes.
    The ways are: constant inertia; Mertsalov's, energy of the second group of bodies at mean speed, the first having
    the least inertia; tangents without the square of the fluctuation; tangents with it, which is Gutyar's exact
    condition (artobolevsky_1988, ch. 16; wittenbauer_1923).

    T_0 + A(phi) = (J_f + J(phi)) w^2 / 2 stays below the line of slope w_max^2 / 2 and above that of slope
    w_min^2 / 2 in the plane of J and A, and touches both. With a and b the ordinates where they cut the axis,
    J_f = (a - b) / (w_max^2 / 2 - w_min^2 / 2), and w_max^2 - w_min^2 = 2 delta w^2 exactly. Mertsalov gives
    both lines the slope w^2 / 2; constant inertia makes all ways the same. The relative error vanishes with
    delta for Mertsalov and with its square for Wittenbauer.
    """
    check_fluctuation(fluctuation, mean_speed)
    excess = excess_work(torque)
    if method == "energy":
        work, less = excess.work, inertia.mean
    else:
        (work,) = works_of_tangents(inertia, excess, [_slopes(method, mean_speed, fluctuation)])
        less = inertia.extremes().least if method == "mertsalov" else 0.0
    return Flywheel(method, float(inertia_for_fluctuation(work, fluctuation, mean_speed)) - less, work)


def works_of_tangents(inertia: Curve, excess: ExcessWork, slopes: Sequence[tuple[float, float]]) -> list[float]:
    """Return what pairs of tangents of the mass-energy curve cut out of the axis of energy, by their slopes. [J]"""
    ends = extremes_of([excess.curve - inertia * slope for pair in slopes for slope in pair])
    return [above.largest - below.least for above, below in zip(ends[::2], ends[1::2], strict=True)]


def check_fluctuation(fluctuation: float, mean_speed: float) -> None:
    """Raise if no flywheel can give a fluctuation of the speed.

    `fluctuation` and `mean_speed`: greatest less least speed over the mean; the mean [rad/s].
    """
    if not 0 < fluctuation < 2 or mean_speed <= 0:
        raise MethodError(ErrorMessage("fluctuation_wild", fluctuation=fluctuation, speed=mean_speed))


def _slopes(method: FlywheelMethod, w: float, delta: float) -> tuple[float, float]:
    """Return half the squares of greatest and least speed as a method takes them."""
    if method == "mertsalov":
        return 2 * (float(slope_of_mean_speed(w)),)
    if method == "wittenbauer":
        return float(wittenbauer_slope_largest(w, delta)), float(wittenbauer_slope_least(w, delta))
    return float(slope_largest(w, delta)), float(slope_least(w, delta))


@formula("work_per_cycle", "khurmi_gupta_2005, ch. 16")
def work_of_mean_torque(M_mean: Value, phi_c: Value) -> Value:
    """Work of a torque over a cycle."""
    return M_mean * phi_c


@formula("flywheel_inertia", "artobolevsky_1988, ch. 16")
def flywheel_beside_machine(J_sum: Value, J: Value) -> Value:
    """Moment of inertia that the flywheel has to add to that of the machine."""
    return J_sum - J

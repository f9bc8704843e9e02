"""The flywheel that keeps the speed within a required fluctuation, by four methods side by side."""

from __future__ import annotations

from collections.abc import Sequence

from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.locale import ErrorMessage
from crankwork.shaft.curve import Curve, extremes_of
from crankwork.shaft.fluctuation import ExcessWork


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


def works_of_tangents(inertia: Curve, excess: ExcessWork, slopes: Sequence[tuple[float, float]]) -> list[float]:
    """Return what pairs of tangents of the mass-energy curve cut out of the axis of energy, by their slopes. [J]

    T_0 + A(phi) = (J_f + J(phi)) w^2 / 2 stays below the line of slope w_max^2 / 2 and above that of slope
    w_min^2 / 2 in the plane of J and A, and touches both. With a and b the ordinates where they cut the axis,
    J_f = (a - b) / (w_max^2 / 2 - w_min^2 / 2), and w_max^2 - w_min^2 = 2 delta w^2 exactly. Mertsalov gives
    both lines the slope w^2 / 2; constant inertia makes all ways the same. The relative error vanishes with
    delta for Mertsalov and with its square for Wittenbauer (artobolevsky_1988, ch. 16; wittenbauer_1923).
    """
    ends = extremes_of([excess.curve - inertia * slope for pair in slopes for slope in pair])
    return [above.largest - below.least for above, below in zip(ends[::2], ends[1::2], strict=True)]


def check_fluctuation(fluctuation: float, mean_speed: float) -> None:
    """Raise if no flywheel can give a fluctuation of the speed.

    `fluctuation` and `mean_speed`: greatest less least speed over the mean; the mean [rad/s].
    """
    if not 0 < fluctuation < 2 or mean_speed <= 0:
        raise MethodError(ErrorMessage("fluctuation_wild", fluctuation=fluctuation, speed=mean_speed))


@formula("work_per_cycle", "khurmi_gupta_2005, ch. 16")
def work_of_mean_torque(M_mean: Value, phi_c: Value) -> Value:
    """Work of a torque over a cycle."""
    return M_mean * phi_c


@formula("flywheel_inertia", "artobolevsky_1988, ch. 16")
def flywheel_beside_machine(J_sum: Value, J: Value) -> Value:
    """Moment of inertia that the flywheel has to add to that of the machine."""
    return J_sum - J

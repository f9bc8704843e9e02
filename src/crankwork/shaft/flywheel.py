"""The flywheel that keeps the speed within a required fluctuation, by four methods, and the size of its wheel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.locale import ErrorMessage
from crankwork.shaft.curve import Curve, extremes_of
from crankwork.shaft.fluctuation import ExcessWork


@formula("flywheel_inertia", "khurmi_gupta_2005, ch. 16")
def inertia_of_wheel(m_f: Value, k_f: Value) -> Value:
    """Moment of inertia of a flywheel of a mass and a radius of gyration."""
    return m_f * k_f**2


@formula("flywheel_mass", "khurmi_gupta_2005, ch. 16")
def mass_of_wheel(J_f: Value, k_f: Value) -> Value:
    """Mass of a flywheel of a radius of gyration."""
    return J_f / k_f**2


@formula("rim_mass", "khurmi_gupta_2005, ch. 16")
def mass_of_rim(rho_r: Value, pi: Value, D_r: Value, b_r: Value, t_r: Value) -> Value:
    """Mass of a rim of a rectangular section."""
    return rho_r * pi * D_r * b_r * t_r


@formula("rim_inertia", "khurmi_gupta_2005, ch. 16")
def inertia_of_rim(m_r: Value, D_r: Value) -> Value:
    """Moment of inertia of a rim, all of whose mass is taken to be at its mean diameter."""
    return m_r * D_r**2 / 4


@formula("rim_mass", "khurmi_gupta_2005, ch. 16")
def mass_for_inertia_of_rim(J_r: Value, D_r: Value) -> Value:
    """Mass that a rim must have at its mean diameter."""
    return 4 * J_r / D_r**2


@formula("rim_speed", "khurmi_gupta_2005, ch. 16")
def rim_speed_of_stress(sigma_r: Value, rho_r: Value) -> Value:
    """Speed at which a rim has a hoop stress."""
    return np.sqrt(sigma_r / rho_r)


@formula("rim_speed", "khurmi_gupta_2005, ch. 16")
def rim_speed(w: Value, D_r: Value) -> Value:
    """Speed of a rim at its mean diameter."""
    return w * D_r / 2


@formula("rim_stress", "khurmi_gupta_2005, ch. 16")
def hoop_stress(rho_r: Value, v_r: Value) -> Value:
    """Hoop stress of a rim that its spokes do not hold."""
    return rho_r * v_r**2


@formula("rim_diameter", "khurmi_gupta_2005, ch. 16")
def rim_diameter(v_r: Value, w: Value) -> Value:
    """Mean diameter of a rim of a speed."""
    return 2 * v_r / w


@formula("rim_diameter", "khurmi_gupta_2005, ch. 16")
def rim_diameter_of_section(J_r: Value, rho_r: Value, pi: Value, b_r: Value, t_r: Value) -> Value:
    """Mean diameter that a rim of a section must have, all of its mass at that diameter."""
    return (4 * J_r / (rho_r * pi * b_r * t_r)) ** (1 / 3)


@formula("rim_section", "khurmi_gupta_2005, ch. 16")
def rim_section(m_r: Value, pi: Value, D_r: Value, rho_r: Value) -> Value:
    """Area of the section of a rim."""
    return m_r / (pi * D_r * rho_r)


@formula("rim_thickness", "khurmi_gupta_2005, ch. 16")
def rim_thickness(A_rim: Value, c_r: Value) -> Value:
    """Thickness of a rectangular section of a ratio of its sides."""
    return np.sqrt(A_rim / c_r)


@formula("recovery_torque", "khurmi_gupta_2005, ch. 16")
def recovery_torque(J_sum: Value, delta: Value, w: Value, t_rec: Value) -> Value:
    """Torque that brings a shaft from its least speed back to its greatest in a time."""
    return J_sum * delta * w / t_rec


@dataclass(frozen=True)
class RimSpec:
    """What is known of a rim: speed, stress or diameter, and what is given of the section; or the section alone."""

    diameter: float | None = None  # Mean [m]
    speed: float | None = None  # At that diameter [m/s]
    stress: float | None = None  # Greatest hoop stress [Pa]
    density: float | None = None  # [kg/m3]
    ratio: float | None = None  # Width over thickness [-]
    width: float | None = None  # [m]
    thickness: float | None = None  # [m]
    share: float = 1.0  # Of the moment of inertia of the flywheel [-]


@dataclass(frozen=True)
class FlywheelSpec:
    """What is known of a flywheel besides the fluctuation that is wanted of it."""

    mass: float | None = None  # [kg]
    gyration_radius: float | None = None  # [m]
    rim: RimSpec | None = None
    recovery_time: float | None = None  # In which it shall have its greatest speed again [s]


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

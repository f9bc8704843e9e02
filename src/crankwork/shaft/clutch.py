"""Friction clutches: what a plate or cone transmits, and the slip while two shafts come to one speed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import FORMULAS, Value, formula
from crankwork.notation import ARGUMENTS

_TEXT = "khurmi_gupta_2005, ch. 10"


@formula("clutch_radius", _TEXT)
def radius_of_wear(D_cl: Value, d_cl: Value) -> Value:
    """Mean radius of the friction where wear is uniform, so that the pressure falls with the radius."""
    return (D_cl + d_cl) / 4


@formula("clutch_radius", _TEXT)
def radius_of_pressure(D_cl: Value, d_cl: Value) -> Value:
    """Mean radius of the friction where the pressure is uniform."""
    return (D_cl**3 - d_cl**3) / (3 * (D_cl**2 - d_cl**2))


@formula("clutch_force", _TEXT)
def force_of_worn_face(pi: Value, p_cl: Value, D_cl: Value, d_cl: Value) -> Value:
    """Axial force of a pressure at the inner edge where wear is uniform."""
    return pi * p_cl * d_cl * (D_cl - d_cl) / 2


@formula("clutch_force", _TEXT)
def force_of_even_face(pi: Value, p_cl: Value, D_cl: Value, d_cl: Value) -> Value:
    """Axial force of a uniform pressure."""
    return pi * p_cl * (D_cl**2 - d_cl**2) / 4


@formula("clutch_pressure", _TEXT)
def pressure_of_worn_face(pi: Value, F_cl: Value, D_cl: Value, d_cl: Value) -> Value:
    """Pressure at the inner edge where wear is uniform."""
    return 2 * F_cl / (pi * d_cl * (D_cl - d_cl))


@formula("clutch_pressure", _TEXT)
def pressure_of_even_face(pi: Value, F_cl: Value, D_cl: Value, d_cl: Value) -> Value:
    """Uniform pressure of an axial force."""
    return 4 * F_cl / (pi * (D_cl**2 - d_cl**2))


@formula("clutch_torque", _TEXT)
def torque_of_plates(z_cl: Value, mu_cl: Value, F_cl: Value, R_cl: Value) -> Value:
    """Torque of friction of all faces of a plate clutch."""
    return z_cl * mu_cl * F_cl * R_cl


@formula("clutch_torque", _TEXT)
def torque_of_cone(mu_cl: Value, F_cl: Value, R_cl: Value, alpha_cl: Value) -> Value:
    """Torque of friction of a cone clutch, whose surface is pressed by more than the axial force."""
    return mu_cl * F_cl * R_cl / np.sin(alpha_cl)


@formula("clutch_force", _TEXT)
def force_of_plates(M_cl: Value, z_cl: Value, mu_cl: Value, R_cl: Value) -> Value:
    """Axial force that a plate clutch needs for a torque."""
    return M_cl / (z_cl * mu_cl * R_cl)


@formula("clutch_force", _TEXT)
def force_of_cone(M_cl: Value, mu_cl: Value, R_cl: Value, alpha_cl: Value) -> Value:
    """Axial force that a cone clutch needs for a torque."""
    return M_cl * np.sin(alpha_cl) / (mu_cl * R_cl)


@formula("clutch_power", _TEXT)
def power_of_clutch(M_cl: Value, w_drg: Value) -> Value:
    """Power that the clutch transmits without slip."""
    return M_cl * w_drg


@formula("clutch_torque", _TEXT)
def torque_at_power(P_cl: Value, w_drg: Value) -> Value:
    """Torque of a power that the clutch transmits without slip."""
    return P_cl / w_drg


@formula("driving_inertia", _TEXT)
def inertia_of_side(m_cl: Value, k_cl: Value) -> Value:
    """Moment of inertia of a shaft with all that turns with it."""
    return m_cl * k_cl**2


@formula("closing_acceleration", _TEXT)
def closing_at_one_speed(M_cl: Value, M_drn: Value, J_drn: Value) -> Value:
    """Rate at which the slip falls where the driving shaft keeps its speed."""
    return (M_cl - M_drn) / J_drn


@formula("closing_acceleration", _TEXT)
def closing_of_both(M_cl: Value, M_drn: Value, J_drn: Value, M_drg: Value, J_drg: Value) -> Value:
    """Rate at which the slip falls where the clutch speeds one shaft up and slows the other down."""
    return (M_cl - M_drn) / J_drn + (M_cl - M_drg) / J_drg


@formula("slip_time", _TEXT)
def slip_time(w_drg: Value, w_drn: Value, eps_cl: Value) -> Value:
    """Time until both shafts have one speed."""
    return (w_drg - w_drn) / eps_cl


@formula("engaged_speed", _TEXT)
def engaged_speed(w_drn: Value, M_cl: Value, M_drn: Value, J_drn: Value, t_cl: Value) -> Value:
    """Speed of both shafts when the clutch slips no more."""
    return w_drn + (M_cl - M_drn) / J_drn * t_cl


@formula("slip_heat", _TEXT)
def heat_of_slip(M_cl: Value, w_drg: Value, w_drn: Value, t_cl: Value) -> Value:
    """Work of friction in an engagement, with a slip that falls evenly."""
    return M_cl * (w_drg - w_drn) * t_cl / 2


@formula("engaged_speed", _TEXT)
def speed_of_momentum(J_drg: Value, w_drg: Value, J_drn: Value, w_drn: Value) -> Value:
    """Speed of two shafts together on which nothing else acts, whatever the torque of the clutch is."""
    return (J_drg * w_drg + J_drn * w_drn) / (J_drg + J_drn)


@formula("slip_heat", _TEXT)
def heat_of_momentum(J_drg: Value, w_drg: Value, J_drn: Value, w_drn: Value) -> Value:
    """Kinetic energy that two shafts lose when they come to one speed."""
    return J_drg * J_drn * (w_drg - w_drn) ** 2 / (2 * (J_drg + J_drn))


_FACES: dict[str, tuple[Callable[..., Any], ...]] = {
    "uniform wear": (radius_of_wear, force_of_worn_face, pressure_of_worn_face),
    "uniform pressure": (radius_of_pressure, force_of_even_face, pressure_of_even_face),
}


def work_clutch(worked: Calculation, contact: str, pi: float) -> None:
    """Work all that follows from what is known of a clutch and of its shafts."""
    known = worked.known
    friction = (torque_of_cone, force_of_cone) if "cone_angle" in known else (torque_of_plates, force_of_plates)
    rules = [torque_at_power, *_FACES[contact], *friction, power_of_clutch]
    if not known.keys().isdisjoint(("clutch_torque", "clutch_force", "clutch_pressure", "clutch_power")):
        closing = closing_of_both if "driving_inertia" in known else closing_at_one_speed
        rules += [closing, slip_time, engaged_speed, heat_of_slip]
    elif known["driving_load"].is_absent and known["driven_load"].is_absent:
        rules += [speed_of_momentum, heat_of_momentum]
    for rule in rules * 2:
        entry = FORMULAS[rule.__name__]
        taken = {ARGUMENTS[name].quantity for name in entry.arguments if name != "pi"}
        if entry.quantity not in known and known.keys() >= taken:
            worked(rule, **({"pi": pi} if "pi" in entry.arguments else {}))

"""Dry friction of pins and guides, as laws and formulas."""

from __future__ import annotations

from dataclasses import dataclass

from crankwork.formula.expression import Value, formula


@dataclass(frozen=True)
class PinFriction:
    """Friction in a revolute joint."""

    joint: str  # Name of the joint, see `mechanism.joints`
    radius: float  # Radius of the pin [m]
    # Friction moment over joint force and radius, f': from f in a loose bearing to 1.57 f in a tight new one [-]
    coefficient: float


@dataclass(frozen=True)
class GuideFriction:
    """Friction of a sliding piece on its guide."""

    slider: str  # The sliding piece
    coefficient: float  # Friction force over normal force, the tangent of the friction angle [-]
    # Length of the piece along the guide, its origin in the middle. The moment of the normal force then presses the
    # ends of the piece on both sides; with 0 that moment makes no friction [m]
    length: float = 0.0


Friction = PinFriction | GuideFriction


@formula("friction_radius", "artobolevsky_1988, ch. 11")
def friction_radius(f_z: Value, r_z: Value) -> Value:
    """Radius of the friction circle of a pin."""
    return f_z * r_z


@formula("friction_torque", "artobolevsky_1988, ch. 11")
def friction_torque(rho: Value, R: Value) -> Value:
    """Friction moment in a pin."""
    return rho * R


@formula("friction_force", "artobolevsky_1988, ch. 11")
def friction_force(f: Value, N_s: Value) -> Value:
    """Friction force of a guide."""
    return f * N_s


@formula("efficiency", "artobolevsky_1988, ch. 14")
def instantaneous_efficiency(M_0: Value, M_f: Value) -> Value:
    """Instantaneous efficiency of a mechanism that the crank drives."""
    return M_0 / M_f

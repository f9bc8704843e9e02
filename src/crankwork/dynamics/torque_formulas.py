"""Terms of sums of forces and torques, and differences of the reduced inertia."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("balancing_torque", "artobolevsky_1988, ch. 16")
def balancing_torque_of_parts(M_st: Value, M_dyn: Value) -> Value:
    """Torque on the crank that balances the loads and moves the masses."""
    return M_st + M_dyn


@formula("static_torque", "artobolevsky_1988, ch. 16")
def static_torque_of_balancing(M_b: Value, M_dyn: Value) -> Value:
    """Static torque that a known balancing torque leaves."""
    return M_b - M_dyn


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def forward_difference(J_next: Value, J: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference to the next position."""
    return (J_next - J) / dphi


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def central_difference(J_next: Value, J_prev: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference of the positions on both sides."""
    return (J_next - J_prev) / dphi


@formula("efficiency", "artobolevsky_1988, ch. 14")
def efficiency_share(k_i: Value, eta_i: Value) -> Value:
    """Part of one of several parallel chains in their efficiency."""
    return k_i * eta_i

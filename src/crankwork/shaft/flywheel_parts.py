"""Parts of the choice of a flywheel that a note shows: work per cycle, and the machine's own inertia."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("work_per_cycle", "khurmi_gupta_2005, ch. 16")
def work_of_mean_torque(M_mean: Value, phi_c: Value) -> Value:
    """Work of a torque over a cycle."""
    return M_mean * phi_c


@formula("flywheel_inertia", "artobolevsky_1988, ch. 16")
def flywheel_beside_machine(J_sum: Value, J: Value) -> Value:
    """Moment of inertia that the flywheel has to add to that of the machine."""
    return J_sum - J

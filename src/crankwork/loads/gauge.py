"""From the pressure of an indicator diagram to the pressure that pushes the piston."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("gas_pressure", "kolchin_demidov_2008, ch. 7")
def gauge_pressure(p_abs: Value, p_0: Value) -> Value:
    """Pressure above that on the crankcase side."""
    return p_abs - p_0

"""From the pressure of an indicator diagram to the pressure that pushes the piston."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("gas_pressure", "kolchin_demidov_2008, ch. 7")
def gauge_pressure(p_abs: Value, p_0: Value) -> Value:
    """Pressure above that on the crankcase side.

    Parameters
    ----------
    p_abs, p_0 : array
        Absolute pressure in the cylinder, pressure on the crankcase side. [Pa]

    Returns
    -------
    array
        Pressure on the piston. [Pa]
    """
    return p_abs - p_0

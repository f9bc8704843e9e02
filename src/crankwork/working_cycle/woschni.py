"""Heat to the walls of the cylinder by the correlation of Woschni.

The correlation is an empirical one and has its units built in: the bore in metres, the temperature in kelvins,
the gas speed in metres per second, the pressure in kilopascals (here divided from pascals in the formula itself),
the coefficient in W/(m2 K).
"""

from __future__ import annotations

from typing import NamedTuple

from crankwork.expressions import Value, formula


class GasSpeedFactors(NamedTuple):
    """The two factors of Woschni's gas speed: of the mean piston speed [-] and of the rise by burning [m/(s K)]."""

    piston: float
    burning: float


GAS_EXCHANGE = GasSpeedFactors(6.18, 0.0)
COMPRESSION = GasSpeedFactors(2.28, 0.0)
EXPANSION = GasSpeedFactors(2.28, 3.24e-3)


@formula("wall_gas_speed", "woschni_1967")
def woschni_gas_speed(  # noqa: PLR0913 - one argument per symbol
    C_speed: Value,
    S_pm: Value,
    C_burn: Value,
    V_d: Value,
    T_shut: Value,
    p_shut: Value,
    V_1: Value,
    p_cyl: Value,
    p_mot: Value,
) -> Value:
    """Gas speed at the walls.

    Parameters
    ----------
    C_speed, S_pm, C_burn, V_d : array
        Factor of the piston speed, mean piston speed, factor of burning, swept volume.
        [-], [m/s], [m/(s*K)], [m3]
    T_shut, p_shut, V_1 : array
        Temperature, pressure and volume at intake closing. [K], [Pa], [m3]
    p_cyl, p_mot : array
        Pressure in the cylinder, and without burning at the same angle. [Pa]

    Returns
    -------
    array
        Gas speed. [m/s]

    References
    ----------
    heywood_1988, ch. 12.
    """
    return C_speed * S_pm + C_burn * V_d * T_shut / (p_shut * V_1) * (p_cyl - p_mot)


@formula("heat_transfer_coefficient", "woschni_1967")
def woschni_coefficient(D: Value, p_cyl: Value, T_cyl: Value, w_gas: Value) -> Value:
    """Heat transfer coefficient from gas to walls.

    Parameters
    ----------
    D, p_cyl, T_cyl, w_gas : array
        Bore, pressure, temperature, gas speed at the walls. [m], [Pa], [K], [m/s]

    Returns
    -------
    array
        Coefficient. [W/(m2*K)]

    References
    ----------
    heywood_1988, ch. 12; the exponent of the bore is 0.2, that of the temperature 0.75 - 1.62 * 0.8 = -0.546,
    rounded to -0.55.
    """
    return 3.26 * (p_cyl / 1000) ** 0.8 * w_gas**0.8 / (D**0.2 * T_cyl**0.55)


@formula("wall_area", "heywood_1988, ch. 2")
def wall_area(A_head: Value, A_crown: Value, pi: Value, D: Value, x: Value) -> Value:
    """Area of the walls around the gas.

    Parameters
    ----------
    A_head, A_crown, pi, D, x : array
        Areas of head and crown, pi, bore, distance of the piston from top dead centre.
        [m2], [m2], [-], [m], [m]

    Returns
    -------
    array
        Area. [m2]
    """
    return A_head + A_crown + pi * D * x


@formula("wall_heat_rate", "heywood_1988, ch. 12")
def wall_heat_rate(h_wall: Value, A_wall: Value, T_cyl: Value, T_wall: Value, w: Value) -> Value:
    """Heat to the walls by crank angle.

    Parameters
    ----------
    h_wall, A_wall, T_cyl, T_wall, w : array
        Heat transfer coefficient, wall area, gas and wall temperatures, angular speed of the crank.
        [W/(m2*K)], [m2], [K], [K], [rad/s]

    Returns
    -------
    array
        Heat per crank angle. [J/rad]
    """
    return h_wall * A_wall * (T_cyl - T_wall) / w

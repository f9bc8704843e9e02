"""Heat to the walls of the cylinder by the correlation of Woschni.

The correlation is an empirical one and has its units built in: the bore in metres, the temperature in kelvins,
the gas speed in metres per second, the pressure in kilopascals (here divided from pascals in the formula itself),
the coefficient in W/(m2 K).
"""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.expression import Value, formula


class GasSpeedFactors(NamedTuple):
    """The two factors of Woschni's gas speed: of the mean piston speed [-] and of the rise by burning [m/(s K)]."""

    piston: float
    burning: float


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
    """Gas speed at the walls."""
    return C_speed * S_pm + C_burn * V_d * T_shut / (p_shut * V_1) * (p_cyl - p_mot)


@formula("heat_transfer_coefficient", "woschni_1967", constants="kPa, m, m/s, K")
def woschni_coefficient(D: Value, p_cyl: Value, T_cyl: Value, w_gas: Value) -> Value:
    """Heat transfer coefficient from gas to walls.

    Notes
    -----
    The exponent of the bore is 0.2, that of the temperature 0.75 - 1.62 * 0.8 = -0.546,
    rounded to -0.55.
    """
    return 3.26 * (p_cyl / 1000) ** 0.8 * w_gas**0.8 / (D**0.2 * T_cyl**0.55)


@formula("wall_area", "heywood_1988, ch. 2")
def wall_area(A_head: Value, A_crown: Value, pi: Value, D: Value, x: Value) -> Value:
    """Area of the walls around the gas."""
    return A_head + A_crown + pi * D * x


@formula("wall_heat_rate", "heywood_1988, ch. 12", unit="J/rad")
def wall_heat_rate(h_wall: Value, A_wall: Value, T_cyl: Value, T_wall: Value, w: Value) -> Value:
    """Heat to the walls by crank angle."""
    return h_wall * A_wall * (T_cyl - T_wall) / w

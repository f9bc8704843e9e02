"""A calculated working cycle: its worked steps, its values and the corners of its diagram."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

from crankwork.expressions import Value, formula
from crankwork.steps import Step, Worked

CycleKind = Literal["petrol", "diesel", "otto", "ideal-diesel", "dual"]
Notice = tuple[str, Mapping[str, float | str]]


class Corners(NamedTuple):
    """What the theoretical diagram is drawn from.

    Parameters
    ----------
    p_r, p_a, p_c, p_z, p_b : float
        Absolute pressures at the named points. [Pa]
    rho : float
        Volume at z over the clearance volume; 1 where burning is at constant volume. [-]
    n1, n2 : float
        Exponents of compression and expansion. [-]
    epsilon : float
        Compression ratio of the closed cylinder. [-]
    psi : float
        Share of the stroke that the ports of a two-stroke engine take. [-]
    """

    p_r: float
    p_a: float
    p_c: float
    p_z: float
    p_b: float
    rho: float
    n1: float
    n2: float
    epsilon: float
    psi: float = 0.0


@dataclass(frozen=True)
class CalculatedCycle:
    """A working cycle and how it was calculated.

    Parameters
    ----------
    kind : {"petrol", "diesel", "otto", "ideal-diesel", "dual"}
        What was calculated.
    angle : float
        Crank angle of the cycle, 720 or 360. [deg]
    corners : Corners
        Of the theoretical diagram.
    steps : tuple of Step
        Every calculated value in the order of textbooks.
    values : mapping of str to float
        Data and results by key; of a key worked twice, the last. [SI]
    notices : tuple
        Code and numbers of everything worth saying.
    """

    kind: CycleKind
    angle: float
    corners: Corners
    steps: tuple[Step, ...]
    values: Mapping[str, float]
    notices: tuple[Notice, ...] = ()


@formula("compression_line", "kolchin_demidov_2008, ch. 3")
def compression_line(p_c: Value, i_V: Value, n_1: Value) -> Value:
    """Pressure on the polytrope of compression.

    Parameters
    ----------
    p_c, i_V, n_1 : float
        Pressure at c, volume over clearance volume, exponent. [Pa], [-], [-]

    Returns
    -------
    float
        Absolute pressure. [Pa]
    """
    return p_c / i_V**n_1


@formula("expansion_line", "kolchin_demidov_2008, ch. 3")
def expansion_line(p_z: Value, rho_cut: Value, i_V: Value, n_2: Value) -> Value:
    """Pressure on the polytrope of expansion.

    Parameters
    ----------
    p_z, rho_cut, i_V, n_2 : float
        Pressure at z, cut-off ratio, volume over clearance volume, exponent. [Pa], [-], [-], [-]

    Returns
    -------
    float
        Absolute pressure. [Pa]
    """
    return p_z * (rho_cut / i_V) ** n_2


class PolytropeRow(NamedTuple):
    """Volume over clearance volume [-], pressures on compression and expansion [Pa], the latter from z on only."""

    ratio: float
    compression: float
    expansion: float | None


def polytrope_table(corners: Corners, step: float = 0.5) -> tuple[PolytropeRow, ...]:
    """Return the table from which a diagram is drawn by hand, with rows of its own at z and at the largest volume.

    Parameters
    ----------
    corners : Corners
        Of the diagram.
    step : float
        Step of the volume over the clearance volume. [-]

    Returns
    -------
    tuple of PolytropeRow
        From the clearance volume to the whole one.

    References
    ----------
    nguyen_tat_tien_2000; kolchin_demidov_2008, ch. 3.
    """
    last = corners.epsilon
    count = int((last - 1) / step)
    ratios = sorted({1.0, corners.rho, last, *(1 + step * k for k in range(count + 1))})
    return tuple(
        PolytropeRow(
            ratio,
            compression_line(corners.p_c, ratio, corners.n1),
            expansion_line(corners.p_z, corners.rho, ratio, corners.n2) if ratio >= corners.rho else None,
        )
        for ratio in ratios
    )


def polytrope_steps(corners: Corners, ratio: float) -> tuple[Step, ...]:
    """Return both pressures of one row of the table as worked steps.

    Parameters
    ----------
    corners : Corners
        Of the diagram.
    ratio : float
        Volume over clearance volume, from z on. [-]

    Returns
    -------
    tuple of Step
        Compression and expansion.
    """
    worked = Worked()
    worked(compression_line, corners.p_c, ratio, corners.n1)
    worked(expansion_line, corners.p_z, corners.rho, ratio, corners.n2)
    return tuple(worked.steps)

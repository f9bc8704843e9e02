"""One order of the Fourier series of the piston motion, as `series.series_transfer` adds them up."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("piston_displacement", "taylor_1985, vol. 2, ch. 8")
def series_displacement_term(a_k: Value, cos_kphi: Value, k_h: Value) -> Value:
    """One order of the displacement of a central slider-crank.

    Parameters
    ----------
    a_k, cos_kphi, k_h : array
        Cosine coefficient of d2x/dphi2, cosine of order times crank angle, order. [m], [-], [-]

    Returns
    -------
    array
        Part of the displacement. [m]
    """
    return a_k * (1 - cos_kphi) / k_h**2


@formula("piston_displacement", "taylor_1985, vol. 2, ch. 8")
def series_displacement_term_offset(  # noqa: PLR0913 - two coefficients and two angles
    a_k: Value, cos_kphi_0: Value, b_k: Value, sin_kphi_0: Value, cos_kphi: Value, sin_kphi: Value, k_h: Value
) -> Value:
    """One order of the displacement of an offset slider-crank, from the angle where it is to be zero.

    Parameters
    ----------
    a_k, cos_kphi_0, b_k, sin_kphi_0, cos_kphi, sin_kphi, k_h : array
        Cosine coefficient of d2x/dphi2, cosine of order times the angle of top dead centre, sine coefficient,
        sine there, functions of order times crank angle, order. [m], [-], [m], [-], [-], [-], [-]

    Returns
    -------
    array
        Part of the displacement. [m]
    """
    return (a_k * cos_kphi_0 + b_k * sin_kphi_0 - (a_k * cos_kphi + b_k * sin_kphi)) / k_h**2


@formula("piston_transfer_1", "taylor_1985, vol. 2, ch. 8")
def series_transfer_1_term(a_k: Value, sin_kphi: Value, b_k: Value, cos_kphi: Value, k_h: Value) -> Value:
    """One order of dx/dphi.

    Parameters
    ----------
    a_k, sin_kphi, b_k, cos_kphi, k_h : array
        Cosine coefficient of d2x/dphi2, sine of order times crank angle, sine coefficient, cosine, order.
        [m], [-], [m], [-], [-]

    Returns
    -------
    array
        Part of dx/dphi. [m]
    """
    return (a_k * sin_kphi - b_k * cos_kphi) / k_h


@formula("piston_transfer_2", "taylor_1985, vol. 2, ch. 8")
def series_transfer_2_term(a_k: Value, cos_kphi: Value, b_k: Value, sin_kphi: Value) -> Value:
    """One order of d2x/dphi2.

    Parameters
    ----------
    a_k, cos_kphi, b_k, sin_kphi : array
        Cosine coefficient, cosine of order times crank angle, sine coefficient, sine. [m], [-], [m], [-]

    Returns
    -------
    array
        Part of d2x/dphi2. [m]
    """
    return a_k * cos_kphi + b_k * sin_kphi

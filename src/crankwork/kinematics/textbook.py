"""Slider-crank motion the textbook way: the square root of the rod replaced by two terms."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("piston_displacement_first_order", "kolchin_demidov_2008, ch. 6")
def textbook_displacement_first(r: Value, cos_phi: Value) -> Value:
    """First-order part of the piston displacement: that of an infinitely long rod.

    Parameters
    ----------
    r, cos_phi : array
        Crank radius, cosine of the crank angle. [m], [-]

    Returns
    -------
    array
        Displacement. [m]
    """
    return r * (1 - cos_phi)


@formula("piston_displacement_second_order", "kolchin_demidov_2008, ch. 6")
def textbook_displacement_second(r: Value, lam: Value, cos_2phi: Value) -> Value:
    """Second-order part of the piston displacement.

    Parameters
    ----------
    r, lam, cos_2phi : array
        Crank radius, crank-to-rod ratio, cosine of twice the crank angle. [m], [-], [-]

    Returns
    -------
    array
        Displacement. [m]
    """
    return r * lam / 4 * (1 - cos_2phi)


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6")
def textbook_displacement(r: Value, lam: Value, cos_phi: Value, cos_2phi: Value) -> Value:
    """Piston displacement in two terms.

    Parameters
    ----------
    r, lam, cos_phi, cos_2phi : array
        Crank radius, crank-to-rod ratio, cosines of the crank angle and twice it. [m], [-], [-], [-]

    Returns
    -------
    array
        Displacement from top dead centre. [m]
    """
    return r * ((1 - cos_phi) + lam / 4 * (1 - cos_2phi))


@formula("piston_velocity_first_order", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_1_first(r: Value, sin_phi: Value) -> Value:
    """First-order part of dx/dphi.

    Parameters
    ----------
    r, sin_phi : array
        Crank radius, sine of the crank angle. [m], [-]

    Returns
    -------
    array
        Part of dx/dphi. [m]
    """
    return r * sin_phi


@formula("piston_velocity_second_order", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_1_second(r: Value, lam: Value, sin_2phi: Value) -> Value:
    """Second-order part of dx/dphi.

    Parameters
    ----------
    r, lam, sin_2phi : array
        Crank radius, crank-to-rod ratio, sine of twice the crank angle. [m], [-], [-]

    Returns
    -------
    array
        Part of dx/dphi. [m]
    """
    return r * lam / 2 * sin_2phi


@formula("piston_velocity", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_1(r: Value, lam: Value, sin_phi: Value, sin_2phi: Value) -> Value:
    """First transfer function of the piston in two terms, dx/dphi.

    Parameters
    ----------
    r, lam, sin_phi, sin_2phi : array
        Crank radius, crank-to-rod ratio, sines of the crank angle and twice it. [m], [-], [-], [-]

    Returns
    -------
    array
        dx/dphi. [m]
    """
    return r * (sin_phi + lam / 2 * sin_2phi)


@formula("piston_acceleration_first_order", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_2_first(r: Value, cos_phi: Value) -> Value:
    """First-order part of d2x/dphi2.

    Parameters
    ----------
    r, cos_phi : array
        Crank radius, cosine of the crank angle. [m], [-]

    Returns
    -------
    array
        Part of d2x/dphi2. [m]
    """
    return r * cos_phi


@formula("piston_acceleration_second_order", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_2_second(r: Value, lam: Value, cos_2phi: Value) -> Value:
    """Second-order part of d2x/dphi2.

    Parameters
    ----------
    r, lam, cos_2phi : array
        Crank radius, crank-to-rod ratio, cosine of twice the crank angle. [m], [-], [-]

    Returns
    -------
    array
        Part of d2x/dphi2. [m]
    """
    return r * lam * cos_2phi


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_2(r: Value, lam: Value, cos_phi: Value, cos_2phi: Value) -> Value:
    """Second transfer function of the piston in two terms, d2x/dphi2.

    Parameters
    ----------
    r, lam, cos_phi, cos_2phi : array
        Crank radius, crank-to-rod ratio, cosines of the crank angle and twice it. [m], [-], [-], [-]

    Returns
    -------
    array
        d2x/dphi2. [m]
    """
    return r * (cos_phi + lam * cos_2phi)


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6 (offset mechanism)")
def textbook_displacement_offset(lam: Value, e: Value, sin_phi: Value) -> Value:
    """What a cylinder offset adds to the two-term displacement.

    Parameters
    ----------
    lam, e, sin_phi : array
        Crank-to-rod ratio, offset, sine of the crank angle. [-], [m], [-]

    Returns
    -------
    array
        Addition to the displacement. [m]
    """
    return -(lam * e * sin_phi)


@formula("rod_angular_velocity", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_1(lam: Value, cos_phi: Value) -> Value:
    """First transfer function of the rod to first order, dbeta/dphi.

    Parameters
    ----------
    lam, cos_phi : array
        Crank-to-rod ratio, cosine of the crank angle. [-], [-]

    Returns
    -------
    array
        dbeta/dphi. [-]
    """
    return lam * cos_phi


@formula("rod_angular_acceleration", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_2(lam: Value, sin_phi: Value) -> Value:
    """Second transfer function of the rod to first order, d2beta/dphi2.

    Parameters
    ----------
    lam, sin_phi : array
        Crank-to-rod ratio, sine of the crank angle. [-], [-]

    Returns
    -------
    array
        d2beta/dphi2. [-]
    """
    return -lam * sin_phi


@formula("piston_velocity", "kolchin_demidov_2008, ch. 6 (offset mechanism)")
def textbook_transfer_1_offset(lam: Value, e: Value, cos_phi: Value) -> Value:
    """What a cylinder offset adds to the two-term dx/dphi.

    Parameters
    ----------
    lam, e, cos_phi : array
        Crank-to-rod ratio, offset, cosine of the crank angle. [-], [m], [-]

    Returns
    -------
    array
        Addition to dx/dphi. [m]
    """
    return -(lam * e * cos_phi)


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6 (offset mechanism)")
def textbook_transfer_2_offset(lam: Value, e: Value, sin_phi: Value) -> Value:
    """What a cylinder offset adds to the two-term d2x/dphi2.

    Parameters
    ----------
    lam, e, sin_phi : array
        Crank-to-rod ratio, offset, sine of the crank angle. [-], [m], [-]

    Returns
    -------
    array
        Addition to d2x/dphi2. [m]
    """
    return lam * e * sin_phi

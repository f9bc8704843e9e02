"""Slider-crank motion the textbook way: the square root of the rod replaced by two terms."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6")
def textbook_displacement(r: Value, cos_phi: Value, lam: Value, cos_2phi: Value, e: Value, sin_phi: Value) -> Value:
    """Piston displacement in two terms, and what an offset of the cylinder adds."""
    return r * ((1 - cos_phi) + lam / 4 * (1 - cos_2phi)) - lam * e * sin_phi


@formula("piston_transfer_1", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_1(r: Value, sin_phi: Value, lam: Value, sin_2phi: Value, e: Value, cos_phi: Value) -> Value:
    """First transfer function of the piston in two terms, dx/dphi, and what an offset of the cylinder adds."""
    return r * (sin_phi + lam / 2 * sin_2phi) - lam * e * cos_phi


@formula("piston_transfer_2", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_2(r: Value, cos_phi: Value, lam: Value, cos_2phi: Value, e: Value, sin_phi: Value) -> Value:
    """Second transfer function of the piston in two terms, d2x/dphi2, and what an offset of the cylinder adds."""
    return r * (cos_phi + lam * cos_2phi) + lam * e * sin_phi


@formula("rod_transfer_1", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_1(lam: Value, cos_phi: Value) -> Value:
    """First transfer function of the rod to first order, dbeta/dphi."""
    return lam * cos_phi


@formula("rod_transfer_2", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_2(lam: Value, sin_phi: Value) -> Value:
    """Second transfer function of the rod to first order, d2beta/dphi2."""
    return -lam * sin_phi

"""The flywheel as a body: rim or disc of a wanted moment of inertia, and the stress that its speed causes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from crankwork.formula.expression import Value, formula


@formula("flywheel_mass", "khurmi_gupta_2005, ch. 16")
def rim_mass(J_f: Value, k_g: Value) -> Value:
    """Mass of a flywheel from its moment of inertia."""
    return J_f / k_g**2


@formula("rim_stress", "khurmi_gupta_2005, ch. 16")
def rim_stress(rho_m: Value, v_r: Value) -> Value:
    """Hoop stress of a thin rim that turns, without the help of its arms."""
    return rho_m * v_r**2


@formula("inertia_on_crank", "artobolevsky_1988, ch. 16")
def inertia_on_other_shaft(J_f: Value, i_g: Value) -> Value:
    """Moment of inertia that acts on the crank like a body on a shaft that turns i times as fast."""
    return J_f * i_g**2


@dataclass(frozen=True)
class Rim:
    """A rim of rectangular section; hub and arms are left out, which is on the safe side.

    Parameters
    ----------
    mean_diameter, width, thickness : float
        Mean diameter, width along the shaft, radial thickness. [m]
    density : float
        Density of the material. [kg/m3]
    """

    mean_diameter: float
    width: float
    thickness: float
    density: float = 7200.0

    @property
    def mass(self) -> float:
        """Mass. [kg]"""
        return self.density * math.pi * self.mean_diameter * self.width * self.thickness

    @property
    def inertia(self) -> float:
        """Moment of inertia, exact for the thick ring: m (D^2 + h^2) / 4. [kg m2]"""
        return self.mass * (self.mean_diameter**2 + self.thickness**2) / 4

    def stress(self, speed: float) -> float:
        """Return the hoop stress of the thin ring.

        Parameters
        ----------
        speed : float
            Speed of its shaft. [rad/s]
        """
        return float(rim_stress(self.density, speed * self.mean_diameter / 2))


@dataclass(frozen=True)
class Disc:
    """A disc of constant thickness.

    Parameters
    ----------
    diameter, width : float
        Diameter, thickness along the shaft. [m]
    density, poisson : float
        Density [kg/m3], Poisson's ratio [-] of the material.
    """

    diameter: float
    width: float
    density: float = 7850.0
    poisson: float = 0.3

    @property
    def mass(self) -> float:
        """Mass. [kg]"""
        return self.density * math.pi / 4 * self.diameter**2 * self.width

    @property
    def inertia(self) -> float:
        """Moment of inertia, m D^2 / 8. [kg m2]"""
        return self.mass * self.diameter**2 / 8

    def stress(self, speed: float) -> float:
        """Return the largest stress, in the centre: (3 + nu) / 8 rho v^2.

        Parameters
        ----------
        speed : float
            Speed of its shaft. [rad/s]
        """
        return (3 + self.poisson) / 8 * float(rim_stress(self.density, speed * self.diameter / 2))


def rim_of_inertia(inertia: float, mean_diameter: float, *, width_ratio: float = 2.0, density: float = 7200.0) -> Rim:
    """Return the rim with a wanted moment of inertia and mean diameter.

    Parameters
    ----------
    inertia, mean_diameter : float
        Moment of inertia, mean diameter. [kg m2], [m]
    width_ratio, density : float
        Width over thickness [-], density of the material [kg/m3].

    Notes
    -----
    With A = h^2 width_ratio the section, J = rho pi D A (D^2 + h^2) / 4 is quadratic in h^2.

    References
    ----------
    khurmi_gupta_2005, ch. 16, where h^2 is left out beside D^2.
    """
    square = mean_diameter**2
    whole = 4 * inertia / (density * math.pi * mean_diameter * width_ratio)
    h_square = 2 * whole / (square + math.sqrt(square**2 + 4 * whole))
    thickness = math.sqrt(h_square)
    return Rim(mean_diameter, width_ratio * thickness, thickness, density)


def disc_of_inertia(inertia: float, diameter: float, *, density: float = 7850.0) -> Disc:
    """Return the disc with a wanted moment of inertia and diameter.

    Parameters
    ----------
    inertia, diameter : float
        Moment of inertia, diameter. [kg m2], [m]
    density : float
        Density of the material. [kg/m3]
    """
    return Disc(diameter, 32 * inertia / (density * math.pi * diameter**4), density)


def largest_diameter(strength: float, speed: float, density: float = 7200.0) -> float:
    """Return the mean diameter of a thin rim at which its hoop stress reaches what the material bears.

    Parameters
    ----------
    strength, speed, density : float
        Permissible stress, speed of the shaft, density. [Pa], [rad/s], [kg/m3]
    """
    return 2 / speed * math.sqrt(strength / density)

"""Quantities of balance."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    # free forces and moments
    Quantity("acceleration_coefficient", "",
             "Amplitude of one order of the piston acceleration over crank radius times angular speed squared."),
    Quantity("order_inertia_force", "N", "Amplitude of one order of the inertia force of one cylinder.", "MPa"),
    Quantity("force_factor", "", "Free force of one order over that of one cylinder."),
    Quantity("moment_factor", "", "Free moment of one order over that of one cylinder at one cylinder pitch."),
    Quantity("balance_pitch", "mm", "Distance along the shaft between two cylinders."),
    Quantity("free_force", "N", "Largest sum of the inertia forces of one order of all cylinders."),
    Quantity("free_force_direction", "deg",
             "Direction of the largest free force of one order, from the reference direction of the engine."),
    Quantity("free_moment", "N*m", "Largest moment of the inertia forces of one order along the shaft."),
    # counterweights
    Quantity("balanced_share", "",
             "Share of the reciprocating mass that counterweights balance as if it turned with the crankpin."),
    Quantity("counterweight_moment", "kg*m",
             "Mass of a counterweight times the distance of its centre of mass from the crankshaft axis."),
    # balance shafts
    Quantity("balance_shaft_moment", "kg*m",
             "Mass of the weight on one balance shaft times the distance of its centre of mass from that shaft."),
)  # fmt: skip

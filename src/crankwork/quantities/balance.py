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
    Quantity("shaking_force", "N", "Magnitude of the sum of the inertia forces of all moving masses."),
    Quantity("shaking_force_x", "N", "Sum of the inertia forces of all moving masses along the fixed x axis."),
    Quantity("shaking_force_y", "N", "Sum of the inertia forces of all moving masses along the fixed y axis."),
    Quantity("shaking_moment", "N*m",
             "Moment of the inertia of all moving masses about the pivot of the crank, positive anticlockwise."),
    Quantity("shaking_moment_amplitude", "N*m", "Amplitude of one order of the shaking moment."),
    # counterweights
    Quantity("counterweight_angle", "deg",
             "Direction of a counterweight from the crank, positive anticlockwise, that takes what turns with the crank"
             " of the first order."),
    Quantity("balanced_share", "",
             "Share of the reciprocating mass that counterweights balance as if it turned with the crankpin."),
    Quantity("counterweight_moment", "kg*m",
             "Mass of a counterweight times the distance of its centre of mass from the crankshaft axis."),
    Quantity("best_balanced_share", "",
             "Share of the reciprocating mass at which counterweights leave least of what turns with the crank."),
    Quantity("best_counterweight_moment", "kg*m",
             "Mass moment of a counterweight for the rotating mass and the best share of the reciprocating mass."),
    # balance shafts
    Quantity("balance_shaft_moment", "kg*m",
             "Mass of the weight on one balance shaft times the distance of its centre of mass from that shaft."),
)  # fmt: skip

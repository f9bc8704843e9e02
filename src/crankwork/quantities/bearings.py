"""Quantities of bearing loads."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    # crankpin and big end
    Quantity("big_end_weight", "N", "Weight of the rod mass at the crankpin, along the crank arm."),
    Quantity("big_end_tangential_force", "N", "Weight and inertia of the rod mass there, across the crank arm."),
    Quantity("big_end_inertia_force", "N",
             "Along the crank arm, positive towards the crankshaft, so never positive itself.", "MPa"),
    Quantity("crankpin_radial_force", "N",
             "Radial force of the rods and inertia force of their masses at the crankpin, positive towards the"
             " crankshaft.", "MPa"),
    Quantity("crankpin_tangential_force", "N",
             "Tangential force of all rods on the crankpin, positive with the rotation.", "MPa"),
    Quantity("mean_crankpin_load", "N", "Mean over the cycle of the size of the load on the crankpin.", "MPa"),
    Quantity("crankpin_load", "N", "Size of the force of the rods on the crankpin.", "MPa"),
    Quantity("big_end_load", "N", "Size of the force of the crankpin on the big end of the rod.", "MPa"),
    # piston pin and small end
    Quantity("piston_pin_force", "N",
             "Gas, inertia of the piston group alone and its weight along the axis, positive towards the crankshaft.",
             "MPa"),
    Quantity("small_end_load", "N", "Size of the force of the piston pin on the small end of the rod.", "MPa"),
    Quantity("reversal_duration", "deg",
             "Longest unbroken stretch of the cycle in the direction of the load that has the shorter one."),
    Quantity("reversal_ratio", "", "Smaller over larger of the peak loads in the two directions."),
    # main journals
    Quantity("shaft_unbalance", "kg*m",
             "Mass of a throw or a counterweight times the distance of its centre from the axis of rotation."),
    Quantity("unbalance_force", "N", "Force of a mass fixed to the crankshaft, away from the axis of rotation."),
    Quantity("unbalance_weight", "N", "Weight of such a mass at the crank radius, along its arm away from the shaft."),
    Quantity("unbalance_tangential_force", "N", "Weight and inertia of such a mass across its arm, with the rotation."),
    Quantity("shaft_position", "mm", "Distance along the crankshaft, positive towards higher throws."),
    Quantity("journal_share", "", "By the lever between the two journals of a throw."),
    Quantity("main_journal_load", "N", "Size of the force of the main bearing on the journal.", "MPa"),
    # what a load comes to
    Quantity("bearing_load", "N", "Size of the force on the journal or the bearing.", "MPa"),
    Quantity("bearing_force_x", "N", "Part of the force along the reference direction of its frame.", "MPa"),
    Quantity("bearing_force_y", "N", "Part of the force a quarter turn further with the rotation.", "MPa"),
    Quantity("bearing_load_direction", "deg",
             "Angle of the force from the reference direction of its frame, positive with the rotation."),
    Quantity("mean_bearing_load", "N", "Mean of the size of the load over the cycle.", "MPa"),
    Quantity("bearing_load_ratio", "", "Largest bearing load over the mean one."),
    Quantity("bearing_pressure", "MPa", "Bearing load over diameter times length of the bearing."),
    Quantity("bearing_diameter", "mm", "Diameter of the journal."),
    Quantity("bearing_length", "mm", "Length of the journal that carries load."),
    # wear
    Quantity("wear_ray_angle", "deg",
             "Direction from the centre of the journal to a point of its surface, from the reference direction of its"
             " frame, positive with the rotation."),
    Quantity("wear_sum", "N", "Sum of the loads whose arc of contact covers the ray.", "MPa"),
    Quantity("oil_hole_angle", "deg", "Middle of the least loaded arc of the journal."),
)  # fmt: skip

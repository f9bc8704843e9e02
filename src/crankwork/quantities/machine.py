"""Quantities that say what a crank gear is: lengths, speed, masses."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    # geometry
    Quantity("crank_angle", "deg",
             "Angle of the crank from the cylinder axis on the top-dead-centre side, positive with the rotation."),
    Quantity("crank_radius", "mm", "Distance from the crankshaft axis to the crankpin axis."),
    Quantity("stroke", "mm", "Distance between the dead centres of the piston."),
    Quantity("rod_length", "mm", "Distance between the axes of the crankpin and the piston pin."),
    Quantity("rod_ratio", "", "Crank radius over rod length, r/l."),
    Quantity("inverse_rod_ratio", "", "Rod length over crank radius, l/r."),
    Quantity("offset", "mm",
             "Distance of the cylinder axis from the crankshaft axis, positive towards the crankpin at 90 degrees."),
    Quantity("relative_offset", "", "Cylinder offset over crank radius."),
    Quantity("bore", "mm", "Diameter of the cylinder."),
    Quantity("piston_rod_diameter", "mm", "Diameter of the rod of a double-acting piston."),
    Quantity("piston_area", "cm2", "Area of the piston crown, pi D^2 / 4, of a face less that of a rod."),
    Quantity("clearance_volume", "cm3", "Least volume of the working space."),
    Quantity("total_volume", "cm3", "Volume of the working space where compression begins, as a sheet states it."),
    Quantity("swept_volume", "cm3", "Piston area times stroke: the largest volume less the least."),
    Quantity("compression_ratio", "", "Total volume over clearance volume."),
    Quantity("cylinder_volume", "cm3", "Volume of the working space, above the piston or between faces."),
    Quantity("cycle_angle", "deg", "Crank angle of one working cycle: 720 degrees for four strokes, 360 for two."),
    Quantity("inclination", "deg", "Angle from the upward vertical to the direction from the crankshaft to the head."),
    Quantity("gravity", "m/s2", "Acceleration of free fall."),
    # speed
    Quantity("rotational_speed", "rpm", "Revolutions of the crankshaft per minute."),
    Quantity("speed", "rad/s",
             "Angular speed of the crank, positive from top dead centre towards the crankpin at 90 degrees."),
    Quantity("angular_acceleration", "rad/s2", "Time derivative of the angular speed."),
    Quantity("mean_piston_speed", "m/s", "Twice the stroke per revolution."),
    # masses
    Quantity("mass_per_area", "g/cm2", "A mass over the piston area."),
    Quantity("piston_mass", "kg", "Piston, rings and pin.", "g/cm2"),
    Quantity("rod_mass", "kg", "Connecting rod with its bearings and bolts.", "g/cm2"),
    Quantity("rod_small_end_mass", "kg", "Part of the rod mass placed at the piston pin.", "g/cm2"),
    Quantity("rod_big_end_mass", "kg", "Part of the rod mass placed at the crankpin.", "g/cm2"),
    Quantity("small_end_share", "", "Part of the rod mass placed at the piston pin, over all of it."),
    Quantity("rod_centre_distance", "mm", "Distance of the centre of mass of the rod from the crankpin axis."),
    Quantity("rod_gyration_radius", "mm", "Radius of gyration of the rod about its centre of mass."),
    Quantity("rod_inertia", "kg*m2", "Moment of inertia of the rod about its centre of mass."),
    Quantity("rod_inertia_excess", "kg*m2", "Moment of inertia of the rod less that of its two-mass model."),
    Quantity("crank_mass", "kg", "Unbalanced mass of one crank throw, placed at the crankpin.", "g/cm2"),
    Quantity("reciprocating_mass", "kg", "Piston group and the rod mass at the piston pin.", "g/cm2"),
    Quantity("rotating_mass", "kg", "Crank throw and the rod mass at the crankpin.", "g/cm2"),
)  # fmt: skip

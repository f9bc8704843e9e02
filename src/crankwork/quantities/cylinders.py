"""Quantities of many cylinders on one shaft."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    # layout
    Quantity("firing_interval", "deg", "Crank angle from one firing to the next, each at its own top dead centre."),
    Quantity("firing_angle", "deg", "Crank angle by which that of a cylinder comes after that of cylinder 1."),
    Quantity("cylinder_number", "", "Number of the cylinder."),
    Quantity("bank_axis", "deg", "From the reference direction of the engine, positive with the rotation."),
    Quantity("crankpin_angle", "deg", "Angle of the crankpin ahead of that of cylinder 1, positive with the rotation."),
    Quantity("crankpin_sine", "", "Sine of the angle of the crankpin."),
    Quantity("crankpin_cosine", "", "Cosine of the angle of the crankpin."),
    # torque along the shaft
    Quantity("engine_indicated_power", "kW", "Indicated work of all cylinders per unit of time."),
    Quantity("total_torque", "N*m", "Torque of all cylinders on the crankshaft, positive with the rotation."),
    Quantity("mean_total_torque", "N*m", "Mean of the torque of all cylinders over the cycle."),
    Quantity("throw_torque", "N*m", "Torque of all cylinders of one throw."),
    Quantity("journal_torque", "N*m",
             "Sum of the torques of all throws before the journal, from the free end of the shaft."),
    Quantity("crankpin_torque", "N*m",
             "Torque of the main journal before the crankpin and half of that of its own throw."),
    # harmonics
    Quantity("harmonic_order", "", "How often the harmonic repeats in a revolution of the crankshaft."),
    Quantity("harmonic_cosine", "N*m", "Coefficient of the cosine of one order."),
    Quantity("harmonic_sine", "N*m", "Coefficient of the sine of one order."),
    Quantity("harmonic_amplitude", "N*m", "Amplitude of one order of the torque of one cylinder."),
    Quantity("harmonic_phase", "deg", "Crank angle times the order at which the harmonic is largest."),
    Quantity("phase_sum", "", "Length of the sum of the unit vectors of one order over all cylinders."),
    Quantity("total_harmonic_amplitude", "N*m", "Amplitude of one order of the torque of all cylinders."),
    # articulated rods
    Quantity("articulated_rod_length", "mm", "Distance between the axes of the knuckle pin and the piston pin."),
    Quantity("knuckle_radius", "mm", "Distance from the crankpin axis to the knuckle pin axis."),
    Quantity("knuckle_angle", "deg", "From the axis of the master rod to the knuckle pin, seen from the crankpin."),
    Quantity("knuckle_direction", "deg",
             "From the axis of the articulated rod's cylinder to the knuckle pin, seen from the crankpin."),
    Quantity("knuckle_x", "mm", "From the crankshaft along the axis of the articulated rod's cylinder."),
    Quantity("knuckle_y", "mm", "From the crankshaft across the axis of the articulated rod's cylinder."),
    Quantity("knuckle_sine", "", "Sine of the direction of the knuckle pin."),
    Quantity("knuckle_cosine", "", "Cosine of the direction of the knuckle pin."),
    Quantity("knuckle_direction_1", "", "First derivative of the direction of the knuckle pin by the crank angle."),
    Quantity("knuckle_direction_2", "", "Second derivative of the direction of the knuckle pin by the crank angle."),
    Quantity("knuckle_x_1", "mm", "First derivative of x of the knuckle pin by the crank angle."),
    Quantity("knuckle_x_2", "mm", "Second derivative of x of the knuckle pin by the crank angle."),
    Quantity("knuckle_y_1", "mm", "First derivative of y of the knuckle pin by the crank angle."),
    Quantity("knuckle_y_2", "mm", "Second derivative of y of the knuckle pin by the crank angle."),
    Quantity("articulated_axis", "deg", "From the axis of the master cylinder to that of the cylinder."),
    Quantity("axis_sine", "", "Sine of the angle between the axes of the cylinder and the master cylinder."),
    Quantity("axis_cosine", "", "Cosine of the angle between the axes of the cylinder and the master cylinder."),
    Quantity("master_sine", "", "Sine of the crank angle from the axis of the master cylinder."),
    Quantity("master_cosine", "", "Cosine of the crank angle from the axis of the master cylinder."),
    Quantity("articulated_rod_angle", "deg", "Angle between articulated rod and axis of its cylinder."),
    Quantity("knuckle_mass", "kg", "Part of the mass of the articulated rod placed at the knuckle pin."),
    Quantity("knuckle_acceleration_x", "m/s2", "Of the knuckle pin along the axis of its cylinder, towards the head."),
    Quantity("knuckle_acceleration_y", "m/s2", "Of the knuckle pin across the axis of its cylinder."),
    Quantity("knuckle_force_x", "N", "Of the articulated rod on its knuckle pin, along the axis of its cylinder."),
    Quantity("knuckle_force_y", "N", "Of the articulated rod on its knuckle pin, across the axis of its cylinder."),
    Quantity("knuckle_couple", "N*m", "Moment of the force on the knuckle pin about the crankpin."),
    Quantity("knuckle_side_force", "N", "Side force of the master piston that holds the moment of the knuckle pin."),
)  # fmt: skip

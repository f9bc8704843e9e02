"""Quantities of chambers of gas and of what is sealed in them."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    Quantity("face_sense", "", "1 where a chamber grows as its face moves along the guide, -1 where it shrinks."),
    Quantity("face_volume", "cm3", "What faces have added to their chamber, from where it is least if that is known."),
    Quantity("cylinder_volume_1", "cm3", "Derivative of `cylinder_volume` by the crank angle in radians."),
    Quantity("cylinder_volume_2", "cm3", "Second derivative of `cylinder_volume` by the crank angle in radians."),
    Quantity("gas_mass", "g", "Mass enclosed: from intake closing to exhaust opening, or for good."),
    Quantity("dead_volume", "cm3", "Volume of a part of the gas that no face changes."),
    Quantity("reduced_volume", "cm3/K", "Volume of a part of the gas over its absolute temperature, or their sum."),
    Quantity("rod_load", "N", "Force of all gas on a sliding piece between chambers, positive along its guide."),
    Quantity("suction_pressure", "MPa", "Absolute pressure at which the suction valve opens."),
    Quantity("discharge_pressure", "MPa", "Absolute pressure at which the discharge valve opens."),
    Quantity("suction_temperature", "K", "Absolute temperature of what is drawn in."),
    Quantity("discharge_temperature", "K", "Absolute temperature at the end of compression."),
    Quantity("free_air_pressure", "MPa", "Absolute pressure at which a delivery is told."),
    Quantity("free_air_temperature", "K", "Absolute temperature at which a delivery is told."),
    Quantity("expanded_volume", "cm3", "Volume at which the suction valve opens."),
    Quantity("induced_volume", "cm3", "Volume drawn in during a cycle, at the state of the suction."),
    Quantity("clearance_volumetric_efficiency", "", "Volume drawn in during a cycle over swept volume."),
    Quantity("inlet_flow", "m3/min", "Volume drawn in per unit of time, at the state of the suction."),
    Quantity("gas_mass_flow", "kg/h", "Mass drawn in per unit of time."),
    Quantity("free_air_delivery", "m3/min", "Volume drawn in per unit of time, at the state of free air."),
    Quantity("isothermal_power", "kW", "Power of a compression at the temperature of the suction."),
    Quantity("isothermal_efficiency", "", "Isothermal over indicated power."),
    Quantity("delivered_flow", "m3/min", "Volume delivered per unit of time, as measured."),
    Quantity("discharge_coefficient", "", "Flow as measured over that of stroke and valves."),
    Quantity("pump_slip", "", "Share of the flow of stroke and valves that is not delivered."),
    Quantity("liquid_density", "kg/m3", "Density of what a pump moves."),
    Quantity("pipe_length", "m", "Length of a pipe between a vessel and a valve."),
    Quantity("pipe_diameter", "mm", "Inner diameter of a pipe."),
    Quantity("pipe_area", "cm2", "Area of the section of a pipe."),
    Quantity("pipe_friction", "", "Friction factor of a pipe after Darcy."),
    Quantity("pipe_pressure", "MPa", "Pressure before a pipe less that in the chamber behind its valve."),
    Quantity("acceleration_pressure", "MPa", "Pressure that speeds up the liquid in a pipe."),
    Quantity("friction_pressure", "MPa", "Pressure that the friction in a pipe takes."),
)  # fmt: skip

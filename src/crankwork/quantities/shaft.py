"""Quantities of flywheel, motor and speed."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    # speed, flywheel, motor
    Quantity("crank_torque_sum", "N*m", "Torque of motor and loads on the crank, positive with the rotation."),
    Quantity("load_torque", "N*m", "Torque that drives the crank against its load, mean or root mean square."),
    Quantity("excess_work", "J", "Difference of the extremes of the work that the torque does beyond its mean."),
    Quantity("speed_fluctuation", "", "Largest less least speed, over the mean of the two."),
    Quantity("work_per_cycle", "J", "Mean torque times the crank angle of the cycle."),
    Quantity("energy_fluctuation", "", "Excess work over work per cycle."),
    Quantity("wittenbauer_slope", "J", "Half the square of the speed: kinetic energy per moment of inertia."),
    Quantity("whole_inertia", "kg*m2", "Moment of inertia on the crank that the wanted fluctuation needs."),
    Quantity("flywheel_inertia", "kg*m2", "Moment of inertia of the flywheel about its shaft."),
    Quantity("inertia_on_crank", "kg*m2", "Moment of inertia on the crank that stores the same energy."),
    Quantity("gear_ratio", "", "Speed of the shaft over the speed of the crank."),
    Quantity("mains_frequency", "Hz", "Frequency of the mains."),
    Quantity("pole_pairs", "", "Half the number of poles."),
    Quantity("synchronous_speed", "rad/s", "Speed of the field of an alternating-current motor."),
    Quantity("slip", "", "Lag behind the synchronous speed, over that speed."),
    Quantity("rated_slip", "", "Slip at rated power."),
    Quantity("breakdown_slip", "", "Slip of the greatest torque."),
    Quantity("overload_capacity", "", "Greatest over rated torque of a motor."),
    Quantity("resistance_ratio", "", "Resistance of the stator over that of the rotor, referred to the stator."),
    Quantity("breakdown_torque", "N*m", "Greatest torque of an asynchronous motor."),
    Quantity("motor_torque", "N*m", "Torque of the motor on its own shaft."),
    Quantity("motor_power", "kW", "Power that the motor must have."),
    Quantity("power_reserve", "", "Rated power over the power that is needed."),
)  # fmt: skip

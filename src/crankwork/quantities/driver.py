"""Quantities of drivers and of the laws by which they move."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    Quantity("time", "s", "Time since the beginning of the period of a driver's law."),
    Quantity("period", "s", "Time after which the law of a driver begins again."),
    Quantity("start_time", "s", "Time at which a segment of a law begins."),
    Quantity("segment_time", "s", "Time that a segment of a law takes."),
    Quantity("time_share", "", "Part of the time of a segment that has passed."),
    Quantity("way_share", "", "Part of the way of a segment that is done."),
    Quantity("way_share_1", "", "First derivative of the part of the way by the part of the time."),
    Quantity("way_share_2", "", "Second derivative of the part of the way by the part of the time."),
    Quantity("law_coefficient", "", "Coefficient of a motion law."),
    Quantity("law_amplitude", "", "Amplitude of the normalised acceleration of a motion law."),
    Quantity("law_frequency", "", "Factor of the part of the time in the sine of a motion law."),
    Quantity("law_phase", "", "Constant angle in the sine of a motion law."),
    Quantity("driver_way", "mm", "Way of the driver in one segment of its law."),
    Quantity("driver_turn", "deg", "Angle through which the driver turns in one segment of its law."),
    Quantity("driver_displacement", "mm", "Coordinate of a driver that moves along a line: of a slider its distance"
             " along the guide, of a cylinder its length."),
    Quantity("driver_velocity", "m/s", "Time derivative of the displacement of the driver."),
    Quantity("driver_acceleration", "m/s2", "Second time derivative of the displacement of the driver."),
    Quantity("driver_angle", "deg", "Coordinate of a driver that turns."),
    Quantity("driver_speed", "rad/s", "Time derivative of the angle of the driver."),
    Quantity("driver_angular_acceleration", "rad/s2", "Second time derivative of the angle of the driver."),
    Quantity("link_length_1", "mm", "First derivative of the length of a link by the coordinate of the driver."),
    Quantity("link_length_2", "mm", "Second derivative of the length of a link by the coordinate of the driver."),
    Quantity("stretch_x", "mm", "What a link of changing length adds to the second derivative of its end, along x."),
    Quantity("stretch_y", "mm", "What a link of changing length adds to the second derivative of its end, along y."),
    Quantity("driver_force", "N",
             "Force with which a driver moves its mechanism, positive as its coordinate grows: of a cylinder pushing."),
    Quantity("driver_torque", "N*m", "Torque with which a driver moves its mechanism, positive as its angle grows."),
    Quantity("driver_power", "kW", "Force times velocity of the driver, or torque times angular velocity."),
)  # fmt: skip

"""Coordinates of a linkage in a position: angles, distances, positions of sliders, the driver's coordinate."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from crankwork.kinematics.dyads import LinkMotion, fixed_guide, guide_on_link, in_link_frame
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import Guide
from crankwork.mechanism.mechanism import Mechanism


class Configurations(NamedTuple):
    """Some positions on a circuit: directions and frames of all links, with derivatives by the arc."""

    angles: dict[str, Transfer]
    frames: dict[str, LinkMotion]


Coordinate = Callable[[Configurations], Transfer]


def link_angle(name: str) -> Coordinate:
    """Return the direction of a link from the x axis. [rad]"""
    return lambda poses: poses.angles[name]


def driver_coordinate(mechanism: Mechanism) -> Coordinate:
    """Return the driver's coordinate: a crank angle or an angle between links [rad], a distance or a length [m]."""
    driver = mechanism.driver
    match driver:
        case DrivingSlider():
            return slider_place(driver.guide, driver.link)
        case Cylinder():
            return slider_place(Guide(link=driver.link), rod_of(driver.link))
        case LinkMotor():
            return relative_angle(*driver.links)

    def coordinate(poses: Configurations) -> Transfer:
        angle = poses.angles[driver.link]
        rate = driver.direction * angle.position_1
        return Transfer(driver.direction * (angle.position - driver.start), rate, angle.position_2)

    return coordinate


def relative_angle(link: str, other: str) -> Coordinate:
    """Return the angle from one link to another. [rad]"""
    return lambda poses: Transfer(*(b - a for a, b in zip(poses.angles[link], poses.angles[other], strict=True)))


def slider_place(guide: Guide, piece: str) -> Coordinate:
    """Return the distance of a sliding piece along its guide. [m]"""

    def coordinate(poses: Configurations) -> Transfer:
        line = guide_on_link(poses.frames[guide.link], guide) if guide.link else fixed_guide(guide)
        return in_link_frame(line, poses.frames[piece].origin).x

    return coordinate


def rod_of(link: str) -> str:
    """Return the name of the rod of a link whose length changes."""
    return f"{link}.rod"

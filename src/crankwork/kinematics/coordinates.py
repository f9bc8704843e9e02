"""What is measured on positions of a linkage: angles, distances, places of sliders, the coordinate of a driver."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from crankwork.kinematics.dyads import LinkMotion, fixed_guide, guide_on_link, seen_from
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import Guide
from crankwork.mechanism.mechanism import Mechanism


class Stretch(NamedTuple):
    """Some positions of a circuit: directions and frames of all links, derivatives by the arc."""

    angles: dict[str, Transfer]
    frames: dict[str, LinkMotion]


Coordinate = Callable[[Stretch], Transfer]


def link_angle(name: str) -> Coordinate:
    """Return the direction of a link from the x axis. [rad]"""
    return lambda there: there.angles[name]


def driver_coordinate(mechanism: Mechanism) -> Coordinate:
    """Return what drives: a crank angle or the angle between two links [rad], a distance or a length [m]."""
    driver = mechanism.driver
    match driver:
        case DrivingSlider():
            return slider_place(driver.guide, driver.link)
        case Cylinder():
            return slider_place(Guide(link=driver.link), rod_of(driver.link))
        case LinkMotor():
            return relative_angle(*driver.links)

    def coordinate(there: Stretch) -> Transfer:
        angle = there.angles[driver.link]
        rate = driver.direction * angle.position_1
        return Transfer(driver.direction * (angle.position - driver.start), rate, angle.position_2)

    return coordinate


def relative_angle(link: str, other: str) -> Coordinate:
    """Return the angle from one link to another. [rad]"""
    return lambda there: Transfer(*(b - a for a, b in zip(there.angles[link], there.angles[other], strict=True)))


def slider_place(guide: Guide, piece: str) -> Coordinate:
    """Return the distance of a sliding piece along its guide. [m]"""

    def coordinate(there: Stretch) -> Transfer:
        line = guide_on_link(there.frames[guide.link], guide) if guide.link else fixed_guide(guide)
        return seen_from(line, there.frames[piece].origin).x

    return coordinate


def rod_of(link: str) -> str:
    """Return the name of the rod of a link whose length changes."""
    return f"{link}.rod"

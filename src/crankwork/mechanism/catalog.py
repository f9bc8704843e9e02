"""Mechanisms every book has, as a crank and dyads. Crank pivot in the origin; lengths in metres, angles in radians."""

from __future__ import annotations

import math

from crankwork.errors import GeometryError
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import RPP, RPR, RRP, RRR, Branch, Guide, Point
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism


def four_bar(
    crank: float,
    coupler: float,
    rocker: float,
    ground: float,
    *,
    branch: Branch = 1,
    coupler_point: Point | None = None,
) -> Mechanism:
    """Return a four-bar linkage, its fixed link on the x axis, the crank turning anticlockwise from it.

    Points `crank_pin`, `coupler_pin`, `rocker_pivot`, links `coupler` and `rocker`.

    Parameters
    ----------
    crank, coupler, rocker, ground : float
        The lengths. [m]
    branch : {1, -1}
        1 if the coupler pin lies on the left on the way from the crank pin to the rocker pivot.
    coupler_point : tuple of float, optional
        A point of the coupler, along and across from the crank pin. [m]
    """
    dyad = RRR("crank_pin", "rocker_pivot", "coupler_pin", "coupler", "rocker", coupler, rocker, branch)
    points = (LinkPoint("coupler_point", "coupler", *coupler_point),) if coupler_point else ()
    return Mechanism(Crank(crank), (dyad,), ground={"rocker_pivot": (ground, 0.0)}, points=points)


def watt_six_bar(
    first: Mechanism, arm: Point, link: float, output: float, pivot: Point, branch: Branch = 1
) -> Mechanism:
    """Return a Watt six-bar: a four-bar whose rocker drives a second one.

    Parameters
    ----------
    first : Mechanism
        A four-bar linkage of `four_bar`.
    arm : tuple of float
        The second pin of the rocker, along and across from its pivot. [m]
    link, output : float
        Lengths of the second coupler and rocker. [m]
    pivot : tuple of float
        Pivot of the second rocker. [m]
    branch : {1, -1}
        1 if the output pin lies on the left on the way from the second pin to the second pivot.
    """
    return _six_bar(first, LinkPoint("second_pin", "rocker", *arm), link, output, pivot, branch)


def stephenson_six_bar(
    first: Mechanism, point: Point, link: float, output: float, pivot: Point, branch: Branch = 1
) -> Mechanism:
    """Return a Stephenson III six-bar: a four-bar whose coupler drives a dyad.

    Parameters
    ----------
    first : Mechanism
        A four-bar linkage of `four_bar`.
    point : tuple of float
        The third pin of the coupler, along and across from the crank pin. [m]
    link, output : float
        Lengths of the second coupler and rocker. [m]
    pivot : tuple of float
        Pivot of the second rocker. [m]
    branch : {1, -1}
        1 if the output pin lies on the left on the way from the third pin to the second pivot.
    """
    return _six_bar(first, LinkPoint("second_pin", "coupler", *point), link, output, pivot, branch)


def _six_bar(first: Mechanism, pin: LinkPoint, link: float, output: float, pivot: Point, branch: Branch) -> Mechanism:
    dyad = RRR("second_pin", "output_pivot", "output_pin", "second_coupler", "output", link, output, branch)
    ground = {**first.ground, "output_pivot": pivot}
    return Mechanism(first.crank, (*first.dyads, dyad), ground=ground, points=(*first.points, pin))


def crank_shaper(crank: float, pivot_distance: float, lever: float, link: float, ram_height: float) -> Mechanism:
    """Return a crank shaper: a slotted lever pivoted below the crank, its tip linked to a ram on a level guide.

    Links `lever` and `link`, sliding pieces `block` and `ram`; at a crank angle of zero the crank stands upright.

    Parameters
    ----------
    crank : float
        Crank radius, less than `pivot_distance`. [m]
    pivot_distance : float
        How far the lever's pivot lies below the crankshaft. [m]
    lever, link : float
        Length of the lever from pivot to tip, and of the link from tip to ram. [m]
    ram_height : float
        Height of the guide above the crankshaft. [m]
    """
    if not crank < pivot_distance:
        raise GeometryError(ErrorMessage("lever_turns", crank=crank * 1e3, pivot=pivot_distance * 1e3))
    lever_dyad = RPR("crank_pin", "lever_pivot", "lever", "block")
    ram = RRP("tip", "ram_pin", "link", link, guide_point=(0.0, ram_height), block="ram")
    return Mechanism(
        Crank(crank, start=math.pi / 2),
        (lever_dyad, ram),
        ground={"lever_pivot": (0.0, -pivot_distance)},
        points=(LinkPoint("tip", "lever", lever),),
    )


def whitworth(crank: float, pivot_distance: float, arm: float, link: float, ram_height: float = 0.0) -> Mechanism:
    """Return a Whitworth quick return: a slotted lever that turns fully, its arm linked to a ram on a level guide.

    Parameters
    ----------
    crank : float
        Crank radius, more than `pivot_distance`. [m]
    pivot_distance : float
        How far the lever's pivot lies below the crankshaft. [m]
    arm, link : float
        Length of the arm opposite to the slot, and of the link to the ram. [m]
    ram_height : float
        Height of the guide above the lever's pivot. [m]
    """
    if not crank > pivot_distance:
        raise GeometryError(ErrorMessage("lever_swings", crank=crank * 1e3, pivot=pivot_distance * 1e3))
    ram = RRP("tip", "ram_pin", "link", link, guide_point=(0.0, ram_height - pivot_distance), block="ram")
    return Mechanism(
        Crank(crank),
        (RPR("crank_pin", "lever_pivot", "lever", "block"), ram),
        ground={"lever_pivot": (0.0, -pivot_distance)},
        points=(LinkPoint("tip", "lever", -arm),),
    )


def scotch_yoke(crank: float, slot_angle: float = math.pi / 2) -> Mechanism:
    """Return a Scotch yoke that slides along the x axis.

    Sliding pieces `yoke`, its distance along the guide, and `block` in its slot.

    Parameters
    ----------
    crank : float
        Crank radius. [m]
    slot_angle : float
        Angle of the slot to the guide. [rad]
    """
    return Mechanism(Crank(crank), (RPP("crank_pin", "yoke", "block", Guide(angle=slot_angle)),))


def toggle_press(crank: float, rod: float, upper: float, lower: float, pivot: Point) -> Mechanism:
    """Return a toggle (knuckle) press: a rod that straightens two levers, the lower one on the ram.

    Point `knee`, links `rod`, `upper`, `lower`, sliding piece `ram`, its distance counted downwards.

    Parameters
    ----------
    crank, rod : float
        Crank radius and length of the rod from the crank pin to the knee. [m]
    upper, lower : float
        Lengths of the levers above and below the knee. [m]
    pivot : tuple of float
        Fixed pivot of the upper lever; the ram slides on the vertical line below it. [m]
    """
    side: Branch = -1 if pivot[0] > 0 else 1
    return Mechanism(
        Crank(crank),
        (
            RRR("crank_pin", "upper_pivot", "knee", "rod", "upper", rod, upper, side),
            RRP("knee", "ram_pin", "lower", lower, guide_point=pivot, guide_angle=-math.pi / 2, block="ram"),
        ),
        ground={"upper_pivot": pivot},
    )

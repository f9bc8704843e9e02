"""Joint forces of the five dyads in closed form.

Each takes what acts on its two links, moments about the origins of their frames, and gives the force in its
inner joint and in the two outer ones, on the link that each joint holds (see `mechanism.joints`).
"""

from __future__ import annotations

from typing import NamedTuple

from crankwork.dynamics.link_loads import Wrench, cross
from crankwork.kinematics.crank_grid import Array

Vector = tuple[Array, Array]


class OnGuide(NamedTuple):
    """Normal force on a sliding piece [N] and its moment about the origin of the piece [N m], arrays of shape (n,)."""

    normal: Array
    moment: Array


def rrr_forces(a: Wrench, b: Wrench, u: Vector, v: Vector) -> tuple[Vector, Vector, Vector]:
    """Return the forces in the pins of two links.

    Parameters
    ----------
    a, b : Wrench, arrays of shape (n,)
        What acts on the links, moments about their outer pins. [N], [N]
    u, v : tuple of array, shape (n,)
        From the outer pins of the links to the inner one. [m], [m]

    Returns
    -------
    tuple of three tuples of array, shape (n,)
        On the first link from outside, on the second from the first, on the second from outside. [N]

    Notes
    -----
    The moments about the outer pins, u x R = M_a and v x R = -M_b, give R = (M_a v + M_b u) / (u x v).

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    area = cross(u, v)
    inner = (a.moment * v[0] + b.moment * u[0]) / area, (a.moment * v[1] + b.moment * u[1]) / area
    return _minus(inner, a), inner, _balance(b, inner)


def rrp_forces(link: Wrench, piece: Wrench, u: Vector, t: Vector) -> tuple[Vector, Vector, OnGuide]:
    """Return the forces in the pins of a link and on the guide of its sliding piece.

    Parameters
    ----------
    link, piece : Wrench, arrays of shape (n,)
        What acts on them, moments about outer and inner pin. [N], [N]
    u, t : tuple of array, shape (n,)
        From the outer pin to the inner one [m], direction of the guide [-].

    Returns
    -------
    tuple of array, shape (n,)
        On the link from outside, on the piece from the link [N], on the piece from the guide.

    Notes
    -----
    Along the guide the piece gives R_t = -F_t; about the outer pin the link gives u x R = M, hence
    R_n = (M + u_n R_t) / u_t.

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    n = -t[1], t[0]
    along = -_dot(piece, t)
    across = (link.moment + (u[0] * n[0] + u[1] * n[1]) * along) / (u[0] * t[0] + u[1] * t[1])
    inner = along * t[0] + across * n[0], along * t[1] + across * n[1]
    return _minus(inner, link), inner, OnGuide(-_dot(piece, n) - across, -piece.moment)


def rpr_forces(lever: Wrench, block: Wrench, u: Vector, t: Vector) -> tuple[Vector, OnGuide, Vector]:
    """Return the forces in the pins of a slotted lever and its block, and between them.

    Parameters
    ----------
    lever, block : Wrench, arrays of shape (n,)
        What acts on them, moments about the pivot of the lever and the pin of the block. [N], [N]
    u, t : tuple of array, shape (n,)
        From the pivot to the pin [m], direction of the slot [-].

    Returns
    -------
    tuple of array, shape (n,)
        On the block from its pin [N], on the block from the slot, on the lever from its pivot [N].

    Notes
    -----
    The block gives R_t = -F_t and takes its moment from the slot; the lever gives N = (M + M_block) / u_t.

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    n = -t[1], t[0]
    normal = (lever.moment + block.moment) / (u[0] * t[0] + u[1] * t[1])
    pressed = normal * n[0], normal * n[1]
    return _balance(block, pressed), OnGuide(normal, -block.moment), _minus(pressed, lever)


def prp_forces(a: Wrench, b: Wrench, t_a: Vector, t_b: Vector) -> tuple[OnGuide, Vector, OnGuide]:
    """Return the forces on the guides of two blocks and in the pin between them.

    Parameters
    ----------
    a, b : Wrench, arrays of shape (n,)
        What acts on the blocks, moments about the pin. [N], [N]
    t_a, t_b : tuple of array, shape (n,)
        Directions of the guides. [-], [-]

    Returns
    -------
    tuple of array, shape (n,)
        On the first block from its guide, on the second block from the first [N], on the second from its guide.

    Notes
    -----
    Along the guides R t_a = F_a t_a and R t_b = -F_b t_b.

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    sine, along_a, along_b = cross(t_a, t_b), _dot(a, t_a), -_dot(b, t_b)
    inner = (along_a * t_b[1] - along_b * t_a[1]) / sine, (along_b * t_a[0] - along_a * t_b[0]) / sine
    x, y = inner
    on_a = OnGuide((x - a.x) * -t_a[1] + (y - a.y) * t_a[0], -a.moment)
    on_b = OnGuide((x + b.x) * t_b[1] - (y + b.y) * t_b[0], -b.moment)
    return on_a, inner, on_b


def rpp_forces(yoke: Wrench, block: Wrench, u: Vector, slot: Vector, guide: Vector) -> tuple[Vector, OnGuide, OnGuide]:
    """Return the forces in the pin of a block, in the slot of its yoke and on the guide of the yoke.

    Parameters
    ----------
    yoke, block : Wrench, arrays of shape (n,)
        What acts on them, moments about the origin of the yoke and the pin of the block. [N], [N]
    u, slot, guide : tuple of array, shape (n,)
        From the origin of the yoke to the pin, directions of slot and guide. [m], [-], [-]

    Returns
    -------
    tuple of array, shape (n,)
        On the block from its pin [N], on the block from the slot, on the yoke from its guide.

    Notes
    -----
    Along the guide the yoke gives N n t = F t with the normal n of the slot; across it and about its origin the rest.

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    n = -slot[1], slot[0]
    normal = _dot(yoke, guide) / (n[0] * guide[0] + n[1] * guide[1])
    pressed = normal * n[0], normal * n[1]
    on_yoke = (pressed[0] - yoke.x) * -guide[1] + (pressed[1] - yoke.y) * guide[0]
    moment = -yoke.moment - block.moment + cross(u, pressed)
    return _balance(block, pressed), OnGuide(normal, -block.moment), OnGuide(on_yoke, moment)


def _dot(force: Wrench, t: Vector) -> Array:
    return force.x * t[0] + force.y * t[1]


def _minus(reaction: Vector, force: Wrench) -> Vector:
    return reaction[0] - force.x, reaction[1] - force.y


def _balance(force: Wrench, reaction: Vector) -> Vector:
    return -force.x - reaction[0], -force.y - reaction[1]

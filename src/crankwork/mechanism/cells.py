"""Cells: the rods between the crank, or a rod on it, and pieces on fixed guides, cells from the structure alone."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from crankwork.errors import Problem
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import RRP, Bar, Branch, Point
from crankwork.mechanism.mechanism import Body, Crank, LinkPoint, Mechanism

# of the largest length, where rounding begins
_SAME = 1e-12


class NoCellsError(Exception):
    """A machine that is not made of equal cells: the reason, and the key in the description that shows it."""

    def __init__(self, reason: str, key: str = "") -> None:
        super().__init__(reason)
        self.problem = Problem(key, reason)


@dataclass(frozen=True)
class Part:
    """Mass of a rod or a piece [kg], its moment of inertia about the centre of mass [kg m2], and that centre [m].

    `centre` of a rod: from its joint along it and to the left of that, as a complex number; of a piece: from its pin
    along its guide.
    """

    mass: float = 0.0
    inertia: float = 0.0
    centre: complex = 0j


@dataclass(frozen=True)
class Cell:
    """A rod between a pin of the crank, or of the rod of another cell, and a piece on a fixed guide."""

    slider: str  # Name of the piece
    link: str  # Name of the rod
    pin: str  # Name of its crankpin; of a rod on another rod the crankpin of that one
    length: float  # Of the rod [m]
    # Direction from the shaft to the piece at its outer dead position, from the x axis [rad]
    head: float
    offset: float  # Of the line of its pin from the shaft, positive towards the crankpin at 90 degrees [m]
    sense: Branch  # 1 if its distance along the guide grows towards the head, -1 if it falls
    master: str = ""  # Name of the rod that carries its joint, empty if the crank does
    knuckle: complex = 0j  # Its joint, from the crankpin along that rod and to the left of it [m]
    rod: Part = Part()
    piston: Part = Part()


@dataclass(frozen=True)
class CrankCells:
    """The cells of a mechanism in the order of its dyads, and its crank."""

    crank: Crank
    cells: tuple[Cell, ...]
    # Pins of the crank that rods turn on, from the shaft along the arm and to the left of it [m]
    pins: Mapping[str, complex]
    turning: Part  # Mass of the crank, with its centre counted like the pins


def crank_cells(mechanism: Mechanism) -> CrankCells:
    """Return the cells of a mechanism; NoCellsError if it has a driver or a dyad of another kind."""
    crank = mechanism.driver
    if not isinstance(crank, Crank) or crank.law is not None or crank.geared:
        raise NoCellsError(ErrorMessage("cells_driver"))
    points = {point.name: point for point in mechanism.points}
    on_crank = {name: complex(point.along, point.across) for name, point in points.items() if point.link == crank.link}
    on_crank[crank.pin] = complex(crank.radius)
    cells = dict[str, Cell]()
    for dyad in mechanism.dyads:
        if not isinstance(dyad, RRP) or dyad.guide_link:
            raise NoCellsError(ErrorMessage("cells_dyad", name=_names(dyad)))
        cell = _cell(dyad, crank)
        if dyad.joint in on_crank:
            cell = replace(cell, pin=dyad.joint)
        else:
            cell = _on_master(cell, points.get(dyad.joint), cells, mechanism.bars)
        cells[cell.link] = cell
    if not cells:
        raise NoCellsError(ErrorMessage("cells_driver"))
    pins = {cell.pin: on_crank[cell.pin] for cell in cells.values()}
    if any(abs(abs(pin) - crank.radius) > _SAME * crank.radius for pin in pins.values()):
        raise NoCellsError(ErrorMessage("cells_radii"))
    return _with_bodies(CrankCells(crank, tuple(cells.values()), pins, Part()), mechanism, on_crank)


def _names(group: object) -> str:
    """Return the names of the links of a group."""
    links = [link.name for link in getattr(group, "links", ())]
    names = [getattr(group, key, "") for key in ("link", "link_a", "link_b", "block", "block_a", "block_b", "slider")]
    return ", ".join(dict.fromkeys(name for name in (*links, *names) if name))


def _cell(rod: RRP, crank: Crank) -> Cell:
    head = rod.guide_angle if rod.branch == 1 else rod.guide_angle + math.pi
    away = complex(*rod.guide_point) - complex(*crank.pivot)
    offset = (away * cmath.exp(-1j * (head + crank.direction * math.pi / 2))).real
    offset = offset if abs(offset) > _SAME * rod.length else 0.0
    return Cell(rod.piece, rod.link, "", rod.length, head, offset, rod.branch)


def _on_master(cell: Cell, joint: LinkPoint | None, cells: Mapping[str, Cell], bars: Mapping[str, Bar]) -> Cell:
    """Return a cell whose rod turns on a point of another rod."""
    master = cells.get(joint.link) if joint is not None else None
    if joint is None or master is None or master.master:
        raise NoCellsError(ErrorMessage("cells_joint", name=cell.link))
    return replace(
        cell, pin=master.pin, master=master.link, knuckle=_along_rod((joint.along, joint.across), bars.get(master.link))
    )


def _along_rod(point: Point, bar: Bar | None) -> complex:
    """Return a point of a rod from its joint along the rod and to the left of it. [m]"""
    return complex(*point) if bar is None else (complex(*point) - complex(*bar.start)) * cmath.exp(-1j * bar.angle)


def _with_bodies(cells: CrankCells, mechanism: Mechanism, on_crank: Mapping[str, complex]) -> CrankCells:
    """Return the cells with their masses."""
    points = {point.name: point for point in mechanism.points}
    dyads = {dyad.link: dyad for dyad in mechanism.dyads if isinstance(dyad, RRP)}
    rods, pieces, turning = dict[str, Part](), dict[str, Part](), Part()
    for body in mechanism.bodies:
        if body.link == cells.crank.link:
            turning = _part(body, {**dict.fromkeys(mechanism.ground, 0j), **on_crank})
        elif body.link in dyads:
            dyad, bar = dyads[body.link], mechanism.bars.get(body.link)
            own = {
                name: _along_rod((point.along, point.across), bar)
                for name, point in points.items()
                if point.link == body.link
            }
            rods[body.link] = _part(body, {**own, dyad.joint: 0j, dyad.slider: complex(dyad.length)})
        else:
            on_piece = [point for point in mechanism.points if point.link == body.link]
            own = {point.name: complex(point.along, point.across) for point in on_piece}
            pins = {dyad.slider: 0j for dyad in dyads.values() if dyad.piece == body.link}
            pieces[body.link] = _part(body, {**own, **pins})
    with_masses = tuple(
        replace(cell, rod=rods.get(cell.link, Part()), piston=pieces.get(cell.slider, Part())) for cell in cells.cells
    )
    return replace(cells, cells=with_masses, turning=turning)


def _part(body: Body, places: Mapping[str, complex]) -> Part:
    start, end = places[body.start], places[body.end]
    return Part(body.mass, body.inertia, start + body.share * (end - start))

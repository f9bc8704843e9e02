"""The engine equivalent to a linkage of crank, rods and pistons, from its structure, never from its names."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from crankwork.cylinders.articulated import ArticulatedRod, check_articulated_rod
from crankwork.cylinders.firing import SAME_ANGLE, wrap_angle
from crankwork.cylinders.journal_loads import check_journals
from crankwork.cylinders.layout import MOST_CYLINDERS, CylinderPlace, Layout
from crankwork.dynamics.masses import CrankGearMasses, rod_big_end_mass, rod_inertia_excess, rod_small_end_mass
from crankwork.errors import CrankworkError, Problem
from crankwork.kinematics.slider_crank import SliderCrank, check_slider_crank
from crankwork.loads.chamber import Chamber
from crankwork.loads.load import Weight
from crankwork.locale import ErrorMessage
from crankwork.machine import Bearings, Cylinder, Drive, Engine, Gas, Machine, Shaft
from crankwork.mechanism.cells import Cell, CrankCells, NoCellsError, Part, crank_cells
from crankwork.mechanism.mechanism import slider_crank
from crankwork.preparation.cell_gas import CellChambers, bore_of, chambers_of, gas_of, is_close, nearly_equal

_TURN = 360.0
# of the size of a value, where rounding begins
_SAME = 1e-12
# of angles that are worked out of positions [deg]
_SAME_ANGLE = 1e-9


def engine_form(machine: Machine) -> Machine | None:
    """Return a linkage of crank, rods and pistons as the engine that it is, None if it is another machine.

    The engine is without friction and motor.

    The crank angle counts as in the linkage: from the axis of cylinder 1.
    """
    form = engine_form_or_reason(machine)
    return form if isinstance(form, Machine) else None


def engine_form_or_reason(machine: Machine, *, has_all: bool = False) -> Machine | Problem:
    """Return a linkage as the engine that it is, or why it is none, with the key in the description that shows it.

    `has_all`: whether the engine must have everything that the linkage has, friction and motor too.
    """
    try:
        _check_expressible(machine, has_all=has_all)
        crank = crank_cells(machine.mechanism)
        return _Form(machine, crank, machine.shaft or Shaft()).machine()
    except NoCellsError as error:
        return error.problem
    except CrankworkError as error:
        return Problem("", error.args[0])


def _check_expressible(machine: Machine, *, has_all: bool) -> None:
    """Raise NoCellsError for inputs that an engine has no tables for."""
    if machine.linkage is None or machine.transfer is not None or machine.turning is not None:
        raise NoCellsError(ErrorMessage("cells_driver"))
    partial = machine.working_range is not None or (machine.way is not None and not machine.way.is_whole)
    if partial or machine.mechanism.passages:
        raise NoCellsError(ErrorMessage("cells_turn"))
    drive = machine.drive
    unsupported: dict[str, object] = {
        "charges": machine.charges,
        "stages": machine.stages,
        "sliders": machine.crossheads,
        "vessels": machine.vessels,
        "links": machine.redundant,
        "chambers.valves.density": [
            name for name, chamber in machine.chambers.items() if chamber.valves is not None and chamber.valves.density
        ],
        "loads": [load for load in machine.loads if not isinstance(load, Weight)] or len(machine.loads) > 1,
    }
    if has_all:
        unsupported |= {
            "friction": machine.friction,
            "transient": machine.transient,
            "motor": drive.motor,
            "efficiency": drive.chain or drive.efficiency != 1,
        }
    for table, stated in unsupported.items():
        if stated:
            raise NoCellsError(ErrorMessage("cells_unsaid", table=table))
    if any(load.gravity != machine.method.gravity for load in machine.loads if isinstance(load, Weight)):
        raise NoCellsError(ErrorMessage("cells_unsaid", table="loads"))


class _Form:
    """The cells of a linkage in the order of their cylinders, and the parts of the engine."""

    def __init__(self, machine: Machine, crank: CrankCells, shaft: Shaft) -> None:
        self._machine, self._crank, self._shaft = machine, crank, shaft
        self._sense = crank.crank.direction
        self._chambers = chambers_of(machine, crank.cells)
        self._cells = self._numbered()
        self._first = self._cells[0]
        if self._first.master:
            raise NoCellsError(ErrorMessage("cells_first", name=self._first.slider))
        self._numbers = {cell.link: number for number, cell in enumerate(self._cells, start=1)}
        self._masters = [cell for cell in self._cells if not cell.master]
        self._lengths = self._common_lengths()
        offsets = _unified([cell.offset for cell in self._masters], _SAME * self._lengths.rod_length)
        self._offsets = dict(zip((cell.link for cell in self._masters), offsets, strict=True))

    def machine(self) -> Machine:
        """Return the machine."""
        machine, layout = self._machine, self._layout()
        masses, articulated_masses, inertia = self._masses(layout)
        cylinder, gases = self._cylinder(layout), self._gases(layout)
        articulated = self._articulated_rods(layout)
        first_offset = float(self._lengths.offset)
        offsets = tuple(self._offsets.get(cell.link, first_offset) for cell in self._cells)
        engine = Engine(
            layout=layout,
            articulated_rods=articulated if any(articulated) else (),
            articulated_masses=articulated_masses,
            offsets=offsets if len(set(offsets)) > 1 else (),
            gases=() if len({id(gas) for gas in gases}) < 2 else gases,
            misfires=tuple(sorted(self._number_of("shaft.misfire", name) for name in self._shaft.misfires)),
            bearings=replace(machine.bearings, pins={}),
            counterweight=self._shaft.counterweight,
            rotating_share=self._shaft.rotating_share,
            reciprocating_share=self._shaft.reciprocating_share,
            balance_shafts=self._shaft.balance_shafts,
        )
        wheel = machine.drive
        drive = Drive(inertia=wheel.inertia + inertia, fluctuation=wheel.fluctuation, wheel=wheel.wheel)
        has_wheel = drive.wheel is not None or drive.fluctuation is not None or drive.inertia
        has_shaft = machine.shaft is not None and machine.shaft != Shaft(bore=machine.shaft.bore)
        has_shaft = has_shaft or engine.bearings != Bearings()
        is_engine = len(self._cells) > 1 or has_shaft or has_wheel or layout.places[0].axis
        return replace(
            machine,
            mechanism=slider_crank(*self._lengths),
            linkage=None,
            cylinder=cylinder,
            masses=masses,
            gas=gases[0] if gases else None,
            has_gravity=bool(machine.loads),
            loads=(),
            friction=(),
            transient=None,
            chambers={},
            bearings=Bearings(),
            shaft=None,
            drive=drive,
            notices=(),
            way=None,
            stated={key: number for key, number in machine.stated.items() if key in ("crank.speed", "method.gravity")},
            engine=engine if is_engine else None,
        )

    def _numbered(self) -> list[Cell]:
        """Return the cells in the order of their cylinders: stated, else that of the chambers, then of the pieces."""
        of_slider = {cell.slider: cell for cell in self._crank.cells}
        listed = self._shaft.cylinders
        for name in listed:
            self._check_name("shaft.cylinders", name, of_slider)
        if listed and (len(set(listed)) < len(listed) or len(listed) < len(of_slider)):
            missing = ", ".join(name for name in of_slider if name not in listed)
            raise NoCellsError(ErrorMessage("shaft_every_cylinder", names=missing or listed[0]), "shaft.cylinders")
        if len(of_slider) > MOST_CYLINDERS:
            raise NoCellsError(ErrorMessage("cells_many", most=MOST_CYLINDERS))
        drawn = [member.name for member in self._machine.drawn.members if member.name in of_slider]
        with_gas = (face.slider for chamber in self._machine.chambers.values() for face in chamber.faces)
        return [of_slider[name] for name in listed or dict.fromkeys((*with_gas, *drawn))]

    @staticmethod
    def _check_name(key: str, name: str, known: Iterable[str]) -> None:
        if name not in known:
            raise NoCellsError(ErrorMessage("absent_slider", name=name, known=", ".join(sorted(known))), key)

    def _number_of(self, key: str, name: str) -> int:
        sliders = [cell.slider for cell in self._cells]
        self._check_name(key, name, sliders)
        return sliders.index(name) + 1

    def _common_lengths(self) -> SliderCrank:
        """Return the lengths of crank and rods, and the offset of cylinder 1, if all turn fully."""
        radius, length = self._crank.crank.radius, self._first.length
        for cell in self._masters:
            if abs(cell.length - length) > _SAME * length:
                raise NoCellsError(ErrorMessage("cells_unequal", name=cell.link, other=self._first.link))
            check_slider_crank(SliderCrank(radius, length, cell.offset))
        return SliderCrank(radius, length, self._first.offset)

    def _direction(self, direction: float) -> float:
        """Return how far a direction is ahead of the head of cylinder 1, with the rotation. [rad] -> [deg]"""
        return math.degrees(math.remainder(self._sense * (direction - self._first.head), math.tau))

    def _ahead(self, pin: str) -> float:
        """Return how far a crankpin is ahead of that of cylinder 1, with the rotation. [deg]"""
        between = self._crank.pins[pin] / self._crank.pins[self._first.pin]
        return math.degrees(self._sense * cmath.phase(between))

    def _layout(self) -> Layout:
        """Return the positions of the cylinders, and when each begins its cycle."""
        start = self._direction(self._crank.crank.start + cmath.phase(self._crank.pins[self._first.pin]))
        if abs(start) > _SAME_ANGLE:
            raise NoCellsError(ErrorMessage("cells_start", name=self._first.slider))
        cycle, pins = self._cycle(), self._pins()
        axes = self._axes(pins)
        ahead = _unified([wrap_angle(_clean(self._ahead(cell.pin))) for cell in self._cells], _SAME_ANGLE)
        tops = self._tops()
        positions, journals = self._along()
        places = []
        for number, (cell, axis, pin, top) in enumerate(zip(self._cells, axes, ahead, tops, strict=True), start=1):
            base = wrap_angle(_clean(axis - axes[0] - pin))
            crankpin, throw = pins[cell.pin]
            master = self._numbers.get(cell.master, 0)
            firing = self._firing(cell, base, top, cycle)
            places.append(CylinderPlace(number, axis, crankpin, throw, pin, positions[number - 1], firing, master, top))
        order = sorted(places, key=lambda place: wrap_angle(place.firing_angle + place.top - tops[0], cycle))
        layout = Layout(_kind(places), tuple(places), cycle, tuple(place.number for place in order), journals)
        if journals:
            try:
                check_journals(layout)
            except CrankworkError as error:
                raise NoCellsError(error.args[0], "shaft.journals") from None
        return layout

    def _cycle(self) -> float:
        """Return the crank angle after which the gas of every cylinder repeats. [deg]"""
        heads = [chambers.head[1] for chambers in self._chambers.values() if chambers.head is not None]
        cycles = {chamber.cycle for chamber in heads if chamber.pressure is None}
        stated = self._shaft.period
        if len(cycles) > 1 or (cycles and stated is not None and {stated} != cycles):
            raise NoCellsError(ErrorMessage("cells_cycles"), "shaft.period" if stated is not None else "")
        return cycles.pop() if cycles else stated or _TURN

    def _pins(self) -> dict[str, tuple[int, int]]:
        """Return the number of each crankpin and of its throw from 0, along the shaft."""
        cells, positions = self._cells, self._shaft.positions
        used = list(dict.fromkeys(cell.pin for cell in cells))
        if not self._shaft.throws:
            middle = {
                pin: np.mean([positions.get(cell.slider, 0.0) for cell in cells if cell.pin == pin]) for pin in used
            }
            return {pin: (index, index) for index, pin in enumerate(sorted(used, key=lambda pin: float(middle[pin])))}
        listed = [(pin, throw) for throw, pins in enumerate(self._shaft.throws) for pin in pins]
        names = [pin for pin, _ in listed]
        if sorted(names) != sorted(used):
            raise NoCellsError(ErrorMessage("shaft_throws", names=", ".join(sorted(used))), "shaft.throws")
        return {pin: (index, throw) for index, (pin, throw) in enumerate(listed)}

    def _axes(self, pins: Mapping[str, tuple[int, int]]) -> list[float]:
        """Return the directions of the cylinders from the reference, of a row around the shaft those from the first."""
        stated = self._shaft.reference
        reference = 0.0 if stated is None else _clean(self._direction(stated))
        if stated is None and self._machine.loads and not self._machine.chambers and self._shaft.bore is None:
            # there is no cylinder that says how it leans
            reference = -self._inclination()
        axes = [_clean(self._direction(cell.head) - reference) for cell in self._cells]
        # half a turn is the same angle with either sign
        axes = [axis - _TURN * round(axis / _TURN) if abs(axis) > _TURN / 2 + _SAME_ANGLE else axis for axis in axes]
        axes = _unified(axes, _SAME_ANGLE)
        around = [axis % _TURN for axis in axes]
        is_row = len(axes) > 2 and len({throw for _, throw in pins.values()}) == 1
        steps = {round(after - before, 6) for before, after in pairwise([*sorted(around), min(around) + _TURN])}
        return around if is_row and len(steps) == 1 else axes

    def _inclination(self) -> float:
        """Return how far the head of cylinder 1 is ahead of the upward vertical, with the rotation. [deg]"""
        down = next((load.direction for load in self._machine.loads if isinstance(load, Weight)), -math.pi / 2)
        return _clean(-self._direction(down + math.pi))

    def _tops(self) -> list[float]:
        """Return the angles of the top dead centres from the axes, where offsets differ. [deg]"""
        r, l, first = self._lengths  # noqa: E741
        if all(offset == first for offset in self._offsets.values()):
            return [0.0] * len(self._cells)
        if len(self._masters) < len(self._cells):
            raise NoCellsError(ErrorMessage("offsets_articulated"))
        return [math.degrees(math.asin(self._offsets[cell.link] / (r + l))) for cell in self._cells]

    def _along(self) -> tuple[list[float], tuple[float, ...]]:
        """Return the distances of cylinders and main journals from the middle between the outermost cylinders. [m]"""
        stated = self._shaft.positions
        for name in stated:
            self._number_of(f"shaft.positions.{name}", name)
        if stated and len(stated) < len(self._cells):
            missing = ", ".join(cell.slider for cell in self._cells if cell.slider not in stated)
            raise NoCellsError(ErrorMessage("shaft_every_cylinder", names=missing), "shaft.positions")
        positions = [stated.get(cell.slider, 0.0) for cell in self._cells]
        middle = (min(positions) + max(positions)) / 2
        middle = middle if abs(middle) > _SAME * max(map(abs, (*positions, 1e-3))) else 0.0
        return [position - middle for position in positions], tuple(
            journal - middle for journal in self._shaft.journals
        )

    def _firing(self, cell: Cell, base: float, top: float, cycle: float) -> float:
        """Return the crank angle at which a cylinder begins its cycle, as far as whole turns are left. [deg]"""
        for name in self._shaft.firing:
            self._number_of(f"shaft.firing.{name}", name)
        stated = self._shaft.firing.get(cell.slider)
        delay = stated if stated is not None else self._delay(cell) - self._delay(self._first)
        turns = round((delay - base - (top if stated is None else 0.0)) / _TURN)
        firing = wrap_angle(base + turns * _TURN, cycle)
        is_first = cell is self._first
        if stated is not None and (abs(base + turns * _TURN - stated) > SAME_ANGLE or (is_first and firing)):
            reason = ErrorMessage("shaft_firing_first") if is_first else ErrorMessage("shaft_firing", angle=base)
            raise NoCellsError(reason, f"shaft.firing.{cell.slider}")
        return 0.0 if is_first else firing

    def _delay(self, cell: Cell) -> float:
        head = self._chambers[cell.slider].head
        return head[1].delay if head is not None else 0.0

    def _articulated_rods(self, layout: Layout) -> tuple[ArticulatedRod | None, ...]:
        """Return the articulated rod of each cylinder, None of a master rod."""
        rods = list[ArticulatedRod | None]()
        for cell, place in zip(self._cells, layout.places, strict=True):
            if not cell.master:
                rods.append(None)
                continue
            between = _clean(place.axis - layout.places[place.master - 1].axis)
            angle = _clean(self._sense * math.degrees(cmath.phase(cell.knuckle)))
            angle += _TURN * round((between - angle) / _TURN)
            rod = ArticulatedRod(cell.length, abs(cell.knuckle), angle, between, cell.offset)
            check_articulated_rod(self._lengths._replace(offset=self._offsets[cell.master]), rod)
            rods.append(rod)
        return tuple(rods)

    def _masses(self, layout: Layout) -> tuple[CrankGearMasses | None, CrankGearMasses | None, float]:
        """Return the masses of a cylinder and of articulated rods, and the inertia of the crank beyond its throws."""
        if not self._machine.mechanism.bodies:
            return None, None, 0.0
        throw, inertia = self._throw(layout)
        piston = self._common([cell.piston for cell in self._cells], [cell.slider for cell in self._cells])
        if abs(piston.centre.imag) > _SAME * self._lengths.rod_length and piston.mass:
            raise NoCellsError(ErrorMessage("cells_centre", name=self._first.slider))
        articulated = [cell for cell in self._cells if cell.master]
        rod = _two_masses(self._masters)
        own = _two_masses(articulated) if articulated else None
        if own is not None and _have_same_masses(own, replace(rod, rod_inertia_excess=0.0), self._lengths.rod_length):
            own = None
        return replace(rod, piston=piston.mass, crank=throw), own, inertia

    def _common(self, parts: Sequence[Part], names: Sequence[str]) -> Part:
        """Return the part that all cylinders share; the inertia of a part that does not turn is zero."""
        first = parts[0]
        for part, name in zip(parts, names, strict=True):
            is_there = part.mass or first.mass
            across = abs(part.centre.imag - first.centre.imag) > _SAME * self._lengths.rod_length
            if abs(part.mass - first.mass) > _SAME * first.mass or (is_there and across):
                raise NoCellsError(ErrorMessage("cells_unequal", name=name, other=names[0]))
        return first

    def _throw(self, layout: Layout) -> tuple[float, float]:
        """Return the mass of a throw at its crankpin, and the inertia of the crank beyond that of the throws."""
        crank, radius = self._crank.turning, self._lengths.crank_radius
        pins = {place.crankpin: (place.throw, self._crank.pins[cell.pin])
                for place, cell in zip(layout.places, self._cells, strict=True)}  # fmt: skip
        throws = [throw for throw, _ in pins.values()]
        count = len(set(throws))
        # the pins of a throw share its mass
        middle = sum(pin / throws.count(throw) for throw, pin in pins.values())
        moment, inertia = crank.mass * crank.centre, crank.inertia + crank.mass * abs(crank.centre) ** 2
        size, least = crank.mass * radius, _SAME * 10
        at_pins = abs(inertia - size * radius) <= least * size * radius
        if at_pins and abs(moment - crank.mass / count * middle) <= least * size:
            return crank.mass / count, 0.0
        if count > 1 or self._machine.loads:
            # how it is spread along the shaft is not known, or it bears other weights
            raise NoCellsError(ErrorMessage("cells_crank", name=self._crank.crank.link))
        throw = (moment / middle).real
        if throw < -_SAME * crank.mass or abs(moment - throw * middle) > least * size:
            raise NoCellsError(ErrorMessage("cells_crank", name=self._crank.crank.link))
        left = inertia - throw * radius**2
        if left < -least * inertia:
            raise NoCellsError(ErrorMessage("cells_crank", name=self._crank.crank.link))
        return max(throw, 0.0), max(left, 0.0)

    def _cylinder(self, layout: Layout) -> Cylinder | None:
        """Return the cylinder that all cells share, None without gas."""
        chambers_of_cells = [self._chambers[cell.slider] for cell in self._cells]
        if all(chambers == CellChambers() for chambers in chambers_of_cells):
            bore = self._shaft.bore
            return None if bore is None else Cylinder(bore, inclination=self._stated_inclination(layout))
        sizes = list[tuple[float, float, float | None, float | None]]()
        for cell, chambers in zip(self._cells, chambers_of_cells, strict=True):
            if chambers.head is None:
                raise NoCellsError(ErrorMessage("cells_gas", name=cell.slider))
            (name, head), behind = chambers.head, chambers.crank_end
            bore, rod = bore_of(head, self._machine), behind[1].faces[0].rod_diameter if behind else 0.0
            if head.faces[0].rod_diameter:
                raise NoCellsError(ErrorMessage("cells_chamber", name=name))
            if behind is not None and not (rod and is_close(bore_of(behind[1], self._machine), bore)):
                raise NoCellsError(ErrorMessage("cells_chamber", name=behind[0]))
            sizes.append((bore, rod, head.clearance_volume, head.compression_ratio))
            if not nearly_equal(sizes[-1], sizes[0]):
                raise NoCellsError(ErrorMessage("cells_unequal", name=cell.slider, other=self._first.slider))
        bore, rod, clearance, ratio = sizes[0]
        return Cylinder(bore, clearance, ratio, rod, self._stated_inclination(layout))

    def _stated_inclination(self, layout: Layout) -> float | None:
        """Return the inclination of cylinder 1, None if its axis already says it. [rad]"""
        inclination = self._inclination()
        is_upright = abs(inclination - layout.places[0].axis) <= _SAME_ANGLE
        return None if is_upright else math.radians(inclination)

    def _gases(self, layout: Layout) -> tuple[Gas, ...]:
        """Return the gas of each cylinder, one object for equal gas."""
        gases = list[Gas]()
        for cell, place in zip(self._cells, layout.places, strict=True):
            head, behind = self._chambers[cell.slider].head, self._chambers[cell.slider].crank_end
            if head is not None:
                gas = gas_of(*head, layout.cycle, behind[1] if behind else None)
                gas = replace(gas, delay=self._gas_delay(head[1], place, layout.cycle))
                gases.append(next((known for known in gases if nearly_equal(known, gas)), gas))
        return tuple(gases)

    @staticmethod
    def _gas_delay(chamber: Chamber, place: CylinderPlace, cycle: float) -> float:
        """Return how much later than its own cycle the gas of a cylinder is. [deg]"""
        if chamber.pressure is not None:
            return 0.0
        later = chamber.delay - place.firing_angle - place.top
        later -= cycle * round(later / cycle)
        if chamber.calculated is not None or chamber.valves is not None:
            # these begin at the nearest dead centre
            later = _TURN * round(later / _TURN) % cycle
        return later if abs(later) > _SAME_ANGLE else 0.0


def _two_masses(cells: Sequence[Cell]) -> CrankGearMasses:
    """Return the masses of the ends of equal rods, and their excess of inertia."""
    first, *following = (_masses_of_rod(cell) for cell in cells)
    for masses, cell in zip(following, cells[1:], strict=True):
        if not _have_same_masses(masses, first, cells[0].length):
            raise NoCellsError(ErrorMessage("cells_unequal", name=cell.link, other=cells[0].link))
    return first


def _have_same_masses(masses: CrankGearMasses, other: CrankGearMasses, length: float) -> bool:
    """Return whether two rods have the same masses within rounding."""
    size = 10 * _SAME * (other.rod_small_end + other.rod_big_end)
    ends = (masses.rod_small_end - other.rod_small_end, masses.rod_big_end - other.rod_big_end)
    excess = masses.rod_inertia_excess - other.rod_inertia_excess
    return max(map(abs, ends)) <= size and abs(excess) <= size * length**2


def _masses_of_rod(cell: Cell) -> CrankGearMasses:
    rod, length = cell.rod, cell.length
    if abs(rod.centre.imag) > _SAME * length and rod.mass:
        raise NoCellsError(ErrorMessage("cells_centre", name=cell.link))
    small = float(rod_small_end_mass(rod.mass, rod.centre.real, length))
    excess = float(rod_inertia_excess(rod.inertia, rod.mass, rod.centre.real, length))
    excess = excess if abs(excess) > 10 * _SAME * max(rod.inertia, rod.mass * length**2) else 0.0
    return CrankGearMasses(
        rod_small_end=small, rod_big_end=float(rod_big_end_mass(rod.mass, small)), rod_inertia_excess=excess
    )


def _kind(places: Sequence[CylinderPlace]) -> str:
    """Return the name of an arrangement."""
    axes = {place.axis for place in places}
    if len(axes) == 1:
        return "inline"
    if len({place.throw for place in places}) == 1 and len(places) == len(axes) > 2:
        return "radial"
    if len(axes) > 2:
        return "W"
    first, other = axes
    is_flat = abs(abs(first - other) - _TURN / 2) <= _SAME_ANGLE
    return "boxer" if is_flat and len({place.crankpin for place in places}) == len(places) else "V"


def _clean(angle: float) -> float:
    """Return an angle without the rounding of its calculation. [deg]"""
    near = round(angle, 9)
    return near + 0.0 if abs(angle - near) <= 1e-11 else angle


def _unified(values: Sequence[float], distance: float) -> list[float]:
    """Return values, each as the first that is as near as that."""
    kept = list[float]()
    for value in values:
        kept.append(next((known for known in kept if abs(known - value) <= distance), value))
    return kept

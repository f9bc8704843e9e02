"""What the gas in chambers does: volumes, pressures and forces on sliding pieces, remembered."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.known import Found, Known, absent, given, is_known, total
from crankwork.formula.over_cycle import OverCycle
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.loads import gas
from crankwork.loads.applied import AppliedLoads, force_on_slider, together
from crankwork.loads.chamber import (
    NOTHING,
    Chamber,
    Charge,
    Face,
    charge_mass,
    charge_pressure,
    cycle_of,
    face_owners,
    least_common,
    own_cycle,
)
from crankwork.loads.indicator import DeadCentres, DiagramError, IndicatorDiagram, Segment, VolumeAt, solve_diagram
from crankwork.loads.measured import Told
from crankwork.loads.pressure import at_angle, remembered_pressure
from crankwork.loads.retold import StatedDiagram
from crankwork.loads.treated import Around, measured_diagram
from crankwork.loads.valves import Flow, StatedValves
from crankwork.locale import Refusal
from crankwork.mechanism.driver import Law
from crankwork.mechanism.mechanism import Mechanism

_TURN = 360.0
# share of the swept volume by which one may change at rest
_STILL = 1e-9
# dead centres that are nearer are one [deg]
_SAME_ANGLE = 1e-6


class GasForce(NamedTuple):
    """The force of the gas in a chamber on a sliding piece, along its guide. [N]"""

    chamber: str
    slider: str
    force: Known


class Filling(NamedTuple):
    """All gas of a machine: its columns and single values by key, its forces, and what the reader should know."""

    columns: Mapping[str, Known]
    singles: Mapping[str, Known]
    forces: tuple[GasForce, ...]
    notices: tuple[Told, ...]

    def loads(self, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
        """Return the forces as loads: remembered on a remembered motion, numbers on one in numbers."""
        force: Mapping[str, Value] = {one.force.key: one.force for one in self.forces}
        if not is_known(*(one.position for one in motion.sliders.values())):
            force = Program({one.force.key: one.force for one in self.forces})(motion.grid)
        return together(
            force_on_slider(mechanism, motion, one.slider, force[one.force.key], f".{one.chamber}")
            for one in self.forces
        )


NO_GAS = Filling({}, {}, (), ())


class _Wall(NamedTuple):
    """A face with its area and sense, and how far its piece has come."""

    slider: str
    sense: Known
    area: Known
    position: Known
    position_1: Known
    position_2: Known


class _Space(NamedTuple):
    """A chamber as it moves: after which crank angle its volume repeats, and at which it turns back. [deg]"""

    walls: tuple[_Wall, ...]
    volume: Known
    volume_1: Known
    swept: Known
    clearance: Known
    ratio: Known
    period: float
    dead_centres: tuple[float, ...]

    def volume_at(self, degrees: Array) -> Array:
        """Return the volume at crank angles. [m3]"""
        return Program({"": self.volume})(CrankGrid.from_degrees(degrees))[""]


def filled(  # noqa: PLR0913 - what the gas is, and how it is moved
    chambers: Mapping[str, Chamber],
    charges: Mapping[str, Charge],
    motion: Motion,
    pi: float,
    law: Law | None = None,
    period: float = _TURN,
    turning: tuple[Known, Known] | None = None,
) -> Filling:
    """Return the gas of chambers on the sliding pieces of a remembered motion.

    `law`: that of the driver, where it is not a crank that turns fully at the angle of the tables; `period`: crank
    angle after which the motion repeats [deg]; `turning`: speed and acceleration of the driver's coordinate, for what
    flows through pipes.
    """
    if not chambers:
        return NO_GAS
    whole = least_common(cycle_of(chambers), period)
    spaces = _spaces(chambers, motion, pi, law, period)
    pressures, works, own, told = dict[str, Known](), dict[str, Known](), list[Known](), list[Told]()
    for name, charge in charges.items():
        pressure, values = _sealed(name, charge, chambers, spaces, period)
        own += values
        pressures |= {one: pressure.named(f"diagram_pressure.{one}") for one in charge.chambers}
    works |= _works(pressures, spaces, period)
    for name, chamber in chambers.items():
        if name not in pressures:
            pressures[name], works[name], notices = _of_its_own(name, chamber, spaces[name], whole, law)
            told += notices
            if turning is not None and chamber.valves is not None and chamber.valves.has_pipes:
                flow = Flow(*_rates(spaces[name]), *turning, pi)
                piped = _behind_pipes(name, chamber, spaces[name], pressures[name], flow)
                pressures[name], notices = piped.pressure, piped.notices
                works |= _works({name: pressures[name]}, spaces, period)
                own += piped.least
                told += notices
    columns, forces = list[Known](), list[GasForce]()
    for name, space in spaces.items():
        ambient, above = chambers[name].ambient, pressures[name].named(f"gas_pressure.{name}")
        if ambient:
            around = given(f"ambient_pressure.{name}", ambient, f"chambers.{name}.ambient")
            above = gas.gauge_pressure(pressures[name], around).named(above.key)
            told += [("ambient", {"pressure": ambient / 1e6})] * (not chambers[name].names_ambient)
        if chambers[name].factor != 1:
            factor = given(f"pressure_factor.{name}", chambers[name].factor, f"chambers.{name}.pressure_factor")
            above = (above * factor).named(above.key)
        columns += [space.volume, pressures[name], above]
        for wall in space.walls:
            key = wall.area.key.replace("piston_area", "gas_force", 1)
            force = gas.face_force(wall.sense, above, wall.area).named(key)
            forces.append(GasForce(name, wall.slider, force))
        mean = gas.indicated_mean_pressure(works[name], space.swept).named(f"indicated_mean_pressure.{name}")
        own += [*_sizes(space), works[name], mean]
    columns += [*(one.force for one in forces), *_rod_loads(forces)]
    once = {repr(one): one for one in told}
    return Filling(_by_key(columns), _by_key(own), tuple(forces), tuple(once.values()))


def _rod_loads(forces: Sequence[GasForce]) -> Iterator[Known]:
    """Yield what all gas does to each sliding piece between chambers."""
    for slider in dict.fromkeys(one.slider for one in forces):
        acting = [one.force for one in forces if one.slider == slider]
        if len(acting) > 1:
            yield total(f"rod_load.{slider}", acting)


class _Piped(NamedTuple):
    """The pressure behind the pipes of a chamber, its least value and the angle of that, and what should be known."""

    pressure: Known
    least: tuple[Known, ...]
    notices: list[Told]


def _behind_pipes(name: str, chamber: Chamber, space: _Space, before: Known, flow: Flow) -> _Piped:
    """Return the pressure in a chamber whose liquid comes and goes through pipes."""
    path = f"chambers.{name}"
    valves = stated_valves(path, chamber)
    begins = chamber.delay + _ends_of_stroke(space, chamber.delay)[0]
    if valves is None:
        return _Piped(before, (), [])
    pressure = valves.through_pipes(before, _solved(chamber, space, begins, path).later(begins), flow)
    found = OverCycle({pressure.key: pressure}, CrankGrid.from_degrees, space.period).extremes(pressure.key)
    least, at = (found[f"diagram_pressure_{word}.{name}"] for word in ("min", "min_angle"))
    boiling, notices = valves.valves.vapour_pressure, list[Told]()
    if boiling is not None and least.value < boiling:
        pressures = {"least": least.value / 1e6, "vapour": boiling / 1e6}
        notices.append(("separation", {"name": name, **pressures, "angle": math.degrees(at.value)}))
    return _Piped(pressure, (least, at), notices)


def _rates(space: _Space) -> tuple[Known, Known]:
    """Return the derivatives of a volume by the driver's coordinate."""
    first = [gas.face_volume_1(one.sense, one.area, one.position_1) for one in space.walls]
    second = [gas.face_volume_2(one.sense, one.area, one.position_2) for one in space.walls]
    owner = space.volume.key.partition(".")[2]
    return total(f"cylinder_volume_1.{owner}", first), total(f"cylinder_volume_2.{owner}", second)


def _by_key(knowns: list[Known]) -> dict[str, Known]:
    return {one.key: one for one in knowns}


def _sizes(space: _Space) -> Iterator[Known]:
    yield from (wall.area for wall in space.walls)
    yield space.swept
    if not space.clearance.is_absent:
        yield space.clearance
        yield space.ratio


def rate_by_angle(motion: Motion, law: Law) -> Known:
    """Return the derivative of the driver's coordinate by the angle that all columns follow."""
    _, rate, _ = motion.driver if motion.driver is not None else (None, absent("driver_velocity"), None)
    return rate * (given("period", law.period, "driver.period") / math.radians(_TURN))


def _spaces(
    chambers: Mapping[str, Chamber], motion: Motion, pi: float, law: Law | None, period: float
) -> dict[str, _Space]:
    """Return the chambers as they move."""
    walls = {name: tuple(_walls(name, one, motion, pi)) for name, one in chambers.items()}
    followed = {}
    for name, some in walls.items():
        travel = [gas.face_volume(one.sense, one.area, one.position, absent("")) for one in some]
        followed[f"face_volume.{name}"] = total(f"face_volume.{name}", travel)
        rates = [gas.face_volume_1(one.sense, one.area, one.position_1) for one in some]
        rate = total(f"cylinder_volume_1.{name}", rates)
        followed[rate.key] = rate if law is None else (rate * rate_by_angle(motion, law)).named(rate.key)
    over = OverCycle(followed, CrankGrid.from_degrees, period)
    return {name: _space(name, chambers[name], some, over, period) for name, some in walls.items()}


def _walls(name: str, chamber: Chamber, motion: Motion, pi: float) -> Iterator[_Wall]:
    for number, (face, owner) in enumerate(zip(chamber.faces, face_owners(name, chamber), strict=True), start=1):
        path = f"chambers.{name}.faces[{number}]"
        sense = absent("face_sense", 1.0) if face.sense == 1 else given(f"face_sense.{owner}", -1.0, f"{path}.sense")
        slide: Any = motion.sliders[face.slider]
        yield _Wall(
            face.slider, sense, _area(face, owner, path, pi), slide.position, slide.position_1, slide.position_2
        )


def _area(face: Face, owner: str, path: str, pi: float) -> Known:
    key = f"piston_area.{owner}"
    if face.bore is None:
        return given(key, face.area or 0.0, f"{path}.area")
    area: Known = gas.piston_area(pi, given(f"bore.{owner}", face.bore, f"{path}.bore"))
    if not face.rod_diameter:
        return area.named(key)
    rod = given(f"piston_rod_diameter.{owner}", face.rod_diameter, f"{path}.rod_diameter")
    less: Known = gas.face_area(area.named(f"{key}.bore"), gas.piston_area(pi, rod).named(f"{key}.rod"))
    return less.named(key)


def _space(name: str, chamber: Chamber, walls: tuple[_Wall, ...], over: OverCycle, period: float) -> _Space:
    travel, rate = f"face_volume.{name}", f"cylinder_volume_1.{name}"
    largest, least = over.largest_and_least[travel]
    if largest.value - least.value <= NOTHING * max(largest.value, -least.value):
        raise DiagramError(f"chambers.{name}", Refusal("chamber_still"))
    found = over.extremes(travel)
    swept = (found[f"face_volume_max.{name}"] - found[f"face_volume_min.{name}"]).named(f"swept_volume.{name}")
    ratio = absent("compression_ratio")
    if chamber.compression_ratio is not None:
        path = f"chambers.{name}.compression_ratio"
        ratio = given(f"compression_ratio.{name}", chamber.compression_ratio, path)
        clearance = gas.clearance_volume(swept, ratio).named(f"clearance_volume.{name}")
    elif chamber.clearance_volume:
        path = f"chambers.{name}.clearance_volume"
        clearance = given(f"clearance_volume.{name}", chamber.clearance_volume, path)
        ratio = gas.compression_ratio(swept, clearance).named(f"compression_ratio.{name}")
    else:
        clearance = absent("clearance_volume")
    parts = [] if clearance.is_absent else [clearance]
    turned = found[f"face_volume_min_angle.{name}"] * (180 / math.pi)
    for wall in walls:
        start = at_angle(wall.position, least.at, f"slider_displacement.{wall.slider}.{name}", turned)
        part = gas.face_volume(wall.sense, wall.area, wall.position, start)
        parts.append(part.named(f"face_volume.{name}.{wall.slider}"))
    volume = total(f"cylinder_volume.{name}", parts)
    centres = [*over.crossings(rate).tolist(), largest.at, least.at, *_at_zero(rate, over, period)]
    turning = _apart(centres, period)
    at = Program({"": volume})(CrankGrid.from_degrees(turning))[""]
    # where a driver dwells the volume has turned back at the beginning of the dwell
    moves = np.abs(at - np.roll(at, 1)) > _STILL * swept.value
    kept = tuple(one for one, moved in zip(turning, moves.tolist(), strict=True) if moved)
    return _Space(walls, volume, over.knowns[rate], swept, clearance, ratio, period, kept)


def _at_zero(rate: str, over: OverCycle, period: float) -> Iterator[float]:
    """Yield zero where a volume turns back between one period and the next."""
    before, after = over.at(rate, np.array([period - _SAME_ANGLE, _SAME_ANGLE])).tolist()
    if before * after < 0:
        yield 0.0


def _apart(degrees: list[float], period: float) -> tuple[float, ...]:
    """Return crank angles within a period, ascending, those that only rounding has set apart as one."""
    ordered = sorted(one % period if period - one % period > _SAME_ANGLE else 0.0 for one in degrees)
    return tuple(two for one, two in itertools.pairwise([-1.0, *ordered]) if two - one > _SAME_ANGLE)


def _of_its_own(
    name: str, chamber: Chamber, space: _Space, whole: float, law: Law | None
) -> tuple[Known, Known, list[Told]]:
    """Return the pressure that a chamber has by itself, its work over a cycle, and what the reader should know."""
    key, path = f"diagram_pressure.{name}", f"chambers.{name}"
    told: list[Told] = []
    cycle = own_cycle(chamber, space.period)
    if chamber.pressure is not None:
        pressure = given(key, chamber.pressure, f"{path}.pressure")
        # nothing where the volume comes back
        done = chamber.factor * chamber.pressure * float(np.diff(space.volume_at(np.array([0.0, cycle])))[0])
        return pressure, Known(Found(done, "work", (pressure, space.volume)), f"indicated_work.{name}"), told
    if cycle > chamber.cycle:
        told.append(("chamber_again", {"name": name, "cycle": chamber.cycle, "turns": round(space.period / _TURN)}))
    # where its diagram begins: that of heat or of valves at the dead centre nearest to where it is stated
    counts = chamber.released is not None or chamber.valves is not None
    start, bottom = _ends_of_stroke(space, chamber.delay) if counts else (0.0, 0.0)
    begins = chamber.delay + start
    # where the volume is what it was in an earlier cycle, the diagram is that of then
    phases = [one % space.period for one in np.arange(0.0, whole, chamber.cycle).tolist()]
    if chamber.measured is not None:
        # where it is least once in a turn it is that of an engine, and the samples say where
        is_plain = law is None and len(space.dead_centres) == 2 and chamber.cycle in (_TURN, 2 * _TURN)
        top = _ends_of_stroke(space, chamber.delay)[0] if is_plain and space.period == _TURN else None
        around = Around(_volume_from(space, begins), top)
        samples, said = measured_diagram(
            chamber.measured, chamber.cycle, around, shift=chamber.angle_shift, step=chamber.resample, path=path
        )
        told += said
        found = dict.fromkeys(phases, samples)
    elif chamber.released is not None:
        found = {}
        for phase in dict.fromkeys(phases):
            found[phase], notices = chamber.released.diagram_in(
                _volume_from(space, begins + phase),
                _rate_from(space, begins + phase),
                (0.0, (bottom - start) % space.period),
            )
            told += notices
    else:
        found = {phase: _solved(chamber, space, begins + phase, path) for phase in dict.fromkeys(phases)}
        told += [_jump(point, phase + at, step, law) for phase, one in found.items() for point, at, step in one.jumps]
    diagram = _joined(found, phases).later(begins)
    stated = StatedDiagram(
        chamber.points,
        chamber.pieces,
        path,
        space.volume,
        space.clearance,
        space.swept,
        stated_valves(path, chamber),
        begins,
    )
    retold = partial(stated.retold, diagram) if len(found) == 1 and chamber.pieces else None
    pressure = remembered_pressure(diagram, space.volume, path, retold)
    own = phases[: round(cycle / chamber.cycle)]
    done = chamber.factor * sum(found[one].work(_volume_from(space, begins + one)) for one in own)
    return pressure, Known(Found(done, "work", (pressure, space.volume)), f"indicated_work.{name}"), told


def _ends_of_stroke(space: _Space, delay: float) -> tuple[float, float]:
    """Return where the volume is least and largest, counted from a crank angle, the least nearest to it. [deg]"""
    volumes = space.volume_at(np.array(space.dead_centres))
    least, largest = (float(space.dead_centres[at(volumes)]) - delay for at in (np.argmin, np.argmax))
    return (least + space.period / 2) % space.period - space.period / 2, largest


def _solved(chamber: Chamber, space: _Space, start: float, path: str) -> IndicatorDiagram:
    """Return the diagram of a chamber over the cycle that begins at a crank angle of its volume."""
    centres = DeadCentres(tuple(sorted((one - start) % space.period for one in space.dead_centres)), space.period)
    volume_at, valves = _volume_from(space, start), stated_valves(path, chamber)
    if valves is not None:
        if len(space.dead_centres) != 2 or space.period != chamber.cycle:
            raise DiagramError(valves.path, Refusal("valves_strokes", count=len(space.dead_centres)))
        valves.check(space.clearance.value, space.swept.value)
    found = solve_diagram(chamber.points, chamber.pieces, chamber.cycle, volume_at, dead_centres=centres, path=path)
    return found if valves is None else valves.remembered(found)


def stated_valves(path: str, chamber: Chamber) -> StatedValves | None:
    """Return the valves of a chamber as they are stated, if it has any."""
    if chamber.valves is None:
        return None
    return StatedValves(chamber.valves, f"{path}.valves", f".{path.removeprefix('chambers.')}")


def _rate_from(space: _Space, start: float) -> VolumeAt:
    rate = Program({"": space.volume_1})
    return lambda degrees: rate(CrankGrid.from_degrees(degrees + start))[""]


def _volume_from(space: _Space, start: float) -> VolumeAt:
    return lambda degrees: space.volume_at(degrees + start)


def _jump(point: str, degrees: float, step: float, law: Law | None) -> Told:
    """Return the notice of a jump at a crank angle, or at its time where a law drives."""
    if law is None:
        return "jump", {"point": point, "angle": degrees, "step": step}
    return "jump_time", {"point": point, "time": degrees / _TURN * law.period, "step": step}


def _joined(found: Mapping[float, IndicatorDiagram], phases: Sequence[float]) -> IndicatorDiagram:
    """Return the diagrams of cycles that begin at angles of a volume, one behind the other, as one. [deg]

    Points of a later phase have a mark.
    """
    segments, named, start = list[Segment](), dict[str, tuple[float, float]](), 0.0
    for phase in phases:
        one, mark = found[phase], "′" * list(found).index(phase)
        segments += [
            replace(
                part,
                start=part.start + start,
                end=part.end + start,
                knots=part.knots + start,
                origin=part.origin and part.origin + mark,
            )
            for part in one.segments
        ]
        for name, (degrees, pressure) in one.named.items():
            named.setdefault(name + mark, (degrees + phase, pressure))
        start += one.segments[-1].end
    return replace(found[phases[0]], segments=tuple(segments), named=named)


def _works(pressures: Mapping[str, Known], spaces: Mapping[str, _Space], period: float) -> dict[str, Known]:
    """Return the work of a sealed charge in each of its chambers over a period of its volume."""
    if not pressures:
        return {}
    over = OverCycle(
        {name: one * spaces[name].volume_1 for name, one in pressures.items()}, CrankGrid.from_degrees, period
    )
    return {
        name: Known(
            # what rounding leaves of a work that comes back is nothing
            Found(over.mean(name, "").value * math.radians(period), "work", (one, spaces[name].volume)),
            f"indicated_work.{name}",
        )
        for name, one in pressures.items()
    }


def _sealed(
    name: str, charge: Charge, chambers: Mapping[str, Chamber], spaces: Mapping[str, _Space], period: float
) -> tuple[Known, list[Known]]:
    """Return the pressure of a sealed charge, and its single values."""
    path = f"charges.{name}"
    parts = [(one, spaces[one].volume, chambers[one].temperature, f"chambers.{one}") for one in charge.chambers]
    for number, dead in enumerate(charge.dead_volumes, start=1):
        place = f"{path}.dead_volumes[{number}]"
        volume = given(f"dead_volume.{name}.{number}", dead.volume, f"{place}.volume")
        parts.append((f"{name}.{number}", volume, dead.temperature, place))
    if charge.exponent is not None:
        whole = total(f"cylinder_volume.{name}", [volume for _, volume, _, _ in parts])
        exponent = given(f"polytropic_exponent.{name}", charge.exponent, f"{path}.exponent")
        return charge_pressure(name, charge, whole, exponent, period), []
    reduced = []
    for owner, volume, kelvin, place in parts:
        temperature = given(f"cylinder_temperature.{owner}", kelvin or math.nan, f"{place}.temperature")
        reduced.append(gas.reduced_volume(volume, temperature).named(f"reduced_volume.{owner}"))
    whole = total(f"reduced_volume.{name}", reduced)
    constant = given(f"specific_gas_constant.{name}", charge.gas_constant or math.nan, f"{path}.gas_constant")
    mass = charge_mass(name, charge, whole, constant, period)
    return gas.isothermal_pressure(mass, constant, whole), [mass]

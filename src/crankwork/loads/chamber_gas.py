"""Gas in chambers: volumes, pressures and forces on sliding pieces, as traced values; equal parts have equal gas."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, delayed, given, is_traced, total
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.loads import gas
from crankwork.loads.applied_loads import AppliedLoads, combine_loads, force_on_slider
from crankwork.loads.chamber import (
    ZERO_TOLERANCE,
    CalculatedDiagram,
    Chamber,
    Charge,
    Face,
    charge_mass,
    charge_pressure,
    cycle_of,
    face_names,
    least_common,
    own_cycle,
)
from crankwork.loads.indicator import (
    DeadCentres,
    DiagramError,
    IndicatorDiagram,
    Segment,
    VolumeAt,
    counts_from_top,
    solve_diagram,
)
from crankwork.loads.measured_pressure import NoticeData
from crankwork.loads.pressure_processing import PressureReference, measured_diagram
from crankwork.loads.traced_diagram import DiagramInput, at_angle, pressure_on_piston, traced_pressure
from crankwork.loads.valves import Flow, StatedValves
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Law
from crankwork.mechanism.equal_parts import EqualPart
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities.key import key_of

_TURN = 360.0
# share of the swept volume by which a volume at rest may change
_STILL = 1e-9
# dead centres closer together than this are equal [deg]
_SAME_ANGLE = 1e-6


class GasForce(NamedTuple):
    """The force of the gas in a chamber on a sliding piece, along its guide. [N]"""

    chamber: str
    slider: str
    force: TracedValue


class ChamberGas(NamedTuple):
    """The gas of a machine: columns and single values by key, forces and notices."""

    columns: Mapping[str, TracedValue]
    singles: Mapping[str, TracedValue]
    forces: tuple[GasForce, ...]
    notices: tuple[NoticeData, ...]
    calculated: Mapping[str, CalculatedDiagram] = {}  # Calculated cycles by the names of their chambers

    def loads(self, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
        """Return the forces as loads, traced if the motion is traced, else as numbers."""
        force: Mapping[str, Value] = {gas_force.force.key: gas_force.force for gas_force in self.forces}
        if not is_traced(*(slider.position for slider in motion.sliders.values())):
            force = Program({gas_force.force.key: gas_force.force for gas_force in self.forces})(motion.grid)
        return combine_loads(
            force_on_slider(mechanism, motion, gas_force.slider, force[gas_force.force.key], f".{gas_force.chamber}")
            for gas_force in self.forces
        )


NO_GAS = ChamberGas({}, {}, (), ())


class _Wall(NamedTuple):
    """A face with its area and sense, and the position of its piece."""

    slider: str
    sense: TracedValue
    area: TracedValue
    position: TracedValue
    position_1: TracedValue
    position_2: TracedValue


class _Space(NamedTuple):
    """A chamber in motion; `period` and `dead_centres` are those of its volume. [deg]"""

    walls: tuple[_Wall, ...]
    volume: TracedValue
    volume_1: TracedValue
    swept: TracedValue
    clearance: TracedValue
    ratio: TracedValue
    period: float
    dead_centres: tuple[float, ...]

    def volume_at(self, degrees: Array) -> Array:
        """Return the volume at crank angles. [m3]"""
        return Program({"": self.volume})(CrankGrid.from_degrees(degrees))[""]


def solve_chambers(  # noqa: PLR0913 - inputs of gas and of motion
    chambers: Mapping[str, Chamber],
    charges: Mapping[str, Charge],
    motion: Motion,
    pi: float,
    law: Law | None = None,
    period: float = _TURN,
    turning: tuple[TracedValue, TracedValue] | None = None,
) -> ChamberGas:
    """Return the gas of chambers on the sliding pieces of a traced motion.

    `law`: of the driver, unless it is a crank that turns by the angle of the tables; `period`: of the motion [deg];
    `turning`: speed and acceleration of the driver's coordinate, for the flow in pipes.
    """
    if not chambers:
        return NO_GAS
    full_cycle = least_common(cycle_of(chambers), period)
    spaces = _spaces(chambers, motion, pi, law, period)
    pressures = dict[str, TracedValue]()
    works = dict[str, TracedValue]()
    own = list[TracedValue]()
    all_notices = list[NoticeData]()
    calculated = dict[str, CalculatedDiagram]()
    for name, charge in charges.items():
        pressure, values = _sealed(name, charge, chambers, spaces, period)
        own += values
        pressures |= {
            chamber_name: pressure.named(f"diagram_pressure.{chamber_name}") for chamber_name in charge.chambers
        }
    works |= _works(pressures, spaces, period)
    for name, chamber in chambers.items():
        if name not in pressures:
            own_gas = _of_its_own(name, chamber, spaces[name], full_cycle, law)
            pressures[name], works[name] = own_gas.pressure, own_gas.work
            calculated |= {name: own_gas.calculated} if own_gas.calculated is not None else {}
            all_notices += own_gas.notices
            if turning is not None and chamber.valves is not None and chamber.valves.has_pipes:
                flow = Flow(*_rates(spaces[name]), *turning, pi)
                piped = _behind_pipes(name, chamber, spaces[name], pressures[name], flow)
                pressures[name], notices = piped.pressure, piped.notices
                works |= _works({name: pressures[name]}, spaces, period)
                own += piped.least
                all_notices += notices
    columns, forces = list[TracedValue](), list[GasForce]()
    for name, space in spaces.items():
        ambient, path = chambers[name].ambient, f"chambers.{name}"
        if ambient and not chambers[name].names_ambient:
            all_notices.append(("ambient", {"pressure": ambient / 1e6}))
        around, factor = (ambient, f"{path}.ambient"), (chambers[name].factor, f"{path}.pressure_factor")
        above = pressure_on_piston(pressures[name], around, factor, f".{name}")
        columns += [space.volume, pressures[name], above]
        for wall in space.walls:
            key = wall.area.key.replace("piston_area", "gas_force", 1)
            forces.append(GasForce(name, wall.slider, gas.face_force(wall.sense, above, wall.area).named(key)))
        mean = gas.indicated_mean_pressure(works[name], space.swept).named(f"indicated_mean_pressure.{name}")
        own += [*_sizes(space), works[name], mean]
    columns += [*(gas_force.force for gas_force in forces), *_rod_loads(forces)]
    once = {repr(notice): notice for notice in all_notices}
    return ChamberGas(_by_key(columns), _by_key(own), tuple(forces), tuple(once.values()), calculated)


def _rod_loads(forces: Sequence[GasForce]) -> Iterator[TracedValue]:
    """Yield the sum of the gas forces on each sliding piece between chambers."""
    for slider in dict.fromkeys(gas_force.slider for gas_force in forces):
        acting = [gas_force.force for gas_force in forces if gas_force.slider == slider]
        if len(acting) > 1:
            yield total(f"rod_load.{slider}", acting)


class _Piped(NamedTuple):
    """The pressure in a chamber behind pipes, its minimum with its angle and heads, and notices."""

    pressure: TracedValue
    least: tuple[TracedValue, ...]
    notices: list[NoticeData]


def _behind_pipes(name: str, chamber: Chamber, space: _Space, before: TracedValue, flow: Flow) -> _Piped:
    """Return the pressure in a chamber with pipes; `before`: without them."""
    path = f"chambers.{name}"
    valves = stated_valves(path, chamber)
    begins = chamber.delay + _ends_of_stroke(space, chamber.delay)[0]
    if valves is None:
        return _Piped(before, (), [])
    pressure = valves.through_pipes(before, _solved(chamber, space, begins, path).later(begins), flow)
    extremes = CycleInterpolant({pressure.key: pressure}, CrankGrid.from_degrees, space.period).extremes(pressure.key)
    least, angle = (extremes[f"diagram_pressure_{word}.{name}"] for word in ("min", "min_angle"))
    boiling, notices = valves.valves.vapour_pressure, list[NoticeData]()
    if boiling is not None and least.value < boiling:
        pressures = {"least": least.value / 1e6, "vapour": boiling / 1e6}
        notices.append(("separation", {"name": name, **pressures, "angle": math.degrees(angle.value)}))
    heads, turning = list(valves.heads(flow, space.period)), abs(flow.speed.value)
    for head in heads:
        if head.key.startswith("separation_speed") and head.value < turning:
            speeds = {"most": 30 / math.pi * head.value, "speed": 30 / math.pi * turning}
            notices.append((f"separation_{head.key.rpartition('.')[2]}", {"name": name, **speeds}))
    return _Piped(pressure, (least, angle, *heads), notices)


def _rates(space: _Space) -> tuple[TracedValue, TracedValue]:
    """Return the derivatives of a volume by the driver's coordinate."""
    first = [gas.face_volume_1(wall.sense, wall.area, wall.position_1) for wall in space.walls]
    second = [gas.face_volume_2(wall.sense, wall.area, wall.position_2) for wall in space.walls]
    owner = key_of(space.volume.key).owner
    return total(f"cylinder_volume_1.{owner}", first), total(f"cylinder_volume_2.{owner}", second)


def _by_key(values: list[TracedValue]) -> dict[str, TracedValue]:
    return {value.key: value for value in values}


def _sizes(space: _Space) -> Iterator[TracedValue]:
    yield from (wall.area for wall in space.walls)
    yield space.swept
    if not space.clearance.is_absent:
        yield space.clearance
        yield space.ratio


def rate_by_angle(motion: Motion, law: Law) -> TracedValue:
    """Return the derivative of the driver's coordinate by the angle of the tables."""
    _, rate, _ = motion.driver if motion.driver is not None else (None, absent("driver_velocity"), None)
    return rate * (given("period", law.period, "driver.period") / math.radians(_TURN))


def _spaces(
    chambers: Mapping[str, Chamber], motion: Motion, pi: float, law: Law | None, period: float
) -> dict[str, _Space]:
    """Return the chambers as they move."""
    walls = {name: tuple(_walls(name, chamber, motion, pi)) for name, chamber in chambers.items()}
    followed = {}
    for name, chamber_walls in walls.items():
        travel = [gas.face_volume(wall.sense, wall.area, wall.position, absent("")) for wall in chamber_walls]
        followed[f"face_volume.{name}"] = total(f"face_volume.{name}", travel)
        rates = [gas.face_volume_1(wall.sense, wall.area, wall.position_1) for wall in chamber_walls]
        rate = total(f"cylinder_volume_1.{name}", rates)
        followed[rate.key] = rate if law is None else (rate * rate_by_angle(motion, law)).named(rate.key)
    over = CycleInterpolant(followed, CrankGrid.from_degrees, period)
    return {name: _space(name, chambers[name], own_walls, over, period) for name, own_walls in walls.items()}


def _walls(name: str, chamber: Chamber, motion: Motion, pi: float) -> Iterator[_Wall]:
    for number, (face, owner) in enumerate(zip(chamber.faces, face_names(name, chamber), strict=True), start=1):
        path = f"chambers.{name}.faces[{number}]"
        sense = absent("face_sense", 1.0) if face.sense == 1 else given(f"face_sense.{owner}", -1.0, f"{path}.sense")
        slide: Any = motion.sliders[face.slider]
        yield _Wall(
            face.slider, sense, _area(face, owner, path, pi), slide.position, slide.position_1, slide.position_2
        )


def _area(face: Face, owner: str, path: str, pi: float) -> TracedValue:
    key = f"piston_area.{owner}"
    if face.bore is None:
        return given(key, face.area or 0.0, f"{path}.area")
    area: TracedValue = gas.piston_area(pi, given(f"bore.{owner}", face.bore, f"{path}.bore"))
    if not face.rod_diameter:
        return area.named(key)
    rod = given(f"piston_rod_diameter.{owner}", face.rod_diameter, f"{path}.rod_diameter")
    less: TracedValue = gas.face_area(area.named(f"{key}.bore"), gas.piston_area(pi, rod).named(f"{key}.rod"))
    return less.named(key)


def _space(name: str, chamber: Chamber, walls: tuple[_Wall, ...], over: CycleInterpolant, period: float) -> _Space:
    travel, rate = f"face_volume.{name}", f"cylinder_volume_1.{name}"
    largest, least = over.extreme_points[travel]
    if largest.value - least.value <= ZERO_TOLERANCE * max(largest.value, -least.value):
        raise DiagramError(f"chambers.{name}", ErrorMessage("chamber_still"))
    extremes = over.extremes(travel)
    swept = (extremes[f"face_volume_max.{name}"] - extremes[f"face_volume_min.{name}"]).named(f"swept_volume.{name}")
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
    turned = extremes[f"face_volume_min_angle.{name}"] * (180 / math.pi)
    for wall in walls:
        start = at_angle(wall.position, least.at, f"slider_displacement.{wall.slider}.{name}", turned)
        part = gas.face_volume(wall.sense, wall.area, wall.position, start)
        parts.append(part.named(f"face_volume.{name}.{wall.slider}"))
    volume = total(f"cylinder_volume.{name}", parts)
    centres = [*over.crossings(rate).tolist(), largest.at, least.at, *_at_zero(rate, over, period)]
    turning = _distinct_angles(centres, period)
    volumes = Program({"": volume})(CrankGrid.from_degrees(turning))[""]
    # during a dwell of the driver only its first angle is a dead centre
    moves = np.abs(volumes - np.roll(volumes, 1)) > _STILL * swept.value
    kept = tuple(angle for angle, moved in zip(turning, moves.tolist(), strict=True) if moved)
    return _Space(walls, volume, over.columns[rate], swept, clearance, ratio, period, kept)


def _at_zero(rate: str, over: CycleInterpolant, period: float) -> Iterator[float]:
    """Yield 0 if the volume has an extreme where the period repeats."""
    before, after = over.at(rate, np.array([period - _SAME_ANGLE, _SAME_ANGLE])).tolist()
    if before * after < 0:
        yield 0.0


def _distinct_angles(degrees: list[float], period: float) -> tuple[float, ...]:
    """Return crank angles within a period, ascending, without those that differ by rounding only."""
    ordered = sorted(angle % period if period - angle % period > _SAME_ANGLE else 0.0 for angle in degrees)
    return tuple(angle for before, angle in itertools.pairwise([-1.0, *ordered]) if angle - before > _SAME_ANGLE)


class _OwnGas(NamedTuple):
    """The pressure of a chamber that is not part of a charge, its work over a cycle, and what else is known of it."""

    pressure: TracedValue
    work: TracedValue
    notices: list[NoticeData]
    calculated: CalculatedDiagram | None = None


def _of_its_own(name: str, chamber: Chamber, space: _Space, full_cycle: float, law: Law | None) -> _OwnGas:
    """Return the gas of a chamber that is not part of a charge."""
    key, path = f"diagram_pressure.{name}", f"chambers.{name}"
    notices: list[NoticeData] = []
    cycle = own_cycle(chamber, space.period)
    if chamber.pressure is not None:
        pressure = given(key, chamber.pressure, f"{path}.pressure")
        # zero if the volume repeats
        done = chamber.factor * chamber.pressure * float(np.diff(space.volume_at(np.array([0.0, cycle])))[0])
        work = TracedValue(ProcedureValue(done, "work", (pressure, space.volume)), f"indicated_work.{name}")
        return _OwnGas(pressure, work, notices)
    if cycle > chamber.cycle:
        notices.append(("chamber_again", {"name": name, "cycle": chamber.cycle, "turns": round(space.period / _TURN)}))
    # valves open by the volume, and strokes begin, wherever the dead centre is
    is_from_top = chamber.valves is not None or counts_from_top(chamber.points, chamber.pieces, by_law=law is not None)
    begins = chamber.delay + (_ends_of_stroke(space, chamber.delay)[0] if is_from_top else 0.0)
    # a calculated cycle comes later as that of a cylinder does, so that its jumps keep their sides
    later = chamber.delay if chamber.calculated is not None else 0.0
    volume = delayed(space.volume, -later, full_cycle, space.volume.key)
    general_form: Callable[[], TracedValue] | DiagramInput | None = None
    calculated: CalculatedDiagram | None = None
    # cycles at equal volumes share one diagram
    phases = [angle % space.period for angle in np.arange(0.0, full_cycle, chamber.cycle).tolist()]
    if chamber.measured is not None:
        # a volume with one minimum per turn is that of an engine: top dead centre can be checked
        is_plain = law is None and len(space.dead_centres) == 2 and chamber.cycle in (_TURN, 2 * _TURN)
        top = _ends_of_stroke(space, chamber.delay)[0] if is_plain and space.period == _TURN else None
        around = PressureReference(_volume_from(space, begins), top)
        samples, measured_notices = measured_diagram(
            chamber.measured, chamber.cycle, around, shift=chamber.angle_shift, step=chamber.resample, path=path
        )
        notices += measured_notices
        diagrams = dict.fromkeys(phases, samples)
    elif chamber.calculated is not None:
        if chamber.calculated.has_corners and (len(space.dead_centres), space.period) != (2, _TURN):
            raise DiagramError(f"{path}.cycle", ErrorMessage("cycle_strokes", count=len(space.dead_centres)))
        diagrams, centres = {}, _ends_of_stroke(space, begins)
        for phase in dict.fromkeys(phases):
            volume_at, rate_at = _volume_from(space, begins + phase), _rate_from(space, begins + phase)
            calculated = chamber.calculated.pressure(volume_at, rate_at, centres)
            diagrams[phase] = calculated.diagram
            notices += calculated.notices
        if (traced := chamber.calculated.traced) is not None and len(diagrams) == 1:
            general_form = partial(traced, volume, centres)
    else:
        diagrams = {phase: _solved(chamber, space, begins + phase, path) for phase in dict.fromkeys(phases)}
        notices += [
            _jump(point, phase + angle, step, law)
            for phase, phase_diagram in diagrams.items()
            for point, angle, step in phase_diagram.jumps
        ]
    diagram = _joined(diagrams, phases).later(begins - later)
    if chamber.pieces and len(diagrams) == 1:
        size, valves = (space.clearance, space.swept), stated_valves(path, chamber)
        general_form = DiagramInput(chamber.points, chamber.pieces, path, space.volume, *size, valves, begins)
    pressure = delayed(traced_pressure(diagram, volume, path, general_form, name), later, full_cycle, key)
    own_phases = phases[: round(cycle / chamber.cycle)]
    done = chamber.factor * sum(diagrams[own].work(_volume_from(space, begins + own)) for own in own_phases)
    work = TracedValue(ProcedureValue(done, "work", (pressure, space.volume)), f"indicated_work.{name}")
    return _OwnGas(pressure, work, notices, calculated)


def _ends_of_stroke(space: _Space, delay: float) -> tuple[float, float]:
    """Return the nearest angle of smallest volume and the next one of the largest, counted from `delay`. [deg]"""
    volumes = space.volume_at(np.array(space.dead_centres))
    least, largest = (float(space.dead_centres[index_of(volumes)]) - delay for index_of in (np.argmin, np.argmax))
    top = (least + space.period / 2) % space.period - space.period / 2
    # rounding would let it end the cycle
    top = top if abs(top) > _SAME_ANGLE else 0.0
    return top, top + (largest - least) % space.period


def _solved(chamber: Chamber, space: _Space, start: float, path: str) -> IndicatorDiagram:
    """Return the diagram of a chamber over the cycle that begins at a crank angle of its volume."""
    centres = DeadCentres(tuple(sorted((angle - start) % space.period for angle in space.dead_centres)), space.period)
    volume_at, valves = _volume_from(space, start), stated_valves(path, chamber)
    if valves is not None:
        if len(space.dead_centres) != 2 or space.period != chamber.cycle:
            raise DiagramError(valves.path, ErrorMessage("valves_strokes", count=len(space.dead_centres)))
        valves.check(space.clearance.value, space.swept.value)
        return valves.solved(chamber.points, chamber.pieces, volume_at, centres, f"{path}.clearance_volume")
    return solve_diagram(chamber.points, chamber.pieces, chamber.cycle, volume_at, dead_centres=centres, path=path)


def stated_valves(path: str, chamber: Chamber) -> StatedValves | None:
    """Return the valves of a chamber with the path of their input, None without valves."""
    if chamber.valves is None:
        return None
    return StatedValves(chamber.valves, f"{path}.valves", f".{path.removeprefix('chambers.')}")


def _rate_from(space: _Space, start: float) -> VolumeAt:
    rate = Program({"": space.volume_1})
    return lambda degrees: rate(CrankGrid.from_degrees(degrees + start))[""]


def _volume_from(space: _Space, start: float) -> VolumeAt:
    volume = Program({"": space.volume})
    return lambda degrees: volume(CrankGrid.from_degrees(degrees + start))[""]


def _jump(point: str, degrees: float, step: float, law: Law | None) -> NoticeData:
    """Return the notice of a jump at a crank angle, or at its time where a law drives."""
    if law is None:
        return "jump", {"point": point, "angle": degrees, "step": step}
    return "jump_time", {"point": point, "time": degrees / _TURN * law.period, "step": step}


def _joined(diagrams: Mapping[float, IndicatorDiagram], phases: Sequence[float]) -> IndicatorDiagram:
    """Return the diagrams of consecutive cycles as one; points of a later phase get a prime."""
    segments, named, start = list[Segment](), dict[str, tuple[float, float]](), 0.0
    for phase in phases:
        diagram, mark = diagrams[phase], "′" * list(diagrams).index(phase)
        segments += [
            replace(
                part,
                start=part.start + start,
                end=part.end + start,
                knots=part.knots + start,
                origin=part.origin and part.origin + mark,
            )
            for part in diagram.segments
        ]
        for name, (degrees, pressure) in diagram.named.items():
            named.setdefault(name + mark, (degrees + phase, pressure))
        start += diagram.segments[-1].end
    return replace(diagrams[phases[0]], segments=tuple(segments), named=named)


def _works(pressures: Mapping[str, TracedValue], spaces: Mapping[str, _Space], period: float) -> dict[str, TracedValue]:
    """Return the work of a sealed charge in each of its chambers over a period of its volume."""
    if not pressures:
        return {}
    over = CycleInterpolant(
        {name: pressure * spaces[name].volume_1 for name, pressure in pressures.items()}, CrankGrid.from_degrees, period
    )
    return {
        name: TracedValue(
            # the mean is exactly zero where the work is below rounding
            ProcedureValue(over.mean(name, "").value * math.radians(period), "work", (pressure, spaces[name].volume)),
            f"indicated_work.{name}",
        )
        for name, pressure in pressures.items()
    }


def _sealed(
    name: str, charge: Charge, chambers: Mapping[str, Chamber], spaces: Mapping[str, _Space], period: float
) -> tuple[TracedValue, list[TracedValue]]:
    """Return the pressure of a sealed charge, and its single values."""
    path = f"charges.{name}"
    parts = [
        (chamber, spaces[chamber].volume, chambers[chamber].temperature, f"chambers.{chamber}")
        for chamber in charge.chambers
    ]
    for number, dead in enumerate(charge.dead_volumes, start=1):
        place = f"{path}.dead_volumes[{number}]"
        volume = given(f"dead_volume.{name}.{number}", dead.volume, f"{place}.volume")
        parts.append((f"{name}.{number}", volume, dead.temperature, place))
    if charge.exponent is not None:
        total_volume = total(f"cylinder_volume.{name}", [volume for _, volume, _, _ in parts])
        exponent = given(f"polytropic_exponent.{name}", charge.exponent, f"{path}.exponent")
        return charge_pressure(name, charge, total_volume, exponent, period), []
    reduced = []
    for owner, volume, kelvin, place in parts:
        temperature = given(f"cylinder_temperature.{owner}", kelvin or math.nan, f"{place}.temperature")
        reduced.append(gas.reduced_volume(volume, temperature).named(f"reduced_volume.{owner}"))
    total_volume = total(f"reduced_volume.{name}", reduced)
    constant = given(f"specific_gas_constant.{name}", charge.gas_constant or math.nan, f"{path}.gas_constant")
    mass = charge_mass(name, charge, total_volume, constant, period)
    return gas.isothermal_pressure(mass, constant, total_volume), [mass]


def with_equal_chambers(filling: ChamberGas, chambers: Mapping[str, Chamber], parts: Sequence[EqualPart]) -> ChamberGas:
    """Return the gas of all chambers, by that of those in parts that later parts are equal to."""
    if not parts or not chambers:
        return filling
    columns, singles, forces = dict(filling.columns), dict(filling.singles), [*filling.forces]
    for part in parts:
        for first, own in part.chambers.items():
            owners = dict(zip(face_names(first, chambers[first]), face_names(own, chambers[own]), strict=True))
            owners |= {first: own} | {face.slider: part.names[face.slider] for face in chambers[first].faces}
            for values in (columns, singles):
                for key, known in [*values.items()]:
                    kind, owner = key_of(key)
                    if owner in owners:
                        name = f"{kind}.{owners[owner]}"
                        values[name] = (
                            delayed(known, part.delay, part.cycle, name) if known.varies else known.named(name)
                        )
            forces += [
                GasForce(own, owners[force.slider], columns[f"gas_force.{owners[force.force.key.partition('.')[2]]}"])
                for force in filling.forces
                if force.chamber == first
            ]
    order = {name: number for number, name in enumerate(chambers)}
    forces.sort(key=lambda force: order[force.chamber])
    columns, singles = _in_order(columns, chambers), _in_order(singles, chambers)
    return filling._replace(columns=columns, singles=singles, forces=tuple(forces))


def _in_order(values: Mapping[str, TracedValue], chambers: Mapping[str, Chamber]) -> dict[str, TracedValue]:
    """Return values of each chamber in the order of chambers; gas forces and rod loads come last."""
    order = dict[str, int]()
    for number, (name, chamber) in enumerate(chambers.items()):
        order |= dict.fromkeys((name, *face_names(name, chamber), *(face.slider for face in chamber.faces)), number)
    last = ("gas_force", "rod_load")

    def rank(key: str) -> tuple[int, int]:
        kind, owner = key_of(key)
        return last.index(kind) + 1 if kind in last else 0, order.get(owner, -1)

    return {key: values[key] for key in sorted(values, key=rank)}

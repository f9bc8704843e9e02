"""Torsional vibration of a machine: its discs and shafts, natural modes, nodes, tables by Holzer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from crankwork.analysis.crankshaft_bearings import rotating_mass_of
from crankwork.analysis.cylinder_forces import TracedCylinder, traced_cylinder
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.harmonics import curve_of
from crankwork.analysis.reduction import MOVING
from crankwork.analysis.results import Deferred, Listing, Results
from crankwork.cylinders.arrangement import inline
from crankwork.cylinders.layout import CylinderPlace
from crankwork.cylinders.torque import curve_harmonics
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import (
    FunctionValue,
    HarmonicCoefficient,
    ProcedureValue,
    TracedValue,
    absent,
    given,
    total,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Engine, Machine
from crankwork.preparation.cell_gas import linkage_paths, relocate
from crankwork.preparation.cylinder_form import engine_form
from crankwork.preparation.prepared import Notice, PreparedMachine
from crankwork.shaft import torsion_formulas as formulas
from crankwork.shaft.torsion_model import GROUNDED, ElasticShaft, ShaftPart, TorsionModel, structure_of, walked
from crankwork.shaft.torsional_system import (
    DampedDisc,
    ForcedVibration,
    HolzerTable,
    Modes,
    NaturalModes,
    TorsionalStructure,
    Wave,
    damped_modes,
)

_TURN, _CYCLE = 360.0, 720.0


def engine_of(results: Results) -> MultiCylinderEngine | None:
    """Return all cylinders of an engine or of the linkage that it is, one of one crank gear; None of other machines."""
    solved, machine = results.solved, results.machine
    if not isinstance(solved, TracedCylinder):
        form = None if machine.linkage is None else engine_form(machine)
        if form is None:
            return None
        solved = traced_cylinder(form, form.method)
        relocate(solved.trace.values(), linkage_paths(machine))
    if solved.machine.engine is not None:
        return multi_cylinder_engine(solved)
    layout, _ = inline(1, (1,), strokes=4 if solved.machine.cycle == _CYCLE else 2)
    return MultiCylinderEngine(solved.machine, Engine(layout), (solved,))


def throw_inertias(engine: MultiCylinderEngine | None) -> tuple[Mapping[str, TracedValue], TracedValue | None]:
    """Return the mean over the cycle of the reduced inertia of the cylinders of each throw, and the crank radius."""
    if engine is None:
        return {}, None
    radius = engine.master.trace["crank_radius"]
    if engine.machine.masses is None:
        return {}, radius
    throws: dict[str, list[TracedValue]] = {}
    means = dict[int, TracedValue]()
    for place, cylinder in zip(engine.layout.places, engine.cylinders, strict=True):
        parts = throws.setdefault(f"throw_{place.throw + 1}", [])
        if id(cylinder) not in means:
            moving = [
                cylinder.trace[key] for key in (f"reduced_inertia.{part}" for part in MOVING) if key in cylinder.trace
            ]
            column = total("reduced_inertia.moving", moving)
            over = CycleInterpolant({column.key: column}, CrankGrid.from_degrees, _TURN)
            means[id(cylinder)] = over.mean(column.key, "reduced_inertia.mean")
        rotating = rotating_mass_of(engine, place) * radius * radius
        parts += [means[id(cylinder)], rotating.named("reduced_inertia.rotating")]
    return {name: total("disc_inertia", parts) for name, parts in throws.items()}, radius


class _Harmonic(NamedTuple):
    """One order of a torque of a cylinder, traced, and whether it grows with the square of the speed."""

    order: float
    cosine: TracedValue
    sine: TracedValue
    is_inertia: bool


def gas_and_inertia_torques(
    engine: MultiCylinderEngine, highest: float
) -> Iterator[tuple[CylinderPlace, tuple[_Harmonic, ...]]]:
    """Yield every cylinder with the harmonics of its torque: of its gas, then of all else (den_hartog_1956, ch. 5)."""
    kinds = dict[int, tuple[_Harmonic, ...]]()
    cycle = engine.layout.cycle
    for place, cylinder in zip(engine.layout.places, engine.cylinders, strict=True):
        if id(cylinder) not in kinds:
            own, torque = cylinder.trace, cylinder.trace["crank_torque"]
            columns = {"crank_torque.inertia": torque.named("crank_torque.inertia")}
            if "gas_force" in own:
                gas = (own["gas_force"] * own["piston_transfer_1"]).named("crank_torque.gas")
                columns = {gas.key: gas, "crank_torque.inertia": (torque - gas).named("crank_torque.inertia")}
            over = CycleInterpolant(columns, CrankGrid.from_degrees, cycle)
            kinds[id(cylinder)] = tuple(
                harmonic for key in columns for harmonic in _harmonics(over, key, round(highest * cycle / _TURN))
            )
        yield place, kinds[id(cylinder)]


def _harmonics(over: CycleInterpolant, key: str, count: int) -> Iterator[_Harmonic]:
    """Yield the harmonics of a torque."""
    if over.is_zero(key):
        return
    column, harmonics = over.columns[key], curve_harmonics(curve_of(over, key), count)
    for order, a, b in zip(harmonics.orders.tolist(), harmonics.cosine.tolist(), harmonics.sine.tolist(), strict=True):
        cosine, sine = (
            TracedValue(HarmonicCoefficient(value, column, part, order), f"harmonic_{part}.{order:g}")
            for part, value in (("cosine", a), ("sine", b))
        )
        yield _Harmonic(order, cosine, sine, key.endswith("inertia"))


_PATH = "torsion"


@dataclass(frozen=True)
class TorsionTrace:
    """A torsional system with its traced numbers: discs and rings by name, shafts and springs, gears."""

    model: TorsionModel
    structure: TorsionalStructure
    names: tuple[str, ...]  # Of discs, rings last
    inertia: Mapping[str, TracedValue]
    stiffness: Mapping[str, TracedValue]  # Of shafts and of springs of dampers
    ratio: Mapping[str, TracedValue]  # Of gears
    own_inertia: Mapping[str, TracedValue]  # Of shafts whose mass counts
    lengths: Mapping[str, TracedValue]  # Equivalent lengths of shafts
    values: Mapping[str, TracedValue]  # By key
    geared: Mapping[str, TracedValue]  # Speed of discs over that of the first one, where they differ

    @property
    def elastic(self) -> tuple[TracedValue, ...]:
        """The numbers of the system without what only dampers hold."""
        kept = self.names[: len(self.names) - self.structure.rings]
        return (*(self.inertia[name] for name in kept), *self.stiffness.values(), *self.ratio.values(),
                *self.own_inertia.values())  # fmt: skip


def torsion_trace(
    model: TorsionModel, own: Mapping[str, TracedValue], pi: float, radius: TracedValue | None = None
) -> TorsionTrace:
    """Return the traced numbers of a system; `own`: inertias of throws, `radius`: of the crank, of the machine."""
    names, values = walked(model), dict[str, TracedValue]()
    inertia = {name: _inertia(model, name, own).named(f"disc_inertia.{name}") for name in names}
    ratio = {name: _ratio(model, name) for name in model.gears}
    geared = _speed_ratios(model, names, ratio)
    reference = _reference(model, pi)
    stiffness, lengths, heavy = dict[str, TracedValue](), dict[str, TracedValue](), dict[str, TracedValue]()
    for name, shaft in model.shafts.items():
        stiffness[name], length = _stiffness(model, shaft, f"torsional_stiffness.{name}", reference, (pi, radius))
        if length is not None:
            first = next(end for end in shaft.between if end in inertia)
            reduced = formulas.length_at_first_speed(length.named(f"equivalent_length.{name}.own"), geared[first]) if (
                first in geared) else length  # fmt: skip
            lengths[name] = reduced.named(f"equivalent_length.{name}")
        if shaft.density is not None:
            density = given("shaft_density", shaft.density, f"{shaft.path}.density")
            part, moment = shaft.parts[0], _moment(shaft.path, shaft.parts[0], pi)
            heavy[name] = formulas.inertia_of_shaft(density, moment, _length(shaft.path, part)).named(
                f"shaft_inertia.{name}"
            )
    for name, damper in model.dampers.items():
        if damper.stiffness:
            stiffness[name] = given(
                f"torsional_stiffness.{name}", damper.stiffness, f"{_PATH}.dampers.{name}.stiffness"
            )
    values |= {item.key: item for item in (*inertia.values(), *stiffness.values(), *lengths.values(), *heavy.values())}
    for name, u in geared.items():
        values[u.key] = u
        values[f"equivalent_inertia.{name}"] = formulas.inertia_at_first_speed(inertia[name], u).named(
            f"equivalent_inertia.{name}"
        )
    if len(lengths) == len(model.shafts) > 1 and structure_of(model).is_tree:
        values["equivalent_length"] = total("equivalent_length", lengths.values())
    return TorsionTrace(model, structure_of(model), names, inertia, stiffness, ratio, heavy, lengths, values, geared)


def _inertia(model: TorsionModel, name: str, own: Mapping[str, TracedValue]) -> TracedValue:
    """Return the moment of inertia of a disc, of the ring of a damper, or of a throw."""
    if name in model.dampers:
        return given("disc_inertia", model.dampers[name].inertia, f"{_PATH}.dampers.{name}.inertia")
    if name in model.throws:
        parts = [own[name]] if name in own else []
        if model.throw_inertia or not parts:
            parts.append(given("disc_inertia", model.throw_inertia, f"{_PATH}.throw_inertia"))
        return total("disc_inertia", parts)
    disc, path = model.discs[name], f"{_PATH}.discs.{name}"
    if disc.inertia is not None:
        return given("disc_inertia", disc.inertia, f"{path}.inertia")
    mass = given("disc_mass", disc.mass or 0.0, f"{path}.mass")
    radius = given("disc_gyration_radius", disc.radius_of_gyration or 0.0, f"{path}.radius_of_gyration")
    inertia: TracedValue = formulas.inertia_of_disc(mass, radius)
    return inertia


def _ratio(model: TorsionModel, name: str) -> TracedValue:
    gear, path = model.gears[name], f"{_PATH}.gears.{name}"
    if gear.teeth is None:
        return given(f"speed_ratio.{name}", gear.ratio, f"{path}.ratio")
    first, second = (given("teeth", count, f"{path}.teeth[{place}]") for place, count in enumerate(gear.teeth, start=1))
    return (first / second).named(f"speed_ratio.{name}")


def _speed_ratios(
    model: TorsionModel, names: tuple[str, ...], ratio: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the speed of every disc that turns at another speed than the first one, over that speed."""
    if not model.gears:
        return {}
    known: dict[str, TracedValue | None] = {names[0]: None}
    links: list[tuple[tuple[str, str], str]] = [(shaft.between, "") for shaft in model.shafts.values()]
    links += [(gear.between, name) for name, gear in model.gears.items()]
    for _ in links:
        for (first, second), gear in links:
            for disc, other in ((first, second), (second, first)):
                if disc not in known or other in known or other not in names:
                    continue
                value = known[disc]
                if gear:
                    factor = ratio[gear] if disc == first else 1.0 / ratio[gear]
                    value = factor if value is None else value * factor
                known[other] = None if value is None else value.named(f"speed_ratio.{other}")
    return {name: value for name, value in known.items() if value is not None}


def _reference(model: TorsionModel, pi: float) -> TracedValue | None:
    """Return the polar moment of the shaft that equivalent lengths are of: stated, or the first section."""
    diameter = model.reference_diameter
    if diameter is not None:
        moment = _solid(pi, given("reference_diameter", diameter, f"{_PATH}.reference_diameter"))
        return moment.named("polar_moment.reference")
    first = next((shaft for shaft in model.shafts.values() if shaft.parts), None)
    return None if first is None else _moment(_part_path(first, 0), first.parts[0], pi).named("polar_moment.reference")


def _part_path(shaft: ElasticShaft, index: int) -> str:
    return shaft.path if len(shaft.parts) == 1 and shaft.diameter is not None else f"{shaft.path}.parts[{index + 1}]"


def _length(path: str, part: ShaftPart) -> TracedValue:
    return given("shaft_length", part.length, f"{path}.length")


def section(path: str, diameter: float, bore: float) -> tuple[TracedValue, TracedValue]:
    """Return outer diameter and bore of a section."""
    inner = given("shaft_bore", bore, f"{path}.bore") if bore else absent("shaft_bore")
    return given("shaft_diameter", diameter, f"{path}.diameter"), inner


def _solid(pi: float, diameter: TracedValue) -> TracedValue:
    moment: TracedValue = formulas.polar_moment(pi, diameter, absent("shaft_bore"))
    return moment


def _moment(path: str, part: ShaftPart, pi: float) -> TracedValue:
    moment: TracedValue = formulas.polar_moment(pi, *section(path, part.diameter, part.bore))
    return moment


def _stiffness(
    model: TorsionModel,
    shaft: ElasticShaft,
    key: str,
    reference: TracedValue | None,
    inputs: tuple[float, TracedValue | None],
) -> tuple[TracedValue, TracedValue | None]:
    """Return the stiffness of a shaft, and its equivalent length where its sizes are known; `inputs`: pi and radius."""
    (pi, radius), path, name = inputs, shaft.path, key.partition(".")[2]
    if shaft.stiffness is not None:
        return given(key, shaft.stiffness, f"{path}.stiffness"), None
    own = shaft.modulus is not None
    modulus = given("shear_modulus", shaft.modulus or model.modulus, f"{path}.modulus" if own else f"{_PATH}.modulus")
    if shaft.throw is not None:
        sizes = {item: _throw_size(shaft, item, radius) for item in _SIZES}
        length = formulas.THROW_FORMULAS[shaft.throw.formula](*sizes.values()).named(f"equivalent_length.{name}")
        moment = _solid(pi, sizes["journal_diameter"]).named(f"polar_moment.{name}")
        return formulas.stiffness_of_length(modulus, moment, length).named(key), length
    if reference is None:
        raise TypeError("a shaft without a stiffness has sections")
    lengths = []
    for index, part in enumerate(shaft.parts):
        place, number = _part_path(shaft, index), f"{name}.{index + 1}"
        moment = _moment(place, part, pi).named(f"polar_moment.{number}")
        lengths.append(
            formulas.equivalent_length(_length(place, part), reference, moment).named(f"equivalent_length.{number}")
        )
    length = total(f"equivalent_length.{name}", lengths)
    return formulas.stiffness_of_length(modulus, reference, length).named(key), length


_SIZES = ("journal_length", "journal_diameter", "journal_bore", "pin_length", "pin_diameter", "pin_bore", "radius",
          "web_thickness", "web_width")  # fmt: skip


def _throw_size(shaft: ElasticShaft, name: str, radius: TracedValue | None) -> TracedValue:
    value, key = getattr(shaft.throw, name), "crank_radius" if name == "radius" else name
    if name == "radius" and value is None and radius is not None:
        return radius
    return given(key, value, f"{shaft.path}.throw.{name}") if value else absent(key)


# range of speeds where none is stated, over that of the machine, and points of it
_RANGE, _POINTS = (0.2, 1.2), 161
_MOST_PERIODS = 12
# an amplitude below this part of the largest is that of a node
NODE = 1e-9


class Excitation(NamedTuple):
    """What excites: waves, the traced numbers that they are made of, the angle after which they repeat. [rad]"""

    waves: tuple[Wave, ...]
    numbers: tuple[TracedValue, ...]
    cycle: float
    # Discs with the order of a torque and by which it is ahead, or without an order by which all are late [rad]
    phases: tuple[tuple[int, float | None, float], ...]


class Vibrating(NamedTuple):
    """A torsional system with its numbers, undamped modes and excitation."""

    trace: TorsionTrace
    modes: Modes
    forced: ForcedVibration
    operands: tuple[TracedValue, ...]
    excitation: Excitation
    speed: float

    @property
    def numbers(self) -> Array:
        """The numbers of the operands."""
        return np.array([operand.value for operand in self.operands])

    @property
    def is_damped(self) -> bool:
        """Whether anything damps."""
        system = self.forced.system(self.numbers)
        return bool(np.any(system.disc_damping) or np.any(system.shaft_damping) or np.any(system.loss_factor))

    @property
    def range(self) -> tuple[float, float]:
        """Least and greatest speed that is looked at. [rad/s]"""
        stated = self.trace.model.speeds
        return stated or (_RANGE[0] * self.speed, _RANGE[1] * self.speed)


def vibrating(results: Results, engine: MultiCylinderEngine | None, trace: TorsionTrace, modes: Modes) -> Vibrating:
    """Return a torsional system with what excites and damps it; `engine`: whose cylinders excite."""
    model, count = trace.model, len(trace.structure.shafts)
    natural = NaturalModes(trace.structure, model.modes)
    none = absent("angular_damping")
    held = [_damping(f"{_PATH}.discs.{name}", model.discs[name].damping) if name in model.discs else none
            for name in trace.names]  # fmt: skip
    dampers = sorted(model.dampers.items(), key=lambda item: item[1].stiffness <= 0)
    relative = [_damping(item.path, item.damping) for item in model.shafts.values()]
    relative += [_damping(f"{_PATH}.dampers.{name}", item.damping) for name, item in dampers]
    loss = [given("loss_factor", item.loss_factor, f"{item.path}.loss_factor") for item in model.shafts.values()]
    stiffness = [*trace.stiffness.values(), *[absent("torsional_stiffness")] * trace.structure.rings]
    speed = results.trace.get("speed", given("speed", results.machine.speed, "crank.speed"))
    excitation = _excitation(engine, trace)
    operands = (
        *trace.inertia.values(), *stiffness, *trace.ratio.values(), *trace.own_inertia.values(), *held, *relative,
        *loss, *[absent("loss_factor")] * (count - len(loss)), speed, *excitation.numbers,
    )  # fmt: skip
    forced = ForcedVibration(natural, excitation.waves, excitation.cycle)
    # discs and shafts alone need no speed
    is_known = engine is not None or "crank.speed" in results.machine.stated
    return Vibrating(trace, modes, forced, operands, excitation, speed.value if is_known else 0.0)


def _damping(path: str, value: float) -> TracedValue:
    return given("angular_damping", value, f"{path}.damping") if value else absent("angular_damping")


def _excitation(engine: MultiCylinderEngine | None, trace: TorsionTrace) -> Excitation:
    """Return the torques that a file states, and those of the cylinders of an engine."""
    number = {name: index for index, name in enumerate(trace.names)}
    waves, numbers, phases = list[Wave](), list[TracedValue](), list[tuple[int, float | None, float]]()
    for index, torque in enumerate(trace.model.torques, start=1):
        path, disc, own = f"{_PATH}.torques[{index}]", number[torque.disc], len(numbers)
        numbers.append(given("excitation_torque", torque.torque, f"{path}.torque"))
        phases.append((disc, torque.order, torque.phase))
        if torque.frequency is not None:
            numbers.append(given("angular_frequency", torque.frequency, f"{path}.frequency"))
            waves.append(Wave(disc, 0.0, own, None, torque.phase, frequency=own + 1))
        else:
            waves.append(Wave(disc, torque.order or 1.0, own, None, torque.phase))
    if engine is not None and "crank_torque" in engine.master.trace:
        cycle, places = math.radians(engine.layout.cycle), dict[int, int]()
        for place, torques in gas_and_inertia_torques(engine, trace.model.orders):
            disc, delay = number[f"throw_{place.throw + 1}"], math.radians(place.firing_angle)
            phases.append((disc, None, delay))
            for order, cosine, sine, is_inertia in torques:
                if id(cosine) not in places:
                    places[id(cosine)] = len(numbers)
                    numbers += [cosine, sine]
                own = places[id(cosine)]
                waves.append(Wave(disc, order, own, own + 1, -order * delay, is_inertia=is_inertia))
        return Excitation(tuple(waves), tuple(numbers), cycle, tuple(phases))
    orders = [wave.order for wave in waves if wave.frequency is None]
    periods = next((count for count in range(1, _MOST_PERIODS) if all((count * order) % 1 == 0 for order in orders)), 2)
    return Excitation(tuple(waves), tuple(numbers), periods * math.tau, tuple(phases))


def forced_values(system: Vibrating, pi: float) -> dict[str, TracedValue]:
    """Return the largest angles of discs, torques and stresses of shafts at the speed of the machine."""
    if not system.excitation.waves:
        return {}
    trace, forced = system.trace, system.forced
    largest, values = forced(np.empty(0), system.numbers[:, None, None]), dict[str, TracedValue]()
    keys = [f"vibration_amplitude.{name}" for name in trace.names]
    keys += [f"vibration_torque.{name}" for name in (*trace.stiffness, *_rings(trace.model))]
    for part, (key, value) in enumerate(zip(keys, largest, strict=True)):
        values[key] = TracedValue(FunctionValue(value, "forced", system.operands, forced, part), key)
    for name, shaft in trace.model.shafts.items():
        sizes = _section(shaft)
        if sizes is not None:
            key = f"vibration_stress.{name}"
            values[key] = formulas.stress_of_torque(values[f"vibration_torque.{name}"], pi, *sizes).named(key)
    return values


def _rings(model: TorsionModel) -> list[str]:
    return [name for name, damper in model.dampers.items() if damper.stiffness <= 0]


def _section(shaft: ElasticShaft) -> tuple[TracedValue, TracedValue] | None:
    """Return outer diameter and bore where a shaft is weakest."""
    sections = [(part.diameter, part.bore, _part_path(shaft, index)) for index, part in enumerate(shaft.parts)]
    if shaft.diameter is not None and not sections:
        sections = [(shaft.diameter, shaft.bore, shaft.path)]
    if shaft.throw is not None:
        throw = {
            name: (getattr(shaft.throw, f"{name}_diameter"), getattr(shaft.throw, f"{name}_bore"))
            for name in ("journal", "pin")
        }
        name = min(throw, key=lambda name: _modulus(*throw[name]))
        size, bore = throw[name]
        path = f"{shaft.path}.throw.{name}"
        inner = given(f"{name}_bore", bore, f"{path}_bore") if bore else absent("shaft_bore")
        return given(f"{name}_diameter", size, f"{path}_diameter"), inner
    if not sections:
        return None
    diameter, bore, path = min(sections, key=lambda item: _modulus(*item[:2]))
    return section(path, diameter, bore)


def _modulus(diameter: float, bore: float) -> float:
    """Return what the section modulus of torsion is proportional to. [m3]"""
    return (diameter**4 - bore**4) / diameter


def damper_values(system: Vibrating, pi: float, radius: TracedValue | None) -> dict[str, TracedValue]:
    """Return what is best for each damper: inertia ratio, damping, spring, and the peak that is left."""
    values, model = dict[str, TracedValue](), system.trace.model
    bare = torsion_trace(replace(model, dampers={}), dict(system.trace.inertia), pi, radius)
    operands = bare.elastic
    for name, damper in model.dampers.items():
        function = DampedDisc(NaturalModes(bare.structure, max(model.modes, damper.mode)), bare.names.index(damper.on),
                              damper.mode)  # fmt: skip
        w, inertia = function.of([operand.value for operand in operands])
        if not math.isfinite(w):
            continue
        w_j, J = (
            TracedValue(FunctionValue(value, "eigenvalue", operands, function, part), f"{key}.{name}")
            for part, (key, value) in enumerate((("angular_frequency", w), ("effective_inertia", inertia)))
        )
        ring = system.trace.inertia[name]
        mu = formulas.damper_inertia_ratio(ring, J).named(f"damper_inertia_ratio.{name}")
        best = {"effective_inertia": J, "damper_inertia_ratio": mu}
        if damper.stiffness:
            best["optimum_tuning"] = formulas.tuned_frequency_ratio(mu)
            best["optimum_stiffness"] = formulas.stiffness_of_ring(ring, best["optimum_tuning"], w_j)
            best["optimum_damping_ratio"], peak = formulas.tuned_damping(mu), formulas.tuned_magnification(mu)
        else:
            best["optimum_damping_ratio"], peak = formulas.untuned_damping(mu), formulas.untuned_magnification(mu)
        best["optimum_damping"] = formulas.damping_of_ring(best["optimum_damping_ratio"], ring, w_j)
        best["least_magnification"] = peak
        values |= {f"{key}.{name}": value.named(f"{key}.{name}") for key, value in best.items()}
    return values


def damped_values(system: Vibrating) -> dict[str, Array]:
    """Return damped frequencies and damping ratios as columns, where viscous damping is stated."""
    damped, inertia = system.forced.system(system.numbers), system.trace.inertia.values()
    if not (np.any(damped.disc_damping) or np.any(damped.shaft_damping)) or not all(item.value for item in inertia):
        return {}
    roots = damped_modes(damped)
    size = np.abs(roots)
    return {"mode_number": np.arange(1.0, roots.size + 1), "damped_frequency": roots.imag, "natural_frequency": size,
            "damping_ratio": -roots.real / size}  # fmt: skip


def vibration_listings(system: Vibrating, pi: float) -> dict[str, Listing]:
    """Return critical speeds by order, and vibration over the range of speeds."""
    listings = dict[str, Listing]()
    critical = _critical_speeds(system)
    if critical["critical_speed"].size:
        listings["critical_speeds"] = Listing(critical)
    if any(wave.frequency is None for wave in system.excitation.waves):
        listings["torsional_response"] = Listing(_response(system, critical["critical_speed"], pi))
    return listings


def at_rest(names: Sequence[str], shape: Array) -> list[str]:
    """Return the discs in which a mode has a node."""
    return [name for name, own in zip(names, shape.tolist(), strict=False) if abs(own) < NODE * np.max(np.abs(shape))]


def _orders(system: Vibrating) -> Array:
    """Return the orders that excite, all whole ones up to the highest where nothing does."""
    own = sorted({wave.order for wave in system.excitation.waves if wave.frequency is None})
    return np.array(own) if own else np.arange(1.0, math.floor(system.trace.model.orders) + 1)


def _critical_speeds(system: Vibrating) -> dict[str, Array]:
    """Return modes, orders and critical speeds in the range, with sums of phase vectors and amplitudes at resonance."""
    low, high = system.range
    rows = [
        (mode, w, order)
        for mode, w in enumerate(system.modes.frequency.tolist())
        for order in _orders(system).tolist()
        if low <= formulas.speed_of_order(w, order) <= high
    ]
    columns = {
        "mode_number": np.array([mode + 1.0 for mode, _, _ in rows]),
        "harmonic_order": np.array([order for _, _, order in rows]),
        "critical_speed": np.array([formulas.speed_of_order(w, order) for _, w, order in rows]),
    }
    if not rows or not any(wave.frequency is None for wave in system.excitation.waves):
        return columns
    sums, works, amplitudes = [], [], []
    orders, torque = system.forced.amplitudes(system.numbers, columns["critical_speed"])
    damped = system.forced.system(system.numbers) if system.is_damped else None
    for row, (mode, w, order) in enumerate(rows):
        shape, own = system.modes.shape[mode], torque[row, np.searchsorted(orders, order)]
        vectors = (
            shape[disc] * np.exp(1j * (-order * angle if own_order is None else angle))
            for disc, own_order, angle in system.excitation.phases
            if own_order in (None, order)
        )
        sums.append(abs(sum(vectors)))
        works.append(abs(shape @ own[: shape.size]))
        if damped is not None:
            amplitudes.append(abs(damped.forced([w], own[None])[0][0, 0]))
    columns |= {"mode_phase_sum": np.array(sums), "excitation_torque": np.array(works)}
    return columns | ({"resonance_amplitude": np.array(amplitudes)} if amplitudes else {})


def _response(system: Vibrating, critical: Array, pi: float) -> dict[str, Array]:
    """Return largest angles, torques and stresses over the range of speeds."""
    speeds = np.linspace(*system.range, _POINTS)
    if system.is_damped:
        # peaks are narrow
        speeds = np.unique(np.concatenate([speeds, critical]))
    vibration = system.forced.vibration(system.numbers, speeds)
    columns: dict[str, Array] = {"rotational_speed": speeds}
    for name, values in zip(system.trace.names, vibration.largest_angle.T, strict=True):
        columns[f"vibration_amplitude.{name}"] = values
    shafts = system.trace.model.shafts
    for name, values in zip(shafts, vibration.largest_torque.T, strict=False):
        columns[f"vibration_torque.{name}"] = values
    for name, shaft in shafts.items():
        sizes = _section(shaft)
        if sizes is not None:
            diameter, bore = (size.value for size in sizes)
            stress = formulas.stress_of_torque(columns[f"vibration_torque.{name}"], pi, diameter, bore)
            columns[f"vibration_stress.{name}"] = np.asarray(stress)
    return columns


def vibration_notices(system: Vibrating, radius: float | None) -> Iterator[Notice]:
    """Yield nodes in discs, rings that nothing holds, that nothing damps, and throws whose pins overlap."""
    for mode, shape in enumerate(system.modes.shape, start=1):
        for name in at_rest(system.trace.names, shape):
            yield Notice("torsion_node", {"mode": mode, "name": name})
    for name, damper in system.trace.model.dampers.items():
        if not damper.damping and not damper.stiffness:
            yield Notice("torsion_free_ring", {"name": name})
    if system.excitation.waves and not system.is_damped:
        yield Notice("torsion_undamped", {})
    paths = {item.path: item.throw for item in system.trace.model.shafts.values() if item.throw is not None}
    for path, throw in paths.items():
        if (throw.radius or radius or math.inf) < (throw.pin_diameter + throw.journal_diameter) / 2:
            yield Notice("torsion_overlap", {"path": path})


def shaft_alone(machine: Machine, grid: CrankGrid | None = None) -> Results:
    """Return the results of discs on shafts without a mechanism, still without their vibration."""
    solved = PreparedMachine(machine, machine.method, machine.speed)
    grid = grid or CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    return Results(solved, grid, {}, {}, {}, (), {})


def with_torsion(results: Results) -> Results:
    """Return results with the torsional vibration of the shaft of their machine."""
    model = results.machine.torsion
    if model is None:
        return results
    engine, pi = engine_of(results), results.method.pi
    own, radius = throw_inertias(engine)
    trace = torsion_trace(model, own, pi, radius)
    natural = NaturalModes(trace.structure.without_rings(), model.modes)
    modes = natural.modes([number.value for number in trace.elastic])
    values = dict(trace.values) | dict(_traced_modes(trace, natural, modes))
    nodes = dict(_nodes(trace, values, modes))
    values |= {key: value for pair in nodes.values() for key, value in pair.items()}
    values |= dict(_remainders(trace, natural))
    system = vibrating(results, engine, trace, modes)
    values |= damper_values(system, pi, radius) | forced_values(system, pi)
    single = {key: value for key, value in values.items() if _is_single(key, value)}
    listings = {**results.listings, **_listings(trace, modes), **_node_listing(nodes), **_holzer(trace, natural, modes)}
    if damped := damped_values(system):
        listings["damped_modes"] = Listing(damped)
    notices = vibration_notices(system, None if radius is None else radius.value)
    return replace(
        results,
        summary={**results.summary, **{key: value.value for key, value in single.items()}},
        checks={**results.checks, **_checks(trace, natural, modes)},
        notices=(*results.notices, *notices),
        listings=Deferred(listings, lambda: vibration_listings(system, pi)),
        trace={**results.trace, **values},
    )


_SINGLE = (
    "natural_frequency", "node_distance", "equivalent_node_distance", "vibration_amplitude", "vibration_torque",
    "vibration_stress", "holzer_remainder", "effective_inertia", "damper_inertia_ratio", "optimum_tuning",
    "optimum_damping_ratio", "optimum_damping", "optimum_stiffness", "least_magnification",
)  # fmt: skip
_CALCULATED = ("torsional_stiffness", "equivalent_length", "equivalent_inertia")


def _is_single(key: str, value: TracedValue) -> bool:
    """Return whether a value stands in the summary: a result, or what follows from sizes that are stated."""
    kind = key.partition(".")[0]
    return kind in _SINGLE or (kind in _CALCULATED and bool(value.node.operands))


def _traced_modes(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> Iterator[tuple[str, TracedValue]]:
    """Yield natural frequencies, then the amplitudes of discs in each mode."""
    count = modes.frequency.size
    for index, frequency in enumerate(modes.frequency.tolist()):
        key = f"natural_frequency.{index + 1}"
        yield key, TracedValue(FunctionValue(frequency, "eigenvalue", trace.elastic, natural, index), key)
    for index, shape in enumerate(modes.shape):
        for disc, amplitude in enumerate(shape.tolist()):
            key, part = f"relative_amplitude.{index + 1}.{trace.names[disc]}", count + index * shape.size + disc
            yield key, TracedValue(FunctionValue(amplitude, "eigenvector", trace.elastic, natural, part), key)


def _nodes(
    trace: TorsionTrace, values: Mapping[str, TracedValue], modes: Modes
) -> Iterator[tuple[tuple[int, str], dict[str, TracedValue]]]:
    """Yield mode and shaft of each node, with its distances from the first end of the shaft where lengths are known."""
    number = {name: index for index, name in enumerate(trace.names)}
    for mode, shape in enumerate(modes.shape, start=1):
        for name, shaft in trace.model.shafts.items():
            if GROUNDED in shaft.between or shaft.density is not None:
                continue
            first, second = (shape[number[end]] for end in shaft.between)
            if min(abs(first), abs(second)) < NODE * np.max(np.abs(shape)) or first * second >= 0:
                continue
            a, b = (values[f"relative_amplitude.{mode}.{end}"] for end in shaft.between)
            length = values.get(f"equivalent_length.{name}.own", trace.lengths.get(name))
            distances = dict[str, TracedValue]()
            if length is not None:
                key = f"equivalent_node_distance.{mode}.{name}"
                distances[key] = (length * a / (a - b)).named(key)
            if shaft.parts:
                key, place = f"node_distance.{mode}.{name}", first / (first - second) * _compliance(shaft.parts)
                distance = _along(shaft.parts, place)
                distances[key] = TracedValue(ProcedureValue(distance, "node", (a, b)), key)
                if len(shaft.parts) == 1:
                    own = _length(_part_path(shaft, 0), shaft.parts[0])
                    distances[key] = (own * a / (a - b)).named(key)
            yield (mode, name), distances
        for name in at_rest(trace.names, shape):
            yield (mode, name), {}


def _compliance(parts: tuple[ShaftPart, ...]) -> float:
    """Return what the twist of the parts of a shaft is proportional to. [1/m3]"""
    return math.fsum(part.length / (part.diameter**4 - part.bore**4) for part in parts)


def _along(parts: tuple[ShaftPart, ...], place: float) -> float:
    """Return how far along a shaft a part of its twist is reached. [1/m3] -> [m]"""
    distance = 0.0
    for part in parts:
        own = _compliance((part,))
        if place <= own:
            return distance + part.length * place / own
        place, distance = place - own, distance + part.length
    return distance


def _listings(trace: TorsionTrace, modes: Modes) -> dict[str, Listing]:
    """Return the tables of discs, of shafts and of modes."""
    discs = {"disc_inertia": np.array([trace.inertia[name].value for name in trace.names])}
    if trace.geared:
        ratios = [trace.geared[name].value if name in trace.geared else 1.0 for name in trace.names]
        discs["speed_ratio"] = np.array(ratios)
        discs["equivalent_inertia"] = discs["disc_inertia"] * discs["speed_ratio"] ** 2
    held = [trace.model.discs[name].damping if name in trace.model.discs else 0.0 for name in trace.names]
    if any(held):
        discs["angular_damping"] = np.array(held)
    shafts = {"torsional_stiffness": np.array([item.value for item in trace.stiffness.values()])}
    if trace.lengths:
        lengths = [trace.lengths[name].value if name in trace.lengths else math.nan for name in trace.stiffness]
        shafts["equivalent_length"] = np.array(lengths)
    for key, name in (("angular_damping", "damping"), ("loss_factor", "loss_factor")):
        damped = np.array([getattr(shaft, name) for shaft in trace.model.shafts.values()])
        if np.any(damped):
            shafts[key] = damped
    frequency = modes.frequency
    rows = {"mode_number": np.arange(1.0, frequency.size + 1), "natural_frequency": frequency,
            "angular_frequency": frequency}  # fmt: skip
    for index in range(modes.shape.shape[1]):
        rows[f"relative_amplitude.{trace.names[index]}"] = modes.shape[:, index]
    tables = {
        "torsional_discs": Listing(discs, trace.names),
        "torsional_shafts": Listing(shafts, tuple(trace.stiffness)),
    }
    return tables | ({"natural_modes": Listing(rows)} if frequency.size else {})


def _node_listing(nodes: Mapping[tuple[int, str], Mapping[str, TracedValue]]) -> dict[str, Listing]:
    """Return the table of nodes: mode, shaft and distances."""
    if not nodes:
        return {}
    columns = {"mode_number": np.array([float(mode) for mode, _ in nodes])}
    for kind in ("node_distance", "equivalent_node_distance"):
        cells = [
            known[f"{kind}.{mode}.{name}"].value if f"{kind}.{mode}.{name}" in known else math.nan
            for (mode, name), known in nodes.items()
        ]
        if not np.all(np.isnan(cells)):
            columns[kind] = np.array(cells)
    return {"torsional_nodes": Listing(columns, tuple(name for _, name in nodes))}


def _remainders(trace: TorsionTrace, natural: NaturalModes) -> Iterator[tuple[str, TracedValue]]:
    """Yield what tables by Holzer leave at trial frequencies."""
    if natural.structure.is_tree and not natural.heavy:
        system = natural.system([number.value for number in trace.elastic])
        for index, w in enumerate(trace.model.trials, start=1):
            key, left = f"holzer_remainder.{index}", system.holzer(w, system.trial(w)).remainder
            w_trial = given("angular_frequency", w, f"torsion.trials[{index}]")
            yield key, TracedValue(ProcedureValue(left, "holzer", (*trace.elastic, w_trial)), key)


def _holzer(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> dict[str, Listing]:
    """Return the tables by Holzer, at natural frequencies and at trial frequencies, one below the other."""
    structure = natural.structure
    if not structure.is_tree or natural.heavy:
        return {}
    system = natural.system([number.value for number in trace.elastic])
    tables = {
        "holzer": [
            (w, system.holzer(w, shape)) for w, shape in zip(modes.frequency.tolist(), modes.shape, strict=True)
        ],
        "holzer_trials": [(w, system.holzer(w, system.trial(w))) for w in trace.model.trials],
    }
    return {name: _holzer_listing(trace, rows) for name, rows in tables.items() if rows}


def _holzer_listing(trace: TorsionTrace, tables: list[tuple[float, HolzerTable]]) -> Listing:
    stiffness = [item.value for item in trace.stiffness.values()]
    columns: dict[str, list[float]] = {
        key: [] for key in ("angular_frequency", "disc_inertia", "relative_amplitude", "disc_torque", "holzer_sum",
                            "torsional_stiffness", "shaft_twist")
    }  # fmt: skip
    names = []
    for w, table in tables:
        for row in table.rows:
            names.append(trace.names[row.disc])
            k = math.nan if row.shaft is None else stiffness[row.shaft]
            cells = (w, trace.inertia[names[-1]].value, row.amplitude, row.torque, row.sum, k, row.sum / k)
            for cell, column in zip(cells, columns.values(), strict=True):
                column.append(cell)
    return Listing({key: np.array(column) for key, column in columns.items()}, tuple(names))


def _checks(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> dict[str, float]:
    """Return what is left of the table by Holzer at natural frequencies, relative to the largest torque in it."""
    structure = natural.structure
    if not structure.is_tree or natural.heavy or not modes.frequency.size:
        return {}
    system = natural.system([number.value for number in trace.elastic])
    left = []
    for w, shape in zip(modes.frequency.tolist(), modes.shape, strict=True):
        table = system.holzer(w, shape)
        largest = max((abs(value) for row in table.rows for value in (row.torque, row.sum)), default=1.0)
        left.append(abs(table.remainder) / (largest or 1.0))
    return {"holzer": max(left)}

"""Forced torsional vibration of a machine: torques by order, critical speeds, amplitudes and stresses, dampers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from crankwork.analysis.prepared import Notice
from crankwork.analysis.results import Listing, Results
from crankwork.analysis.torsion_machine import engine_of, gas_and_inertia_torques
from crankwork.analysis.torsion_trace import TorsionTrace, section, torsion_trace
from crankwork.formula.traced_value import FunctionValue, TracedValue, absent, given
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.torsion_formulas import (
    damper_inertia_ratio,
    damping_of_ring,
    speed_of_order,
    stiffness_of_ring,
    stress_of_torque,
    tuned_damping,
    tuned_frequency_ratio,
    tuned_magnification,
    untuned_damping,
    untuned_magnification,
)
from crankwork.shaft.torsion_model import ElasticShaft, TorsionModel
from crankwork.shaft.torsion_replay import DampedDisc, ForcedVibration, NaturalModes, Wave, damped_modes
from crankwork.shaft.torsional_system import Modes

# range of speeds where none is stated, over that of the machine, and points of it
_RANGE, _POINTS = (0.2, 1.2), 161
_MOST_PERIODS = 12
_PATH = "torsion"
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


def vibrating(results: Results, trace: TorsionTrace, modes: Modes) -> Vibrating:
    """Return a torsional system with what excites and damps it."""
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
    excitation = _excitation(results, trace)
    operands = (
        *trace.inertia.values(), *stiffness, *trace.ratio.values(), *trace.own_inertia.values(), *held, *relative,
        *loss, *[absent("loss_factor")] * (count - len(loss)), speed, *excitation.numbers,
    )  # fmt: skip
    forced = ForcedVibration(natural, excitation.waves, excitation.cycle)
    # discs and shafts alone need no speed
    is_known = engine_of(results) is not None or "crank.speed" in results.machine.stated
    return Vibrating(trace, modes, forced, operands, excitation, speed.value if is_known else 0.0)


def _damping(path: str, value: float) -> TracedValue:
    return given("angular_damping", value, f"{path}.damping") if value else absent("angular_damping")


def _excitation(results: Results, trace: TorsionTrace) -> Excitation:
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
    engine = engine_of(results)
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
            values[key] = stress_of_torque(values[f"vibration_torque.{name}"], pi, *sizes).named(key)
    return values


def _rings(model: TorsionModel) -> list[str]:
    return [name for name, damper in model.dampers.items() if damper.stiffness <= 0]


def _section(shaft: ElasticShaft) -> tuple[TracedValue, TracedValue] | None:
    """Return outer diameter and bore where a shaft is weakest."""
    sections = [(part.diameter, part.bore, shaft.path if len(shaft.parts) == 1 and shaft.diameter else
                 f"{shaft.path}.parts[{index}]") for index, part in enumerate(shaft.parts, start=1)]  # fmt: skip
    if shaft.diameter is not None and not sections:
        sections = [(shaft.diameter, shaft.bore, shaft.path)]
    if shaft.throw is not None:
        pin, journal = shaft.throw.pin_diameter, shaft.throw.journal_diameter
        name = "pin" if pin < journal else "journal"
        size, bore = (getattr(shaft.throw, f"{name}_{part}") for part in ("diameter", "bore"))
        path = f"{shaft.path}.throw.{name}"
        inner = given(f"{name}_bore", bore, f"{path}_bore") if bore else absent("shaft_bore")
        return given(f"{name}_diameter", size, f"{path}_diameter"), inner
    if not sections:
        return None
    diameter, bore, path = min(sections, key=lambda item: (item[0] ** 4 - item[1] ** 4) / item[0])
    return section(path, diameter, bore)


def damper_values(results: Results, system: Vibrating) -> dict[str, TracedValue]:
    """Return what is best for each damper: inertia ratio, damping, spring, and the peak that is left."""
    values, model = dict[str, TracedValue](), system.trace.model
    bare = torsion_trace(replace(model, dampers={}), dict(system.trace.inertia), results.method.pi,
                         results.trace.get("crank_radius"))  # fmt: skip
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
        mu = damper_inertia_ratio(ring, J).named(f"damper_inertia_ratio.{name}")
        best = {"effective_inertia": J, "damper_inertia_ratio": mu}
        if damper.stiffness:
            best["optimum_tuning"] = tuned_frequency_ratio(mu)
            best["optimum_stiffness"] = stiffness_of_ring(ring, best["optimum_tuning"], w_j)
            best["optimum_damping_ratio"], peak = tuned_damping(mu), tuned_magnification(mu)
        else:
            best["optimum_damping_ratio"], peak = untuned_damping(mu), untuned_magnification(mu)
        best["optimum_damping"] = damping_of_ring(best["optimum_damping_ratio"], ring, w_j)
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
        if low <= speed_of_order(w, order) <= high
    ]
    columns = {
        "mode_number": np.array([mode + 1.0 for mode, _, _ in rows]),
        "harmonic_order": np.array([order for _, _, order in rows]),
        "critical_speed": np.array([speed_of_order(w, order) for _, w, order in rows]),
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
            stress = stress_of_torque(columns[f"vibration_torque.{name}"], pi, diameter, bore)
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
    throws: Sequence[ElasticShaft] = [item for item in system.trace.model.shafts.values() if item.throw is not None]
    for shaft in throws[:1]:
        throw = shaft.throw
        if (
            throw is not None
            and (throw.radius or radius or math.inf) < (throw.pin_diameter + throw.journal_diameter) / 2
        ):
            yield Notice("torsion_overlap", {"path": shaft.path})

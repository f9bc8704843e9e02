"""Flow of several chambers into a vessel or out of it: its mean, its pulsation, and what the vessel saves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import Piecewise, ProcedureValue, TracedValue, absent, given, reached, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.chamber import face_names
from crankwork.loads.gas import piston_area
from crankwork.loads.valves import pressure_head
from crankwork.machine import Machine
from crankwork.preparation.linkage import speed_of
from crankwork.preparation.prepared import PreparedLinkage
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import excess_work

_TEXT = "subramanya_2005, ch. 16"
COLUMNS = ("pressure_head", "chamber_flow", "vessel_flow", "vessel_inflow", "pipe_power")


@formula("chamber_flow", _TEXT)
def chamber_flow(sigma: Value, A: Value, v_s: Value) -> Value:
    """Volume that a face adds to its chamber per unit of time."""
    return sigma * A * v_s


@formula("pipe_power", _TEXT)
def pipe_power(f_pipe: Value, l_pipe: Value, d_pipe: Value, rho_liq: Value, Q_ves: Value, A_pipe: Value) -> Value:
    """Power that the friction in a pipe takes, by Darcy and Weisbach."""
    return f_pipe * l_pipe / d_pipe * (rho_liq / 2) * (Q_ves / A_pipe) ** 2 * Q_ves


@formula("vessel_saving", _TEXT)
def vessel_saving(P_even: Value, P_pipe: Value) -> Value:
    """Share of the power of friction that a vessel saves, which evens the flow."""
    return 1 - P_even / P_pipe


def flow_columns(solved: PreparedLinkage, trace: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return heads in chambers, flows of chambers, at vessels and into them, and the power of friction without them."""
    machine, columns = solved.machine, dict[str, TracedValue]()
    for name in dict.fromkeys(name for vessel in machine.vessels.values() for name in vessel.chambers):
        columns[f"chamber_flow.{name}"] = total("", list(_of_faces(solved, name, trace)))
    for name, chamber in machine.chambers.items():
        if chamber.valves is not None and "gravity" in chamber.valves.linked:
            density = given("liquid_density", chamber.valves.density or 0.0, f"chambers.{name}.valves.density")
            pressure = trace[f"diagram_pressure.{name}"]
            columns[f"pressure_head.{name}"] = pressure_head(pressure, density, chamber.valves.linked["gravity"])
    for name, vessel in machine.vessels.items():
        flows = {f"chamber_flow.{item}": columns[f"chamber_flow.{item}"] for item in vessel.chambers}
        over = CycleInterpolant(flows, CrankGrid.from_degrees, machine.cycle)
        flow = total("", [_one_way(over, key, vessel.side == "suction") for key in flows]).named(f"vessel_flow.{name}")
        columns[flow.key] = flow
        mean = CycleInterpolant({flow.key: flow}, CrankGrid.from_degrees, machine.cycle).mean(
            flow.key, f"mean_flow.{name}"
        )
        columns[f"vessel_inflow.{name}"] = mean - flow if vessel.side == "suction" else flow - mean
        if vessel.pipe is not None:
            columns[f"pipe_power.{name}"] = _friction(machine, name, flow)
    return {key: value.named(key) for key, value in columns.items()}


def _one_way(over: CycleInterpolant, key: str, is_suction: bool) -> TracedValue:  # noqa: FBT001 - which of two strokes
    """Return the flow of a chamber on one of its strokes, positive, zero on the other one."""
    column, (ends, negative) = over.columns[key].named(key), over.sign_intervals(key)
    nothing = absent("")
    laws = (column, nothing) if is_suction else (nothing, -column)
    places: list[float | TracedValue] = [*(reached(column, end) for end in ends[:-1]), ends[-1]]
    return TracedValue(Piecewise(places, tuple(laws[is_less] for is_less in negative)))


def _of_faces(solved: PreparedLinkage, name: str, trace: Mapping[str, TracedValue]) -> Iterator[TracedValue]:
    chamber = solved.machine.chambers[name]
    for number, (face, owner) in enumerate(zip(chamber.faces, face_names(name, chamber), strict=True), start=1):
        path = f"chambers.{name}.faces[{number}].sense"
        sense = absent("face_sense", 1.0) if face.sense == 1 else given(f"face_sense.{owner}", -1.0, path)
        area = solved.filling.singles[f"piston_area.{owner}"]
        yield chamber_flow(sense, area, trace[f"slider_velocity.{face.slider}"])


def _friction(machine: Machine, name: str, flow: TracedValue) -> TracedValue:
    """Return the power of friction in the pipe of a vessel at a flow."""
    vessel, path = machine.vessels[name], f"vessels.{name}"
    first = vessel.chambers[0]
    valves = machine.chambers[first].valves
    if vessel.pipe is None or valves is None:
        raise TypeError(f"there is no pipe at {name}")
    diameter = given(f"pipe_diameter.{name}", vessel.pipe.diameter, f"{path}.diameter")
    area = piston_area(machine.method.pi, diameter).named(f"pipe_area.{name}")
    return pipe_power(  # type: ignore[no-any-return]
        given(f"pipe_friction.{name}", vessel.pipe.friction, f"{path}.friction"),
        given(f"pipe_length.{name}", vessel.pipe.length, f"{path}.length"),
        diameter,
        given("liquid_density", valves.density or 0.0, f"chambers.{first}.valves.density"),
        flow,
        area,
    )


def flow_values(machine: Machine, over: CycleInterpolant) -> dict[str, TracedValue]:
    """Return mean and pulsation of the flow at every vessel, the volume it evens out, and what it saves."""
    values = dict[str, TracedValue]()
    for name, vessel in machine.vessels.items():
        key = f"vessel_flow.{name}"
        if key not in over.columns:
            continue
        extremes, mean = over.extremes(key), over.mean(key, f"mean_flow.{name}")
        high, low = extremes[f"vessel_flow_max.{name}"], extremes[f"vessel_flow_min.{name}"]
        excess = excess_work(Curve.legendre(np.radians(over.edges), over.polynomials(key)))
        beyond = TracedValue(ProcedureValue(excess.work, "integral", (over.columns[key],)), f"vessel_flow.Δ_{name}")
        values |= {
            f"mean_flow.{name}": mean,
            f"flow_pulsation.{name}": (high - low) / mean,
            f"flow_ratio.{name}": high / mean,
            f"vessel_volume_change.{name}": beyond / speed_of(machine),
        }
        if vessel.pipe is not None:
            uneven = over.mean(f"pipe_power.{name}", f"mean_pipe_power.{name}")
            even = _friction(machine, name, mean).named(f"even_pipe_power.{name}")
            values |= {uneven.key: uneven, even.key: even, f"vessel_saving.{name}": vessel_saving(even, uneven)}
    return {key: value.named(key) for key, value in values.items()}

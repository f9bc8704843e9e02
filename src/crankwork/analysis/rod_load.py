"""Loads of piston rods and crosshead pins, in tension and compression, and how long the load of a pin is reversed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis.bearings import reversal_values
from crankwork.dynamics.link_loads import OperatingState, link_inertia_force
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue, absent, given, total
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank
from crankwork.preparation.prepared import Notice, PreparedLinkage

_API = "api_618, 6.6"
COLUMNS = ("rod_load", "piston_rod_load", "crosshead_load")
# below this duration [rad], or this share of the larger peak, a pin may not be lubricated on both sides (api_618)
_LEAST_DURATION, _LEAST_RATIO = math.radians(15.0), 0.03


@formula("piston_rod_load", _API)
def piston_rod_load(F_rod: Value, m_i: Value, m_cross: Value, a_sl: Value) -> Value:
    """Force that the piston passes on to its rod at the crosshead: of the gas, less what piston and rod take."""
    return F_rod - (m_i - m_cross) * a_sl


@formula("crosshead_load", _API)
def crosshead_load(F_rod: Value, F_in: Value) -> Value:
    """Force of all that slides along its guide on the crosshead pin."""
    return F_rod + F_in


@formula("mean_rod_load", "bloch_hoefner_1996, ch. 3")
def mean_rod_load(F_t: Value, F_c: Value) -> Value:
    """Mean of the largest loads in tension and compression."""
    return (F_t + F_c) / 2


def rod_load_columns(
    solved: PreparedLinkage, running: OperatingState, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the loads of every piston rod whose crosshead has a stated mass, positive along its guide."""
    columns = dict[str, TracedValue]()
    masses = {body.link: body.mass for body in running.mechanism.bodies}
    for slider, mass in solved.machine.crossheads.items():
        acting = [pushed.force for pushed in solved.filling.forces if pushed.slider == slider]
        gas = total(f"rod_load.{slider}", acting)
        own, acceleration = masses.get(slider, absent("body_mass")), trace[f"slider_acceleration.{slider}"]
        inertia = link_inertia_force(own, acceleration).named(f"link_inertia_force.{slider}")
        crosshead = given(f"crosshead_mass.{slider}", mass, f"sliders.{slider}.crosshead_mass")
        rod = piston_rod_load(gas, own, crosshead, acceleration)
        columns |= {
            gas.key: gas,
            f"piston_rod_load.{slider}": rod,
            f"crosshead_load.{slider}": crosshead_load(gas, inertia),
        }
    return {key: value.named(key) for key, value in columns.items()}


def rod_load_values(machine: Machine, over: CycleInterpolant) -> dict[str, TracedValue]:
    """Return the largest loads in tension and compression by column, their mean, and the reversal at the pin."""
    values = dict[str, TracedValue]()
    for slider in machine.crossheads:
        keys = [f"{kind}.{slider}" for kind in COLUMNS]
        if not {*keys} <= over.columns.keys():
            continue
        extremes = over.extremes(*keys)
        for kind in COLUMNS:
            ends = (-extremes[f"{kind}_min.{slider}"], extremes[f"{kind}_max.{slider}"])
            # a force towards the shaft presses
            words = (
                ("tension", "compression") if _towards_shaft(machine, over, slider) > 0 else ("compression", "tension")
            )
            loads = (value.named(f"{kind}_{word}.{slider}") for word, value in zip(words, ends, strict=True))
            values |= {value.key: value for value in loads}
        gas = (values[f"rod_load_{word}.{slider}"] for word in ("tension", "compression"))
        values[f"mean_rod_load.{slider}"] = mean_rod_load(*gas).named(f"mean_rod_load.{slider}")
        values |= reversal_values(keys[-1], over, extremes, slider)
    return values


def _towards_shaft(machine: Machine, over: CycleInterpolant, slider: str) -> float:
    """Return the sign of the direction along the guide in which the pin of a piece sees the pivot of the crank."""
    crank, member = machine.mechanism.driver, next(item for item in machine.drawn.members if item.name == slider)
    guide = machine.drawn.guides[member.guide]
    if not isinstance(crank, Crank) or guide.link:
        return 1.0
    middle = float(np.mean(over.at(f"slider_displacement.{slider}", np.arange(0.0, 360.0, 30.0))))
    along = np.array([math.cos(guide.angle), math.sin(guide.angle)])
    return math.copysign(1.0, float((np.array(crank.pivot) - guide.point) @ along) - middle)


def rod_load_notices(summary: Mapping[str, TracedValue], machine: Machine) -> Iterator[Notice]:
    """Yield notices of pins whose load is reversed for too short a time, or too little, to be lubricated well."""
    for slider in machine.crossheads:
        duration, ratio = (summary[f"reversal_{word}.{slider}"].value for word in ("duration", "ratio"))
        if duration < _LEAST_DURATION or ratio < _LEAST_RATIO:
            yield Notice("rod_reversal", {"name": slider, "duration": math.degrees(duration), "share": 100 * ratio})

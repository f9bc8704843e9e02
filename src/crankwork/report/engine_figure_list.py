"""Which figures there are of a slider-crank and of a whole engine, and what draws each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from crankwork.locale import say
from crankwork.report.engine_figure_bearings import (
    big_end_polar,
    crankpin_load,
    crankpin_polar,
    crankpin_polar_of_one,
    crankpin_wear,
    main_journal_polar,
    main_wear,
    small_end_polar,
)
from crankwork.report.engine_figure_construction import brix, tolle
from crankwork.report.engine_figure_cylinder import (
    crankpin_forces,
    indicator,
    kinematics,
    piston_forces,
    pressure,
    rod_forces,
    torque,
)
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.engine_figure_orders import (
    balance_ellipses,
    balance_orders,
    has_free_forces,
    phase_stars,
    torque_harmonics,
)
from crankwork.report.engine_figure_torque import accumulated_torque, crank_speed, excess_work, total_torque
from crankwork.report.figure_data import kind_of
from crankwork.show.chart import Graph
from crankwork.show.paper import Canvas
from crankwork.show.scene import Drawing

Draw = Callable[[EngineDrawn], tuple[Canvas, Mapping[str, Graph]]]
# what draws it, and the column it needs
_ONE_CYLINDER: dict[str, tuple[Draw, str]] = {
    "kinematics": (kinematics, "piston_displacement"),
    "brix": (brix, "piston_displacement"),
    "tolle": (tolle, "piston_displacement"),
    "pressure": (pressure, "gas_pressure"),
    "indicator": (indicator, "gas_pressure"),
    "piston_forces": (piston_forces, "piston_force"),
    "rod_forces": (rod_forces, "rod_force"),
    "crankpin_forces": (crankpin_forces, "tangential_force"),
    "torque": (torque, "crank_torque"),
    "crankpin_polar": (crankpin_polar_of_one, "tangential_force"),
}
_LOADS: dict[str, Draw] = {
    "crankpin_load": crankpin_load,
    "big_end_polar": big_end_polar,
    "small_end_polar": small_end_polar,
    "main_journal_polar": main_journal_polar,
    "crankpin_wear": crankpin_wear,
    "main_wear": main_wear,
}
_OF_FORCES = ("piston_forces", "rod_forces", "crankpin_forces", "crankpin_polar", *_LOADS)


def engine_pictures(engine: EngineDrawn) -> dict[str, Callable[[], Drawing]]:
    """Return what draws each figure of a machine where it is placed."""
    listed = figure_list(engine)
    numbered = {name.rstrip("0123456789") for name in listed}

    def picture(name: str, draw: Draw) -> Drawing:
        kind = kind_of(name)
        # of several crankpins the first has a number too
        first = next(iter(engine.diagrams.pin_sizes[1]), "1") if f"{name}_" in numbered else ""
        title = f"{name}_{first}" if first else name
        return engine.finished(title, draw(engine)[0], _remark(engine, kind), forces=kind in _OF_FORCES)

    return {name: partial(picture, name, draw) for name, draw in listed.items()}


def figure_list(engine: EngineDrawn) -> dict[str, Draw]:
    """Return what draws each figure of a machine."""
    machine, columns = engine.results.machine, engine.columns
    result = {name: draw for name, (draw, key) in _ONE_CYLINDER.items() if key in columns}
    if machine.engine is None or "crank_torque" not in columns:
        return result
    result |= _polars(engine) | _LOADS
    if engine.diagrams.count > 1:
        result["total_torque"] = total_torque
    if engine.diagrams.has_throws:
        result["accumulated_torque"] = accumulated_torque
    result["excess_work"] = excess_work
    if engine.diagrams.torque.speed is not None:
        result["crank_speed"] = crank_speed
    result["torque_harmonics"] = torque_harmonics
    if engine.diagrams.count > 1:
        result["phase_stars"] = phase_stars
    result["balance_orders"] = balance_orders
    if has_free_forces(engine):
        result["balance_ellipses"] = balance_ellipses
    return result


def _polars(engine: EngineDrawn) -> dict[str, Draw]:
    """Return the polar diagram of every unlike crankpin; the first has no number."""

    def of_pin(pin: str) -> Draw:
        return lambda one: crankpin_polar(one, pin)

    pins = list(engine.diagrams.pin_sizes[1])
    return {"crankpin_polar" if at == 0 else f"crankpin_polar_{pin}": of_pin(pin) for at, pin in enumerate(pins)}


def _remark(engine: EngineDrawn, kind: str) -> str:
    """Return what a figure says at its lower left: the frame that its vectors stand in."""
    frames = {
        "crankpin_polar": "crank_up",
        "big_end_polar": "rod_up",
        "small_end_polar": "rod_up",
        "main_journal_polar": "crank_one",
    }
    if kind == "kinematics" and "piston_velocity_first_order" in engine.columns:
        return say("drawing.orders", engine.language)
    return say(f"drawing.{frames[kind]}", engine.language) if kind in frames else ""

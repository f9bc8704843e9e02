"""Forces, torque, the polar and the unrolled load of the crankpin, and its wear, as graphs of a sheet."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.engine_diagrams import CrankpinLoad, crankpin_of_one
from crankwork.errors import CrankworkError
from crankwork.locale import Language, say
from crankwork.note.sheets.engine_gas import angle_side, value_side
from crankwork.note.sheets.graph import Curve, Graph, Side, graph
from crankwork.note.sheets.placing import Named, lines_of, names_beside
from crankwork.note.sheets.words import Words
from crankwork.report.figure_data import Drawn
from crankwork.report.language import displayed, row_name
from crankwork.report.linkage_look import round_scale
from crankwork.show.scene import Box, Circle, Item, LineKind, Text, arrow, indexed

MARKS = 30.0
_LINES: dict[str, dict[str, LineKind]] = {
    "piston_forces": {
        "gas_force": "dashed", "inertia_force": "dash_dot", "weight_force": "dotted", "piston_force": "thick",
    },
    "rod_forces": {"rod_force": "thick", "side_force": "dashed"},
    "crankpin_forces": {"radial_force": "dashed", "tangential_force": "thick"},
}  # fmt: skip


class OverCycle(NamedTuple):
    """Values over the cycle, arrays of shape (n,), at crank angles. [display unit], [deg]"""

    degrees: Array
    values: Array

    @property
    def mean(self) -> float:
        """Their mean over the angles. [display unit]"""
        return float(np.trapezoid(self.values, self.degrees) / np.ptp(self.degrees))


def over_cycle(drawn: Drawn, extra: Mapping[str, Array | float], key: str, kind: str) -> OverCycle | None:
    """Return values that somebody else has computed, or None if there are none.

    `extra`: with `crank_angle` [rad], or evenly over the cycle without it. [SI].
    """
    if key not in extra:
        return None
    values = np.asarray(extra[key], dtype=float)
    degrees = np.linspace(0.0, float(drawn.results.machine.cycle), values.size)
    if "crank_angle" in extra:
        degrees = np.degrees(np.asarray(extra["crank_angle"], dtype=float))
    if values.shape != degrees.shape or values.size < 2:
        raise CrankworkError(f"{key} and crank_angle differ in length; give one value for each crank angle")
    return OverCycle(degrees, values * displayed(kind, 1.0, per_area=drawn.area))


def crankpin_name(extra: Mapping[str, Array | float], language: Language) -> str:
    """Return which crankpin is shown, nothing where all are alike."""
    return row_name(f"crankpin.{float(extra['crankpin']):g}", language) if "crankpin" in extra else ""


def forces(drawn: Drawn, name: str, box: Box, words: Words) -> Graph:
    """Return `piston_forces`, `rod_forces` or `crankpin_forces` over the cycle."""
    kinds = {key: kind for key, kind in _LINES[name].items() if key in drawn.columns}
    curves = [
        Curve(key, words.symbol(key), words.label(key), drawn.degrees, drawn.values(key), kind)
        for key, kind in kinds.items()
    ]
    side = value_side("piston_force", [one.y for one in curves], words)._replace(
        symbol=_common(curves), mark=say("marks.force", words.language)
    )
    return graph(name, box, (angle_side(drawn, words), side), curves, words)


def _common(curves: list[Curve]) -> str:
    return ", ".join(one.symbol for one in curves)


def torque(drawn: Drawn, extra: Mapping[str, Array | float], box: Box, words: Words) -> Graph:
    """Return the torque of one cylinder, that of all if it is known, and the mean.

    `extra`: with `total_torque` and `total_torque_mean`, as `engine_sheets` says.
    """
    values, total = drawn.values("crank_torque"), over_cycle(drawn, extra, "total_torque", "crank_torque")
    sign, unit = words.symbol("crank_torque"), words.unit("N*m")
    thin: LineKind = "thick" if total is None else "dashed"
    curves = [Curve("crank_torque", sign, words.say("cylinder_torque"), drawn.degrees, values, thin)]
    mean = displayed("mean_torque", drawn.results.summary["mean_torque"])
    if total is not None:
        curves.append(
            Curve("total_torque", f"Σ{sign}", words.label("total_torque"), total.degrees, total.values, "thick")
        )
        mean = float(np.asarray(extra.get("total_torque_mean", total.mean)))
    if abs(mean) < 1e-6 * float(np.max(np.abs(curves[-1].y))):
        mean = 0.0
    shown = f"{words.say('mean')} {words.number(mean, 6)} {unit}"
    mark = indexed(f"{'Σ' if total is not None else ''}M_{say('symbols.sheet_mean', words.language)}")
    ends = np.array([0.0, float(drawn.results.machine.cycle)])
    curves.append(Curve("mean_torque", mark, shown, ends, np.full(2, mean), "dash_dot"))
    side = value_side("crank_torque", [one.y for one in curves], words)
    return graph("torque", box, (angle_side(drawn, words), side), curves, words)


def _of_one(drawn: Drawn) -> CrankpinLoad:
    return crankpin_of_one(drawn.results, drawn.degrees, drawn.columns)


class _Pin(NamedTuple):
    """Forces of the rods on a crankpin at crank angles, the inertia of the rods, the sign of that. [display unit]"""

    degrees: Array
    across: Array
    along: Array
    inertia: float
    sign: str


def _pin(drawn: Drawn, extra: Mapping[str, Array | float], words: Words) -> _Pin:
    """Return the forces on the crankpin of all its rods, where they are known, or of the one rod."""
    across, along = (over_cycle(drawn, extra, f"crankpin_{one}", "piston_force") for one in ("tangential", "radial"))
    sign = indexed(say("symbols.sheet_big_end", words.language))
    if across is None or along is None:
        one, unit = _of_one(drawn), displayed("piston_force", 1.0, per_area=drawn.area)
        return _Pin(drawn.degrees, one.polar.across * unit, one.polar.down * unit, one.inertia * unit, sign)
    rods = round(float(extra.get("crankpin_rods", 1.0)))
    inertia = displayed("rotating_inertia_force", float(extra.get("crankpin_inertia", 0.0)), per_area=drawn.area)
    return _Pin(across.degrees, across.values, along.values, inertia, f"{rods}{sign}" if rods > 1 else sign)


def polar(drawn: Drawn, extra: Mapping[str, Array | float], box: Box, words: Words) -> Graph:
    """Return the load on the crankpin as its end runs: tangential to the right, radial downward, marks every 30 deg.

    `extra`: with `crankpin_tangential` and what belongs to it, as `engine_sheets` says; the force of this one rod
    otherwise.
    """
    degrees, across, along, inertia, sign = _pin(drawn, extra, words)
    reach = np.append(along, [0.0, -inertia])
    unit = words.unit_of("tangential_force")
    sides = _equal(
        Side(
            words.symbol("tangential_force"),
            unit,
            min(0.0, float(across.min())),
            max(0.0, float(across.max())),
            mark=say("marks.force", words.language),
        ),
        Side(
            words.symbol("radial_force"),
            unit,
            float(reach.min()),
            float(reach.max()),
            is_down=True,
            mark=say("marks.force", words.language),
        ),
        box,
    )
    curve = Curve("crankpin_load", "R", "", across, along)
    shown = graph("polar", box, sides, [curve], words, of=crankpin_name(extra, words.language))
    items: list[Item] = []
    if inertia:
        pole, origin = shown.point(0.0, -inertia), shown.point(0.0, 0.0)
        items += [Circle(pole, 1.2, "medium", 1.0), *arrow(pole, origin, "thick", head=4.0)]
        items.append(Text((pole[0] + 2.0, (pole[1] + origin[1]) / 2), sign))
    marks = np.arange(0.0, float(drawn.results.machine.cycle), MARKS)
    at = np.searchsorted(degrees, marks)
    points = [
        Named(f"{mark:g}", shown.point(float(across[i]), float(along[i]))) for mark, i in zip(marks, at, strict=True)
    ]
    points += [Named("O", shown.point(0.0, -inertia))] if inertia else []
    room = box.inset(2.0, 2.0, 2.0, 20.0)
    return shown.with_items([*items, *names_beside(points, lines_of([*shown.items, *items]), room)])


def _equal(x: Side, y: Side, box: Box) -> tuple[Side, Side]:
    """Return two axes with the same scale, the first in the middle of its box."""
    wide, tall = box.width - 40.0, box.height - 42.0
    scale = round_scale(max((x.high - x.low) / wide, (y.high - y.low) / tall, 1e-12))
    spare = (box.width - 40.0 - (x.high - x.low) / scale) / 2
    return x._replace(scale=scale, zero=box.left + 18.0 + spare - x.low / scale), y._replace(scale=scale)


def unrolled(drawn: Drawn, extra: Mapping[str, Array | float], box: Box, words: Words) -> Graph:
    """Return the size of the load on the crankpin over the cycle, and its mean.

    `extra`: with `crankpin_load` and `crankpin_load_mean`, as `engine_sheets` says; that of this one rod otherwise.
    """
    load = over_cycle(drawn, extra, "crankpin_load", "piston_force")
    if load is None:
        load = OverCycle(drawn.degrees, _of_one(drawn).size * displayed("piston_force", 1.0, per_area=drawn.area))
    sign = indexed(say("symbols.sheet_load", words.language))
    base = say("symbols.sheet_load", words.language).partition("_")[0]
    unit = words.unit(words.unit_of("piston_force"))
    level = load.mean
    if "crankpin_load_mean" in extra:
        level = displayed("piston_force", float(extra["crankpin_load_mean"]), per_area=drawn.area)
    shown = f"{words.say('mean')} {words.number(level, 6)} {unit}"
    mean = indexed(f"{base}_{say('symbols.sheet_mean', words.language)}")
    ends = load.degrees[[0, -1]]
    curves = [
        Curve("crankpin_load", sign, "", load.degrees, load.values),
        Curve("crankpin_load_mean", mean, shown, ends, np.full(2, level), "dashed"),
    ]
    side = value_side("piston_force", [load.values], words)._replace(
        symbol=sign, mark=say("marks.force", words.language)
    )
    return graph(
        "unrolled", box, (angle_side(drawn, words), side), curves, words, of=crankpin_name(extra, words.language)
    )

"""The sheets of an engine: gas and piston motion on the first, forces and loads on the second."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.note.sheets import engine_forces as loads
from crankwork.note.sheets import engine_gas as gas
from crankwork.note.sheets.engine_motion import motion_graph, tolle
from crankwork.note.sheets.engine_wear import wear
from crankwork.note.sheets.graph import Graph
from crankwork.note.sheets.sheet import Paper, Sheet
from crankwork.note.sheets.words import Words
from crankwork.quantities import Language
from crankwork.report.figure_data import Drawn, drawn_from
from crankwork.report.language import displayed
from crankwork.report.linkage_look import round_scale
from crankwork.report.summary import results_method
from crankwork.show.scene import TEXT, Box, Item, Text, text_width

_DATA = (
    "bore", "stroke", "compression_ratio", "rod_ratio", "rotational_speed", "crank_radius", "rod_length", "offset",
    "reciprocating_mass", "rotating_mass", "indicated_mean_pressure", "indicated_power", "mean_torque",
)  # fmt: skip


def engine_sheets(
    results: Results, language: Language, paper: Paper, extra: Mapping[str, Array | float], *, per_area: bool
) -> Iterator[Sheet]:
    """Yield a sheet of the motion of a piston and one of its forces.

    Curves are computed afresh, finer than the table of the results. `extra` is what is known of the whole engine, in
    SI: `crank_angle` of the following, evenly over the cycle without it; `total_torque` and `total_torque_mean`;
    `crankpin_load`, the size of the load on the crankpin, and `crankpin_load_mean`; `crankpin_tangential` and
    `crankpin_radial`, the forces of all its rods, from whose origin the pole is `crankpin_inertia` away, that of
    `crankpin_rods` rods; `crankpin`, its number; `wear_sums` on each ray of the crankpin, and `wear_angle`, where the
    rays are, from the outer side of the pin with the rotation, evenly around it without it; `oil_hole_angle`, on the
    ray of the least sum without it.
    """
    if "piston_displacement" not in results.columns:
        return
    drawn, words = drawn_from(results, language, per_area=per_area), Words(language, per_area)
    yield _motion_sheet(drawn, paper, words)
    if "piston_force" in drawn.columns:
        yield _force_sheet(drawn, paper, words, extra)


def _motion_sheet(drawn: Drawn, paper: Paper, words: Words) -> Sheet:
    """Return the sheet of gas and piston motion: Brix and Tolle stand under the stroke of the indicator diagram."""
    has_gas = "gas_pressure" in drawn.columns
    upper, middle, lower = paper.part(0, 301, 286, 279), paper.part(0, 163, 286, 138), paper.part(0, 0, 286, 163)
    motions = [paper.part(286 + 176.6 * count, 62, 176.6, 232) for count in range(3)]
    if not has_gas:
        middle, lower = paper.part(0, 285, 286, 270), paper.part(0, 0, 286, 285)
        motions = [paper.part(286, 408 - 173 * count, 530, 172) for count in range(3)]
    scale = gas.displacement_scale(drawn, upper, middle)
    at = gas.top_centre(drawn, upper, scale)
    graphs: list[Graph] = []
    if has_gas:
        side = gas.pressure_side(drawn, words)
        pressure_scale = round_scale((side.high - side.low) / (upper.height - 36.0))
        graphs.append(gas.indicator(drawn, upper, words, pressure_scale, scale))
        graphs.append(gas.developed(drawn, paper.part(286, 301, 530, 279), words, pressure_scale))
    if not drawn.results.solved.lengths.offset:
        graphs.append(gas.brix(drawn, middle, words, scale, at))
        graphs.append(tolle(drawn, lower, words, scale, at))
    nouns = ("displacement", "velocity", "acceleration")
    graphs += [motion_graph(drawn, noun, box, words) for noun, box in zip(nouns, motions, strict=True)]
    more = _data(drawn, paper.part(296, 0, 328, 58), words)
    return Sheet("engine-motion", words.say("first_sheet"), words.language, paper, tuple(graphs), tuple(more))


def _force_sheet(drawn: Drawn, paper: Paper, words: Words, extra: Mapping[str, Array | float]) -> Sheet:
    """Return the sheet of forces, torque and the loads of the crankpin."""
    graphs = [
        loads.forces(drawn, name, paper.part(0, 387 - 193.3 * count, 408, 193), words)
        for count, name in enumerate(("piston_forces", "rod_forces", "crankpin_forces"))
    ]
    graphs.append(loads.torque(drawn, extra, paper.part(408, 437, 408, 143), words))
    graphs.append(loads.unrolled(drawn, extra, paper.part(408, 303, 408, 134), words))
    worn = wear(drawn, extra, paper.part(630, 60, 186, 240), words)
    if worn is None:
        graphs.append(loads.polar(drawn, extra, paper.part(408, 60, 408, 240), words))
    else:
        graphs += [loads.polar(drawn, extra, paper.part(408, 0, 220, 300), words), worn]
    return Sheet("engine-forces", words.say("second_sheet"), words.language, paper, tuple(graphs))


def _data(drawn: Drawn, box: Box, words: Words) -> list[Item]:
    """Return what the engine is, in rows."""
    summary = drawn.results.summary
    entries = []
    for key in _DATA:
        value = summary.get(key)
        if value is None or not np.isfinite(value) or (key == "offset" and not value):
            continue
        shown = words.number(displayed(key, float(value), per_area=drawn.area))
        unit = words.unit(words.unit_of(key))
        entries.append(f"{words.symbol(key)} = {shown}{'' if unit in ('', '°') else ' '}{unit}")
    entries.append(f"{words.say('method')}: {results_method(drawn.results, words.language)}")
    items: list[Item] = [Text((box.left + 1.5, box.top - 6.5), words.say("data"), 5.0)]
    x, y = box.left + 1.5, box.top - 15.0
    for one in entries:
        width = text_width(one) + 10.0
        if x + width > box.right and x > box.left + 2:
            x, y = box.left + 1.5, y - 7.0
        items.append(Text((x, y), one, TEXT))
        x += max(width, 44.0)
    return items

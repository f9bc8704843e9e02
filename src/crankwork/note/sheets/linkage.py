"""The sheets of a linkage: its structure, plans and motion, the forces in it, its dynamics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.moving import Moving, moving, reached_angles
from crankwork.analysis.plans import accelerations, driver_rates, velocities
from crankwork.analysis.skeleton import skeleton
from crankwork.locale import say
from crankwork.mechanism.structure import structure
from crankwork.note.sheets.linkage_tables import (
    Positions,
    Scales,
    comparable,
    compared_table,
    motion_tables,
    positions,
    reactions_table,
    scales_table,
    structure_block,
)
from crankwork.note.sheets.packing import Picture, in_grid
from crankwork.note.sheets.sheet import Paper, Sheet, sheets_with
from crankwork.quantities import Language
from crankwork.report.figure_data import kind_of
from crankwork.report.linkage_figures import Pictures, linkage_pictures
from crankwork.report.linkage_look import Style
from crankwork.report.linkage_plan_figures import acceleration_plan, size_of, velocity_plan
from crankwork.show.scene import Drawing

# step of the motion that plans are taken from [deg], and how many figures a sheet has
_DENSE_STEP, _FULL = 1.0, 8
_POSITIONS = tuple(range(0, 360, 30))
# which positions get an acceleration plan
_ACCELERATIONS = (1, 5, 9)
# figures on each sheet, by the key of its title
_SHEETS: dict[str, tuple[str, tuple[str, ...]]] = {
    "linkage-kinematics": ("headings.linkage_kinematics", (
        "structure", "position_plans", "velocity_plans", "acceleration_plans", "scales", "compared",
    )),
    "linkage-motion": ("sheets.motion_sheet", ("velocities", "accelerations", "sliders", "links", "driver")),
    "linkage-forces": ("headings.linkage_forces", (
        "force_plans", "zhukovsky_lever", "reactions", "joint_forces", "friction",
    )),
    "linkage-dynamics": ("sheets.linkage_dynamics", (
        "torques", "reduced_inertia", "wittenbauer", "speed", "indicator", "chambers", "transient",
    )),
}  # fmt: skip


def linkage_sheets(results: Results, language: Language, paper: Paper) -> Iterator[Sheet]:
    """Yield the sheets of a linkage that was drawn, or of what is reduced to a driver."""
    known = linkage_pictures(results, language)
    if results.machine.linkage is not None:
        known |= _words(results, language)
    subjects: list[tuple[str, str, list[Picture]]] = []
    for name, (title, kinds) in _SHEETS.items():
        pictures = [Picture(key, known[key]) for kind in kinds for key in known if kind_of(key) == kind]
        # one or two figures would leave a sheet of their own empty
        if subjects and len(pictures) in (1, 2) and len(subjects[-1][2]) + len(pictures) <= _FULL:
            first, before, joined_pictures = subjects[-1]
            heading = say(title, language)
            joined = before if len(pictures) == 1 else f"{before}; {heading[:1].lower()}{heading[1:]}"
            subjects[-1] = first, joined, [*joined_pictures, *pictures]
        elif pictures:
            subjects.append((name, say(title, language), pictures))
    for name, title, pictures in subjects:
        yield from sheets_with(name, title, pictures, paper, language)


def _words(results: Results, language: Language) -> Pictures:
    """Return plans at a dozen positions, and the texts and tables of the sheets, of a linkage that was drawn."""
    machine = results.machine
    mechanism, (analysed, _) = machine.mechanism, structure(machine.drawn)
    style = Style(language, analysed.links if analysed is not None else (), period=results.period)
    degrees, _ = reached_angles(machine, _DENSE_STEP)
    nearest = [int(np.argmin(np.abs(degrees - angle))) for angle in _POSITIONS]
    shown = [row for row, angle in zip(nearest, _POSITIONS, strict=True) if abs(degrees[row] - angle) < _DENSE_STEP]
    data = positions(results, degrees[shown], skeleton(mechanism, style.links), style)
    drawn: Pictures = {"structure": partial(structure_block, data, analysed)} if analysed is not None else {}
    drawn |= {**motion_tables(data), **reactions_table(data)}
    return drawn | _plans(data, moving(mechanism, data.degrees))


def _plans(data: Positions, moved: Moving) -> Pictures:
    """Return velocity plans at all positions, acceleration plans at three of them, and the values read on them."""
    mechanism, style, language, scales = data.results.machine.mechanism, data.style, data.language, Scales()
    rates = driver_rates(data.results, data.columns)

    rows = range(len(data.degrees))
    chosen = [row for row in _ACCELERATIONS if row < len(rows)] or [0]
    first, second = rates.first.tolist(), rates.second.tolist()
    fast = [size_of(velocities(mechanism, moved, row, first[row], style.links)) for row in rows]
    faster = [size_of(accelerations(mechanism, moved, row, first[row], second[row], style.links)) for row in chosen]

    def moving_at(position: int) -> Drawing:
        plan = velocity_plan(mechanism, moved, position, first[position], style, position, fast)
        return scales.kept("v", position, plan)

    def accelerated(position: int) -> Drawing:
        plan = acceleration_plan(mechanism, moved, position, first[position], second[position], style, position, faster)
        return scales.kept("a", position, plan)

    moves = [row for row in rows if rates.first[row]]
    plans: Pictures = {
        "velocity_plans": _grid("velocity_plans", [partial(moving_at, row) for row in rows], 4, scales, language),
        "acceleration_plans": _grid(
            "acceleration_plans", [partial(accelerated, row) for row in chosen], 3, scales, language
        ),
        "scales": partial(scales_table, data, scales, {"v": moves, "a": chosen}),
    }
    if comparable(data):
        plans["compared"] = partial(compared_table, data, scales, [row for row in chosen if row in moves])
    return plans


def _grid(
    name: str, cells: Sequence[Callable[[], Drawing]], columns: int, scales: Scales, language: Language
) -> Callable[[], Drawing]:
    def remark() -> str:
        return say("drawing.own_scales", language) if scales.differ(name[0]) else ""

    return partial(in_grid, cells, columns, say(f"sheets.{name}", language), language, remark)

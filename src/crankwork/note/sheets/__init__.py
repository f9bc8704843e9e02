"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.all_cylinders import with_engine_results
from crankwork.errors import CrankworkError, InputError, Problem
from crankwork.locale import ErrorMessage, translate
from crankwork.note.sheets.packing import Picture
from crankwork.note.sheets.plans import Pictures, of_links
from crankwork.note.sheets.sheet import Paper, Sheet, TitleBlock, block_of, numbered, sheets_with, text_block
from crankwork.quantities import Language
from crankwork.report.display import for_readers
from crankwork.report.figures import diagrams
from crankwork.report.look import Drawn, drawn_of, kind_of
from crankwork.report.motion import indicator_brix
from crankwork.report.summary import results_method
from crankwork.show.scene import Drawing

__all__ = [
    "Paper",
    "Sheet",
    "TitleBlock",
    "block_of",
    "drawn_sheets",
]
PLAIN = Paper()
# figures that a sheet has room for
_FULL = 8
_DATA = (
    "bore", "stroke", "compression_ratio", "rod_ratio", "rotational_speed", "crank_radius", "rod_length", "offset",
    "reciprocating_mass", "rotating_mass", "indicated_mean_pressure", "indicated_power", "mean_torque",
)  # fmt: skip
# kinds of figures on each sheet, by the key of its title
_SHEETS: dict[str, tuple[str, tuple[str, ...]]] = {
    "engine-motion": ("sheets.first_sheet", (
        "indicator_brix", "indicator", "pressure", "brix", "tolle", "kinematics", "data",
    )),
    "engine-forces": ("headings.dynamics", (
        "piston_forces", "rod_forces", "crankpin_forces", "torque", "total_tangential_force", "total_torque",
        "crankpin_load", "crankpin_polar", "crankpin_wear",
    )),
    "engine-shaft": ("sheets.shaft_sheet", (
        "accumulated_torque", "excess_work", "crank_speed", "big_end_polar", "main_journal_polar", "main_wear",
    )),
    "engine-balance": ("sheets.balance_sheet", (
        "torque_harmonics", "phase_stars", "balance_orders", "balance_ellipses",
    )),
}  # fmt: skip
_OF_LINKS: dict[str, tuple[str, tuple[str, ...]]] = {
    "linkage-kinematics": ("headings.linkage_kinematics", (
        "structure", "position_plans", "velocity_plans", "acceleration_plans", "scales", "compared",
    )),
    "linkage-motion": ("sheets.motion_sheet", ("velocities", "accelerations", "sliders", "links", "driver")),
    "linkage-forces": ("headings.linkage_forces", (
        "force_plans", "zhukovsky_lever", "reactions", "joint_forces", "friction",
    )),
    "linkage-dynamics": ("sheets.linkage_dynamics", (
        "process_force", "torques", "reduced_inertia", "wittenbauer", "speed", "indicator", "chambers", "transient",
    )),
}  # fmt: skip


@for_readers
def drawn_sheets(
    results: Results, language: Language = "en", *, paper: Paper = PLAIN, per_area: bool = False
) -> tuple[Sheet, ...]:
    """Return the sheets of a machine; figures for which nothing is known are left out."""
    # sheets say what the note says, which takes a crank gear of its own as an engine of one cylinder
    results = with_engine_results(results)
    machine = drawn_of(results, language, per_area=per_area)
    chosen = results.machine.document.sheets
    known = _pictures(results, machine, language, chosen)
    subjects: list[tuple[str, str, list[Picture]]] = []
    for name, (title, kinds) in (_SHEETS if machine.has_piston else _OF_LINKS).items():
        keys = [key for kind in kinds for key in known if kind_of(key) == kind]
        keys = [key for key in chosen if key in keys] if chosen else keys
        pictures = [Picture(key, known[key]) for key in keys]
        # one or two figures would leave a sheet of their own empty
        is_few = len(pictures) in (1, 2) and not machine.has_piston
        if subjects and is_few and len(subjects[-1][2]) + len(pictures) <= _FULL:
            first, before, joined_pictures = subjects[-1]
            heading = translate(title, language)
            joined = before if len(pictures) == 1 else f"{before}; {heading[:1].lower()}{heading[1:]}"
            subjects[-1] = first, joined, [*joined_pictures, *pictures]
        elif pictures:
            subjects.append((name, translate(title, language), pictures))
    placed = {picture.name for _, _, pictures in subjects for picture in pictures}
    if remaining := [Picture(key, known[key]) for key in chosen if key not in placed]:
        subjects.append(("chosen", translate("page.diagrams", language), remaining))
    if not subjects:
        raise CrankworkError("sheets need the motion of a piston, a drawn linkage or torques; these results have none")
    sheets: list[Sheet] = []
    for name, title, pictures in subjects:
        sheets += sheets_with(name, title, pictures, paper, language)
    return numbered(sheets, paper)


def _pictures(results: Results, machine: Drawn, language: Language, chosen: Sequence[str]) -> Pictures:
    """Return what the sheets of a machine choose from: all that there is, where a file names its figures."""
    known: Pictures = {name: partial(figure.picture, machine) for name, figure in diagrams(machine).items()}
    if machine.has_piston:
        known["data"] = partial(_data, machine)
        if "total_torque" in known and not chosen:
            known.pop("torque")
            # one and the same curve to two scales: schools draw one of them
            known.pop("total_torque" if language == "vi" else "total_tangential_force")
        space = results.solved.space
        if "indicator" in known and space.gas.factor == 1:
            # the pressure at one scale over volume and angle, with its circle
            known = {"indicator_brix": partial(indicator_brix, machine), **known}
            for name in () if chosen else ("indicator", "pressure", "brix"):
                del known[name]
    known |= of_links(results, language) if results.machine.linkage is not None else {}
    for number, name in enumerate(chosen, start=1):
        if name not in known:
            message = ErrorMessage("no_figure", value=name, known=", ".join(known))
            raise InputError([Problem(f"document.sheets[{number}]", message)], [""])
    return known


def _data(engine: Drawn) -> Drawing:
    """Draw the data of the engine in rows."""
    summary, language = engine.results.summary, engine.language
    known = {key: float(summary[key]) for key in _DATA if summary.get(key) is not None}
    entries = [
        f"{engine.symbol(key)} = {engine.value(key, value)}"
        for key, value in known.items()
        if np.isfinite(value) and (value or key != "offset")
    ]
    entries.append(f"{translate('report.method', language)}: {results_method(engine.results, language)}")
    return text_block(entries, translate("headings.data", language), language)

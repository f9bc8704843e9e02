"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.whole_engine import as_engine
from crankwork.errors import CrankworkError
from crankwork.locale import say
from crankwork.note.sheets.linkage import linkage_sheets
from crankwork.note.sheets.packing import Picture
from crankwork.note.sheets.sheet import Paper, Sheet, numbered, sheets_with
from crankwork.note.sheets.table import text_block
from crankwork.note.sheets.title_block import TitleBlock, block_of
from crankwork.quantities import Language
from crankwork.report.engine_figure_data import EngineDrawn, engine_drawn
from crankwork.report.engine_figure_list import engine_pictures
from crankwork.report.language import for_readers
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
_DATA = (
    "bore", "stroke", "compression_ratio", "rod_ratio", "rotational_speed", "crank_radius", "rod_length", "offset",
    "reciprocating_mass", "rotating_mass", "indicated_mean_pressure", "indicated_power", "mean_torque",
)  # fmt: skip
# kinds of figures on each sheet, by the key of its title
_SHEETS: dict[str, tuple[str, tuple[str, ...]]] = {
    "engine-motion": ("sheets.first_sheet", ("indicator", "pressure", "brix", "tolle", "kinematics")),
    "engine-forces": ("headings.dynamics", (
        "piston_forces", "rod_forces", "crankpin_forces", "torque", "total_torque", "crankpin_load", "crankpin_polar",
        "crankpin_wear",
    )),
    "engine-shaft": ("sheets.shaft_sheet", (
        "accumulated_torque", "excess_work", "crank_speed", "big_end_polar", "main_journal_polar", "main_wear",
    )),
    "engine-balance": ("sheets.balance_sheet", (
        "torque_harmonics", "phase_stars", "balance_orders", "balance_ellipses",
    )),
}  # fmt: skip


@for_readers
def drawn_sheets(
    results: Results, language: Language = "en", *, paper: Paper = PLAIN, per_area: bool = False
) -> tuple[Sheet, ...]:
    """Return the sheets of a machine; figures for which nothing is known are left out."""
    # sheets say what the note says, which takes a crank gear of its own as an engine of one cylinder
    results = as_engine(results)
    sheets = [*engine_sheets(results, language, paper, per_area=per_area), *linkage_sheets(results, language, paper)]
    if not sheets:
        raise CrankworkError("sheets need the motion of a piston, a drawn linkage or torques; these results have none")
    return numbered(sheets, paper)


def engine_sheets(results: Results, language: Language, paper: Paper, *, per_area: bool) -> Iterator[Sheet]:
    """Yield the sheets of an engine, or of a crank gear, as far as its figures are known."""
    if "piston_displacement" not in results.columns:
        return
    engine = engine_drawn(results, language, per_area=per_area)
    known = engine_pictures(engine)
    if "total_torque" in known:
        known.pop("torque")
    for name, (title, kinds) in _SHEETS.items():
        pictures = [
            Picture(key, draw) for kind in kinds for key, draw in known.items() if key.rstrip("_0123456789") == kind
        ]
        if name == "engine-motion":
            pictures.append(Picture("data", partial(_data, engine)))
        yield from sheets_with(name, say(title, language), pictures, paper, language)


def _data(engine: EngineDrawn) -> Drawing:
    """Draw the data of the engine in rows."""
    summary, language = engine.results.summary, engine.language
    known = {key: float(summary[key]) for key in _DATA if summary.get(key) is not None}
    entries = [
        f"{engine.symbol(key)} = {engine.value(key, value)}"
        for key, value in known.items()
        if np.isfinite(value) and (value or key != "offset")
    ]
    entries.append(f"{say('report.method', language)}: {results_method(engine.results, language)}")
    return text_block(entries, say("headings.data", language), language)

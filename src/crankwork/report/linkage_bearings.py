"""The figures of the bearings and of the torque harmonics of a linkage."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial

from crankwork.analysis import Results
from crankwork.analysis.bearing_diagrams import JointDiagrams
from crankwork.locale import say
from crankwork.quantities import Language
from crankwork.report.engine_figure_bearings import (
    crankpin_load,
    crankpin_polar,
    crankpin_wear,
    main_journal_polar,
    main_wear,
)
from crankwork.report.engine_figure_data import BearingsDrawn
from crankwork.report.engine_figure_orders import torque_harmonics
from crankwork.show.chart import Graph
from crankwork.show.paper import Canvas, plain
from crankwork.show.scene import Drawing

Draw = Callable[[BearingsDrawn], tuple[Canvas, Mapping[str, Graph]]]
# what draws it, and the listing it needs
_LISTED: dict[str, tuple[Draw, str]] = {
    "crankpin_load": (crankpin_load, "crankpin_wear"),
    "main_journal_polar": (main_journal_polar, "main_wear"),
    "crankpin_wear": (crankpin_wear, "crankpin_wear"),
    "main_wear": (main_wear, "main_wear"),
    "torque_harmonics": (torque_harmonics, "torque_harmonics"),
}


@dataclass(frozen=True)
class JointsDrawn(BearingsDrawn):
    """Data of the figures of the bearings of a linkage."""

    @cached_property
    def bearings(self) -> JointDiagrams:
        """The loads of its bearings."""
        return JointDiagrams(self.results)


def bearing_pictures(results: Results, language: Language) -> dict[str, Callable[[], Drawing]]:
    """Return what draws each figure of the bearings of a linkage; none where their loads are not known."""
    drawn = JointsDrawn(results, language, None)
    pins = drawn.bearings.pins
    pictures: dict[str, Callable[[], Drawing]] = {}
    for number, pin in enumerate(pins, start=1):
        name = f"crankpin_polar_{number}" if number > 1 else "crankpin_polar"
        pictures[name] = partial(_pin_picture, drawn, pin)
    for name, (draw, listing) in _LISTED.items():
        if listing in results.listings:
            pictures[name] = partial(_picture, drawn, name, draw)
    return pictures


def _pin_picture(drawn: JointsDrawn, pin: str) -> Drawing:
    """Draw the polar diagram of a crankpin, named in the title."""
    remark = say("drawing.crank_up", drawn.language)
    return drawn.finished("crankpin_polar", crankpin_polar(drawn, pin)[0], remark, owner=plain(pin))


def _picture(drawn: JointsDrawn, name: str, draw: Draw) -> Drawing:
    remark = say("drawing.crank_up", drawn.language) if name == "main_journal_polar" else ""
    return drawn.finished(name, draw(drawn)[0], remark)

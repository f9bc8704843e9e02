"""What a page calculates by itself while a number is held: made before the first move, so that nothing waits for it."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description
from crankwork.locale import Language
from crankwork.note.live import page_data
from crankwork.page.document import follow
from crankwork.page.sliders import FAINT, Live, Slider
from crankwork.report.drawing import film_of
from crankwork.report.language import in_own_units
from crankwork.show.alt import alt_text
from crankwork.show.inline import inline_film, inline_svg
from crankwork.study.sliders import around, ends, moved

# of a number, how far from it the designs lie that tell what follows it
_NEAR = 0.02
# of it, where machines lie that others are drawn between: nearer to each other towards the ends, as polynomials ask for
_AROUND = (-0.25, -0.177, 0.0, 0.177, 0.25)
# where the ends of its slider are unless the page tells; machines there and halfway nobody draws
_ENDS = (-0.5, 1.0)
_ROUNDING = 1e-9


@in_own_units
def ahead(
    results: Results,
    description: Description,
    key: str,
    names: Collection[str],
    language: Language,
    reach: tuple[str, str] | None = None,
) -> tuple[dict[str, Any], str]:
    """Return what is drawn anew of figures when a number is moved, what stays behind, and the steps of the calculation.

    `reach`: from where to where its slider goes, as written.
    `behind`: figures that cannot follow, or only in part; `stays`: whether the machine does.
    What is not calculated goes between `films`, and curves, of machines with other `values` of the number.
    """
    made = moved(description, [key], (), results, _NEAR)
    now = made.sliders[0].now
    near = [now * (1 + share) for share in _AROUND]
    low, high = (reach and ends(description, key, *reach)) or [now * (1 + share) for share in _ENDS]
    far = [low, (low + now) / 2, (now + high) / 2, high]
    far = [one for one in far if not np.isclose(one, near, rtol=_ROUNDING, atol=0.0).any()]
    others = around(description, key, results, near)
    further = around(description, key, results, far)
    live = Live(made, language, names, others, further)
    data = page_data(results, live.drawn, None, language, only_read=True)
    marks, steps, stays = follow(live, results, data)
    behind = [name for name, one in data["figures"].items() if one.pop("filed", False) or FAINT in marks[name]]
    for name, one in live.drawn.items():
        data["figures"][name]["told"] = alt_text(one)
    figures = {
        name: inline_svg(one, name, one.title, marks[name]) for name, one in live.drawn.items() if name not in behind
    }
    trusted = _trusted(made.sliders[0], [*near, *far], {*others, *further})
    found = {
        "unit": made.sliders[0].unit,
        "trusted": trusted,
        "behind": behind,
        "stays": stays,
        "data": data,
        "figures": figures,
    }
    films = [_filmed(one, language) for one in others.values()] if stays else []
    return {**found, "values": list(others), "films": films}, steps


def _trusted(slider: Slider, asked: Collection[float], there: Collection[float]) -> tuple[float, float]:
    """Return between which numbers the steps are believed: as far as there are machines one after another. [SI]"""
    reached, now = [slider.low, slider.high], slider.now
    outwards = sorted(asked, key=lambda one: abs(one - now))
    for end in (0, 1):
        for value in (one for one in outwards if (one > now if end else one < now)):
            if value not in there or abs(reached[end] - now) < _NEAR * abs(now) * (1 - _ROUNDING):
                break
            reached[end] = value
    spare = _ROUNDING * max(map(abs, reached))
    return reached[0] - spare, reached[1] + spare


def _filmed(results: Results, language: Language) -> dict[str, Any]:
    """Return a machine as a page plays it."""
    film = film_of(results, language=language)
    if film is None:
        return {}
    data = page_data(results, {}, film, language, only_read=True)
    return {"drawn": inline_film(film, "machine"), "film": data["film"]}

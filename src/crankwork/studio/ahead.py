"""Live preview: what the page calculates while a number is dragged, prepared before the first move."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description
from crankwork.locale import Language
from crankwork.note.live import page_data
from crankwork.page.document import follow
from crankwork.page.sliders import FAINT, LivePage, Slider
from crankwork.report.drawing import film_of
from crankwork.report.language import in_own_units
from crankwork.show.alt import alt_text
from crankwork.show.inline import inline_film, inline_svg
from crankwork.study.sliders import around, ends, moved

# relative range of the number in which the calculation is compiled
_NEAR = 0.02
# relative values of the machines to interpolate between, close to Chebyshev nodes
_AROUND = (-0.25, -0.177, 0.0, 0.177, 0.25)
# default ends of the slider; machines there and halfway are analysed but not drawn
_ENDS = (-0.5, 1.0)
_ROUNDING = 1e-9


@in_own_units
def live_preview(
    results: Results,
    description: Description,
    key: str,
    names: Collection[str],
    language: Language,
    reach: tuple[str, str] | None = None,
) -> tuple[dict[str, Any], str]:
    """Return the data of a live preview and the script of its calculation.

    `reach`: range of the slider as text. In the data, `behind`: figures that cannot follow, or only in part; `stays`:
    whether the machine follows. Figures and curves that are not calculated are interpolated between `films` of machines
    with other `values` of the number.
    """
    made = moved(description, [key], (), results, _NEAR)
    now = made.sliders[0].now
    near = [now * (1 + share) for share in _AROUND]
    low, high = (reach and ends(description, key, *reach)) or [now * (1 + share) for share in _ENDS]
    far = [low, (low + now) / 2, (now + high) / 2, high]
    far = [value for value in far if not np.isclose(value, near, rtol=_ROUNDING, atol=0.0).any()]
    variants = around(description, key, results, near)
    further = around(description, key, results, far)
    live = LivePage(made, language, names, variants, further)
    data = page_data(results, live.drawn, None, language, only_read=True)
    marks, steps, stays = follow(live, results, data)
    behind = [name for name, figure in data["figures"].items() if figure.pop("filed", False) or FAINT in marks[name]]
    for name, drawing in live.drawn.items():
        data["figures"][name]["told"] = alt_text(drawing)
    figures = {
        name: inline_svg(figure, name, figure.title, marks[name])
        for name, figure in live.drawn.items()
        if name not in behind
    }
    trusted = _trusted(made.sliders[0], [*near, *far], {*variants, *further})
    preview = {
        "unit": made.sliders[0].unit,
        "trusted": trusted,
        "behind": behind,
        "stays": stays,
        "data": data,
        "figures": figures,
    }
    films = [_filmed(variant, language) for variant in variants.values()] if stays else []
    return {**preview, "values": list(variants), "films": films}, steps


def _trusted(slider: Slider, values: Collection[float], available: Collection[float]) -> tuple[float, float]:
    """Return the range of the number in which the script is valid: up to the first value without a machine. [SI]"""
    reached, now = [slider.low, slider.high], slider.now
    outwards = sorted(values, key=lambda item: abs(item - now))
    for end in (0, 1):
        for value in (item for item in outwards if (item > now if end else item < now)):
            if value not in available or abs(reached[end] - now) < _NEAR * abs(now) * (1 - _ROUNDING):
                break
            reached[end] = value
    margin = _ROUNDING * max(map(abs, reached))
    return reached[0] - margin, reached[1] + margin


def _filmed(results: Results, language: Language) -> dict[str, Any]:
    """Return the animation of a machine as page data."""
    film = film_of(results, language=language)
    if film is None:
        return {}
    data = page_data(results, {}, film, language, only_read=True)
    return {"drawn": inline_film(film, "machine"), "film": data["film"]}

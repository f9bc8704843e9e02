"""Results as a notebook shows them."""

from __future__ import annotations

import base64
import difflib
import html
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePath

from crankwork import files
from crankwork.analysis import Results
from crankwork.analysis.rounding_noise import summary_without_rounding
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.locale import ErrorMessage, translate
from crankwork.locale.numbers import number
from crankwork.quantities import Language
from crankwork.report.display import displayed, in_own_units, key_unit, label, symbol
from crankwork.report.drawing import film_of
from crankwork.report.summary import results_method
from crankwork.show.formats import FORMATS
from crankwork.show.scene import Drawing
from crankwork.show.svg import moving_svg, svg
from crankwork.show.theme import THEMES, Theme

_LINES = 9


@dataclass(frozen=True)
class Picture:
    """A drawing that a notebook shows and a file takes, in the theme `print`, `colour` or `dark`."""

    drawing: Drawing = field(repr=False)
    name: str
    theme: Theme = "print"

    @property
    def svg(self) -> str:
        """The drawing as SVG."""
        return svg(self.drawing, self.theme).decode()

    def _repr_svg_(self) -> str:
        return self.svg

    def styled(self, theme: Theme) -> Picture:
        """Return it in another theme."""
        if theme not in THEMES:
            raise CrankworkError(ErrorMessage("theme_unknown", name=str(theme)[:40], known=", ".join(THEMES)))
        return replace(self, theme=theme)

    def save(self, path: str | Path, *, overwrite: bool = False) -> None:
        """Write it in the format that the ending of the name asks for: SVG, PDF, PNG or DXF."""
        ending = PurePath(path).suffix.lower().removeprefix(".")
        if ending not in FORMATS:
            raise CrankworkError(ErrorMessage("figure_ending", name=str(path)[-60:], known=", ".join(FORMATS)))
        files.check_files(path, overwrite=overwrite)
        files.write_files({path: FORMATS[ending](self.drawing, self.theme)}, overwrite=overwrite)


def picture(results: Results, name: str, language: Language = "en") -> Picture:
    """Return a figure by the name of its file, `crankpin_polar`; a notebook shows it.

    Raises
    ------
    UnknownKeyError
        If there is no such figure.
    """
    # a notebook that draws nothing does not load it
    from crankwork.report.figures import drawings, figure_names  # noqa: PLC0415

    drawn = drawings(results, language=language, only=(name,))
    if name not in drawn:
        known = figure_names(results, language)
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.5) or known
        raise UnknownKeyError(ErrorMessage("figure_unknown", name=name[:60], known=", ".join(near)))
    return Picture(drawn[name], name)


@in_own_units
def short_text(results: Results) -> str:
    """Return results in fifteen lines."""
    kept = summary_without_rounding(results)
    head = [f"<crankwork.Results: {results.machine.title or results.machine.mechanism.driver.__class__.__name__}"]
    head.append(f"  {results_method(results, 'en')}; {len(results.columns)} columns at {len(results.grid)} angles")
    rows = [f"  {key} = {number(displayed(key, kept[key]), 'en')} {key_unit(key)}".rstrip() for key in kept]
    more = [f"  and {len(rows) - _LINES} single values more"] if len(rows) > _LINES else []
    unmet = [f"  not met: {', '.join(results.unmet)}"] if results.unmet else []
    notices = [f"  {len(results.notices)} notices"] if results.notices else []
    return "\n".join(
        [*head, *rows[:_LINES], *more, *unmet, *notices, "  SI inside: results[key], .value(key, at), .explain(key)>"]
    )


@in_own_units
def page(results: Results, language: Language = "en") -> str:
    """Return results as a notebook shows them: the machine moving, and the summary to be opened."""
    kept, machine = summary_without_rounding(results), results.machine
    rows = [
        (label(key, language), symbol(key, language), number(displayed(key, value), language), key_unit(key))
        for key, value in kept.items()
    ]
    table = "".join(f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    drawn, film = "", film_of(results, language=language, frames=48)
    if film is not None:
        data = base64.b64encode(moving_svg(film, "colour")).decode()
        drawn = f'<img alt="{html.escape(machine.title)}" width="400" src="data:image/svg+xml;base64,{data}">'
    method = html.escape(results_method(results, language))
    return (
        f"<div><p><b>{html.escape(machine.title)}</b><br>{method}</p>{drawn}"
        f"<details><summary>{translate('report.summary', language)}</summary><table>{table}</table></details></div>"
    )

"""Requests of the studio's page: errors by line, form, machine, figures and values, live preview, experiments."""

from __future__ import annotations

import base64
import binascii
import io
import math
import re
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from crankwork import files
from crankwork.analysis import Results, analyse
from crankwork.analysis.motion_range import full_turn_bounds
from crankwork.description.document import Description, origins_of
from crankwork.description.machine_file import template
from crankwork.description.toml_edit import document
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import ErrorMessage, Language, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.mechanism import Crank
from crankwork.note.explain import place_text
from crankwork.note.interactive import controls, page_data
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of, sheets_of, written_note
from crankwork.page.document import TraceExport, cards, follow, page, sentences, tables, title_of, values
from crankwork.page.sliders import FAINT, LivePage, Slider, scale
from crankwork.quantities.key import key_of
from crankwork.report.display import in_own_units, key_unit
from crankwork.report.drawing import drawn, film_of
from crankwork.report.figures import drawings, figure_names
from crankwork.report.look import figure_title
from crankwork.report.notices import notice_text
from crankwork.report.results_folder import workbook
from crankwork.report.summary import results_method, warning_text
from crankwork.show.animation import Animation
from crankwork.show.canvas import MM, SCREEN, ChartLayout, use_layout
from crankwork.show.formats import FORMATS
from crankwork.show.inline import frame_data, frame_marks, inline_film, inline_svg
from crankwork.show.scene import Drawing
from crankwork.show.theme import alt_text
from crankwork.studio.form import additions, form, stated_text, with_addition
from crankwork.studio.sketch import dyads, from_pmks, handles, is_pmks, measured, missing, redrawn, sketched, swapped
from crankwork.study.figures import found_drawings, map_drawings
from crankwork.study.parameter_map import ends_of, map_text, mapped
from crankwork.study.runner import ExecutionOptions, run_study
from crankwork.study.sliders import around, ends, moved
from crankwork.study.study_file import read_study
from crankwork.study.study_text import found_text
from crankwork.units import from_si, use_units

SHARE = "crankwork:"
_LINE = re.compile(r":(\d+)$")
_PLACE = re.compile(r"^.{0,400}?:(\d+): ", re.DOTALL)
# relative range of the number in which the calculation is compiled
_NEAR = 0.02
# relative values of the machines to interpolate between, close to Chebyshev nodes
_AROUND = (-0.25, -0.177, 0.0, 0.177, 0.25)
# default ends of the slider; machines there and halfway are analysed but not drawn
_ENDS = (-0.5, 1.0)
_ROUNDING = 1e-9
_DIGITS = 3
# relative error of bounds found between sampled positions
_BOUND_ERROR = 1e-6
# relative change of the number, and relative difference of equal values
_MOVED = 0.01
_SAME = 1e-7


# windows in which figures stand alone [px], and figures that stand beside other things
_NARROW, _COLUMN = 640, ChartLayout(140 / MM)


class Session:
    """One page of the studio; it caches the results of its last text."""

    def __init__(self, language: Language, path: Path | None = None, *, reads: bool = False) -> None:
        self.language: Language = language
        self._path, self._reads = path, reads or path is not None
        self._text: str | None = None
        self._results: Results | None = None
        self._read: tuple[str, Description] | None = None

    def set_file(self, path: Path | None, *, reads: bool) -> None:
        """Set the file of the next text, or none; `reads`: whether the text may name files without one."""
        if path != self._path:
            # files that the text names are in another folder now
            self._path, self._text, self._read = path, None, None
        self._reads = reads or path is not None

    def answer(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to a request."""
        asks: dict[str, Callable[[Mapping[str, Any]], dict[str, Any]]] = {
            "show": self._show, "set": self._set, "without": self._without, "template": self._template,
            "shared": self._shared, "sketch": self._sketch, "explain": self._explain, "add": self._add,
            "ahead": self._ahead, "reach": self._reach, "missing": self._missing, "swap": self._swap,
        }  # fmt: skip
        try:
            with use_layout(SCREEN if request.get("wide", _NARROW) < _NARROW else _COLUMN):
                return asks[request["do"]](request)
        except CrankworkError as error:
            return {"refusals": self._error_lines(error)}

    def export(self, text: str, name: str) -> bytes:
        """Return the machine of a text as a file; its name gives the kind."""
        return _written(self._computed(text), name, self.language)

    def _check_files(self, description: Description) -> None:
        if not self._reads and (named := _files(description)):
            raise CrankworkError(ErrorMessage("studio_files", names=named))

    def run_experiment(self, request: Mapping[str, Any], progress: Callable[[float], None]) -> dict[str, Any]:
        """Return a map over ranges of numbers, or the results of designs drawn from them."""
        try:
            description = self._fresh(request["text"])
            self._check_files(description)
            return run_experiment(description, request, self.language, progress)
        except CrankworkError as error:
            return {"refusals": self._error_lines(error)}

    def _show(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return everything that the page shows of a text; without a valid machine what is available and the errors."""
        text = request["text"]
        try:
            description = self._described(text)
        except CrankworkError as error:
            return {"refusals": self._error_lines(error)}
        answer: dict[str, Any] = {"refusals": []}
        groups = () if request.get("held") else form(description, self.language)
        if groups:
            answer["form"] = groups
        if not self._reads and (named := _files(description)):
            return {**answer, "named": named}
        try:
            results = self._computed(text)
        except CrankworkError as error:
            return {**answer, "additions": self._additions(description, None), "refusals": self._error_lines(error)}
        with use_units(results.machine.units):
            if request.get("held"):
                return answer | self._live_update(results, request)
            answer |= {
                "additions": self._additions(description, results),
                "handles": handles(description.values, groups),
            }
            needed = full_turn(description, results, answer["handles"], self.language)
            return {**answer, **self._seen(results, request.get("figures")), "turn": needed}

    def _changed(self, request: Mapping[str, Any], text: str) -> dict[str, Any]:
        """Return a changed text and what the page shows of it."""
        return {"text": text, **self._show({**request, "text": text})}

    def _additions(self, description: Description, results: Results | None) -> list[tuple[str, str]]:
        return [(addition.key, addition.label(self.language)) for addition in additions(description, results)]

    def _set(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Set fields to typed texts and return what the page shows."""
        description = self._fresh(request["text"])
        for key, typed in request["fields"].items():
            description[key] = stated_text(description, key, typed, self.language)
        return self._changed(request, description.dump())

    def _without(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Remove a field and return what the page shows."""
        description = self._fresh(request["text"])
        # remove both coordinates of a point
        del description[request["key"].removesuffix("[1]").removesuffix("[2]")]
        return self._changed(request, description.dump())

    def _template(self, request: Mapping[str, Any]) -> dict[str, Any]:
        return self._changed(request, template(request["name"], self.language))

    def _shared(self, request: Mapping[str, Any]) -> dict[str, Any]:
        text = opened_share(request["word"], self.language)
        # a shared text must not read files of this computer
        self._reads = False
        return self._changed(request, text)

    def _sketch(self, request: Mapping[str, Any]) -> dict[str, Any]:
        text = sketched(request, self.language)
        if request.get("before"):
            try:
                before = self._described(sketched(request["before"], self.language)).values
            except CrankworkError:
                before = {}
            text = redrawn(self._fresh(request["text"]), before, self._described(text).values)
        return self._changed(request, text)

    def _swap(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Assemble a dyad in its other branch and return what the page shows."""
        machine = self._computed(request["text"]).machine
        return self._changed(request, swapped(self._fresh(request["text"]), request["key"], machine))

    def _missing(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return what a sketch lacks, and the typed length and direction of its next link."""
        return {"missing": missing(request, self.language), "measured": measured(request["typed"], self.language)}

    def _add(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Add what was chosen and return what the page shows, with a diagram that was not available before."""
        description = self._described(request["text"])
        try:
            results = self._computed(request["text"])
        except CrankworkError:
            results = None
        before = () if results is None else figure_names(results, self.language)
        chosen = next((item for item in additions(description, results) if item.key == request["key"]), None)
        added = description if chosen is None else with_addition(description, chosen)
        text = added.dump()
        answer = self._show({**request, "text": text})
        fresh = [name for name in answer.get("names", ()) if name not in before]
        if fresh and request.get("figures") is not None:
            brought = _first(fresh)[0]
            answer = self._show({**request, "text": text, "figures": [*request["figures"], brought]})
            answer["brought"] = brought
        return {"text": text, "added": [key for key in added if key not in description], **answer}

    def _explain(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return how a value is calculated."""
        results, key = self._computed(request["text"]), request["key"]
        origin = origins_of(request["text"])

        def place(path: str, numbers: Iterable[float]) -> str:
            return place_text(origin(path, numbers), self.language)

        with use_units(results.machine.units):
            columns = page_data(results, {}, None, self.language)["columns"]
            return {"memories": TraceExport(results, self.language, place, columns).of([key]), "key": key}

    def _reach(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the results that depend on a number."""
        text, key = request["text"], request["key"]
        return {"reach": dependent_results(self._computed(text), self._fresh(text), key, self.language), "key": key}

    def _described(self, text: str) -> Description:
        """Return the cached description of a text, which must not be changed."""
        if self._read is None or text != self._read[0]:
            self._read = text, self._fresh(text)
        return self._read[1]

    def _fresh(self, text: str) -> Description:
        path, here = self._path, Path.cwd()
        name = "text" if path is None else str(path.relative_to(here) if path.is_relative_to(here) else path)
        if len(text.encode("utf-8", "replace")) > files.MAX_MACHINE_FILE:
            raise CrankworkError(ErrorMessage("path_large_kb", path=name, size=files.MAX_MACHINE_FILE >> 10))
        return Description(text, name, folder=path and path.parent)

    def _computed(self, text: str) -> Results:
        """Return the cached results of a text."""
        if self._results is None or text != self._text:
            description = self._described(text)
            self._check_files(description)
            self._results = analyse(description.machine())
            self._text = text
        return self._results

    def _ahead(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the live preview of a number; empty if it is not available."""
        text, names = request["text"], request.get("figures") or ()
        low, high = str(request.get("low", "")), str(request.get("high", ""))
        try:
            results, description = self._computed(text), self._described(text)
            preview, steps = live_preview(results, description, request["key"], names, self.language, (low, high))
        except CrankworkError:
            return {}
        return {"ahead": preview, "steps": steps}

    def _live_update(self, results: Results, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the figures that the live preview leaves out, and the machine if it is requested."""
        film = film_of(results, language=self.language) if request.get("machine") else None
        update = self._drawn(results, request.get("figures") or (), film, only_read=True)
        return update if film is None else update | {"film": inline_film(film, "machine")}

    def _drawn(
        self, results: Results, wanted: Collection[str], film: Animation | None, *, only_read: bool = False
    ) -> dict[str, Any]:
        """Return the selected figures and the page data."""
        shown = drawings(results, language=self.language, only=set(wanted))
        data = page_data(results, shown, film, self.language, only_read=only_read)
        for name, drawing in shown.items():
            data["figures"][name]["told"] = alt_text(drawing)
            for k, plot in enumerate(drawing.plots):
                data["figures"][name]["plots"][k] |= frame_data(plot)
        figures = {name: inline_svg(figure, name, figure.title, frame_marks(figure)) for name, figure in shown.items()}
        return {"data": data, "figures": figures}

    def _seen(self, results: Results, wanted: Collection[str] | None) -> dict[str, Any]:
        """Return what the page shows of results: the machine, the selected figures, single values."""
        language = self.language
        names = figure_names(results, language)
        film = film_of(results, language=language, forces=True)
        seen = self._drawn(results, _first(names) if wanted is None else wanted, film)
        seen["film"] = "" if film is None else inline_film(film, "machine") + "".join(controls(film, language))
        seen["data"]["tables"] = tables(results, seen["data"], language)
        warning = warning_text(results, language)
        return {
            **seen, "title": title_of(results, language),
            "cards": "".join(cards(results, results.trace, language)), "method": results_method(results, language),
            "dyads": dyads(results.machine) if results.machine.linkage else [], "places": _places(results),
            "names": {name: figure_title(name, language) for name in names},
            "values": "".join((*values(results, results.trace, language), *sentences(results, language))),
            "notices": [notice_text(notice.code, notice.values, language) for notice in results.notices],
            "summary": dict(results.summary),
            "scales": {key: (scale(key)[0], unit_name(key_unit(key), language)) for key in results.summary},
            "checks": [len(results.checks) - len(results.unmet), len(results.checks)],
            **({"doubt": warning} if warning else {}),
        }  # fmt: skip

    def _error_lines(self, error: CrankworkError) -> list[dict[str, Any]]:
        """Return errors as the command line prints them, files by their names alone, each with its line or 0."""
        lines, places, keys = [in_language(error.args[0], self.language)], [""], [""]
        if isinstance(error, InputError):
            lines = error.lines(lambda message: in_language(message, self.language))
            places, keys = error.places, [problem.key for problem in error.problems]
        matches = (_LINE.search(place) or _PLACE.match(line) for place, line in zip(places, lines, strict=True))
        numbers = (int(match[1]) if match else 0 for match in matches)
        shown = (line.replace(str(self._path), self._path.name) if self._path else line for line in lines)
        named = zip(shown, keys, numbers, strict=True)
        return [{"text": text, "key": key, "line": number} for text, key, number in named]


def _places(results: Results) -> dict[str, tuple[float, float]]:
    """Return the joint positions of a linkage in the first row. [mm]"""
    if not results.machine.linkage:
        return {}
    ground = {name: tuple(position) for name, position in results.machine.drawn.ground.items()}
    keys = {key_of(key).owner for key in results.columns if key.startswith("point_x.")}
    moving = {name: tuple(float(results.columns[f"point_{axis}.{name}"][0]) for axis in "xy") for name in keys}
    return {name: (round(1e3 * x, 6), round(1e3 * y, 6)) for name, (x, y) in (ground | moving).items()}


def _first(names: Sequence[str]) -> list[str]:
    """Return the figures shown initially: curves before constructions."""
    built = ("plan", "plans", "lever", "centrodes", "brix", "tolle", "paths")
    return sorted(names, key=lambda name: name.endswith(built))[:3]


def _files(description: Description) -> list[str]:
    """Return the names of files in a description."""
    return [str(description[key]) for key in description if key.rpartition(".")[2] == "file"]


def _written(results: Results, name: str, language: Language) -> bytes:
    """Return results as a file of a name: machine.gif, figure.svg, sheets.zip, page.html, tables.xlsx, note.pdf."""
    stem, _, ending = name.rpartition(".")
    match stem, ending:
        case "page", "html":
            return page(results, language)
        case "tables", "xlsx":
            return workbook(results, language=language)
        case "machine", "gif" | "svg" | "mp4":
            return drawn(results, ending, "colour", language=language, forces=False)
        case "sheets", "zip":
            return _zipped(sheets_of(results, NoteOptions(language=language, sheets=True)))
        case "note", _:
            return written_note(note_of(results, NoteOptions(language=language)), name)
        case _, _ if ending in FORMATS and (figures := drawings(results, language=language, only=(stem,))):
            return FORMATS[ending](figures[stem], "print")
    raise CrankworkError(
        ErrorMessage("figure_unknown", name=name[:60], known=", ".join(figure_names(results, language)))
    )


def _zipped(contents: Mapping[str, bytes]) -> bytes:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as folder:
        for name, data in contents.items():
            # without the date, so that equal contents give equal bytes
            folder.writestr(zipfile.ZipInfo(name.lstrip("-")), data)
    return held.getvalue()


def shared(text: str) -> str:
    """Return a machine file encoded as one word.

    Examples
    --------
    >>> opened_share(shared("[crank]"))
    '[crank]'
    """
    squeezed = zlib.compress(text.encode(), 9)
    return SHARE + base64.urlsafe_b64encode(squeezed).decode().rstrip("=")


def is_share(word: str) -> bool:
    """Return whether a text may be an encoded machine rather than the name of a file."""
    return word.startswith(SHARE) or is_pmks(word)


def opened_share(word: str, language: Language = "en") -> str:
    """Decode the machine file of a word, of the studio or of PMKS+."""
    if is_pmks(word):
        return from_pmks(word, language)
    letters = "".join(word.split()).removeprefix(SHARE)
    try:
        squeezed = base64.b64decode(letters + "=" * (-len(letters) % 4), altchars="-_", validate=True)
        unfolded = zlib.decompressobj()
        data = unfolded.decompress(squeezed, files.MAX_MACHINE_FILE + 1)
        text = data.decode()
    except (binascii.Error, zlib.error, ValueError):
        raise CrankworkError(ErrorMessage("share_damaged")) from None
    if not unfolded.eof or len(data) > files.MAX_MACHINE_FILE:
        raise CrankworkError(ErrorMessage("share_damaged"))
    return text


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


def full_turn(
    description: Description, results: Results, handles: Iterable[Mapping[str, Any]], language: Language
) -> dict[str, str] | None:
    """Return the least change of one length that lets a rocking crank turn fully; None if there is none."""
    crank_range, mechanism = results.machine.way, results.machine.mechanism
    if crank_range is None or crank_range.is_whole or not isinstance(mechanism.driver, Crank):
        return None
    stated = {handle["key"]: handle for handle in handles}
    choices = []
    for bound in full_turn_bounds(mechanism):
        handle = stated.get(bound.key)
        if handle is None or handle["power"] != 1:
            continue
        value = _rounded(float(from_si(bound.length, handle["unit"])), bound.sign)
        if value > 0:
            choices.append((abs(value / handle["number"] - 1), bound, f"{value:g} {handle['unit']}", value))
    for _, bound, written, value in sorted(choices):
        try:
            other = description.machine([f"{bound.key}={written}"])
        except CrankworkError:
            continue
        if other.way is None or other.way.is_whole:
            name = bound.key.rpartition(".")[0].removeprefix("links.")
            name = bound.key if name.isdigit() else name
            shown = f"{number(value, language)} {unit_name(stated[bound.key]['unit'], language)}"
            start, end = (number(round(angle, 1), language) for angle in (crank_range.start, crank_range.end))
            text = translate(
                "studio.full_turn", language, name=name, sign=bound.sign, value=shown, start=start, end=end
            )
            return {
                "key": bound.key,
                "value": written,
                "text": text,
                "use": translate("studio.use", language, value=shown),
            }
    return None


def _rounded(value: float, sign: str) -> float:
    """Return a bound rounded to the side where it holds; at the bound itself links come into line."""
    step = 10.0 ** (math.floor(math.log10(abs(value) or 1.0)) + 1 - _DIGITS)
    parts = value / step
    slack = _BOUND_ERROR * abs(parts)
    steps = math.floor(parts + slack) + 1 if sign == "≥" else math.ceil(parts - slack) - 1
    return round(steps * step, 12)


def dependent_results(results: Results, description: Description, key: str, language: Language) -> dict[str, list[str]]:
    """Return the single values and columns that change with a number.

    `description`: that of the results; it is changed.
    """
    rows = (row for group in form(description, language) for row in group["rows"])
    row = next((row for row in rows if row["key"] == key and "number" in row), None)
    if row is None:
        return {"values": [], "columns": []}
    number = row["number"]
    size = 1 if row.get("whole") else _MOVED * (abs(number) or 1.0)
    try:
        moved = _moved(description, key, f"{number + size:.9g}{row['after']}", language)
    except CrankworkError:
        moved = _moved(description, key, f"{number - size:.9g}{row['after']}", language)
    values = [name for name, value in results.summary.items() if not _same(value, moved.summary.get(name))]
    columns = [name for name, column in results.columns.items() if not _same(column, moved.columns.get(name))]
    return {"values": values, "columns": columns}


def _moved(description: Description, key: str, text: str, language: Language) -> Results:
    description[key] = stated_text(description, key, text, language)
    return analyse(description.machine())


def _same(value: object, other: object) -> bool:
    a, b = np.asarray(value, dtype=float), np.asarray(np.nan if other is None else other, dtype=float)
    return a.shape == b.shape and bool(
        np.allclose(a, b, rtol=_SAME, atol=_SAME * float(np.max(np.abs(a), initial=0.0)), equal_nan=True)
    )


class StoppedError(Exception):
    """The client has disconnected."""


def run_experiment(
    description: Description, request: Mapping[str, Any], language: Language, progress: Callable[[float], None]
) -> dict[str, Any]:
    """Return text and figures of a map over `over`, ranges by key, or of `count` designs drawn from these."""
    over = {str(key): str(ends) for key, ends in request["over"].items()}
    if request.get("count"):
        return _swept(description, over, request, language, progress)
    parameter_map = mapped(description, [f"{key}={ends}" for key, ends in over.items()], (), progress)
    return {"text": map_text(parameter_map, language), "figures": _figures(map_drawings(parameter_map, language))}


def _swept(
    description: Description, over: Mapping[str, str], request: Mapping[str, Any], language: Language,
    progress: Callable[[float], None],
) -> dict[str, Any]:  # fmt: skip
    ends = {key: dict(zip(("from", "to"), ends_of(text), strict=True)) for key, text in over.items()}
    if not re.fullmatch("[0-9]{1,9}", str(request["count"])):
        raise CrankworkError(ErrorMessage("whole_range", value=str(request["count"])[:20], low="1", high="1000000"))
    text = document({
        "machine": "machine.toml",
        "designs": {"drawing": "sobol", "count": int(request["count"])},
        "vary": ends,
        "objectives": {str(key): str(sense) for key, sense in request.get("objectives", {}).items()},
    })  # fmt: skip
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        files.write_files({Path(folder) / "machine.toml": description.dump().encode()})
        study = read_study(text, "study", folder=Path(folder))
        done: Callable[[int], None] = lambda count: progress(count / study.count)  # noqa: E731
        aggregate = run_study(study, Path(folder) / "found", ExecutionOptions(1), progress=done)
        drawn = found_drawings(study, aggregate, language)
        return {"text": found_text(study, aggregate, language), "figures": _figures(drawn)}


def _figures(drawn: Mapping[str, Drawing]) -> dict[str, tuple[str, str]]:
    """Return figures by name, each with its title."""
    return {name: (drawing.title, inline_svg(drawing, name, drawing.title)) for name, drawing in drawn.items()}

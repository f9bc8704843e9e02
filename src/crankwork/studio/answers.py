"""What the studio is told of a machine file: refusals at their lines, the form, the machine, its figures and values."""

from __future__ import annotations

import base64
import binascii
import io
import re
import zipfile
import zlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from crankwork import files
from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import template
from crankwork.description.origins import origins_of
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import Language, Refusal, told
from crankwork.locale.numbers import unit_name
from crankwork.note.contents import note_of, sheets_of, written_note
from crankwork.note.explain import place_text
from crankwork.note.live import controls, page_data
from crankwork.note.options import NoteOptions
from crankwork.page.document import page, tables, values
from crankwork.page.memories import Memories
from crankwork.report.drawing import drawn, film_of
from crankwork.report.figure_data import figure_title
from crankwork.report.figures import drawings, figure_names
from crankwork.report.language import displayed, key_unit
from crankwork.report.notices import notice_text
from crankwork.report.summary import results_method, warning_text
from crankwork.report.workbook import workbook
from crankwork.show.alt import alt_text
from crankwork.show.formats import FORMATS
from crankwork.show.inline import frame_data, frame_marks, inline_film, inline_svg
from crankwork.show.moving import Animation
from crankwork.studio.additions import additions, with_addition
from crankwork.studio.ahead import ahead
from crankwork.studio.form import form, stated_text
from crankwork.studio.full_turn import full_turn
from crankwork.studio.handles import dyads, handles
from crankwork.studio.pmks import from_pmks, is_pmks
from crankwork.studio.reach import reached
from crankwork.studio.sketch import measured, missing, redrawn, sketched, swapped
from crankwork.studio.trials import tried
from crankwork.units import use_units

SHARE = "crankwork:"
_LINE = re.compile(r":(\d+)$")
_PLACE = re.compile(r"^.{0,400}?:(\d+): ", re.DOTALL)


class Studio:
    """What one page of the studio asks for; it keeps the results of the text that was told last, and nothing else."""

    def __init__(self, language: Language, path: Path | None = None, *, reads: bool = False) -> None:
        self.language: Language = language
        self._path, self._reads = path, reads or path is not None
        self._text: str | None = None
        self._results: Results | None = None
        self._read: tuple[str, Description] | None = None

    def stand(self, path: Path | None, *, reads: bool) -> None:
        """Let the next text stand in a file, or in none; `reads`: whether it may name files all the same."""
        if path != self._path:
            # what it names lies elsewhere
            self._path, self._text, self._read = path, None, None
        self._reads = reads or path is not None

    def answer(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return what is answered to what a page asks for."""
        asks: dict[str, Callable[[Mapping[str, Any]], dict[str, Any]]] = {
            "show": self._show, "set": self._set, "without": self._without, "template": self._template,
            "shared": self._shared, "sketch": self._sketch, "explain": self._explain, "add": self._add,
            "ahead": self._ahead, "reach": self._reach, "missing": self._missing, "swap": self._swap,
        }  # fmt: skip
        try:
            return asks[asked["do"]](asked)
        except CrankworkError as error:
            return {"refusals": self._told(error)}

    def export(self, text: str, name: str) -> bytes:
        """Return the machine of a text as a file: its name says as what."""
        return _written(self._computed(text), name, self.language)

    def _check_files(self, description: Description) -> None:
        if not self._reads and (named := _files(description)):
            raise CrankworkError(Refusal("studio_files", names=named))

    def tried(self, asked: Mapping[str, Any], told: Callable[[float], None]) -> dict[str, Any]:
        """Return what is found over ranges of numbers, or of designs drawn from them."""
        try:
            description = self._fresh(asked["text"])
            self._check_files(description)
            return tried(description, asked, self.language, told)
        except CrankworkError as error:
            return {"refusals": self._told(error)}

    def _show(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return all that is seen of a text; what of it is known where it is refused."""
        text = asked["text"]
        try:
            description = self._described(text)
        except CrankworkError as error:
            return {"refusals": self._told(error)}
        found: dict[str, Any] = {"refusals": []}
        groups = () if asked.get("held") else form(description, self.language)
        if groups:
            found["form"] = groups
        if not self._reads and (named := _files(description)):
            return {**found, "named": named}
        try:
            results = self._computed(text)
        except CrankworkError as error:
            return {**found, "additions": self._additions(description, None), "refusals": self._told(error)}
        with use_units(results.machine.units):
            if asked.get("held"):
                return found | self._held(results, asked)
            found |= {
                "additions": self._additions(description, results),
                "handles": handles(description.values, groups),
            }
            needed = full_turn(description, results, found["handles"], self.language)
            return {**found, **self._seen(results, asked.get("figures")), "turn": needed}

    def _additions(self, description: Description, results: Results | None) -> list[tuple[str, str]]:
        return [(one.key, one.told(self.language)) for one in additions(description, results)]

    def _set(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """State what was typed into fields, and show what comes of it."""
        description = self._fresh(asked["text"])
        for key, one in asked["fields"].items():
            description[key] = stated_text(description, key, one, self.language)
        text = description.dump()
        return {"text": text, **self._show({**asked, "text": text})}

    def _without(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Take a field out, and show what comes of it."""
        description = self._fresh(asked["text"])
        # of a point both coordinates go
        del description[asked["key"].removesuffix("[1]").removesuffix("[2]")]
        text = description.dump()
        return {"text": text, **self._show({**asked, "text": text})}

    def _template(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        text = template(asked["name"], self.language)
        return {"text": text, **self._show({**asked, "text": text})}

    def _shared(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        text = opened_share(asked["word"], self.language)
        # who sent it is not asked for files of this machine
        self._reads = False
        return {"text": text, **self._show({**asked, "text": text})}

    def _sketch(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        text = sketched(asked, self.language)
        if asked.get("before"):
            try:
                before = self._described(sketched(asked["before"], self.language)).values
            except CrankworkError:
                before = {}
            text = redrawn(self._fresh(asked["text"]), before, self._described(text).values)
        return {"text": text, **self._show({**asked, "text": text})}

    def _swap(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Put a dyad together the other way, and show what comes of it."""
        text = swapped(self._fresh(asked["text"]), asked["key"], self._computed(asked["text"]).machine)
        return {"text": text, **self._show({**asked, "text": text})}

    def _missing(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return what a sketch is as far as it goes, and what was typed of its next link."""
        return {"missing": missing(asked, self.language), "measured": measured(asked["typed"], self.language)}

    def _add(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Add what was chosen, and show what comes of it with a diagram that was not there before."""
        description = self._described(asked["text"])
        try:
            results = self._computed(asked["text"])
        except CrankworkError:
            results = None
        before = () if results is None else figure_names(results, self.language)
        one = next((one for one in additions(description, results) if one.key == asked["key"]), None)
        added = description if one is None else with_addition(description, one)
        text = added.dump()
        found = self._show({**asked, "text": text})
        fresh = [name for name in found.get("names", ()) if name not in before]
        if fresh and asked.get("figures") is not None:
            brought = _first(fresh)[0]
            found = self._show({**asked, "text": text, "figures": [*asked["figures"], brought]}) | {"brought": brought}
        return {"text": text, "added": [key for key in added if key not in description], **found}

    def _explain(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return how a value came about."""
        results, key = self._computed(asked["text"]), asked["key"]
        origin = origins_of(asked["text"])

        def place(path: str, numbers: Iterable[float]) -> str:
            return place_text(origin(path, numbers), self.language)

        with use_units(results.machine.units):
            columns = page_data(results, {}, None, self.language)["columns"]
            return {"memories": Memories(results, self.language, place, columns).of([key]), "key": key}

    def _reach(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return what a number reaches."""
        results = self._computed(asked["text"])
        return {"reach": reached(results, self._fresh(asked["text"]), asked["key"], self.language), "key": asked["key"]}

    def _described(self, text: str) -> Description:
        """Return a text as it is read, which nobody changes; of the same text once."""
        if self._read is None or text != self._read[0]:
            self._read = text, self._fresh(text)
        return self._read[1]

    def _fresh(self, text: str) -> Description:
        name = _shown(self._path) if self._path else "text"
        if len(text.encode("utf-8", "replace")) > files.MAX_MACHINE_FILE:
            raise CrankworkError(Refusal("path_large_kb", path=name, size=files.MAX_MACHINE_FILE >> 10))
        return Description(text, name, folder=self._path and self._path.parent)

    def _computed(self, text: str) -> Results:
        """Return the results of a text, of the same text once."""
        if self._results is None or text != self._text:
            description = self._described(text)
            self._check_files(description)
            self._results = analyse(description.machine())
            self._text = text
        return self._results

    def _ahead(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return what calculates a page while a number is held, nothing where no browser can."""
        text, names = asked["text"], asked.get("figures") or ()
        low, high = str(asked.get("low", "")), str(asked.get("high", ""))
        try:
            results, description = self._computed(text), self._described(text)
            found, steps = ahead(results, description, asked["key"], names, self.language, (low, high))
        except CrankworkError:
            return {}
        return {"ahead": found, "steps": steps}

    def _held(self, results: Results, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return what of results does not follow a number that is held: figures, and the machine if it is asked for."""
        film = film_of(results, language=self.language) if asked.get("machine") else None
        found = self._drawn(results, asked.get("figures") or (), film, only_read=True)
        return found if film is None else found | {"film": inline_film(film, "machine")}

    def _drawn(
        self, results: Results, wanted: Collection[str], film: Animation | None, *, only_read: bool = False
    ) -> dict[str, Any]:
        """Return the figures that are wanted, and what a page keeps of results."""
        shown = drawings(results, language=self.language, only=set(wanted))
        data = page_data(results, shown, film, self.language, only_read=only_read)
        for name, one in shown.items():
            data["figures"][name]["told"] = alt_text(one)
            for k, plot in enumerate(one.plots):
                data["figures"][name]["plots"][k] |= frame_data(plot)
        figures = {name: inline_svg(one, name, one.title, frame_marks(one)) for name, one in shown.items()}
        return {"data": data, "figures": figures}

    def _seen(self, results: Results, wanted: Collection[str] | None) -> dict[str, Any]:
        """Return what is seen of results: the machine, the figures that are wanted, single values."""
        language = self.language
        names = figure_names(results, language)
        film = film_of(results, language=language, forces=True)
        found = self._drawn(results, _first(names) if wanted is None else wanted, film)
        found["film"] = "" if film is None else inline_film(film, "machine") + "".join(controls(film, language))
        found["data"]["tables"] = tables(results, found["data"], language)
        warning = warning_text(results, language)
        return {
            **found, "title": results.machine.title, "method": results_method(results, language),
            "dyads": dyads(results.machine) if results.machine.linkage else [], "places": _places(results),
            "names": {name: figure_title(name, language) for name in names},
            "values": "".join(values(results, results.memory, language)),
            "notices": [notice_text(one.code, one.values, language) for one in results.notices],
            "summary": dict(results.summary),
            "scales": {key: _scale(key, language) for key in results.summary},
            "checks": [len(results.checks) - len(results.unmet), len(results.checks)],
            **({"doubt": warning} if warning else {}),
        }  # fmt: skip

    def _told(self, error: CrankworkError) -> list[dict[str, Any]]:
        """Return refusals as the command line tells them, each with its line where it has one."""
        if isinstance(error, InputError):
            lines = error.lines(lambda message: told(message, self.language))
            found = zip(lines, error.places, error.problems, strict=True)
            return [
                {"text": line, "key": problem.key, "line": int(at[1]) if (at := _LINE.search(place)) else 0}
                for line, place, problem in found
            ]
        text = told(error.args[0], self.language)
        at = _PLACE.match(text)
        return [{"text": text, "key": "", "line": int(at[1]) if at else 0}]


def _places(results: Results) -> dict[str, tuple[float, float]]:
    """Return where the joints of a linkage stand in the first row. [mm]"""
    if not results.machine.linkage:
        return {}
    ground = {name: tuple(at) for name, at in results.machine.drawn.ground.items()}
    keys = {key.partition(".")[2] for key in results.columns if key.startswith("point_x.")}
    moving = {name: tuple(float(results.columns[f"point_{axis}.{name}"][0]) for axis in "xy") for name in keys}
    return {name: (round(1e3 * x, 6), round(1e3 * y, 6)) for name, (x, y) in (ground | moving).items()}


def _first(names: Sequence[str]) -> list[str]:
    """Return the figures that are seen before any was chosen: curves sooner than constructions."""
    return sorted(names, key=lambda name: name.endswith(("plan", "plans", "lever", "centrodes", "brix", "tolle")))[:3]


def _scale(key: str, language: Language) -> tuple[float, str]:
    """Return the factor by which a difference of a value is shown, and its unit."""
    return displayed(key, 1.0) - displayed(key, 0.0), unit_name(key_unit(key), language)


def _shown(path: Path) -> str:
    """Return a path as whoever stands in this folder would type it."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def _files(description: Description) -> list[str]:
    """Return the names of files that a description names."""
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
        case _, _ if ending in FORMATS and (found := drawings(results, language=language, only=(stem,))):
            return FORMATS[ending](found[stem], "print")
    raise CrankworkError(Refusal("figure_unknown", name=name[:60], known=", ".join(figure_names(results, language))))


def _zipped(found: Mapping[str, bytes]) -> bytes:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as folder:
        for name, data in found.items():
            # the same bytes whenever it is written
            folder.writestr(zipfile.ZipInfo(name.lstrip("-")), data)
    return held.getvalue()


def shared(text: str) -> str:
    """Return a machine file as one word, to be sent and opened elsewhere.

    Examples
    --------
    >>> opened_share(shared("[crank]"))
    '[crank]'
    """
    squeezed = zlib.compress(text.encode(), 9)
    return SHARE + base64.urlsafe_b64encode(squeezed).decode().rstrip("=")


def is_share(word: str) -> bool:
    """Return whether a text may be a machine that was sent, and no name of a file."""
    return word.startswith(SHARE) or is_pmks(word)


def opened_share(word: str, language: Language = "en") -> str:
    """Return the machine file of a word that was sent, here or by PMKS+."""
    if is_pmks(word):
        return from_pmks(word, language)
    letters = "".join(word.split()).removeprefix(SHARE)
    try:
        squeezed = base64.b64decode(letters + "=" * (-len(letters) % 4), altchars="-_", validate=True)
        unfolded = zlib.decompressobj()
        data = unfolded.decompress(squeezed, files.MAX_MACHINE_FILE + 1)
        text = data.decode()
    except (binascii.Error, zlib.error, ValueError):
        raise CrankworkError(Refusal("share_damaged")) from None
    if not unfolded.eof or len(data) > files.MAX_MACHINE_FILE:
        raise CrankworkError(Refusal("share_damaged"))
    return text

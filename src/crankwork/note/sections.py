"""The note of a machine and its sheets: a cover, and sections of its school or those that its document names."""

from __future__ import annotations

import datetime as dt
import itertools
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import PurePath
from typing import cast

from crankwork.analysis import Results
from crankwork.analysis.all_cylinders import with_engine_results
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage, Language, translate
from crankwork.machine import Document
from crankwork.note import closing, cylinders, data, forces, gas, motion, torque
from crankwork.note.captions import printed_date, printed_unit
from crankwork.note.document import (
    Block,
    Contents,
    Equation,
    ItemList,
    Math,
    Note,
    Paragraph,
    Person,
    Reference,
    Table,
    TitlePage,
)
from crankwork.note.legends import meanings
from crankwork.note.material import Material
from crankwork.note.numbering import equation_source
from crankwork.note.options import NoteOptions
from crankwork.note.parts import Section, written
from crankwork.note.pdf import pdf
from crankwork.note.tables import symbol_table
from crankwork.note.web import web
from crankwork.note.word import word
from crankwork.quantities.quantity import use_numbers
from crankwork.report.display import for_readers, link_numbers, reader_units
from crankwork.report.gas import FOUR_STROKE
from crankwork.report.summary import provenance
from crankwork.show.formats import dxf
from crankwork.show.formats import pdf as page
from crankwork.show.svg import svg
from crankwork.units import use_units

# who stands on a cover, in the order of each language, and who signs beside the name
_PEOPLE: dict[Language, tuple[str, ...]] = {
    "en": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "ru": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "vi": ("supervisor", "author", "student_number", "group", "checked_by", "standards_by", "approved_by"),
}
# tables of values that name their symbols
_OF_VALUES = ("t:data", "t:cycle_data", "t:cycle_results")
_SIGN = ("author", "supervisor", "checked_by", "standards_by", "approved_by")


# sections in the order of a school; those that results have nothing for are left out
_LINKAGE = (
    "summary", "task", "test", "clutch", "structure", "planes", "static", "dynamic", "driving", "moments", "energy",
    "kinematics", "quality", "chambers", "stages", "forces", "balance", "reduction", "torques", "friction", "bearings",
    "harmonics", "motor", "flywheel", "law_of_motion", "torsion", "transient", "comparison", "checks", "conclusion",
    "nomenclature", "sources", "appendix",
)  # fmt: skip
# sections of a linkage that the main course leaves out
_FULL = ("bearings",)
_CRANK_GEAR: dict[str, tuple[str, ...]] = {
    "ru": (
        "summary", "data", "nomenclature", "cycle", "indicator", "burning", "test", "kinematics", "dynamics", "torque",
        "crankpin", "mains", "balance", "evenness", "motor", "torsion", "comparison", "checks", "conclusion", "sources",
        "appendix",
    ),
    # after the data the twelve sections that such notes have, then what conclusions refer to
    "vi": (
        "summary", "data", "nomenclature", "cycle", "indicator", "burning", "test", "displacement", "velocity",
        "acceleration", "inertia", "piston_forces", "crank_forces", "torque", "polar", "unrolled", "big_end", "wear",
        "mains", "balance", "evenness", "motor", "torsion", "comparison", "checks", "conclusion", "sources", "appendix",
    ),
    "en": (
        "summary", "data", "method", "nomenclature", "cycle", "indicator", "burning", "test", "kinematics", "dynamics",
        "torque", "crankpin", "mains", "balance", "evenness", "motor", "torsion", "comparison", "checks", "conclusion",
        "sources", "appendix",
    ),
}  # fmt: skip
# every section of a note; of several with one name the first whose condition holds
SECTIONS: tuple[Section, ...] = (
    *data.SECTIONS, *motion.SECTIONS, *gas.SECTIONS, *forces.SECTIONS,
    *torque.SECTIONS, *cylinders.SECTIONS, *closing.SECTIONS,
)  # fmt: skip


def sections_of(material: Material) -> dict[str, Section]:
    """Return the sections of a note by name, as far as the results have anything for them."""
    return {section.name: section for section in reversed(SECTIONS) if section.when(material)}


def _order(material: Material) -> tuple[str, ...]:
    if material.has_piston:
        return _CRANK_GEAR[material.order]
    return tuple(name for name in _LINKAGE if material.full or name not in _FULL)


def note_of_sections(results: Results, options: NoteOptions) -> Note:
    """Return the note of a machine behind its cover and contents: sections of its school, or those that it names.

    What a note cites stands in its list of sources and its symbols in their own, which are always there.
    """
    if options.order not in _CRANK_GEAR:
        raise CrankworkError(f'no school of notes is called "{options.order}"; take en, ru or vi')
    material = Material(with_engine_results(results), options, has_engine=results.machine.engine is not None)
    document, words = material.machine.document, material.words
    if options.author.strip():
        document = replace(document, author=(options.author,))
    chosen = document.sections
    if chosen:
        chosen = (*chosen, *(name for name in ("nomenclature", "sources") if name not in chosen))
    known = sections_of(material)
    parts = itertools.chain.from_iterable(known[name].parts for name in chosen or _order(material) if name in known)
    blocks = tuple(_with_nomenclature(_cited_once(written(parts, material), material.words.language), material))
    made, subtitle = _titles(material)
    own, title_page = (
        getattr(document, f"title_{options.language}"),
        cover(document, options.language, words.title(subtitle)),
    )
    title = own or material.machine.title
    if title and not own and not _speaks(title, options.language):
        # the title of the file stands below that of its language
        title, title_page = "", replace(title_page, below=(title, *title_page.below))
    front: list[Block] = [title_page]
    if options.full or not title_page.is_plain:
        front.append(Contents())
    return Note(
        options.title or title or made,
        options.language,
        (*front, *(_complete(blocks) if chosen else blocks)),
        tuple(author for author in document.author if author.strip()),
        document.date,
    )


def _cited_once(blocks: Iterable[Block], language: Language) -> Iterator[Block]:
    """Yield blocks, where an equation cites its source unless one before it had the same."""
    cited = set[str]()
    for block in blocks:
        source = equation_source(block, language) if isinstance(block, Equation) else ""
        yield replace(block, cites=False) if isinstance(block, Equation) and source in cited else block
        cited.add(source)


def _with_nomenclature(blocks: Iterable[Block], material: Material) -> Iterator[Block]:
    """Yield blocks, the symbols of all equations listed below the heading that stands for them."""
    kept, words = list(blocks), material.words
    values = [block for block in kept if isinstance(block, Table) and block.label in _OF_VALUES]
    named = {cell.content for table in values for row in table.rows for cell in row if isinstance(cell, Math)}
    listed = [meaning for meaning in meanings(kept, words.language) if meaning.symbol not in named]
    # forces by the piston area are no forces
    newton = f", {printed_unit('N', words.language)}" if material.per_area else ""
    for block in kept:
        if getattr(block, "label", "") != closing.NOMENCLATURE:
            yield block
        elif listed:
            yield block
            yield words.paragraph("symbols_listed", table=Reference("t:nomenclature"))
            yield symbol_table([(Math(meaning.symbol), meaning.text.removesuffix(newton)) for meaning in listed], words)


# titles and subtitles where there is no mechanism
_ALONE = {
    "test": ("test", "test_subtitle"),
    "clutch": ("clutch", "clutch_subtitle"),
    "turning": ("turning", "turning_subtitle"),
    "torsion": ("torsion", "torsion_subtitle"),
    "rotor": ("rotor", "rotor_subtitle"),
    "stages": ("compressor", "compressor_subtitle"),
}


def _titles(material: Material) -> tuple[str, str]:
    """Return the title of a note that has none of its own, and the key of its subtitle."""
    words = material.words
    if material.has_piston:
        space = material.results.solved.space
        is_engine = space is not None and space.work > 0 and "bore" in material.summary
        return _engine_title(material) if is_engine else words.title("crank_gear"), "subtitle"
    if material.machine.alone:
        title, subtitle = _ALONE[material.machine.alone]
        return words.title(title), subtitle
    return words.title("tabulated" if material.results.has_positions else "linkage"), "linkage_subtitle"


def _engine_title(material: Material) -> str:
    """Return what an engine is: strokes, cylinders, bore and stroke, speed."""
    words, summary, engine = material.words, material.summary, material.machine.engine
    bore, stroke = (words.amount(summary[key], "mm", digits=4) for key in ("bore", "stroke"))
    several = engine is not None and len(engine.layout.places) > 1
    return translate(
        f"note.title_of_{'several' if several else 'one'}",
        words.language,
        engine=translate(
            "templates.title_engine" if material.machine.cycle == FOUR_STROKE else "note.two_stroke_engine",
            words.language,
        ),
        count=str(len(engine.layout.places)) if engine is not None else "1",
        size=f"{bore.rpartition(chr(160))[0]} × {stroke}",
        speed=words.amount(summary["rotational_speed"], "rpm", digits=4),
    )


def _own_title(results: Results, options: NoteOptions) -> str:
    """Return the title of the file where it is in the language, else what the machine is."""
    title = getattr(results.machine.document, f"title_{options.language}") or results.machine.title
    return title if title and _speaks(title, options.language) else _titles(Material(results, options))[0]


def _speaks(title: str, language: Language) -> bool:
    """Return whether a title may be in a language: by its letters."""
    letters = [letter for letter in title.lower() if letter.isalpha() and not letter.isascii()]
    is_russian = any("а" <= letter <= "ё" for letter in letters)
    return is_russian if language == "ru" else not is_russian and (language == "en" or bool(letters))


def _complete(blocks: Iterable[Block]) -> Iterator[Block]:
    """Yield blocks without the paragraphs that refer to sections that were not chosen."""
    kept = list(blocks)
    labels = {getattr(item, "label", "") for item in kept}
    for block in kept:
        parts = (block.runs,) if isinstance(block, Paragraph) else block.items if isinstance(block, ItemList) else ()
        references = {run.label for runs in parts for run in runs if isinstance(run, Reference)}
        if references <= labels:
            yield block


def cover(document: Document, language: Language, subtitle: str) -> TitlePage:
    """Return the cover; `subtitle` names the kind of note where the document does not."""
    named = {
        key: translate(f"note.cover_{key}", language, name=getattr(document, key)) for key in ("subject", "variant")
    }
    institution = (document.ministry, document.institution, document.faculty, document.department)
    above = (document.work, named["subject"] if document.subject else "")
    below = (document.subtitle or subtitle, document.designation, named["variant"] if document.variant else "")
    place = when = _when(document.date, document.year, language)
    if document.city:
        place = translate("note.cover_place", language, city=document.city, when=when).strip(", ")
    return TitlePage(
        institution=tuple(filter(None, institution)),
        above=tuple(filter(None, above)),
        below=tuple(filter(None, below)),
        people=tuple(person for key in _PEOPLE[language] if (person := _person(document, key, language)).names),
        place=place,
    )


def _person(document: Document, key: str, language: Language) -> Person:
    value = getattr(document, key)
    # a name left open in the file gets no line
    names = tuple(name for name in ((value,) if isinstance(value, str) else value) if name.strip())
    label = translate(f"note.cover_{'several_' if len(names) > 1 else ''}{key}", language)
    return Person(label, names, signs=language == "ru" and key in _SIGN)


def _when(date: dt.date | None, year: int, language: Language) -> str:
    """Return when a note was made as covers say it: the year alone, where reports in English give the day."""
    if date is not None:
        return printed_date(date, language) if language == "en" else str(date.year)
    return str(year) if year else ""


@for_readers
def note_of(results: Results, options: NoteOptions | None = None) -> Note:
    """Return the calculation note of a machine."""
    options = options or NoteOptions()
    with use_numbers(link_numbers(results)):
        note = note_of_sections(results, options)
    return replace(note, units=reader_units(results), provenance=provenance(results), results=results)


def sheets_of(results: Results, options: NoteOptions | None = None) -> dict[str, bytes]:
    """Return the drawing sheets of a machine in every format, by the ending of their files."""
    options = options or NoteOptions()
    if results.machine.alone:
        raise CrankworkError(ErrorMessage("sheets_of_shaft"))
    # few notes have sheets
    from crankwork.note import sheets  # noqa: PLC0415 - loaded where it is needed

    block = sheets.block_of(results.machine.document, cast("Language", options.order), options.author)
    block = block._replace(subject=block.subject or _own_title(results, options))
    paper = sheets.Paper(options.paper, has_grid=options.grid, block=block)
    with use_numbers(link_numbers(results)):
        drawn = sheets.drawn_sheets(results, options.language, paper=paper, per_area=options.per_area)
    formats = {"pdf": page, "svg": svg, "dxf": dxf}
    return {
        f"-sheet-{number}.{ending}": written(sheet.drawing, "black")
        for number, sheet in enumerate(drawn, start=1)
        for ending, written in formats.items()
    }


WRITERS = {".pdf": pdf, ".docx": word, ".html": web}
_MODULES: dict[str, dict[str, str]] = {".pdf": {"typst": "report"}, ".docx": {"docx": "report"}, ".html": {}}


def check_format(name: str, *, with_sheets: bool = False) -> None:
    """Raise unless a note of this format can be written, before anything is computed."""
    if PurePath(name).suffix.lower() not in WRITERS:
        raise CrankworkError(ErrorMessage("note_ending", name=name, known=", ".join(WRITERS)))
    modules = _MODULES[PurePath(name).suffix.lower()]
    if with_sheets:
        modules = modules | {"typst": "report", "ezdxf": "report"}
    if extras := missing_extras(modules):
        raise MissingExtraError(ErrorMessage("extra_note"), *extras)


def written_note(note: Note, name: str) -> bytes:
    """Return a note in the format that the ending of a file name asks for."""
    check_format(name)
    with use_units(note.units), use_numbers(link_numbers(note.results)):
        return WRITERS[PurePath(name).suffix.lower()](note)

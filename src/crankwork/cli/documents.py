"""Commands that write a machine as a document: the note, the page, and the machine drawn."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal

import click

from crankwork.cli.asked import Asked, asking, film_ending, place_of
from crankwork.cli.options import COMPARE, LANG, LANGUAGE, METHOD, NO_FIGURES, OVERWRITE, PER_AREA, SET, STEP, SYSTEM
from crankwork.cli.spoken import SpokenCommand
from crankwork.errors import CrankworkError
from crankwork.locale import Refusal
from crankwork.progress import bar

if TYPE_CHECKING:
    from pathlib import Path


@click.command(cls=SpokenCommand)
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="NOTE")
@STEP
@METHOD
@LANG
@click.option("--school", type=LANGUAGE)
@SYSTEM
@SET
@COMPARE
@PER_AREA
@click.option("--title", default="", metavar="TEXT")
@click.option("--author", default="", metavar="TEXT")
@NO_FIGURES
@click.option("--sheets", is_flag=True)
@click.option("--paper", type=click.Choice(["A0", "A1", "A2", "A3"]))
@click.option("--grid", is_flag=True)
@OVERWRITE
@asking
def report(  # noqa: PLR0913 - one argument per option of the command
    asked: Asked,
    output: str,
    school: str | None,
    title: str,
    author: str,
    paper: Literal["A0", "A1", "A2", "A3"] | None,
    *,
    sheets: bool,
    grid: bool,
) -> None:
    """Write the calculation note of a machine as PDF, Word or web page."""
    from crankwork.note.contents import check_format, written_note

    sheets = sheets or grid or paper is not None
    # before anything else is loaded
    check_format(output, with_sheets=sheets)
    from crankwork import files
    from crankwork.note.contents import note_of, sheets_of
    from crankwork.note.options import NoteOptions

    files.check_files(output, overwrite=asked.overwrite)
    options = NoteOptions(
        language=asked.language, school=school or "", per_area=asked.per_area, title=title.strip(),
        author=author.strip(), figures=not asked.no_figures, sheets=sheets, paper=paper or "A1", grid=grid,
    )  # fmt: skip
    results = asked.results()
    written: dict[str | Path, bytes] = {output: written_note(note_of(results, options), output)}
    if sheets:
        stem = os.path.splitext(output)[0]  # noqa: PTH122 - a name, not a file
        written |= {stem + ending: data for ending, data in sheets_of(results, options).items()}
    files.write_files(written, overwrite=asked.overwrite)
    asked.tell_written(", ".join(map(str, written)))
    asked.doubt(results)


@click.command(cls=SpokenCommand)
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@STEP
@METHOD
@LANG
@SYSTEM
@SET
@COMPARE
@click.option("--slider", "sliders", multiple=True, metavar="KEY[=FROM..TO]")
@OVERWRITE
@asking
def page(asked: Asked, output: str, sliders: tuple[str, ...]) -> None:
    """Write a machine as one web page: moving, diagrams to read, values explained."""
    from crankwork import files
    from crankwork.page.document import page as written

    if not output.lower().endswith((".html", ".htm")):
        raise CrankworkError(Refusal("page_ending", name=output))
    files.check_files(output, overwrite=asked.overwrite)
    results = asked.results()
    live = None
    if sliders:
        from crankwork.description.document import load
        from crankwork.study.sliders import moved

        live = moved(load(asked.file), sliders, asked.overrides, results)
    files.write_files({output: written(results, asked.language, asked.origin(), live)}, overwrite=asked.overwrite)
    asked.tell_written(output)
    asked.doubt(results)


@click.command(cls=SpokenCommand)
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@click.option("--at", metavar="DEG")
@click.option("--forces", is_flag=True)
@METHOD
@LANG
@SYSTEM
@SET
@click.option("--theme", type=click.Choice(["print", "colour", "dark"]), default="colour")
@OVERWRITE
@asking
def draw(asked: Asked, output: str, at: str | None, *, forces: bool) -> None:
    """Draw a machine as it moves, or as it stands at a crank angle."""
    ending = film_ending(output, is_still=at is not None)
    from crankwork import files
    from crankwork.report.drawing import drawn

    files.check_files(output, overwrite=asked.overwrite)
    results = asked.results()
    where = None if at is None else place_of(at, "time" if results.period else "angle")
    with bar() as telling:
        made = drawn(results, ending, asked.theme, where, asked.language, forces=forces, told=telling)
    files.write_files({output: made}, overwrite=asked.overwrite)
    asked.tell_written(output)
    asked.doubt(results)

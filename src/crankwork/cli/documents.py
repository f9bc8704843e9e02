"""Commands that write a document of a machine: the note, the page, the drawing."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal

import click

from crankwork.cli.asked import CommonOptions, drawing_ending, parse_angle_or_time, with_common_options
from crankwork.cli.options import (
    COMPARE,
    LANG,
    LANGUAGE,
    METHOD,
    NO_FIGURES,
    OVERWRITE,
    PER_AREA,
    SET,
    STEP,
    SYSTEM,
    LocalizedCommand,
)
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage
from crankwork.progress import progress_bar

if TYPE_CHECKING:
    from pathlib import Path


@click.command(cls=LocalizedCommand)
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
@click.option("--full", is_flag=True)
@NO_FIGURES
@click.option("--sheets", is_flag=True)
@click.option("--paper", type=click.Choice(["A0", "A1", "A2", "A3"]))
@click.option("--grid", is_flag=True)
@OVERWRITE
@with_common_options
def report(  # noqa: PLR0913 - one argument per option of the command
    options: CommonOptions,
    output: str,
    school: str | None,
    title: str,
    author: str,
    paper: Literal["A0", "A1", "A2", "A3"] | None,
    *,
    full: bool,
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

    files.check_files(output, overwrite=options.overwrite)
    note_options = NoteOptions(
        language=options.language, school=school or "", per_area=options.per_area, title=title.strip(),
        author=author.strip(), full=full, figures=not options.no_figures, sheets=sheets, paper=paper or "A1", grid=grid,
    )  # fmt: skip
    results = options.results()
    written: dict[str | Path, bytes] = {output: written_note(note_of(results, note_options), output)}
    if sheets:
        stem = os.path.splitext(output)[0]  # noqa: PTH122 - a name, not a file
        written |= {stem + ending: data for ending, data in sheets_of(results, note_options).items()}
    files.write_files(written, overwrite=options.overwrite)
    options.print_written(", ".join(map(str, written)))
    options.raise_if_unverified(results)


@click.command(cls=LocalizedCommand)
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
@with_common_options
def page(options: CommonOptions, output: str, sliders: tuple[str, ...]) -> None:
    """Write a machine as one web page: moving, diagrams to read, values explained."""
    from crankwork import files
    from crankwork.page.document import page as written

    if not output.lower().endswith((".html", ".htm")):
        raise CrankworkError(ErrorMessage("page_ending", name=output))
    files.check_files(output, overwrite=options.overwrite)
    results = options.results()
    live = None
    if sliders:
        from crankwork.description.document import load
        from crankwork.study.sliders import moved

        live = moved(load(options.file), sliders, options.overrides, results)
    files.write_files({output: written(results, options.language, options.origin(), live)}, overwrite=options.overwrite)
    options.print_written(output)
    options.raise_if_unverified(results)


@click.command(cls=LocalizedCommand)
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@click.option("--at", "place", metavar="DEG")
@click.option("--forces", is_flag=True)
@METHOD
@LANG
@SYSTEM
@SET
@click.option("--theme", type=click.Choice(["print", "colour", "dark"]), default="colour")
@OVERWRITE
@with_common_options
def draw(options: CommonOptions, output: str, place: str | None, *, forces: bool) -> None:
    """Draw a machine as it moves, or as it stands at a crank angle."""
    ending = drawing_ending(output, is_still=place is not None)
    from crankwork import files
    from crankwork.report.drawing import drawn

    files.check_files(output, overwrite=options.overwrite)
    results = options.results()
    angle_or_time = None if place is None else parse_angle_or_time(place, "time" if results.period else "angle")
    with progress_bar() as progress:
        drawing = drawn(
            results, ending, options.theme, angle_or_time, options.language, forces=forces, progress=progress
        )
    files.write_files({output: drawing}, overwrite=options.overwrite)
    options.print_written(output)
    options.raise_if_unverified(results)

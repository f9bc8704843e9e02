"""Commands that write a machine as a document: the note, the page, and the machine drawn."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Literal

import click

from crankwork.cli.asked import analysed, compared, doubt, film_ending, laid_over, machine_of, place_of
from crankwork.cli.options import COMPARE, LANG, LANGUAGE, METHOD, NO_FIGURES, OVERWRITE, PER_AREA, SET, STEP, SYSTEM
from crankwork.cli.spoken import SpokenCommand
from crankwork.errors import CrankworkError
from crankwork.locale import Language, Refusal, say
from crankwork.progress import bar

if TYPE_CHECKING:
    from pathlib import Path

    from crankwork.show.theme import Theme


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
def report(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    output: str,
    step: str | None,
    method: str | None,
    language: Language,
    school: str | None,
    units: str | None,
    settings: tuple[str, ...],
    compare: str | None,
    title: str,
    author: str,
    paper: Literal["A0", "A1", "A2", "A3"] | None,
    *,
    per_area: bool,
    no_figures: bool,
    sheets: bool,
    grid: bool,
    overwrite: bool,
) -> None:
    """Write the calculation note of a machine as PDF, Word or web page."""
    from crankwork.note.contents import check_format, written_note

    sheets = sheets or grid or paper is not None
    # before anything else is loaded
    check_format(output, with_sheets=sheets)
    from crankwork import files
    from crankwork.note.contents import note_of, sheets_of
    from crankwork.note.options import NoteOptions

    files.check_files(output, overwrite=overwrite)
    machine = machine_of(file, laid_over(settings, step, method, units), per_area=per_area)
    options = NoteOptions(
        language=language, school=school or "", per_area=per_area, title=title.strip(), author=author.strip(),
        figures=not no_figures, sheets=sheets, paper=paper or "A1", grid=grid,
    )  # fmt: skip
    results = compared(machine, file, compare, per_area=per_area)
    written: dict[str | Path, bytes] = {output: written_note(note_of(results, options), output)}
    if sheets:
        stem = os.path.splitext(output)[0]  # noqa: PTH122 - a name, not a file
        written |= {stem + ending: data for ending, data in sheets_of(results, options).items()}
    files.write_files(written, overwrite=overwrite)
    click.echo(f"{say('report.written', language)} {', '.join(map(str, written))}")
    doubt(file, results, language)


@click.command(cls=SpokenCommand)
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@STEP
@METHOD
@LANG
@SYSTEM
@SET
@COMPARE
@click.option("--slider", "asked", multiple=True, metavar="KEY[=FROM..TO]")
@OVERWRITE
def page(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    output: str,
    step: str | None,
    method: str | None,
    language: Language,
    units: str | None,
    settings: tuple[str, ...],
    compare: str | None,
    asked: tuple[str, ...],
    *,
    overwrite: bool,
) -> None:
    """Write a machine as one web page: moving, diagrams to read, values explained."""
    from crankwork import files
    from crankwork.description.origins import origins
    from crankwork.note.explain import place_text
    from crankwork.page.document import page as written

    if not output.lower().endswith((".html", ".htm")):
        raise CrankworkError(Refusal("page_ending", name=output))
    files.check_files(output, overwrite=overwrite)
    overrides = laid_over(settings, step, method, units)
    machine = machine_of(file, overrides, per_area=False)
    results = compared(machine, file, compare, per_area=False)
    origin = origins(file, overrides)

    def place(path: str, numbers: Iterable[float]) -> str:
        return place_text(origin(path, numbers), language)

    live = None
    if asked:
        from crankwork.description.document import load
        from crankwork.study.sliders import moved

        live = moved(load(file), asked, overrides, results)
    files.write_files({output: written(results, language, place, live)}, overwrite=overwrite)
    click.echo(f"{say('report.written', language)} {output}")
    doubt(file, results, language)


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
def draw(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    output: str,
    at: str | None,
    method: str | None,
    language: Language,
    units: str | None,
    settings: tuple[str, ...],
    theme: Theme,
    *,
    forces: bool,
    overwrite: bool,
) -> None:
    """Draw a machine as it moves, or as it stands at a crank angle."""
    ending = film_ending(output, is_still=at is not None)
    from crankwork import files
    from crankwork.report.drawing import drawn

    files.check_files(output, overwrite=overwrite)
    results = analysed(machine_of(file, laid_over(settings, None, method, units), per_area=False))
    where = None if at is None else place_of(at, "time" if results.period else "angle")
    with bar() as telling:
        made = drawn(results, ending, theme, where, language, forces=forces, told=telling)
    files.write_files({output: made}, overwrite=overwrite)
    click.echo(f"{say('report.written', language)} {output}")
    doubt(file, results, language)

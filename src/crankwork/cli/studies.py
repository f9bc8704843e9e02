"""The commands that calculate many designs."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from crankwork.cli.asked import Asked, asking, count_of, formats_of
from crankwork.cli.options import FORMAT, JSON, LANG, NO_FIGURES, OVERWRITE, SET, SYSTEM, THEME
from crankwork.cli.spoken import SpokenCommand
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import Refusal, say
from crankwork.progress import bar, counting

if TYPE_CHECKING:
    from crankwork.show.scene import Drawing
    from crankwork.show.theme import Theme

_MOST_WORKERS = 1024
_MODULES = {"pyarrow": "data", "scipy": "data"}


@click.command(cls=SpokenCommand)
@click.argument("study")
@click.option("-o", "--output", metavar="DIR", required=True)
@click.option("--workers", metavar="N")
@click.option("--scheduler", metavar="ADDRESS")
@click.option("--resume", is_flag=True)
@LANG
@SET
@JSON
@NO_FIGURES
@FORMAT
@THEME
@asking
def sweep(asked: Asked, study: str, output: str, workers: str | None, scheduler: str | None, *, resume: bool) -> None:
    """Calculate the designs of a study: the best, the Pareto set, histograms and what matters."""
    from crankwork import files
    from crankwork.study.found_figures import found_drawings
    from crankwork.study.found_text import found_data, found_files, found_text
    from crankwork.study.running import ExecutionOptions, run_study
    from crankwork.study.study_file import load_study

    where = ExecutionOptions(_number_of(workers, scheduler), scheduler or "")
    wanted = () if asked.no_figures else formats_of(asked.formats)
    wished = load_study(study, asked.settings)
    if extras := missing_extras(_MODULES):
        raise MissingExtraError(Refusal("extra_study"), *extras)
    started = time.monotonic()
    try:
        with counting(wished.count) as told:
            found = run_study(wished, output, where, resume=resume, progress=told)
    except KeyboardInterrupt:
        click.echo(f"\n{say('study.stopped', asked.language)}", err=True)
        raise
    drawn = found_drawings(wished, found, asked.language) if wanted else {}
    contents = found_files(wished, found) | _figures(drawn, wanted, asked.theme)
    files.write_folder(output, contents, overwrite=True)
    asked.tell(lambda: found_text(wished, found, asked.language), lambda: found_data(wished, found))
    passed = time.monotonic() - started
    asked.tell_written(output, "\n")
    rate = {"seconds": f"{passed:.1f}", "rate": f"{found.designs / passed:.0f}"}
    click.echo(say("study.rate", asked.language, **rate), err=True)


@click.command(cls=SpokenCommand)
@click.argument("study")
@click.option("-o", "--output", metavar="DIR", required=True)
@LANG
@SET
@JSON
@OVERWRITE
@asking
def optimise(asked: Asked, study: str, output: str) -> None:
    """Find the best design of a study: the machine file of it, what holds it, and the way there."""
    from crankwork import files
    from crankwork.study.optimise import best_of
    from crankwork.study.optimum_text import optimum_data, optimum_files, optimum_text
    from crankwork.study.study_file import load_study

    wished = load_study(study, asked.settings, is_search=True)
    files.check_folder(output, overwrite=asked.overwrite)
    with bar() as telling:
        found = best_of(wished, telling)
    contents = optimum_files(wished, found, output)
    asked.tell(lambda: optimum_text(wished, found, asked.language), lambda: optimum_data(wished, found))
    files.write_folder(output, contents, overwrite=asked.overwrite)
    asked.tell_written(output, "\n")


@click.command(name="map", cls=SpokenCommand)
@click.argument("file")
@click.option("--over", multiple=True, required=True, metavar="KEY=FROM..TO")
@click.option("-o", "--output", metavar="DIR")
@click.option("--workers", metavar="N")
@LANG
@SYSTEM
@SET
@JSON
@NO_FIGURES
@FORMAT
@THEME
@OVERWRITE
@asking
def map_(asked: Asked, over: tuple[str, ...], output: str | None, workers: str | None) -> None:
    """Compute a machine over ranges of one or two numbers of its file."""
    from crankwork import files
    from crankwork.description.document import load
    from crankwork.study.map_figures import map_drawings
    from crankwork.study.mapped import map_data, map_files, map_text, mapped

    wanted = () if asked.no_figures or output is None else formats_of(asked.formats)
    if output is not None:
        files.check_folder(output, overwrite=asked.overwrite)
    count = _number_of(workers, None) or os.cpu_count() or 1
    with bar() as telling:
        found = mapped(load(asked.file), over, asked.overrides, telling, count)
    asked.tell(lambda: map_text(found, asked.language), lambda: map_data(found))
    if output is not None:
        drawn = map_drawings(found, asked.language) if wanted else {}
        files.write_folder(output, map_files(found) | _figures(drawn, wanted, asked.theme), overwrite=asked.overwrite)
        asked.tell_written(output, "\n")


def _figures(drawn: Mapping[str, Drawing], formats: tuple[str, ...], theme: Theme) -> dict[str, bytes]:
    """Return figures as files, by their names in a folder."""
    from crankwork.show.formats import FORMATS

    return {f"figures/{name}.{one}": FORMATS[one](drawing, theme) for one in formats for name, drawing in drawn.items()}


def _number_of(workers: str | None, scheduler: str | None) -> int:
    """Return how many workers an option asks for, 0 for as many as there are processors."""
    if workers is None:
        return 0
    if scheduler is not None:
        raise CrankworkError(Refusal("workers_or"))
    count = count_of(workers)
    if not 1 <= count <= _MOST_WORKERS:
        raise CrankworkError(Refusal("workers_number", most=str(_MOST_WORKERS)))
    return count

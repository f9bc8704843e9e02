"""The commands that calculate many designs."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from crankwork.cli.asked import formats_of, laid_over
from crankwork.cli.options import FORMAT, JSON, LANG, NO_FIGURES, OVERWRITE, SET, SYSTEM, THEME
from crankwork.cli.spoken import SpokenCommand
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import Language, Refusal, say
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
def sweep(  # noqa: PLR0913 - one argument per option of the command
    study: str,
    output: str,
    workers: str | None,
    scheduler: str | None,
    language: Language,
    settings: tuple[str, ...],
    formats: str,
    theme: Theme,
    *,
    resume: bool,
    as_json: bool,
    no_figures: bool,
) -> None:
    """Calculate the designs of a study: the best, the Pareto set, histograms and what matters."""
    from crankwork import files
    from crankwork.study.found_figures import found_drawings
    from crankwork.study.found_text import found_data, found_files, found_text
    from crankwork.study.running import Where, run_study
    from crankwork.study.study_file import load_study

    where = Where(_number_of(workers, scheduler), scheduler or "")
    wanted = () if no_figures else formats_of(formats)
    asked = load_study(study, settings)
    if extras := missing_extras(_MODULES):
        raise MissingExtraError(Refusal("extra_study"), *extras)
    started = time.monotonic()
    try:
        with counting(asked.count) as told:
            found = run_study(asked, output, where, resume=resume, told=told)
    except KeyboardInterrupt:
        click.echo(f"\n{say('study.stopped', language)}", err=True)
        raise
    drawn = found_drawings(asked, found, language) if wanted else {}
    contents = found_files(asked, found) | _figures(drawn, wanted, theme)
    files.write_folder(output, contents, overwrite=True)
    if as_json:
        click.echo(json.dumps(found_data(asked, found), ensure_ascii=False, indent=1))
    else:
        click.echo(found_text(asked, found, language))
    passed = time.monotonic() - started
    click.echo(f"\n{say('report.written', language)} {output}", err=as_json)
    click.echo(say("study.rate", language, seconds=f"{passed:.1f}", rate=f"{found.designs / passed:.0f}"), err=True)


@click.command(cls=SpokenCommand)
@click.argument("study")
@click.option("-o", "--output", metavar="DIR", required=True)
@LANG
@SET
@JSON
@OVERWRITE
def optimise(
    study: str,
    output: str,
    language: Language,
    settings: tuple[str, ...],
    *,
    as_json: bool,
    overwrite: bool,
) -> None:
    """Find the best design of a study: the machine file of it, what holds it, and the way there."""
    from crankwork import files
    from crankwork.study.optimise import best_of
    from crankwork.study.optimum_text import optimum_data, optimum_files, optimum_text
    from crankwork.study.study_file import load_study

    asked = load_study(study, settings, is_search=True)
    files.check_folder(output, overwrite=overwrite)
    with bar() as telling:
        found = best_of(asked, telling)
    contents = optimum_files(asked, found, output)
    if as_json:
        click.echo(json.dumps(optimum_data(asked, found), ensure_ascii=False, indent=1))
    else:
        click.echo(optimum_text(asked, found, language))
    files.write_folder(output, contents, overwrite=overwrite)
    click.echo(f"\n{say('report.written', language)} {output}", err=as_json)


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
def map_(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    over: tuple[str, ...],
    output: str | None,
    workers: str | None,
    language: Language,
    units: str | None,
    settings: tuple[str, ...],
    formats: str,
    theme: Theme,
    *,
    as_json: bool,
    no_figures: bool,
    overwrite: bool,
) -> None:
    """Compute a machine over ranges of one or two numbers of its file."""
    from crankwork import files
    from crankwork.description.document import load
    from crankwork.study.map_figures import map_drawings
    from crankwork.study.mapped import map_data, map_files, map_text, mapped

    wanted = () if no_figures or output is None else formats_of(formats)
    if output is not None:
        files.check_folder(output, overwrite=overwrite)
    count = _number_of(workers, None) or os.cpu_count() or 1
    with bar() as telling:
        found = mapped(load(file), over, laid_over(settings, units=units), telling, count)
    if as_json:
        click.echo(json.dumps(map_data(found), ensure_ascii=False, indent=1))
    else:
        click.echo(map_text(found, language))
    if output is not None:
        drawn = map_drawings(found, language) if wanted else {}
        files.write_folder(output, map_files(found) | _figures(drawn, wanted, theme), overwrite=overwrite)
        click.echo(f"\n{say('report.written', language)} {output}", err=as_json)


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
    count = int(workers) if workers.isascii() and workers.isdecimal() and len(workers) < 10 else 0
    if not 1 <= count <= _MOST_WORKERS:
        raise CrankworkError(Refusal("workers_number", most=str(_MOST_WORKERS)))
    return count

"""The commands that calculate many designs."""

from __future__ import annotations

import json
import time

import click

from crankwork.cli.asked import laid_over
from crankwork.cli.options import JSON, LANG, OVERWRITE, SET, SYSTEM
from crankwork.cli.spoken import SpokenCommand
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import Language, Refusal, say
from crankwork.progress import bar, counting

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
def sweep(  # noqa: PLR0913 - one argument per option of the command
    study: str,
    output: str,
    workers: str | None,
    scheduler: str | None,
    language: Language,
    settings: tuple[str, ...],
    *,
    resume: bool,
    as_json: bool,
) -> None:
    """Calculate the designs of a study: the best, the Pareto set, histograms and what matters."""
    from crankwork import files
    from crankwork.study.found_text import found_data, found_files, found_text
    from crankwork.study.running import Where, run_study
    from crankwork.study.study_file import load_study

    where = Where(_number_of(workers, scheduler), scheduler or "")
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
    files.write_folder(output, found_files(asked, found), overwrite=True)
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
@LANG
@SYSTEM
@SET
@JSON
@OVERWRITE
def map_(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    over: tuple[str, ...],
    output: str | None,
    language: Language,
    units: str | None,
    settings: tuple[str, ...],
    *,
    as_json: bool,
    overwrite: bool,
) -> None:
    """Compute a machine over ranges of one or two numbers of its file."""
    from crankwork import files
    from crankwork.description.document import load
    from crankwork.study.mapped import map_data, map_files, map_text, mapped

    if output is not None:
        files.check_folder(output, overwrite=overwrite)
    with bar() as telling:
        found = mapped(load(file), over, laid_over(settings, units=units), telling)
    if as_json:
        click.echo(json.dumps(map_data(found), ensure_ascii=False, indent=1))
    else:
        click.echo(map_text(found, language))
    if output is not None:
        files.write_folder(output, map_files(found), overwrite=overwrite)
        click.echo(f"\n{say('report.written', language)} {output}", err=as_json)


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

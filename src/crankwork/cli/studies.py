"""The commands that calculate many designs."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from crankwork.cli.asked import CommonOptions, parse_count, parse_formats, with_common_options
from crankwork.cli.options import FORMAT, JSON, LANG, NO_FIGURES, OVERWRITE, SET, SYSTEM, THEME, LocalizedCommand
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage, translate
from crankwork.progress import counting, progress_bar

if TYPE_CHECKING:
    from crankwork.show.scene import Drawing
    from crankwork.show.theme import Theme

_MAX_WORKERS = 1024
_MODULES = {"pyarrow": "data", "scipy": "data"}


@click.command(cls=LocalizedCommand)
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
@with_common_options
def sweep(
    options: CommonOptions, study: str, output: str, workers: str | None, scheduler: str | None, *, resume: bool
) -> None:
    """Calculate the designs of a study: the best, the Pareto set, histograms and what matters."""
    from crankwork import files
    from crankwork.study.runner import ExecutionOptions, run_study
    from crankwork.study.study_figures import found_drawings
    from crankwork.study.study_file import load_study
    from crankwork.study.study_text import found_data, found_files, found_text

    where = ExecutionOptions(_number_of(workers, scheduler), scheduler or "")
    formats = () if options.no_figures else parse_formats(options.formats)
    stated = load_study(study, options.settings)
    if extras := missing_extras(_MODULES):
        raise MissingExtraError(ErrorMessage("extra_study"), *extras)
    started = time.monotonic()
    try:
        with counting(stated.count) as progress:
            aggregate = run_study(stated, output, where, resume=resume, progress=progress)
    except KeyboardInterrupt:
        click.echo(f"\n{translate('study.stopped', options.language)}", err=True)
        raise
    drawings = found_drawings(stated, aggregate, options.language) if formats else {}
    contents = found_files(stated, aggregate) | _figures(drawings, formats, options.theme)
    files.write_folder(output, contents, overwrite=True)
    options.print_result(lambda: found_text(stated, aggregate, options.language), lambda: found_data(stated, aggregate))
    passed = time.monotonic() - started
    options.print_written(output, "\n")
    rate = {"seconds": f"{passed:.1f}", "rate": f"{aggregate.designs / passed:.0f}"}
    click.echo(translate("study.rate", options.language, **rate), err=True)


@click.command(cls=LocalizedCommand)
@click.argument("study")
@click.option("-o", "--output", metavar="DIR", required=True)
@LANG
@SET
@JSON
@OVERWRITE
@with_common_options
def optimise(options: CommonOptions, study: str, output: str) -> None:
    """Find the best design of a study: its machine file, its active constraints, and the iterations."""
    from crankwork import files
    from crankwork.study.optimise import best_of
    from crankwork.study.optimum_text import optimum_data, optimum_files, optimum_text
    from crankwork.study.study_file import load_study

    stated = load_study(study, options.settings, is_search=True)
    files.check_folder(output, overwrite=options.overwrite)
    with progress_bar() as progress:
        optimum = best_of(stated, progress)
    contents = optimum_files(stated, optimum, output)
    options.print_result(lambda: optimum_text(stated, optimum, options.language), lambda: optimum_data(stated, optimum))
    files.write_folder(output, contents, overwrite=options.overwrite)
    options.print_written(output, "\n")


@click.command(name="map", cls=LocalizedCommand)
@click.argument("file")
@click.argument("keys", nargs=-1)
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
@with_common_options
def map_(
    options: CommonOptions, keys: tuple[str, ...], over: tuple[str, ...], output: str | None, workers: str | None
) -> None:
    """Compute a machine over ranges of one or two numbers of its file."""
    from crankwork import files
    from crankwork.description.document import load
    from crankwork.study.map_figures import map_drawings
    from crankwork.study.parameter_map import map_data, map_files, map_text, mapped

    formats = () if options.no_figures or output is None else parse_formats(options.formats)
    if output is not None:
        files.check_folder(output, overwrite=options.overwrite)
    count = _number_of(workers, None) or os.cpu_count() or 1
    with progress_bar() as progress:
        parameter_map = mapped(load(options.file), over, options.overrides, progress, count, keys=keys)
    options.print_result(lambda: map_text(parameter_map, options.language), lambda: map_data(parameter_map))
    if output is not None:
        drawings = map_drawings(parameter_map, options.language) if formats else {}
        files.write_folder(
            output, map_files(parameter_map) | _figures(drawings, formats, options.theme), overwrite=options.overwrite
        )
        options.print_written(output, "\n")


def _figures(drawings: Mapping[str, Drawing], formats: tuple[str, ...], theme: Theme) -> dict[str, bytes]:
    """Return figures as files, by their names in a folder."""
    from crankwork.show.formats import FORMATS

    return {
        f"figures/{name}.{ending}": FORMATS[ending](drawing, theme)
        for ending in formats
        for name, drawing in drawings.items()
    }


def _number_of(workers: str | None, scheduler: str | None) -> int:
    """Return the number of workers of an option, 0 for the number of processors."""
    if workers is None:
        return 0
    if scheduler is not None:
        raise CrankworkError(ErrorMessage("workers_or"))
    count = parse_count(workers)
    if not 1 <= count <= _MAX_WORKERS:
        raise CrankworkError(ErrorMessage("workers_number", most=str(_MAX_WORKERS)))
    return count

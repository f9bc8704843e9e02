"""The command line. Each command imports what it needs, so that `--help` is instant."""

from __future__ import annotations

import contextlib
import io
import itertools
import json
import os
import re
import sys
import time
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TextIO

import click

from crankwork.cli.options import (
    COMPARE,
    FIGURES,
    JSON,
    LANG,
    LANGUAGE,
    MACHINE,
    METHOD,
    NO_FIGURES,
    OVERWRITE,
    PER_AREA,
    SET,
    STEP,
    SYSTEM,
    CommonOptions,
    DoubtfulError,
    LocalizedGroup,
    analyse_with_progress,
    drawing_ending,
    parse_angle_or_time,
    parse_count,
    parse_formats,
    parse_number,
    placeholder,
    requested_language,
    with_common_options,
)
from crankwork.errors import (
    CrankworkError,
    InputError,
    MissingExtraError,
    RenamedKeyWarning,
    missing_extras,
)
from crankwork.locale import ErrorMessage, Language, in_language, translate
from crankwork.progress import counting, progress_bar, with_progress
from crankwork.version import __version__

if TYPE_CHECKING:
    from crankwork.show.scene import Drawing
    from crankwork.show.theme import Theme

_MAX_WORKERS = 1024
_OF_STUDIES = {"pyarrow": "data", "scipy": "data"}
_OF_STUDIO = {"starlette": "studio", "uvicorn": "studio", "websockets": "studio"}


def main() -> None:
    """Run the command line; user errors end with code 2 and a sentence, unverified results with code 1."""
    # linear systems are small here: threads would take longer to start than the solution
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # names of files need not be text, and a terminal need not support Unicode
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    sys.exit(_exit_code())


def _print_warning(message: Warning | str) -> None:
    """Print a warning on one line, as far as it is meant for users."""
    if isinstance(message, RenamedKeyWarning):
        click.echo(_in_language(message.args[0]), err=True)


def _exit_code() -> int:
    """Run the commands and print errors; return 0, 1, 2 or 130."""
    warnings.showwarning = lambda message, *_, **_options: _print_warning(message)
    try:
        commands(standalone_mode=False)
        if sys.stdout is not None:
            sys.stdout.flush()
    except InputError as error:
        _print_error(*error.lines(_in_language), _in_language(ErrorMessage("nothing_computed")))
    except CrankworkError as error:
        _print_error(_in_language(error.args[0]))
        return 1 if isinstance(error, DoubtfulError) else 2
    except click.exceptions.NoArgsIsHelpError as error:
        _print_error(error.format_message())
    except click.ClickException as error:
        _print_error(_in_language(_usage_sentence(error)))
    except (click.Abort, KeyboardInterrupt):
        return 130
    except BrokenPipeError:
        _discard_output(sys.stdout)
        return 1
    except OSError as error:
        # all other disk access is in `files`, so this is the output itself
        _discard_output(sys.stdout)
        _print_error(
            _in_language(ErrorMessage("output_unwritable", reason=(error.strerror or "unknown reason").lower()))
        )
    else:
        return 0
    return 2


def _discard_output(stream: TextIO) -> None:
    """Discard the rest of the output, without loading `files` before."""
    from crankwork.files import discard_output

    discard_output(stream)


def _print_error(*lines: str) -> None:
    """Print lines on the error stream, if there is one."""
    with contextlib.suppress(OSError):
        click.echo("\n".join(lines), err=True)


def _in_language(message: str) -> str:
    """Return a message in the language of the command line, even if its arguments are wrong."""
    return in_language(message, requested_language())


def _usage_sentence(error: click.ClickException) -> str:
    """Return one line on the error of the command line."""
    match error:
        case click.NoSuchOption() | click.exceptions.NoSuchCommand():
            return _unknown(error)
        case click.BadOptionUsage():
            name = "option_no_value" if "does not take" in error.message else "option_value"
            return ErrorMessage(name, option=error.option_name)
        case click.MissingParameter() if isinstance(error.param, click.Option):
            option = f"{error.param.opts[0]} {placeholder(error.param.metavar or '')}".strip()
            return ErrorMessage("option_missing", option=error.param.opts[0], written=option)
        case click.MissingParameter():
            name = (error.param.metavar or error.param.name or "argument").upper() if error.param else "argument"
            return ErrorMessage("argument_missing", argument=placeholder(name))
        case click.BadParameter() if error.param and isinstance(error.param.type, click.Choice):
            match = re.search(r"'(.*)' is not one of", error.message)
            given, choices = match[1] if match else ErrorMessage("this"), tuple(error.param.type.choices)
            return ErrorMessage("option_choice", option=error.param.opts[0], given=given, choices=choices)
        case _ if match := re.search(r"extra arguments? \((.*)\)$", error.message):
            return ErrorMessage("argument_extra", argument=match[1])
        case _:
            return f"{error.format_message().rstrip('.')}; see crankwork --help"


def _unknown(error: click.NoSuchOption | click.exceptions.NoSuchCommand) -> str:
    """Return a sentence about an unknown option or command."""
    if isinstance(error, click.NoSuchOption):
        option, known = error.option_name, commands.commands.items()
        having = [name for name, command in known if any(option in param.opts for param in command.params)]
        if not having and error.possibilities:
            return ErrorMessage("option_unknown_near", option=option, nearest=error.possibilities[0])
        # before the command, or behind one that does not have it
        name = "option_early" if error.ctx is not None and error.ctx.command is commands else "option_elsewhere"
        values = {"option": option, "commands": having, "command": "run" if "run" in having else "".join(having[:1])}
        return ErrorMessage(name if having else "option_unknown", **values)
    command = error.command_name[:40]
    if command.endswith(".toml"):
        return ErrorMessage("command_first", file=command)
    if error.possibilities:
        return ErrorMessage("no_command_near", command=command, nearest=error.possibilities[0])
    return ErrorMessage("no_command", command=command, known=", ".join(commands.commands))


@click.group(cls=LocalizedGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="crankwork %(version)s")
def commands() -> None:
    """Kinematics and dynamics of crank-driven machines, from one text file."""


@commands.command()
@click.argument("name", required=False)
@click.option("-o", "--output", metavar="FILE")
@LANG
@OVERWRITE
@with_common_options
def new(options: CommonOptions, name: str | None, output: str | None) -> None:
    """Write a template, or list those there are."""
    from crankwork import files
    from crankwork.description.machine_file import template, template_names, template_title

    if name is None:
        titles = {template: template_title(template, options.language) for template in template_names()}
        width = max(map(len, titles))
        click.echo("\n".join(f"{name:<{width}}  {title}" for name, title in titles.items()))
        return
    text = template(name, options.language)
    if output is None:
        click.echo(text, nl=False)
        return
    files.write_new(output, text, overwrite=options.overwrite)
    click.echo(translate("report.written_new", options.language, file=output))


@commands.command()
@click.argument("file")
@MACHINE
@click.option("--circuits", is_flag=True)
@JSON
@click.option("--expand", is_flag=True)
@click.option("--assumptions", is_flag=True)
@with_common_options
def check(options: CommonOptions, *, circuits: bool, expand: bool, assumptions: bool) -> None:
    """Read a machine and say what it is."""
    if expand and (circuits or options.as_json):
        raise CrankworkError(ErrorMessage("expand_alone"))
    if expand:
        from crankwork.description.shorthand import expanded

        click.echo(expanded(options.file, options.settings, options.language), nl=False)
        return
    from crankwork.report.notices import notice_text, screen_lines, sentence_lists
    from crankwork.report.summary import description_text

    if options.as_json and not circuits:
        raise CrankworkError(ErrorMessage("json_of_circuits"))
    machine = options.machine
    if circuits and options.as_json:
        from crankwork.analysis.assembly_modes import assembly_modes
        from crankwork.report.summary import assembly_modes_data

        click.echo(json.dumps(assembly_modes_data(machine, assembly_modes(machine)), ensure_ascii=False, indent=1))
        return
    results = analyse_with_progress(machine)
    click.echo(f"{options.file}: {machine.title}" if machine.title else options.file)
    click.echo(description_text(results, options.language))
    if circuits:
        from crankwork.analysis.assembly_modes import assembly_modes
        from crankwork.report.summary import assembly_modes_text

        click.echo(assembly_modes_text(machine, assembly_modes(machine), options.language))
    for notice in results.notices:
        click.echo(
            translate("check.note", options.language, notice=notice_text(notice.code, notice.values, options.language))
        )
    for heading, texts in sentence_lists(results, options.language):
        shown = texts if assumptions else screen_lines(texts, options.language)
        click.echo("\n".join((f"{heading}:", *(f"  {text}" for text in shown))))
    options.raise_if_unverified(results)


@commands.command()
@click.argument("file")
@click.option("-o", "--output", metavar="DIR")
@STEP
@METHOD
@MACHINE
@COMPARE
@PER_AREA
@JSON
@FIGURES
@click.option("--width", type=click.Choice(["85", "170"]), default="170")
@click.option("--excel-csv", is_flag=True)
@OVERWRITE
@with_common_options
def run(options: CommonOptions, output: str | None, width: str, *, excel_csv: bool) -> None:
    """Compute a machine: print the summary, and write tables and figures with -o."""
    from crankwork import files
    from crankwork.report.summary import summary_data, summary_text

    language, per_area = options.language, options.per_area
    if output is not None:
        if not output:
            raise CrankworkError(ErrorMessage("folder_unnamed"))
        files.check_folder(output, overwrite=options.overwrite)
    formats = () if options.no_figures or output is None else parse_formats(options.formats)
    results = options.results()
    options.print_result(
        lambda: summary_text(results, language=language, per_area=per_area),
        lambda: summary_data(results, per_area=per_area),
    )
    if output is not None:
        from crankwork.report.results_folder import missing_writers, results_folder

        steps = results_folder(
            results,
            language=language,
            per_area=per_area,
            for_excel=excel_csv,
            formats=formats,
            theme=options.theme,
            width=width,
        )
        contents = with_progress(steps, 4 - options.no_figures)
        files.write_folder(output, contents, overwrite=options.overwrite)
        options.print_written(output, "\n")
        if formats:
            from crankwork.report.notices import skipped_figure_notes

            for skipped in skipped_figure_notes(results, language):
                _print_error(translate("check.note", language, notice=skipped))
        if (missing := missing_writers()) is not None:
            _print_error(translate("check.note", language, notice=_in_language(missing.args[0])))
    options.raise_if_unverified(results)


@commands.command()
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
    from crankwork.note.sections import check_format, written_note

    sheets = sheets or grid or paper is not None
    # before anything else is loaded
    check_format(output, with_sheets=sheets)
    from crankwork import files
    from crankwork.note.options import NoteOptions
    from crankwork.note.sections import note_of, sheets_of

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


@commands.command()
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@STEP
@METHOD
@MACHINE
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


@commands.command()
@click.argument("file")
@click.option("-o", "--output", required=True, metavar="FILE")
@click.option("--at", "place", metavar="DEG")
@click.option("--forces", is_flag=True)
@METHOD
@MACHINE
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


@commands.command()
@click.argument("study")
@click.option("-o", "--output", metavar="DIR", required=True)
@click.option("--workers", metavar="N")
@click.option("--scheduler", metavar="ADDRESS")
@click.option("--resume", is_flag=True)
@LANG
@SET
@JSON
@FIGURES
@with_common_options
def sweep(
    options: CommonOptions, study: str, output: str, workers: str | None, scheduler: str | None, *, resume: bool
) -> None:
    """Calculate the designs of a study: the best, the Pareto set, histograms and what matters."""
    from crankwork import files
    from crankwork.study.figures import found_drawings
    from crankwork.study.runner import ExecutionOptions, run_study
    from crankwork.study.study_file import load_study
    from crankwork.study.study_text import found_data, found_files, found_text

    where = ExecutionOptions(_number_of(workers, scheduler), scheduler or "")
    formats = () if options.no_figures else parse_formats(options.formats)
    stated = load_study(study, options.settings)
    if extras := missing_extras(_OF_STUDIES):
        raise MissingExtraError(ErrorMessage("extra_study"), *extras)
    started = time.monotonic()
    try:
        with counting(stated.count) as progress:
            aggregate = run_study(stated, output, where, resume=resume, progress=progress)
    except KeyboardInterrupt:
        click.echo(f"\n{translate('study.stopped', options.language)}", err=True)
        raise
    drawings = found_drawings(stated, aggregate, options.language) if formats else {}
    contents = found_files(stated, aggregate, options.language) | _figures(drawings, formats, options.theme)
    files.write_folder(output, contents, overwrite=True)
    options.print_result(lambda: found_text(stated, aggregate, options.language), lambda: found_data(stated, aggregate))
    passed = time.monotonic() - started
    options.print_written(output, "\n")
    rate = {"seconds": f"{passed:.1f}", "rate": f"{aggregate.designs / passed:.0f}"}
    click.echo(translate("study.rate", options.language, **rate), err=True)


@commands.command()
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
    from crankwork.study.study_file import load_study
    from crankwork.study.study_text import optimum_data, optimum_files, optimum_text

    stated = load_study(study, options.settings, is_search=True)
    files.check_folder(output, overwrite=options.overwrite)
    with progress_bar() as progress:
        optimum = best_of(stated, progress)
    contents = optimum_files(stated, optimum, output)
    options.print_result(lambda: optimum_text(stated, optimum, options.language), lambda: optimum_data(stated, optimum))
    files.write_folder(output, contents, overwrite=options.overwrite)
    options.print_written(output, "\n")


@commands.command(name="map")
@click.argument("file")
@click.argument("keys", nargs=-1)
@click.option("--over", multiple=True, required=True, metavar="KEY=FROM..TO")
@click.option("-o", "--output", metavar="DIR")
@click.option("--workers", metavar="N")
@MACHINE
@JSON
@FIGURES
@OVERWRITE
@with_common_options
def map_(
    options: CommonOptions, keys: tuple[str, ...], over: tuple[str, ...], output: str | None, workers: str | None
) -> None:
    """Compute a machine over ranges of one or two numbers of its file."""
    from crankwork import files
    from crankwork.description.document import load
    from crankwork.study.figures import map_drawings
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


@commands.command()
@click.argument("file", required=False)
@click.option("--port", metavar="N", default="0")
@click.option("--no-browser", is_flag=True)
@LANG
def studio(file: str | None, port: str, language: Language, *, no_browser: bool) -> None:
    """Open the studio, with a machine file or a shared text."""
    if not (port.isascii() and port.isdecimal() and len(port) < 6 and int(port) < 1 << 16):
        raise CrankworkError(
            ErrorMessage("option_wrong", option="--port", mistake=ErrorMessage("port_range", port=port[:20]))
        )
    if extras := missing_extras(_OF_STUDIO):
        raise MissingExtraError(ErrorMessage("extra_studio"), *extras)
    from crankwork import files
    from crankwork.studio.server import StartupOptions, serve
    from crankwork.studio.session import is_share, opened_share

    if file is None:
        opening = StartupOptions()
    elif is_share(file):
        opening = StartupOptions(opened_share(file, language))
    else:
        path = Path(file)
        text = files.read_text(path, advice=ErrorMessage("check_path_or_new", path=path))
        # a text of another form is not saved in its place
        opening = (
            StartupOptions(opened_share(text, language)) if is_share(text) else StartupOptions(text, path.resolve())
        )
    serve(opening, language, int(port), opens=not no_browser, says=click.echo)


@commands.command()
@click.argument("file")
@click.argument("key", required=False)
@click.option("--at", "place", metavar="DEG")
@click.option("--list", "with_keys", is_flag=True)
@METHOD
@MACHINE
@with_common_options
def explain(options: CommonOptions, key: str | None, place: str | None, *, with_keys: bool) -> None:
    """Explain one value of a machine: every step in order, down to the lines of the file."""
    from crankwork.note.explain import explanation, key_lines

    if key is None and place is None and not with_keys:
        raise CrankworkError(ErrorMessage("explain_what"))
    # if it is no crank angle, it may be a time of the machine
    angle_or_time = (
        None
        if place is None
        else parse_angle_or_time(place, "time" if options.machine.mechanism.driver.law else "angle")
    )
    results = options.results()
    if key is None and angle_or_time is not None:
        from crankwork.report.summary import values_text

        click.echo(values_text(results, angle_or_time, options.language))
        return
    if key is None or with_keys:
        click.echo("\n".join(key_lines(results.complete, options.language)))
        return
    click.echo(explanation(results, key, angle_or_time, options.language, options.origin()), nl=False)


@commands.command()
@click.argument("file")
@click.argument("equations", nargs=-1, required=True, metavar="EQUATION...")
@click.option("--for", "fields", required=True, multiple=True, metavar="KEY")
@click.option("--from", "low", multiple=True, metavar="VALUE")
@click.option("--to", "high", multiple=True, metavar="VALUE")
@click.option("--steps", metavar="N", default="400")
@LANG
@SET
@JSON
@with_common_options
def solve(
    options: CommonOptions,
    equations: tuple[str, ...],
    fields: tuple[str, ...],
    low: tuple[str, ...],
    high: tuple[str, ...],
    steps: str,
) -> None:
    """Find the numbers of a file that make values what is wanted: "piston_force@33deg = 0" --for crank.speed."""
    from crankwork.description.document import load
    from crankwork.study.solve import several_data, several_text, solution_data, solution_text, solve_several
    from crankwork.study.solve import solve as solved

    limits = list(itertools.zip_longest(low, high, fillvalue=None))
    if len(limits) > len(fields) or (limits and len(low or high) != len(high or low)):
        raise CrankworkError(ErrorMessage("solve_limits"))
    limits += [(None, None)] * (len(fields) - len(limits))
    description = load(options.file)
    with progress_bar() as progress:
        if len(equations) == len(fields) == 1:
            solution = solved(
                description, equations[0], fields[0], limits=limits[0], steps=parse_count(steps),
                overrides=options.settings, told=progress,
            )  # fmt: skip
            several = None
        else:
            several = solve_several(
                description, equations, fields, limits=limits, overrides=options.settings, progress=progress
            )
    if several is None:
        options.print_result(lambda: solution_text(solution, options.language), lambda: solution_data(solution))
    else:
        options.print_result(lambda: several_text(several, options.language), lambda: several_data(several))


@commands.command()
@click.argument("file")
@click.argument("keys", nargs=-1)
@click.option("--samples", metavar="N", default="2000")
@click.option("--within", metavar="N", default="3")
@MACHINE
@JSON
@with_common_options
def spread(options: CommonOptions, keys: tuple[str, ...], samples: str, within: str) -> None:
    """Tell how far results spread where the file states numbers with a tolerance or a deviation."""
    from crankwork.description.document import load
    from crankwork.study.spread import spread as found_spread
    from crankwork.study.spread import spread_data, spread_text

    with progress_bar() as progress:
        spreads = found_spread(
            load(options.file), keys, samples=parse_count(samples), within=parse_number(within),
            overrides=options.overrides, told=progress,
        )  # fmt: skip
    options.print_result(lambda: spread_text(spreads, options.language), lambda: spread_data(spreads))


@commands.command()
@LANG
@click.option("--study", "of_study", is_flag=True)
def schema(language: Language, *, of_study: bool) -> None:
    """Print the JSON Schema of the machine file, or of study files, for editors."""
    from crankwork.description.machine_file import json_schema

    if of_study:
        from crankwork.study.study_file import study_schema

        click.echo(study_schema(language))
        return
    click.echo(json_schema(language))

"""The command line. Each command imports what it needs, so that `--help` is instant."""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import sys
from typing import TextIO

import click

from crankwork.cli.asked import (
    Asked,
    analysed,
    asking,
    count_of,
    factor_of,
    formats_of,
    place_of,
)
from crankwork.cli.documents import draw, page, report
from crankwork.cli.options import (
    COMPARE,
    FORMAT,
    JSON,
    LANG,
    METHOD,
    NO_FIGURES,
    OVERWRITE,
    PER_AREA,
    SET,
    STEP,
    SYSTEM,
    THEME,
)
from crankwork.cli.spoken import SpokenGroup, language_asked, placeholder
from crankwork.cli.studies import map_, optimise, sweep
from crankwork.cli.studio import studio
from crankwork.errors import CrankworkError, DoubtfulError, InputError
from crankwork.locale import Language, Refusal, say, told
from crankwork.progress import bar, with_progress


def main() -> None:
    """Run the command line; a mistake of the user ends with code 2 and a sentence, doubtful results with code 1."""
    # linear systems are small here, and starting threads for them takes longer than solving them
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # names of files need not be text, and a terminal need not know Unicode
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    sys.exit(_exit_code())


def _exit_code() -> int:
    """Run the commands and tell what went wrong; return 0, 1, 2 or 130."""
    try:
        commands(standalone_mode=False)
        if sys.stdout is not None:
            sys.stdout.flush()
    except InputError as error:
        _tell(*error.lines(_told), _told(Refusal("nothing_computed")))
    except CrankworkError as error:
        _tell(_told(error.args[0]))
        return 1 if isinstance(error, DoubtfulError) else 2
    except click.exceptions.NoArgsIsHelpError as error:
        _tell(error.format_message())
    except click.ClickException as error:
        _tell(_told(_usage_sentence(error)))
    except (click.Abort, KeyboardInterrupt):
        return 130
    except BrokenPipeError:
        _send_nowhere(sys.stdout)
        return 1
    except OSError as error:
        # everything else that touches the disk is in `files`, so this is the output itself
        _send_nowhere(sys.stdout)
        _tell(_told(Refusal("output_unwritable", reason=(error.strerror or "unknown reason").lower())))
    else:
        return 0
    return 2


def _send_nowhere(stream: TextIO) -> None:
    """Let what is still to be written to a stream go nowhere."""
    from crankwork.files import send_nowhere

    send_nowhere(stream)


def _tell(*lines: str) -> None:
    """Write lines to the error stream, if there is one."""
    with contextlib.suppress(OSError):
        click.echo("\n".join(lines), err=True)


def _told(message: str) -> str:
    """Return a refusal in the language that the command line asks for, which may be what is wrong with it."""
    return told(message, language_asked())


def _usage_sentence(error: click.ClickException) -> str:
    """Return one line on how the command line is written."""
    match error:
        case click.NoSuchOption() | click.exceptions.NoSuchCommand():
            return _unknown(error)
        case click.BadOptionUsage():
            name = "option_no_value" if "does not take" in error.message else "option_value"
            return Refusal(name, option=error.option_name)
        case click.MissingParameter() if isinstance(error.param, click.Option):
            option = f"{error.param.opts[0]} {placeholder(error.param.metavar or '')}".strip()
            return Refusal("option_missing", option=error.param.opts[0], written=option)
        case click.MissingParameter():
            name = (error.param.name or "argument").upper() if error.param else "argument"
            return Refusal("argument_missing", argument=placeholder(name))
        case click.BadParameter() if error.param and isinstance(error.param.type, click.Choice):
            found = re.search(r"'(.*)' is not one of", error.message)
            given, choices = found[1] if found else Refusal("this"), tuple(error.param.type.choices)
            return Refusal("option_choice", option=error.param.opts[0], given=given, choices=choices)
        case _ if found := re.search(r"extra arguments? \((.*)\)$", error.message):
            return Refusal("argument_extra", argument=found[1])
        case _:
            return f"{error.format_message().rstrip('.')}; see crankwork --help"


def _unknown(error: click.NoSuchOption | click.exceptions.NoSuchCommand) -> str:
    """Return a sentence on an option or a command that there is not."""
    if isinstance(error, click.NoSuchOption):
        option = error.option_name
        if error.possibilities:
            return Refusal("option_unknown_near", option=option, nearest=error.possibilities[0])
        every = {name for command in commands.commands.values() for one in command.params for name in one.opts}
        return Refusal("option_early" if option in every else "option_unknown", option=option)
    command = error.command_name[:40]
    if command.endswith(".toml"):
        return Refusal("command_first", file=command)
    if error.possibilities:
        return Refusal("no_command_near", command=command, nearest=error.possibilities[0])
    return Refusal("no_command", command=command, known=", ".join(commands.commands))


@click.group(cls=SpokenGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="crankwork", message="crankwork %(version)s")
def commands() -> None:
    """Kinematics and dynamics of crank-driven machines, from one text file."""


@commands.command()
@click.argument("name", required=False)
@click.option("-o", "--output", metavar="FILE")
@LANG
@OVERWRITE
@asking
def new(asked: Asked, name: str | None, output: str | None) -> None:
    """Write a template, or list those there are."""
    from crankwork import files
    from crankwork.description.machine_file import template, template_names, template_title

    if name is None:
        titles = {one: template_title(one, asked.language) for one in template_names()}
        width = max(map(len, titles))
        click.echo("\n".join(f"{one:<{width}}  {title}" for one, title in titles.items()))
        return
    text = template(name, asked.language)
    if output is None:
        click.echo(text, nl=False)
        return
    files.write_new(output, text, overwrite=asked.overwrite)
    click.echo(say("report.written_new", asked.language, file=output))


@commands.command()
@click.argument("file")
@LANG
@SYSTEM
@SET
@click.option("--circuits", is_flag=True)
@JSON
@click.option("--expand", is_flag=True)
@asking
def check(asked: Asked, *, circuits: bool, expand: bool) -> None:
    """Read a machine and say what it is."""
    if expand and (circuits or asked.as_json):
        raise CrankworkError(Refusal("expand_alone"))
    if expand:
        from crankwork.description.expand import expanded

        click.echo(expanded(asked.file, asked.settings, asked.language), nl=False)
        return
    from crankwork.report.notices import notice_text
    from crankwork.report.summary import description_text

    if asked.as_json and not circuits:
        raise CrankworkError(Refusal("json_of_circuits"))
    machine = asked.machine
    if circuits and asked.as_json:
        from crankwork.analysis.ways import ways
        from crankwork.report.ways import ways_data

        click.echo(json.dumps(ways_data(machine, ways(machine)), ensure_ascii=False, indent=1))
        return
    results = analysed(machine)
    click.echo(f"{asked.file}: {machine.title}" if machine.title else asked.file)
    click.echo(description_text(results, asked.language))
    if circuits:
        from crankwork.analysis.ways import ways
        from crankwork.report.ways import ways_text

        click.echo(ways_text(machine, ways(machine), asked.language))
    for notice in results.notices:
        click.echo(say("check.note", asked.language, notice=notice_text(notice.code, notice.values, asked.language)))
    asked.doubt(results)


@commands.command()
@click.argument("file")
@click.option("-o", "--output", metavar="DIR")
@STEP
@METHOD
@LANG
@SYSTEM
@SET
@COMPARE
@PER_AREA
@JSON
@NO_FIGURES
@FORMAT
@THEME
@click.option("--excel-csv", is_flag=True)
@OVERWRITE
@asking
def run(asked: Asked, output: str | None, *, excel_csv: bool) -> None:
    """Compute a machine: print the summary, and write tables and figures with -o."""
    from crankwork import files
    from crankwork.report.summary import summary_data, summary_text

    language, per_area = asked.language, asked.per_area
    if output is not None:
        if not output:
            raise CrankworkError(Refusal("folder_unnamed"))
        files.check_folder(output, overwrite=asked.overwrite)
    wanted = () if asked.no_figures or output is None else formats_of(asked.formats)
    results = asked.results()
    asked.tell(
        lambda: summary_text(results, language=language, per_area=per_area),
        lambda: summary_data(results, per_area=per_area),
    )
    if output is not None:
        from crankwork.report.results_folder import left_out, results_folder

        steps = results_folder(
            results, language=language, per_area=per_area, for_excel=excel_csv, formats=wanted, theme=asked.theme
        )
        contents = with_progress(steps, 4 - asked.no_figures)
        files.write_folder(output, contents, overwrite=asked.overwrite)
        asked.tell_written(output, "\n")
        if wanted:
            from crankwork.report.not_drawn import not_drawn

            for one in not_drawn(results, language):
                _tell(say("check.note", language, notice=one))
        if (missing := left_out()) is not None:
            _tell(say("check.note", language, notice=_told(missing.args[0])))
    asked.doubt(results)


for one in (report, page, draw, sweep, optimise, map_, studio):
    commands.add_command(one)


@commands.command()
@click.argument("file")
@click.argument("key", required=False)
@click.option("--at", metavar="DEG")
@click.option("--list", "with_keys", is_flag=True)
@METHOD
@LANG
@SYSTEM
@SET
@asking
def explain(asked: Asked, key: str | None, at: str | None, *, with_keys: bool) -> None:
    """Explain one value of a machine: every step in order, down to the lines of the file."""
    from crankwork.note.explain import explanation, key_lines

    if key is None and not with_keys:
        raise CrankworkError(Refusal("explain_what"))
    # what is no crank angle may be a time, which the machine knows
    where = None if at is None else place_of(at, "time" if asked.machine.mechanism.driver.law else "angle")
    results = asked.results()
    if key is None or with_keys:
        click.echo("\n".join(key_lines(results, asked.language)))
        return
    click.echo(explanation(results, key, where, asked.language, asked.origin()), nl=False)


@commands.command()
@click.argument("file")
@click.argument("equation")
@click.option("--for", "sought", required=True, metavar="KEY")
@click.option("--from", "start", metavar="VALUE")
@click.option("--to", "end", metavar="VALUE")
@click.option("--steps", metavar="N", default="400")
@LANG
@SET
@JSON
@asking
def solve(asked: Asked, equation: str, sought: str, start: str | None, end: str | None, steps: str) -> None:
    """Find the numbers of a file that make a value what is wanted: "piston_force@33deg = 0" --for crank.speed."""
    from crankwork.description.document import load
    from crankwork.study.solution import solution_data, solution_text
    from crankwork.study.solve import solve as solved

    with bar() as telling:
        found = solved(
            load(asked.file), equation, sought, limits=(start, end), steps=count_of(steps), overrides=asked.settings,
            told=telling,
        )  # fmt: skip
    asked.tell(lambda: solution_text(found, asked.language), lambda: solution_data(found))


@commands.command()
@click.argument("file")
@click.argument("keys", nargs=-1)
@click.option("--samples", metavar="N", default="2000")
@click.option("--within", metavar="N", default="3")
@LANG
@SYSTEM
@SET
@JSON
@asking
def spread(asked: Asked, keys: tuple[str, ...], samples: str, within: str) -> None:
    """Tell how far results spread where the file states numbers with a deviation: "75 ± 0.1 mm"."""
    from crankwork.description.document import load
    from crankwork.study.spread import spread as found_spread
    from crankwork.study.spread_text import spread_data, spread_text

    with bar() as telling:
        found = found_spread(
            load(asked.file), keys, samples=count_of(samples), within=factor_of(within), overrides=asked.overrides,
            told=telling,
        )  # fmt: skip
    asked.tell(lambda: spread_text(found, asked.language), lambda: spread_data(found))


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

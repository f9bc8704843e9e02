"""The command line. Each command imports what it needs, so that `--help` is instant."""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import os
import re
import sys
import time
from collections.abc import Callable, Iterable
from typing import Any

import click

from crankwork.errors import CrankworkError, InputError

_LANGUAGE = click.Choice(["en", "ru", "vi"])


def main() -> None:
    """Run the command line; a mistake of the user ends with code 2 and a sentence."""
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
        _tell(*error.lines(), "nothing was computed")
    except CrankworkError as error:
        _tell(str(error))
    except click.exceptions.NoArgsIsHelpError as error:
        _tell(error.format_message())
    except click.ClickException as error:
        _tell(_usage_sentence(error))
    except (click.Abort, KeyboardInterrupt):
        return 130
    except BrokenPipeError:
        _load("files").send_nowhere(sys.stdout)
        return 1
    except OSError as error:
        # everything else that touches the disk is in `files`, so this is the output itself
        _load("files").send_nowhere(sys.stdout)
        _tell(f"the output cannot be written ({(error.strerror or 'unknown reason').lower()}); send it elsewhere")
    else:
        return 0
    return 2


def _tell(*lines: str) -> None:
    """Write lines to the error stream, if there is one."""
    with contextlib.suppress(OSError):
        click.echo("\n".join(lines), err=True)


def _usage_sentence(error: click.ClickException) -> str:
    """Return one line on how the command line is written."""
    match error:
        case click.NoSuchOption():
            near = f"did you mean {error.possibilities[0]}?" if error.possibilities else "see --help"
            return f"{error.option_name}: there is no such option; {near}"
        case click.BadOptionUsage():
            return f"{error.option_name}: needs a value; see --help"
        case click.MissingParameter() if isinstance(error.param, click.Option):
            option = f"{error.param.opts[0]} {error.param.metavar or ''}".strip()
            return f"{error.param.opts[0]}: is missing; write {option}, see --help"
        case click.MissingParameter():
            name = (error.param.name or "argument").upper() if error.param else "argument"
            return f"{name}: is missing; write it after the command, see --help"
        case click.BadParameter() if error.param and isinstance(error.param.type, click.Choice):
            choices = " or ".join(error.param.type.choices)
            given = re.search(r"'(.*)' is not one of", error.message)
            return f"{error.param.opts[0]}: {given[1] if given else 'this'} is not possible; write {choices}"
        case click.exceptions.NoSuchCommand():
            return f'"{error.command_name[:40]}": there is no such command; write {", ".join(commands.commands)}'
        case _:
            return f"{error.format_message().rstrip('.')}; see crankwork --help"


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="crankwork", message="crankwork %(version)s")
def commands() -> None:
    """Kinematics and dynamics of crank-driven machines, from one text file."""


@commands.command()
@click.argument("name", required=False)
@click.option("-o", "--output", metavar="FILE", help="Write here instead of to the screen.")
@click.option("--overwrite", is_flag=True, help="Replace a file that is there.")
def new(name: str | None, output: str | None, *, overwrite: bool) -> None:
    """Write a commented machine file to start from: engine, slider-crank or compressor."""
    door = _load("description.machine_file")
    if name is None:
        click.echo("\n".join(door.template_names()))
        return
    text = door.template(name)
    if output is None:
        click.echo(text, nl=False)
        return
    _load("files").write_new(output, text, overwrite=overwrite)
    click.echo(f"{output} written; check it with: crankwork check {output}")


@commands.command()
@click.argument("file")
@click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Override a key of the file.")
def check(file: str, settings: tuple[str, ...]) -> None:
    """Say what a machine file describes, or every mistake in it at once."""
    machine = _load("description.machine_file").read(file, settings)
    results = _load("analysis").analyse(machine)
    summary = _load("report.summary")
    click.echo(f"{file}: {machine.title}" if machine.title else file)
    click.echo(summary.description_text(machine, results))
    for notice in results.notices:
        click.echo(f"note: {_load('report.notices').notice_text(notice.code, notice.values, 'en')}")


@commands.command()
@click.argument("file")
@click.option("-o", "--output", metavar="DIR", help="Write tables, figures and the moving drawing into this folder.")
@click.option("--step", metavar="DEG", help="Step of the tables, in degrees of crank angle.")
@click.option("--method", metavar="NAME", help="exact, textbook or series:N, instead of the file's own.")
@click.option("--lang", "language", type=_LANGUAGE, default="en", show_default=True, help="Language of the output.")
@click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Override a key of the file.")
@click.option("--per-area", is_flag=True, help="Forces per piston area, in MPa.")
@click.option("--json", "as_json", is_flag=True, help="Print the summary as one JSON object.")
@click.option("--no-figures", is_flag=True, help="Leave the figures out.")
@click.option("--excel-csv", is_flag=True, help="CSV with semicolons and decimal commas.")
@click.option("--overwrite", is_flag=True, help="Write into a folder that holds files already.")
def run(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    output: str | None,
    step: str | None,
    method: str | None,
    language: Any,  # noqa: ANN401 - one of three words, checked by click
    settings: tuple[str, ...],
    *,
    per_area: bool,
    as_json: bool,
    no_figures: bool,
    excel_csv: bool,
    overwrite: bool,
) -> None:
    """Compute a machine: print the summary, and write tables and figures with -o."""
    machine = _machine(file, settings, step, method, per_area=per_area)
    if output is not None:
        if not output:
            raise CrankworkError("-o: is empty; write the name of a folder")
        _load("files").check_folder(output, overwrite=overwrite)
    results = _load("analysis").analyse(machine)
    summary = _load("report.summary")
    if as_json:
        click.echo(json.dumps(summary.summary_data(results, per_area=per_area), ensure_ascii=False, indent=1))
    else:
        click.echo(summary.summary_text(results, language=language, per_area=per_area))
    if output is not None:
        folder = _load("report.results_folder")
        steps = folder.results_folder(
            results, language=language, per_area=per_area, for_excel=excel_csv, with_figures=not no_figures
        )
        contents = _with_progress(steps, 4 - no_figures)
        _load("files").write_folder(output, contents, overwrite=overwrite, stale=folder.OUTPUTS)
        click.echo(f"\n{_load('report.language').word('written', language)} {output}", err=as_json)


@commands.command()
@click.argument("file")
@click.option(
    "-o", "--output", required=True, metavar="NOTE", help="Write the note here; its ending is .pdf, .docx or .html."
)
@click.option("--step", metavar="DEG", help="Step of the tables, in degrees of crank angle.")
@click.option("--method", metavar="NAME", help="exact, textbook or series:N, instead of the file's own.")
@click.option("--lang", "language", type=_LANGUAGE, default="en", show_default=True, help="Language of the note.")
@click.option("--school", type=_LANGUAGE, help="Whose order of sections; that of the language if left out.")
@click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Override a key of the file.")
@click.option("--per-area", is_flag=True, help="Forces per piston area, in MPa.")
@click.option("--title", default="", metavar="TEXT", help="Title of the note, instead of the file's.")
@click.option("--author", default="", metavar="TEXT", help="Who hands it in.")
@click.option("--no-figures", is_flag=True, help="Leave the figures out.")
@click.option("--sheets", is_flag=True, help="Write drawing sheets beside it: NOTE-sheet-1.pdf, .svg and .dxf.")
@click.option("--overwrite", is_flag=True, help="Replace a note that is there.")
def report(  # noqa: PLR0913 - one argument per option of the command
    file: str,
    output: str,
    step: str | None,
    method: str | None,
    language: Any,  # noqa: ANN401 - one of three words, checked by click
    school: str | None,
    settings: tuple[str, ...],
    title: str,
    author: str,
    *,
    per_area: bool,
    no_figures: bool,
    sheets: bool,
    overwrite: bool,
) -> None:
    """Write the calculation note of a machine as PDF, Word or web page."""
    _load("note.formats").check_format(output)
    files, contents = _load("files"), _load("note.contents")
    files.check_files(output, overwrite=overwrite)
    machine = _machine(file, settings, step, method, per_area=per_area)
    options = _load("note.options").NoteOptions(
        language=language, school=school or "", per_area=per_area, title=title.strip(), author=author.strip(),
        figures=not no_figures, sheets=sheets,
    )  # fmt: skip
    results = _load("analysis").analyse(machine)
    written = {output: _load("note.formats").written_note(contents.note_of(results, options), output)}
    if sheets:
        stem = os.path.splitext(output)[0]  # noqa: PTH122 - a name, not a file
        written |= {stem + ending: data for ending, data in contents.sheets_of(results, options).items()}
    files.write_files(written, overwrite=overwrite)
    click.echo(f"{_load('report.language').word('written', language)} {', '.join(written)}")


@commands.command()
def schema() -> None:
    """Print the JSON Schema of the machine file, for editors."""
    click.echo(_load("description.machine_file").json_schema())


def _load(module: str) -> Any:  # noqa: ANN401 - a module
    """Import a room when a command needs it."""
    return importlib.import_module(f"crankwork.{module}")


def _machine(file: str, settings: tuple[str, ...], step: str | None, method: str | None, *, per_area: bool) -> Any:  # noqa: ANN401 - a machine of any kind
    """Return the machine of a file with the options of a command put into it."""
    door = _load("description.machine_file")
    overrides: list[Any] = list(settings)
    if step is not None:
        overrides.append(door.Setting("--step", "table.step", _degrees(step)))
    if method is not None:
        overrides.append(door.Setting("--method", "method.kinematics", method))
    machine = door.read(file, overrides)
    if per_area and not hasattr(machine, "cylinder"):
        raise CrankworkError("--per-area: is for machines with a piston; leave it out for a linkage")
    if per_area and machine.cylinder is None:
        raise CrankworkError("--per-area: needs the piston area; give cylinder.bore in the file")
    return machine


def _degrees(text: str) -> str:
    """Return a step with its unit, which may be left out."""
    return f"{text} deg" if text.strip()[-1:].isdecimal() else text


def _with_progress(steps: Iterable[dict[str, bytes]], count: int) -> dict[str, bytes]:
    """Gather the files of a folder, with a bar on the error stream once a second has passed."""
    contents: dict[str, bytes] = {}
    started = time.monotonic()
    show: Callable[[int], None] | None = None
    for done, files in enumerate(steps, start=1):
        contents |= files
        if show is None and time.monotonic() - started > 1 and sys.stderr.isatty() and done < count:
            bar = click.progressbar(length=count, file=sys.stderr)
            bar.update(done - 1)
            show = bar.update
        if show is not None:
            show(1)
    if show is not None:
        click.echo(err=True)
    return contents

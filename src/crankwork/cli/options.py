"""Options that commands share: the machine, the overrides of its file, its results; help in the requested language."""

from __future__ import annotations

import dataclasses
import functools
import json
import math
import os
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from crankwork.errors import CrankworkError, MethodError, MissingExtraError, missing_extras
from crankwork.locale import LANGUAGES, ErrorMessage, Language, has_text, translate
from crankwork.progress import progress_bar

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.description.machine_file import Setting
    from crankwork.machine import Machine
    from crankwork.show.theme import Theme

Decorator = Callable[[Callable[..., None]], Callable[..., None]]
_MAX_METHODS = 6


class DoubtfulError(CrankworkError):
    """Results that are inconsistent or incomplete: they are printed and written, and the command ends with 1."""


def language_of_system() -> Language:
    """Return the language of the system if it has texts, otherwise English."""
    stated = (os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG"))
    own = re.split(r"[_.@]", next(filter(None, stated), ""))[0]
    return next((language for language in LANGUAGES if language == own), "en")


def requested_language() -> Language:
    """Return the language of the command line, even if its arguments are wrong, or that of the system."""
    requested = re.findall(r"(?<=\0)--lang[\0=](\w+)(?=\0)", "\0".join(["", *sys.argv[1:], ""]))
    return next((language for language in LANGUAGES if language in requested[-1:]), language_of_system())


def placeholder(words: str) -> str:
    """Return the placeholders of a usage, `-o FILE`, in the language; literal words are in lower case."""

    def stand_in(match: re.Match[str]) -> str:
        return translate(stand_in_key(match[0]), requested_language()).upper().replace(" ", "-")

    # formats of paper are no placeholders
    return re.sub(r"[A-Z]+(?!\d)", stand_in, words)


def stand_in_key(word: str) -> str:
    """Return the key of the text of a placeholder."""
    return {"OPTIONS": "help.options", "VALUE": "columns.value"}.get(word, f"help.value_{word.lower()}")


def option_key(command: str, option: click.Parameter) -> str:
    """Return the key of the help text of an option: that of its command, or that of all commands."""
    name = option.opts[-1].lstrip("-").replace("-", "_")
    own = f"help.{command}_{name}"
    return own if has_text(own) else f"help.{name}"


class LocalizedCommand(click.Command):
    """A command with help in the requested language."""

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the usage of the command."""
        words = placeholder(" ".join(self.collect_usage_pieces(ctx)))
        formatter.write_usage(ctx.command_path, words, prefix=f"{translate('help.usage', requested_language())}: ")

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the purpose of the command."""
        self.help = self._purpose(self)
        super().format_help_text(ctx, formatter)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help of each option, and the purpose of each command of a group."""
        language = requested_language()
        rows = [
            (placeholder(record[0]), translate(option_key(str(self.name), option), language, default=option.default))
            for option in self.get_params(ctx)
            if isinstance(option, click.Option) and (record := option.get_help_record(ctx)) is not None
        ]
        with formatter.section(translate("help.options", language)):
            formatter.write_dl(rows)
        if isinstance(self, click.Group):
            with formatter.section(translate("help.commands", language)):
                purposes = [(name, self._purpose(command)) for name, command in sorted(self.commands.items())]
                formatter.write_dl(purposes)

    @staticmethod
    def _purpose(command: click.Command) -> str:
        return translate(f"help.command_{command.name}", requested_language())


class LocalizedGroup(LocalizedCommand, click.Group):
    """A group of commands with help in the requested language."""

    command_class = LocalizedCommand


def _together(*options: Decorator) -> Decorator:
    """Return several options as one, in the order of the help."""
    return lambda command: functools.reduce(lambda made, option: option(made), reversed(options), command)


LANGUAGE = click.Choice(LANGUAGES)
LANG = click.option("--lang", "language", type=LANGUAGE, default=language_of_system)
SYSTEM = click.option("--units", type=click.Choice(["metric", "si", "imperial"]))
SET = click.option("--set", "settings", multiple=True, metavar="KEY=VALUE")
METHOD = click.option("--method", metavar="NAME")
STEP = click.option("--step", metavar="DEG")
PER_AREA = click.option("--per-area", is_flag=True)
NO_FIGURES = click.option("--no-figures", is_flag=True)
FORMAT = click.option("--format", "formats", default="svg", metavar="FORMATS")
THEME = click.option("--theme", type=click.Choice(["print", "colour", "dark"]), default="print")
COMPARE = click.option("--compare", metavar="METHODS|FILE")
JSON = click.option("--json", "as_json", is_flag=True)
OVERWRITE = click.option("--overwrite", is_flag=True)
MACHINE, FIGURES = _together(LANG, SYSTEM, SET), _together(NO_FIGURES, FORMAT, THEME)


@dataclasses.dataclass(frozen=True)
class CommonOptions:
    """Values of the arguments and options that commands share; a command that lacks an option has its default."""

    language: Language
    file: str = ""
    settings: tuple[str, ...] = ()
    step: str | None = None
    method: str | None = None
    units: str | None = None
    compare: str | None = None
    formats: str = "svg"
    theme: Theme = "print"
    per_area: bool = False
    as_json: bool = False
    no_figures: bool = False
    overwrite: bool = False

    @functools.cached_property
    def overrides(self) -> list[str | Setting]:
        """Overrides of the file: settings, and options."""
        from crankwork.description.machine_file import Setting

        # the unit of a step is optional
        step = f"{self.step} deg" if self.step and self.step.strip()[-1:].isdecimal() else self.step
        options = (("table.step", step), ("method.kinematics", self.method), ("units", self.units))
        named = zip(("--step", "--method", "--units"), options, strict=True)
        return [*self.settings, *(Setting(name, key, value) for name, (key, value) in named if value is not None)]

    @functools.cached_property
    def machine(self) -> Machine:
        """The machine of the file with its overrides."""
        from crankwork.description.machine_file import read

        machine = read(self.file, self.overrides)
        if self.per_area and machine.cylinder is None:
            raise CrankworkError(ErrorMessage("per_area_bore"))
        return machine

    def results(self) -> Results:
        """Return the results of the machine, with those that it is compared with."""
        if self.compare is None:
            return analyse_with_progress(self.machine)
        from crankwork.analysis.compare import compare

        name, machines = _compared(self.machine, self.file, self.compare)
        results = analyse_with_progress(self.machine)
        compared = compare(results, {key: analyse_with_progress(other) for key, other in machines.items()}, name)
        if self.per_area and compared.compared is not None and not compared.compared.is_of_methods:
            raise CrankworkError(ErrorMessage("compare_per_area"))
        return compared

    def origin(self) -> Callable[[str, Iterable[float]], str]:
        """Return a function that gives the place in the file where numbers are stated."""
        from crankwork.description.document import origins
        from crankwork.note.explain import place_text

        places = origins(self.file, self.overrides)
        return lambda path, numbers: place_text(places(path, numbers), self.language)

    def print_result(self, text: Callable[[], str], data: Callable[[], object]) -> None:
        """Print a result as text or as JSON."""
        click.echo(json.dumps(data(), ensure_ascii=False, indent=1) if self.as_json else text())

    def print_written(self, names: str, before: str = "") -> None:
        """Print the names of written files, on the error stream if the output is JSON."""
        click.echo(f"{before}{translate('report.written', self.language)} {names}", err=self.as_json)

    def raise_if_unverified(self, results: Results) -> None:
        """Raise if results contradict each other or are incomplete; they have been printed and written."""
        from crankwork.report.summary import warning_text

        by_name = {self.file: results}
        if results.compared is not None:
            by_name |= zip(results.compared.names[1:], results.compared.others, strict=True)
        for name, checked in by_name.items():
            if warning := warning_text(checked, self.language):
                raise DoubtfulError(f"{name}: {warning}")


def _compared(machine: Machine, file: str, selection: str) -> tuple[str, dict[str, Machine]]:
    """Return the display name of a machine and the machines to compare it with, by name.

    `selection`: methods separated by commas, for which the machine itself needs no name, or a machine file, which ends
    in .toml.
    """
    from crankwork.analysis import with_method
    from crankwork.analysis.analyse import is_engine
    from crankwork.description.machine_file import read

    if PurePath(selection.strip()).suffix.lower() == ".toml":
        names = [PurePath(path).stem for path in (file, selection.strip())]
        own, other = names if names[0] != names[1] else (f"{names[0]}_1", f"{names[1]}_2")
        return own, {other: read(selection.strip())}
    methods = list(dict.fromkeys(method.strip() for method in selection.split(",")))
    if len(methods) > _MAX_METHODS:
        raise CrankworkError(ErrorMessage("compare_many", most=str(_MAX_METHODS)))
    compared = {}
    for name in methods:
        try:
            compared[name] = with_method(machine, name)
        except MethodError as error:
            raise CrankworkError(ErrorMessage("option_wrong", option="--compare", mistake=error.args[0])) from None
    if not is_engine(machine):
        raise CrankworkError(ErrorMessage("compare_linkage", methods=selection.strip()))
    if machine.method.name in compared:
        raise CrankworkError(ErrorMessage("compare_own", method=machine.method.name))
    return "", compared


def with_common_options(command: Callable[..., None]) -> Callable[..., None]:
    """Decorate a command: it takes shared options as one object, and its own options as arguments."""
    shared = {field.name for field in dataclasses.fields(CommonOptions)}

    @functools.wraps(command)
    def called(**arguments: Any) -> None:  # noqa: ANN401 - all that Click has read
        from crankwork.files import mark_inputs

        options = CommonOptions(**{name: arguments.pop(name) for name in shared & arguments.keys()})
        if options.file:
            mark_inputs(options.file)
        command(options, **arguments)

    return called


def parse_count(text: str) -> int:
    """Parse a positive integer; return 0 if the text is none."""
    return int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0


def parse_angle_or_time(text: str, dimension: str) -> float:
    """Parse a crank angle [deg] or a time [s], with or without a unit, also with a decimal comma."""
    from crankwork.units import parse_in

    try:
        value = parse_in(text, "deg" if dimension == "angle" else "s")
    except ValueError as error:
        raise CrankworkError(ErrorMessage("option_wrong", option="--at", mistake=error.args[0])) from None
    return round(math.degrees(value), 9) if dimension == "angle" else value


def parse_number(text: str) -> float:
    """Parse a number without a unit, also with a decimal comma; return 0 if the text is none."""
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return 0.0


def analyse_with_progress(machine: Machine) -> Results:
    """Analyse a machine, with a progress bar if its transient simulation takes more than a second."""
    from crankwork.analysis import analyse

    with progress_bar() as progress:
        return analyse(machine, progress=progress)


def parse_formats(text: str) -> tuple[str, ...]:
    """Parse the formats of figures, `svg,pdf`."""
    # few commands draw figures
    from crankwork.show.formats import FORMATS, MODULES

    formats = tuple(dict.fromkeys(name.strip().lower() for name in text.split(",") if name.strip()))
    wrong = [name for name in formats if name not in FORMATS]
    if wrong or not formats:
        name = ", ".join(wrong)[:60] or "--format"
        raise CrankworkError(ErrorMessage("figure_formats", name=name, known=", ".join(FORMATS)))
    modules = {module: extra for name in formats for module, extra in MODULES[name].items()}
    if extras := missing_extras(modules):
        raise MissingExtraError(ErrorMessage("extra_writing", names=[name.upper() for name in formats]), *extras)
    return formats


def drawing_ending(name: str, *, is_still: bool) -> str:
    """Return the format of an animation, or of one frame, from the name of its file."""
    # few commands draw
    from crankwork.show.formats import FILMS, FORMATS, MODULES

    ending = PurePath(name).suffix.lower().removeprefix(".")
    if is_still and ending in FILMS and ending not in FORMATS:
        raise CrankworkError(ErrorMessage("still_film", name=name[-60:], known=", ".join(FORMATS)))
    if ending not in (known := tuple(dict.fromkeys([*FILMS, *FORMATS]))):
        raise CrankworkError(ErrorMessage("drawing_ending", name=name[-60:], known=", ".join(known)))
    if extras := missing_extras(MODULES[ending]):
        raise MissingExtraError(ErrorMessage("extra_writing", names=ending.upper()), *extras)
    return ending

"""What the options of a command ask for: the machine, what is laid over its file, its results."""

from __future__ import annotations

import dataclasses
import functools
import json
import math
from collections.abc import Callable, Iterable
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from crankwork.errors import CrankworkError, DoubtfulError, MissingExtraError, missing_extras
from crankwork.locale import Language, Refusal, say
from crankwork.progress import bar

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.description.machine_file import Setting
    from crankwork.machine import Machine
    from crankwork.show.theme import Theme


@dataclasses.dataclass(frozen=True)
class Asked:
    """What the arguments and options that commands share ask for; a command that lacks one has its default."""

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
        """What is laid over the file: settings, and what options say instead of it."""
        from crankwork.description.machine_file import Setting

        # a step may be without its unit
        step = f"{self.step} deg" if self.step and self.step.strip()[-1:].isdecimal() else self.step
        options = (("table.step", step), ("method.kinematics", self.method), ("units", self.units))
        names = ("--step", "--method", "--units")
        said = zip(names, options, strict=True)
        return [*self.settings, *(Setting(name, key, one) for name, (key, one) in said if one is not None)]

    @functools.cached_property
    def machine(self) -> Machine:
        """The machine of the file with the options put into it."""
        from crankwork.description.machine_file import read

        machine = read(self.file, self.overrides)
        if self.per_area and machine.cylinder is None:
            raise CrankworkError(Refusal("per_area_bore"))
        return machine

    def results(self) -> Results:
        """Return the results of the machine, with those beside them that it is to be compared with."""
        if self.compare is None:
            return analysed(self.machine)
        from crankwork.analysis.compare import compare
        from crankwork.study.beside import comparison_machines

        name, machines = comparison_machines(self.machine, self.file, self.compare)
        results = analysed(self.machine)
        found = compare(results, {other: analysed(one) for other, one in machines.items()}, name)
        if self.per_area and found.compared is not None and not found.compared.is_of_methods:
            raise CrankworkError(Refusal("compare_per_area"))
        return found

    def origin(self) -> Callable[[str, Iterable[float]], str]:
        """Return what tells where in the file given numbers stand."""
        from crankwork.description.origins import origins
        from crankwork.note.explain import place_text

        found = origins(self.file, self.overrides)
        return lambda path, numbers: place_text(found(path, numbers), self.language)

    def tell(self, text: Callable[[], str], data: Callable[[], object]) -> None:
        """Print what was found, as text or as data."""
        click.echo(json.dumps(data(), ensure_ascii=False, indent=1) if self.as_json else text())

    def tell_written(self, names: str, before: str = "") -> None:
        """Say which files were written, beside data on the error stream."""
        click.echo(f"{before}{say('report.written', self.language)} {names}", err=self.as_json)

    def doubt(self, results: Results) -> None:
        """Raise if the results do not hold together, or do not cover what was asked; they were told and written."""
        from crankwork.report.summary import warning_text

        every = {self.file: results}
        if results.compared is not None:
            every |= zip(results.compared.names[1:], results.compared.others, strict=True)
        for name, one in every.items():
            if warning := warning_text(one, self.language):
                raise DoubtfulError(f"{name}: {warning}")


def asking(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command that takes what commands share as one thing, and options of its own beside it."""
    shared = {one.name for one in dataclasses.fields(Asked)}

    @functools.wraps(command)
    def called(**options: Any) -> None:  # noqa: ANN401 - whatever Click has read
        from crankwork.files import mark_inputs

        asked = Asked(**{name: options.pop(name) for name in shared & options.keys()})
        if asked.file:
            mark_inputs(asked.file)
        command(asked, **options)

    return called


def count_of(text: str) -> int:
    """Return a whole number of an option, 0 where it is none."""
    return int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0


def place_of(text: str, dimension: str) -> float:
    """Return a crank angle [deg] or a time [s], as a person writes it: without a unit, or with a decimal comma."""
    from crankwork.units import parse_in

    try:
        value = parse_in(text, "deg" if dimension == "angle" else "s")
    except ValueError as error:
        raise CrankworkError(Refusal("option_wrong", option="--at", mistake=error.args[0])) from None
    return round(math.degrees(value), 9) if dimension == "angle" else value


def factor_of(text: str) -> float:
    """Return a plain number of an option, 0 where it is none; a decimal comma is understood."""
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return 0.0


def analysed(machine: Machine) -> Results:
    """Return the results of a machine, with a bar on the error stream where one let go takes more than a second."""
    from crankwork.analysis import analyse

    with bar() as told:
        return analyse(machine, progress=told)


def formats_of(text: str) -> tuple[str, ...]:
    """Return the formats of figures that an option names, `svg,pdf`."""
    # figures are drawn by few commands
    from crankwork.show.formats import FORMATS, MODULES

    found = tuple(dict.fromkeys(one.strip().lower() for one in text.split(",") if one.strip()))
    wrong = [one for one in found if one not in FORMATS]
    if wrong or not found:
        raise CrankworkError(
            Refusal("figure_formats", name=", ".join(wrong)[:60] or "--format", known=", ".join(FORMATS))
        )
    modules = {module: extra for one in found for module, extra in MODULES[one].items()}
    if extras := missing_extras(modules):
        raise MissingExtraError(Refusal("extra_writing", names=[one.upper() for one in found]), *extras)
    return found


def film_ending(name: str, *, is_still: bool) -> str:
    """Return the format that the name of a moving drawing, or of a still of it, asks for."""
    # few commands draw
    from crankwork.show.formats import FILMS, FORMATS, MODULES

    ending = PurePath(name).suffix.lower().removeprefix(".")
    if is_still and ending in FILMS and ending not in FORMATS:
        raise CrankworkError(Refusal("still_film", name=name[-60:], known=", ".join(FORMATS)))
    if ending not in (known := tuple(dict.fromkeys([*FILMS, *FORMATS]))):
        raise CrankworkError(Refusal("drawing_ending", name=name[-60:], known=", ".join(known)))
    if extras := missing_extras(MODULES[ending]):
        raise MissingExtraError(Refusal("extra_writing", names=ending.upper()), *extras)
    return ending

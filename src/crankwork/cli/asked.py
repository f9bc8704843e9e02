"""What the options of a command ask for: the machine, what is laid over its file, its results."""

from __future__ import annotations

import math
from pathlib import PurePath
from typing import TYPE_CHECKING

from crankwork.errors import CrankworkError, DoubtfulError, MissingExtraError, missing_extras
from crankwork.locale import Language, Refusal
from crankwork.progress import bar

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.description.machine_file import Setting
    from crankwork.machine import Machine


def machine_of(file: str, overrides: list[str | Setting], *, per_area: bool) -> Machine:
    """Return the machine of a file with the options of a command put into it."""
    from crankwork.description.machine_file import read

    machine = read(file, overrides)
    if per_area and machine.cylinder is None:
        raise CrankworkError(Refusal("per_area_bore"))
    return machine


def laid_over(
    settings: tuple[str, ...], step: str | None = None, method: str | None = None, units: str | None = None
) -> list[str | Setting]:
    """Return the settings of a command with what its options say."""
    from crankwork.description.machine_file import Setting

    overrides: list[str | Setting] = list(settings)
    if step is not None:
        overrides.append(Setting("--step", "table.step", degrees(step)))
    if method is not None:
        overrides.append(Setting("--method", "method.kinematics", method))
    if units is not None:
        overrides.append(Setting("--units", "units", units))
    return overrides


def doubt(file: str, results: Results, language: Language) -> None:
    """Raise if the results do not hold together, or do not cover what was asked; they have been told and written."""
    from crankwork.report.summary import warning_text

    every = {file: results}
    if results.compared is not None:
        every |= zip(results.compared.names[1:], results.compared.others, strict=True)
    for name, one in every.items():
        if warning := warning_text(one, language):
            raise DoubtfulError(f"{name}: {warning}")


def degrees(text: str) -> str:
    """Return a step with its unit, which may be left out."""
    return f"{text} deg" if text.strip()[-1:].isdecimal() else text


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


def compared(machine: Machine, file: str, asked: str | None, *, per_area: bool) -> Results:
    """Return the results of a machine, with those beside them that it is to be compared with."""
    if asked is None:
        return analysed(machine)
    from crankwork.analysis.compare import compare
    from crankwork.study.beside import others

    name, machines = others(machine, file, asked)
    results = analysed(machine)
    found = compare(results, {other: analysed(one) for other, one in machines.items()}, name)
    if per_area and found.compared is not None and not found.compared.is_of_methods:
        raise CrankworkError(Refusal("compare_per_area"))
    return found


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

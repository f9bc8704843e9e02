"""Machines to compare a machine with: the same machine by other methods, or the machine of another file."""

from __future__ import annotations

from pathlib import PurePath

from crankwork.analysis import with_method
from crankwork.analysis.analyse import is_engine
from crankwork.description.machine_file import read
from crankwork.errors import CrankworkError, MethodError
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine

_MAX_METHODS = 6


def comparison_machines(machine: Machine, file: str, selection: str) -> tuple[str, dict[str, Machine]]:
    """Return the display name of a machine and the machines to compare it with, by name.

    `selection`: methods separated by commas, for which the machine itself needs no name, or a machine file, which ends
    in .toml.
    """
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

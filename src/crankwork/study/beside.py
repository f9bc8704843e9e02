"""What a machine is to be compared with: itself by other methods, or the machine of another file."""

from __future__ import annotations

from pathlib import PurePath

from crankwork.analysis import with_method
from crankwork.description.machine_file import read
from crankwork.errors import CrankworkError, MethodError
from crankwork.locale import Refusal
from crankwork.machine import Machine

_MOST = 6


def others(machine: Machine, file: str, asked: str) -> tuple[str, dict[str, Machine]]:
    """Return what a machine, that of a file, is called among machines, and what it is compared with, by name.

    Among its own methods it needs no name. `asked`: methods with commas between them, or a machine file, which ends in
    .toml.
    """
    if PurePath(asked.strip()).suffix.lower() == ".toml":
        names = [PurePath(one).stem for one in (file, asked.strip())]
        own, other = names if names[0] != names[1] else (f"{names[0]}_1", f"{names[1]}_2")
        return own, {other: read(asked.strip())}
    methods = list(dict.fromkeys(one.strip() for one in asked.split(",")))
    if len(methods) > _MOST:
        raise CrankworkError(Refusal("compare_many", most=str(_MOST)))
    found = {}
    for name in methods:
        try:
            found[name] = with_method(machine, name)
        except MethodError as error:
            raise CrankworkError(Refusal("option_wrong", option="--compare", mistake=error.args[0])) from None
    if machine.linkage is not None or machine.transfer is not None or machine.lengths is None:
        raise CrankworkError(Refusal("compare_linkage", methods=asked.strip()))
    if machine.method.name in found:
        raise CrankworkError(Refusal("compare_own", method=machine.method.name))
    return "", found

"""Origins of the inputs of a calculation in the machine file."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from crankwork import files
from crankwork.description.keys import OF_LINKAGE
from crankwork.description.machine_file import Setting, apply_settings, file_keys, parse
from crankwork.description.schema import TableSpec
from crankwork.description.stated import stated_numbers
from crankwork.description.toml_edit import locate
from crankwork.description.value_types import Reader

_SAME = 1e-9
# keys that determine a key which the file does not state
_FOLLOWS = (
    (r"engine\.bank_angle|cylinder\.inclination", ("engine.bank_angle", "engine.bank_angles", "engine.layout")),
    (r"engine\.(throws|firing_order)", ("engine.firing_order", "engine.layout")),
    (r"(gas|gas\.motored|gas\.cylinders\.\d+|chambers\.[^.]+)\.points\..*", (r"\1.pieces",)),
    (r"gas\.motored\.points\..*", ("gas.motored",)),
    # a chamber with one face may state the keys of the face itself
    (r"(chambers\.[^.]+)\.faces\[1\]\.(\w+)", (r"\1.\2",)),
    # the second joint of a link lies at its length
    (r"(links\.[^.]+)\.points\..*\[1\]", (r"\1.length",)),
    (r"(links\..*\.length|branch\..*|(links|sliders)\..*\.(points|centre).*)", ("positions",)),
    (r"crank\.(radius|stroke)|cylinder\.bore", ("cycle.power",)),
    (r"cylinder\.compression_ratio", ("cycle.timing",)),
    *OF_LINKAGE,
)


class Origin(NamedTuple):
    """Origin of a value: kind, key, and line or option.

    Kinds: stated on a `line`, set by an `option`, `follows_line` or `follows_option` from such a value, or `default`.
    """

    kind: str
    path: str
    line: str = ""


class _File:
    """A machine file with settings applied."""

    def __init__(self, source: str, name: str, overrides: Sequence[str | Setting]) -> None:
        self._values, self._lines = parse(source, name), locate(source)
        self._settings = apply_settings(self._values, overrides)
        self._keys = file_keys(self._values)
        self._stated = stated_numbers(self._keys.read(self._values, "", Reader.of(self._values)) or {})

    def origin(self, path: str, numbers: Iterable[float]) -> Origin:
        """Return the origin of a value that the calculation attributes to a path.

        `numbers`: the value in SI, and in the units in which a plain number may be stated.
        """
        numbers = tuple(numbers)
        for name in self._candidates(path):
            origin = self._origin_at(name)
            if origin is not None:
                return origin if self._is(name, numbers) else origin._replace(kind=f"follows_{origin.kind}")
        return Origin("default", path)

    def _candidates(self, path: str) -> Iterator[str]:
        """Yield the possible keys of a value: its path, equivalent keys, and keys that determine it."""
        yield path
        around, _, entry = path.rpartition("[")
        if around in self._lines and path not in self._lines:
            # a list read from a column of a file
            yield around
        named = self._raw(around)
        if isinstance(named, str):
            # a position may be the name of a fixed point
            yield f"fixed_points.{named}[{entry}"
        *tables, last = path.split(".")
        known: Any = self._keys
        for name in tables:
            known = known.keys[name].kind if isinstance(known, TableSpec) and name in known.keys else None
        if isinstance(known, TableSpec) and last in known.keys:
            yield from (".".join([*tables, other]) for other in known.keys[last].instead_of)
        parts = re.split(r"[.\[]", path)
        above = [path[: len(path) - len("".join(parts[-1:])) - 1]]
        yield from (table for table in above if not isinstance(self._raw(table), dict | None))
        for pattern, keys in _FOLLOWS:
            match = re.fullmatch(pattern, path)
            yield from (match.expand(key) for key in keys if match)

    def _origin_at(self, name: str) -> Origin | None:
        setting = next(
            (candidate for candidate in self._settings if re.match(rf"{re.escape(candidate.key)}($|[.\[])", name)), None
        )
        if setting is not None:
            return Origin("option", name, setting.option)
        return Origin("line", name, str(self._lines[name])) if name in self._lines else None

    def _is(self, name: str, numbers: tuple[float, ...]) -> bool:
        stated = self._stated.get(name)
        if stated is None:
            return False
        return any(
            math.isclose(stated.value, number, rel_tol=_SAME) for number in (numbers[:1] if stated.unit else numbers)
        )

    def _raw(self, path: str) -> Any:  # noqa: ANN401 - whatever a file holds
        """Return the raw value at a path, None if there is none."""
        value: Any = self._values
        for name in path.split("."):
            value = value.get(name) if isinstance(value, dict) else None
        return value


def origins(path: str | Path, overrides: Sequence[str | Setting] = ()) -> Callable[[str, Iterable[float]], Origin]:
    """Return a function that maps an input path and its value to its origin: line, option or default.

    A value that differs from the stated one follows from it.
    """
    return origins_of(files.read_text(Path(path)), str(path), overrides)


def origins_of(
    source: str, name: str = "text", overrides: Sequence[str | Setting] = ()
) -> Callable[[str, Iterable[float]], Origin]:
    """Return `origins` of a text."""
    return _File(source, name, overrides).origin

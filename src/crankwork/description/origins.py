"""Where a machine file states the values that a calculation began with."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from crankwork import files
from crankwork.description.kinds import Reader
from crankwork.description.locate import locate
from crankwork.description.machine_file import Setting, file_keys, lay, parse, settings_of
from crankwork.description.schema import Table
from crankwork.description.stated import stated_numbers

_SAME = 1e-9
# what a key follows from where the file leaves it out
_FOLLOWS = (
    (r"engine\.bank_angle|cylinder\.inclination", ("engine.bank_angle", "engine.bank_angles", "engine.layout")),
    (r"engine\.(throws|firing_order)", ("engine.firing_order", "engine.layout")),
    (r"(gas|gas\.motored|gas\.cylinders\.\d+|chambers\.[^.]+)\.points\..*", (r"\1.pieces",)),
    (r"gas\.motored\.points\..*", ("gas.motored",)),
    # a chamber with one face may have its keys beside the others
    (r"(chambers\.[^.]+)\.faces\[1\]\.(\w+)", (r"\1.\2",)),
    # the second joint of a link lies as far along it as it is long
    (r"(links\.[^.]+)\.points\..*\[1\]", (r"\1.length",)),
    (r"(links\..*\.length|branch\..*|(links|sliders)\..*\.(points|centre).*)", ("positions",)),
    (r"crank\.(radius|stroke)|cylinder\.bore", ("cycle.power",)),
    (r"cylinder\.compression_ratio", ("cycle.timing",)),
)


class Origin(NamedTuple):
    """Where a value comes from: how, by which key, and on which line or by which option.

    It stands at a `line`, was set by an `option`, `follows_line` or `follows_option` from what stands there, or is a
    `default`.
    """

    kind: str
    path: str
    line: str = ""


class _File:
    """A machine file with settings laid over it."""

    def __init__(self, source: str, name: str, settings: Sequence[Setting]) -> None:
        self._values, self._lines, self._settings = parse(source, name), locate(source), settings
        for one in settings:
            lay(self._values, one)
        self._keys = file_keys(self._values)
        is_old = self._values.get("format", 1) == 1
        reader = Reader(decimal_comma=self._values.get("decimal_mark") == ",", metric_hp=is_old)
        self._stated = stated_numbers(self._keys.read(self._values, "", reader) or {})

    def origin(self, path: str, numbers: Iterable[float]) -> Origin:
        """Return where a value comes from that the calculation says to stand at a path.

        `numbers`: the value in SI, and in the units in which it may be written without one.
        """
        numbers = tuple(numbers)
        for name in self._candidates(path):
            stands = self._stands(name)
            if stands is not None:
                return stands if self._is(name, numbers) else stands._replace(kind=f"follows_{stands.kind}")
        return Origin("default", path)

    def _candidates(self, path: str) -> Iterator[str]:
        """Yield what a value may stand under: its path, keys that say the same, and what it follows from."""
        yield path
        around, _, entry = path.rpartition("[")
        if around in self._lines and path not in self._lines:
            # a list that is a column of a file
            yield around
        named = self._raw(around)
        if isinstance(named, str):
            # a place may be that of a fixed point
            yield f"fixed_points.{named}[{entry}"
        *tables, last = path.split(".")
        known: Any = self._keys
        for name in tables:
            known = known.keys[name].kind if isinstance(known, Table) and name in known.keys else None
        if isinstance(known, Table) and last in known.keys:
            yield from (".".join([*tables, one]) for one in known.keys[last].instead_of)
        parts = re.split(r"[.\[]", path)
        above = [path[: len(path) - len("".join(parts[-1:])) - 1]]
        yield from (one for one in above if not isinstance(self._raw(one), dict | None))
        for pattern, found in _FOLLOWS:
            match = re.fullmatch(pattern, path)
            yield from (match.expand(one) for one in found if match)

    def _stands(self, name: str) -> Origin | None:
        setting = next((one for one in self._settings if re.match(rf"{re.escape(one.key)}($|[.\[])", name)), None)
        if setting is not None:
            return Origin("option", name, setting.option)
        return Origin("line", name, str(self._lines[name])) if name in self._lines else None

    def _is(self, name: str, numbers: tuple[float, ...]) -> bool:
        stated = self._stated.get(name)
        if stated is None:
            return False
        return any(math.isclose(stated.value, one, rel_tol=_SAME) for one in (numbers[:1] if stated.unit else numbers))

    def _raw(self, path: str) -> Any:  # noqa: ANN401 - whatever a file holds
        """Return what stands at a path, None where nothing does."""
        found: Any = self._values
        for name in path.split("."):
            found = found.get(name) if isinstance(found, dict) else None
        return found


def origins(path: str | Path, overrides: Sequence[str | Setting] = ()) -> Callable[[str, Iterable[float]], Origin]:
    """Return what says where a value of a calculation comes from, by the path that it is said to stand at.

    The value is compared with what stands there: what differs follows from it and does not stand there itself.
    """
    return origins_of(files.read_text(Path(path)), str(path), overrides)


def origins_of(
    source: str, name: str = "text", overrides: Sequence[str | Setting] = ()
) -> Callable[[str, Iterable[float]], Origin]:
    """Return what `origins` does, of a text."""
    return _File(source, name, settings_of(overrides)).origin

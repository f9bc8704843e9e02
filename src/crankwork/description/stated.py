"""The numbers of a machine file by their paths, as they are stated."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from crankwork.description.kinds import Measure
from crankwork.machine import Stated


def stated_numbers(values: Mapping[str, Any]) -> dict[str, Stated]:
    """Return the numbers of values that were read, entries of lists counted from one: `efficiency.chain[2]`."""
    return dict(_numbers("", values))


def _numbers(path: str, value: Any) -> Iterator[tuple[str, Stated]]:  # noqa: ANN401 - tables, lists and quantities
    match value:
        case Measure():
            yield path, Stated(value.value, value.unit)
        case bool():
            return
        case int() | float():
            yield path, Stated(float(value))
        case str() if found := re.fullmatch(r"(\d+) deg", value):
            yield path, Stated(math.radians(float(found[1])), "deg")
        case Mapping():
            for name, one in value.items():
                yield from _numbers(f"{path}.{name}" if path else name, one)
        case list():
            for at, one in enumerate(value, start=1):
                yield from _numbers(f"{path}[{at}]", one)

"""The numbers stated in a machine file, by path."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from crankwork.description.value_types import MeasuredValue, look_alikes
from crankwork.machine import InputNumber
from crankwork.units import TO_LATIN


def stated_numbers(values: Mapping[str, Any]) -> dict[str, InputNumber]:
    """Return the numbers of read values by path; entries of lists are counted from 1, `efficiency.chain[2]`."""
    return dict(_numbers("", values))


def _numbers(path: str, value: Any) -> Iterator[tuple[str, InputNumber]]:  # noqa: ANN401 - tables, lists and quantities
    match value:
        case MeasuredValue():
            yield path, InputNumber(value.value, value.unit)
        case bool():
            return
        case int() | float():
            yield path, InputNumber(float(value))
        case str() if match := re.fullmatch(r"(\d+) deg", value):
            yield path, InputNumber(math.radians(float(match[1])), "deg")
        case Mapping():
            for name, item in value.items():
                yield from _numbers(f"{path}.{name}" if path else name, item)
        case list():
            for index, item in enumerate(value, start=1):
                yield from _numbers(f"{path}[{index}]", item)


def mistaken_names(values: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Yield path, Cyrillic letters and Latin spelling of names that are another name of the file but for these."""
    words = [(path, text) for path, text in _words("", values) if path != "title"]
    names = {text for _, text in words}
    for path, text in words:
        if (letters := look_alikes(text)) and text.translate(TO_LATIN) in names:
            yield path, letters, text.translate(TO_LATIN)


def _words(path: str, value: Any) -> Iterator[tuple[str, str]]:  # noqa: ANN401 - tables, lists and texts
    """Yield texts and names of tables by path."""
    if isinstance(value, str):
        yield path, value
    items = (
        value.items() if isinstance(value, Mapping) else enumerate(value, start=1) if isinstance(value, list) else ()
    )
    for name, item in items:
        inner = f"{path}[{name}]" if isinstance(name, int) else f"{path}.{name}".lstrip(".")
        if isinstance(name, str):
            yield inner, name
        yield from _words(inner, item)

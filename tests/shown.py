"""Machines of the examples and templates, analysed once and drawn once for all tests of a process."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import read, read_machine, template
from crankwork.machine import Machine
from crankwork.quantities import Language
from crankwork.report.drawing import moving_drawing
from crankwork.report.figures import drawings
from crankwork.show.animation import Animation
from crankwork.show.scene import Drawing
from each import for_each

ROOT = Path(__file__).parents[1]
EXAMPLES = {path.stem: path for path in sorted((ROOT / "examples").glob("*.toml"))}
_TEMPLATES = ROOT / "src" / "crankwork" / "description" / "templates"
TEMPLATES = {f"template {path.stem}": path for path in sorted(_TEMPLATES.glob("*.toml"))}
MACHINES = {path.stem: path for path in sorted((ROOT / "tests" / "machines").glob("*.toml"))}
FILES = MACHINES | EXAMPLES | TEMPLATES
# together they have every kind of figure, and are quick to analyse
FEW = (
    "petrol-four", "spark-engine", "atkinson", "andrews-squeezer", "excavator-boom", "overhung-slide",
    "punching-machine", "press", "vibrating-crankshaft",
)  # fmt: skip
REST = tuple(name for name in EXAMPLES | TEMPLATES if name not in FEW)

# one of the languages with wide letters for each of the rest
WIDE: dict[str, Language] = {name: "ru" if at % 2 else "vi" for at, name in enumerate(REST)}


def machine_of(name: str) -> Machine:
    """Return what a file describes, a template with its words."""
    return read_machine(template(name.removeprefix("template "))) if name in TEMPLATES else read(FILES[name])


@functools.cache
def results_of(name: str, method: str = "") -> Results:
    """Return the results of a machine; `method`: another one than its file states."""
    machine = machine_of(name)
    return analyse(machine, method=machine.method.named(method)) if method else analyse(machine)


def figures_of(name: str, language: Language | None = None, *, per_area: bool = False) -> dict[str, Drawing]:
    """Return the figures of a machine by their names; those of the rest are in a language of their own."""
    return _figures_of(name, language or WIDE.get(name, "en"), per_area=per_area)


@functools.lru_cache(maxsize=64)
def _figures_of(name: str, language: Language, *, per_area: bool) -> dict[str, Drawing]:
    return drawings(results_of(name), language=language, per_area=per_area)


@functools.cache
def film_of_file(name: str, method: str = "") -> Animation:
    """Return the moving drawing of a machine."""
    return moving_drawing(results_of(name, method))


def in_parts(keys: str | tuple[str, ...], few: Iterable[Any], rest: Iterable[Any]) -> Callable[[Any], Any]:
    """Call a test once for each of a few, as one case, and for each of the rest in a slow case."""

    taken = (keys,) if isinstance(keys, str) else keys

    def parted(test: Any) -> Any:
        parts = {"few": for_each(keys, few)(test), "rest": for_each(keys, rest)(test)}

        @functools.wraps(test)
        def of_part(part: str, **fixtures: Any) -> None:
            parts[part](**fixtures)

        own = [one for one in inspect.signature(test).parameters.values() if one.name not in taken]
        part = inspect.Parameter("part", inspect.Parameter.POSITIONAL_OR_KEYWORD)
        of_part.__signature__ = inspect.Signature([part, *own])  # type: ignore[attr-defined]
        return pytest.mark.parametrize("part", ["few", pytest.param("rest", marks=pytest.mark.slow)])(of_part)

    return parted

"""Experiments: results over ranges of numbers, or of designs drawn from them, with progress."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from crankwork import files
from crankwork.description.document import Description
from crankwork.description.written import document
from crankwork.errors import CrankworkError
from crankwork.locale import Language, Refusal
from crankwork.show.inline import inline_svg
from crankwork.show.scene import Drawing
from crankwork.study.map_figures import map_drawings
from crankwork.study.mapped import ends_of, map_text, mapped


class StoppedError(Exception):
    """The client has disconnected."""


def run_experiment(
    description: Description, request: Mapping[str, Any], language: Language, progress: Callable[[float], None]
) -> dict[str, Any]:
    """Return text and figures of a map over `over`, ranges by key, or of `count` designs drawn from these."""
    over = {str(key): str(ends) for key, ends in request["over"].items()}
    if request.get("count"):
        return _swept(description, over, request, language, progress)
    parameter_map = mapped(description, [f"{key}={ends}" for key, ends in over.items()], (), progress)
    return {"text": map_text(parameter_map, language), "figures": _figures(map_drawings(parameter_map, language))}


def _swept(
    description: Description, over: Mapping[str, str], request: Mapping[str, Any], language: Language,
    progress: Callable[[float], None],
) -> dict[str, Any]:  # fmt: skip
    from crankwork.study.found_figures import found_drawings  # noqa: PLC0415 - only sweeps need its parts
    from crankwork.study.found_text import found_text  # noqa: PLC0415
    from crankwork.study.running import ExecutionOptions, run_study  # noqa: PLC0415
    from crankwork.study.study_file import read_study  # noqa: PLC0415

    ends = {key: dict(zip(("from", "to"), ends_of(text), strict=True)) for key, text in over.items()}
    if not re.fullmatch("[0-9]{1,9}", str(request["count"])):
        raise CrankworkError(Refusal("whole_range", value=str(request["count"])[:20], low="1", high="1000000"))
    text = document({
        "machine": "machine.toml",
        "designs": {"drawing": "sobol", "count": int(request["count"])},
        "vary": ends,
        "objectives": {str(key): str(sense) for key, sense in request.get("objectives", {}).items()},
    })  # fmt: skip
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        files.write_files({Path(folder) / "machine.toml": description.dump().encode()})
        study = read_study(text, "study", folder=Path(folder))
        done: Callable[[int], None] = lambda count: progress(count / study.count)  # noqa: E731
        aggregate = run_study(study, Path(folder) / "found", ExecutionOptions(1), progress=done)
        drawn = found_drawings(study, aggregate, language)
        return {"text": found_text(study, aggregate, language), "figures": _figures(drawn)}


def _figures(drawn: Mapping[str, Drawing]) -> dict[str, tuple[str, str]]:
    """Return figures by name, each with its title."""
    return {name: (drawing.title, inline_svg(drawing, name, drawing.title)) for name, drawing in drawn.items()}

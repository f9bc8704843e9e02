"""What stands in figures: the words and numbers of each kind, every line where it was, and which curve is what."""

from __future__ import annotations

import math
import re
import zlib
from pathlib import Path

import numpy as np
import pytest

from crankwork.locale.numbers import unit_name
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.quantities.quantity import use_numbers
from crankwork.report.display import link_numbers
from crankwork.report.drawing import moving_drawing
from crankwork.report.look import math_symbol, quantity_of
from crankwork.show.canvas import marked
from crankwork.show.scene import Arc, Circle, Drawing, Polyline, Text, extent, pen_of, runs
from crankwork.units import UNITS, to_si
from each import for_each
from shown import FEW, REST, figures_of, film_of_file, in_parts, results_of

# written anew by this module when it is run as a program: what has changed is for a reader to judge
STORED = Path(__file__).with_name("figures.txt")
LANGUAGE_OF = {"atkinson": "ru", "excavator-boom": "vi", "punching-machine": "ru", "press": "vi"}
UNIT_OF = {unit_name(unit, language): unit for unit in UNITS for language in LANGUAGES}
NUMBER = re.compile(r"−?\d+(?:[.,]\d+)?(?:e[−+]\d+)?")


def pictures(name: str) -> dict[str, Drawing]:
    """Return the figures of a machine of a kind that no machine before it has, all of the boom, and stills of films."""
    others = FEW[: FEW.index(name)] if name != "excavator-boom" else ()
    before = {figure for other in others for figure in figures_of(other, LANGUAGE_OF.get(other, "en"))}
    found = figures_of(name, LANGUAGE_OF.get(name, "en"))
    return {figure: one for figure, one in found.items() if figure not in before} | stills(name)


def stills(name: str) -> dict[str, Drawing]:
    """Return two stills of the film of a machine that has one, and one with forces."""
    results = results_of(name)
    if results.machine.linkage is None and results.machine.lengths is None:
        return {}
    film, forces = film_of_file(name), moving_drawing(results, forces=True, frames=24)
    return {"film": film.still(0), "film later": film.still(17), "forces": forces.still(5)}


def content(drawing: Drawing) -> list[str]:
    """Return what a picture says, its legend, its curves with their ends and pens, and where everything stands."""
    told = [" | ".join([drawing.title, *("".join(run.text for run in runs(one.text)) for one in texts(drawing))])]
    for plot in drawing.plots:
        angles = [f"{key} {numbers([np.mean(one)])}" for key, one in plot.angles.items()]
        told.append(" ".join([f"plot {plot.over}: {numbers([*plot.x, *plot.y])}", *angles]))
        for key, (x, y) in plot.curves.items():
            known = np.isfinite(x + y)
            parts = [np.min(x[known]), np.max(x[known]), np.min(y[known]), np.max(y[known]), np.mean(y[known])]
            told.append(f"curve {key}: {numbers([*parts, *lines_of(drawing, key)])}")
    told += [f"legend {numbers(pen_of(line.kind)[0:1])} {numbers(pen_of(line.kind).dashes)}: {text}"
             for line, text in legend(drawing)]  # fmt: skip
    told.append(f"paper: {numbers([drawing.width, drawing.height])}")
    for kind in (Polyline, Circle, Arc, Text):
        items = [one for one in drawing.items if isinstance(one, kind)]
        boxes = np.array([extent(one) for one in items]).reshape(-1, 4)
        pens = [pen_of(one.kind) if kind is not Text else (one.height, (), one.grey) for one in items]
        ink = [sum(pen[0] + sum(pen[1]) + pen[2] for pen in pens)]
        told += [f"{kind.__name__} {len(items)}: {numbers([*boxes.sum(axis=0), *ink])}"] if items else []
    return told


def lines_of(drawing: Drawing, key: str) -> list[float]:
    """Return the width and the dashes of the line of a curve."""
    pens = [pen_of(one.kind) for one in drawing.items if isinstance(one, Polyline) and one.name == key]
    return [pens[0].width, *pens[0].dashes] if pens else []


def legend(drawing: Drawing) -> list[tuple[Polyline, str]]:
    """Return the samples of a legend and what is written beside them."""
    after = zip(drawing.items, drawing.items[1:], strict=False)
    return [(one, text.text) for one, text in after if isinstance(one, Polyline) and one.name == "legend"
            and isinstance(text, Text)]  # fmt: skip


def texts(drawing: Drawing) -> list[Text]:
    """Return the texts of a picture that are no numbers of an axis."""
    return [one for one in drawing.items if isinstance(one, Text) and not re.fullmatch(r"−?[\d.,]+", one.text)]


def numbers(values) -> str:
    """Return numbers to seven digits."""
    return " ".join(f"{value:.7g}".replace("-", "−") for value in values)


def are_alike(found: str, stored: str) -> bool:
    """Return whether two lines have the same words, and numbers that differ by rounding alone."""
    (words, one), (others, other) = (
        (NUMBER.sub("#", line), [_value(text) for text in NUMBER.findall(line)]) for line in (found, stored)
    )
    if words != others:
        return False
    size = max(map(abs, other), default=0.0) if found.startswith("curve") else 0.0
    return all(math.isclose(a, b, rel_tol=2e-6, abs_tol=1e-7 * size) for a, b in zip(one, other, strict=True))


def _value(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def in_short(name: str) -> list[str]:
    """Return one line for each picture of a machine: the sum of its words, and that of its numbers."""
    told = {figure: "\n".join(content(one)) for figure, one in (figures_of(name) | stills(name)).items()}
    sums = {figure: sum(abs(_value(one)) for one in NUMBER.findall(text)) for figure, text in told.items()}
    words = {figure: zlib.crc32(NUMBER.sub("#", text).encode()) for figure, text in told.items()}
    return [f"{figure} {words[figure]:08x}: {numbers([sums[figure]])}" for figure in told]


def _written() -> dict[str, list[str]]:
    blocks = STORED.read_text("utf-8").strip().split("\n\n")
    return {head: lines for head, *lines in (block.split("\n") for block in blocks)}


@for_each("name", FEW)
def test_every_kind_of_figure_says_and_shows_what_it_did(name):
    written = _written()
    found = {f"{name}: {figure}": content(one) for figure, one in pictures(name).items()}
    assert [key for key in written if key.startswith(f"{name}: ")] == list(found)
    pairs = [(key, *two) for key, lines in found.items() for two in zip(lines, written[key], strict=True)]
    assert [one for one in pairs if not are_alike(one[1], one[2])] == []


@in_parts("name", FEW, REST)
def test_curves_are_the_columns_that_they_are_named_after_in_the_unit_of_their_axis(name):
    results, wrong = results_of(name), []
    for figure, drawing in figures_of(name).items():
        for plot in (one for one in drawing.plots if one.over == "crank_angle"):
            unit = UNIT_OF.get(plot.titles.get("y", "").rpartition(", ")[2], "")
            named = {key: curve for key, curve in plot.curves.items() if key in results.columns}
            for (x, y), key in zip(named.values(), named, strict=True):
                degrees = np.mod(x[1:-1:11], results.machine.cycle)
                column = results.columns_at(degrees, [key])[key]
                own = unit or QUANTITIES[key.partition(".")[0]].unit
                apart = np.nanmedian(np.abs((to_si(y[1:-1:11], own) if own else y[1:-1:11]) - column))
                wrong += [] if apart <= 1e-6 * np.nanmax(np.abs(column)) + 1e-12 else [(figure, key, unit)]
    assert wrong == []


@in_parts("name", FEW, REST)
def test_a_legend_has_the_line_of_the_curve_that_it_names(name):
    """A curve that lies on another one is in the row of that one."""
    wrong = []
    for figure, drawing in figures_of(name).items():
        for plot in drawing.plots if figure not in ("kinematics", "brix", "crank_speed") else ():
            highest = max(one.box.top for one in drawing.plots)
            rows = [(line.kind, text) for line, text in legend(drawing)
                    if plot.box.bottom < (y := line.points[0, 1]) < plot.box.top or y > highest]  # fmt: skip
            for key in plot.curves if rows else ():
                pens = {one.kind for one in drawing.items if isinstance(one, Polyline) and one.name == key}
                if key.partition(".")[0] in QUANTITIES and pens:
                    # of curves of one kind the axis has the name
                    with use_numbers(link_numbers(results_of(name))):
                        named = marked(math_symbol(quantity_of(key).symbol(drawing.language)))
                    is_told = quantity_of(key).label(drawing.language) in plot.titles.get("y", "") or any(
                        text.startswith(named) or f", {named}" in text for kind, text in rows if kind in pens
                    )
                    wrong += [] if is_told else [(figure, key, rows)]
    assert wrong == []


@pytest.mark.slow
@for_each("name", REST)
def test_the_figures_of_all_other_machines_are_what_they_were(name):
    pairs = list(zip(in_short(name), _written()[name], strict=True))
    assert [one for one in pairs if not are_alike(*one)] == []


def write() -> None:
    """Write what figures say now."""
    blocks = ["\n".join([f"{name}: {figure}", *content(one)]) for name in FEW for figure, one in pictures(name).items()]
    blocks += ["\n".join([name, *in_short(name)]) for name in REST]
    STORED.write_text("\n\n".join(blocks) + "\n", "utf-8")


if __name__ == "__main__":
    write()

"""Sections of the note of an engine: flywheel, main journals, the row that is worked, units and symbols."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from crankwork.formula.calculation_lines import FormulaLine
from crankwork.locale.numbers import number
from crankwork.note.document import Equation, Figure, Heading, Math, Strong
from crankwork.note.equations import by_area, printed_equation, with_area
from crankwork.note.layout import Box, Upright
from crankwork.quantities import LANGUAGES
from crankwork.quantities.key import key_of
from crankwork.report.display import is_per_area
from crankwork.report.drawing import dimensioned, film_of
from crankwork.report.figures import drawings
from crankwork.show.scene import Polyline, Text
from each import failing, for_each
from notes import blocks, nomenclature, note, results, tables

FOUR = "petrol-four"
# tables of the short note over the crank angle, and the angle that the note works for them
WORKED = {"motion": 30, "along": 390, "forces": 390, "total": 30, "crankpin": 390, "mains": 390}


def short(language="en", name=FOUR, **options):
    return note(name, language, full=False, **options)


def value_of(text):
    return float(text.replace("−", "-").replace(",", "."))


# --- flywheel


def test_the_flywheel_is_found_in_the_diagram_that_is_drawn():
    """A dense grid of the energy and the inertia gives the tangents again, and with them the flywheel."""
    names = {block.label for block in blocks(short(figures=True), Figure)}
    assert "f:wittenbauer" in names
    assert "f:excess_work" not in names
    found = results(FOUR)
    degrees = np.arange(0.0, 720.0, 0.05)
    dense = found.columns_at(degrees, ["kinetic_energy_change", "reduced_inertia"])
    energy, inertia = dense["kinetic_energy_change"], dense["reduced_inertia"]
    w, delta = 5600 * math.pi / 30, 0.01
    high, low = (w**2 / 2 * (1 + sign * delta / 2) ** 2 for sign in (1, -1))
    work = np.max(energy - high * inertia) - np.min(energy - low * inertia)
    assert work / (delta * w**2) == pytest.approx(found.summary["flywheel_inertia.exact"], rel=1e-5)
    (plot,) = drawings(found, only=["wittenbauer"])["wittenbauer"].plots
    feet = [plot.curves[name][1][0] for name in ("max", "min")]
    assert feet[0] - feet[1] == pytest.approx(work, rel=1e-4)


@for_each("language", LANGUAGES)
def test_each_excess_work_has_a_symbol_of_its_own(language):
    works = {block.step.key: block.symbol for block in blocks(note(FOUR, language), Equation)
             if isinstance(block.step.key, str) and key_of(block.step.key).quantity == "excess_work"}  # fmt: skip
    assert len(works) == 4
    assert len(set(works.values())) == len(works)


# --- main journals


@for_each("name", [FOUR, "v8-diesel"])
def test_the_forces_on_the_throws_add_up_to_the_load_of_a_journal(name):
    found, table = results(name), tables(short(name=name))["on_journal"]
    *rows, last = table.rows
    assert isinstance(last[0], Strong)
    along, across = (sum(value_of(row[column]) for row in rows) for column in (4, 5))
    assert [along, across] == pytest.approx([value_of(cell) for cell in last[4:]], abs=0.01)
    number_of = "2" if "main_journal_load.2" in found.columns else "1"
    load = found.columns_at([390.0], [f"main_journal_load.{number_of}"])[f"main_journal_load.{number_of}"][0]
    assert math.hypot(along, across) == pytest.approx(load / 1e3, rel=1e-3)
    # each is the share of its force, turned round
    for row in rows:
        assert value_of(row[4]) == pytest.approx(-value_of(row[1]) * value_of(row[2]), abs=0.01)


def test_vietnamese_notes_have_the_sections_that_their_conclusion_tells():
    headings = [block.text for block in blocks(short("vi"), Heading) if block.level == 1]
    assert {"Cổ trục khuỷu", "Cân bằng động cơ"} <= {*headings}
    assert headings.index("Đồ thị mài mòn chốt khuỷu") < headings.index("Cổ trục khuỷu")


# --- the row that is worked


@for_each("name", WORKED)
def test_the_row_that_is_worked_stands_in_bold_in_the_table(name):
    table = tables(short())[name]
    marked = [row for row in table.rows if isinstance(row[0], Strong)]
    assert [row[0] for row in marked] == [str(WORKED[name])]
    assert all(isinstance(cell, Strong) for cell in marked[0])


def test_the_bold_row_has_the_numbers_of_the_equations():
    (row,) = (row for row in tables(short())["along"].rows if isinstance(row[0], Strong))
    worked = {block.step.key: block.step.value for block in blocks(short(), Equation)
              if isinstance(block.step, FormulaLine)}  # fmt: skip
    shown = [value_of(cell) for cell in row[1:]]
    expected = [worked["gas_pressure"] / 1e6, worked["gas_force"] / 1e3, worked["piston_acceleration"],
                worked["inertia_force"] / 1e3, worked["piston_force"] / 1e3]  # fmt: skip
    # the acceleration is worked at 30 degrees, where it is the same as a turn later
    assert shown == pytest.approx(expected, rel=2e-3)


# --- one unit for a quantity, symbols with a meaning


def uprights(box: Box) -> set[str]:
    parts = [getattr(box, name) for name in getattr(box, "__slots__", ())]
    inside = [item for part in parts for item in (part if isinstance(part, tuple) else (part,))]
    own = {box.text} if isinstance(box, Upright) else set()
    return own.union(*(uprights(item) for item in inside if hasattr(item, "__slots__")))


def test_forces_by_the_piston_area_are_in_one_unit_throughout():
    def check(block):
        units = set().union(*map(uprights, printed_equation(block, "vi").lines))
        assert not units & {"N", "kN"}, units

    forces = [block for block in blocks(short("vi"), Equation)
              if isinstance(block.step, FormulaLine) and is_per_area(block.step.key) and block.area]  # fmt: skip
    assert len(forces) > 10
    assert failing({block.step.key: block for block in forces}, check) == {}


def test_a_step_by_the_piston_area_is_true_as_it_is_printed():
    """M = T F R with T by the area; P = P + P and m + m by the area are sums of what is printed."""
    area = results(FOUR).summary["piston_area"]
    steps = {block.step.key: block.step for block in blocks(short(), Equation) if isinstance(block.step, FormulaLine)}
    total, ((value, unit),) = by_area(steps["piston_force"], area)
    assert unit == "MPa"
    assert sum(total.values.values()) == pytest.approx(value)
    assert value == pytest.approx(6803 / area / 1e6, rel=1e-3)
    torque = with_area(steps["crank_torque"], area)
    assert math.prod(torque.values.values()) == pytest.approx(165.7, rel=1e-3)
    assert torque.values["A"] == area


@for_each("language", LANGUAGES)
def test_symbols_above_the_columns_of_lists_have_a_meaning(language):
    one = short(language)
    known = {symbol.content for symbol, _ in nomenclature(one)}
    for name in ("firing", "loads"):
        runs = [run for heading in tables(one)[name].headings for run in heading]
        shown = {run.content for run in runs if isinstance(run, Math)}
        assert shown - known <= {"φ", "α"}


@for_each("language", LANGUAGES)
def test_degrees_celsius_stand_among_the_units(language):
    listed = tables(short(language))["cycle_results"].rows
    # its parts may stand side by side
    rows = [row[start : start + 4] for row in listed for start in range(0, len(row), 4)]
    (found,) = (row for row in rows if row[0] and row[2] == number(490.6, language))
    assert found[3] == "°C"
    assert not re.search("°C", found[0])


# --- the drawing on the first page


@for_each(("name", "bore", "stroke"), [("engine", 85.0, 90.0), (FOUR, 78.0, 78.0)])
def test_the_dimensions_are_as_long_as_bore_and_stroke(name, bore, stroke):
    film = film_of(results(name))
    still, plain = dimensioned(film, "D", "S"), film.still()
    added = still.items[len(plain.items) :]
    assert [item.text for item in added if isinstance(item, Text)] == ["D", "S"]
    spans = [
        np.abs(np.diff(item.points, axis=0))[0] for item in added if isinstance(item, Polyline) and not item.closed
    ]
    along, up = spans[2], spans[5]
    assert along[1] == up[0] == 0
    assert along[0] / up[1] == pytest.approx(bore / stroke, rel=2e-3)
    everything = np.vstack([item.points for item in added if isinstance(item, Polyline)])
    assert np.all(everything > 0)
    assert np.all(everything < (still.width, still.height))


def test_a_cylinder_that_leans_has_no_dimensions():
    film = film_of(results("v8-diesel"))
    leaning = film._replace(parts=tuple(moving for moving in film.parts if not moving.name.startswith("row")))
    assert len(dimensioned(film, "D", "S").items) > len(film.still().items)
    assert len(dimensioned(leaning, "D", "S").items) == len(leaning.still().items)

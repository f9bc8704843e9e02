"""Symbols in the tables of notes are set like those of the equations, in every example and language."""

import re
from collections import Counter, defaultdict
from pathlib import Path

import pytest

import crankwork
from crankwork.formula.expression import Formula
from crankwork.note.contents import note_of
from crankwork.note.document import Equation, Math, Table
from crankwork.note.equations import equation_symbol
from crankwork.note.layout import Upright
from crankwork.note.options import NoteOptions
from crankwork.note.symbols import symbol_box

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
# what may stand flat: units after a comma, and names that the file gives
UNIT = re.compile(r"^, [^,]+$")
# letters that books of a school give two things: moving links and revolutions, stroke and force along the rod, angle of
# the crank and excess of air, of the rod and molar change; pressure in the cylinder by two ways, and transfer functions
# by two names
SCHOOL = {"en": "n", "ru": "nS", "vi": "nαβ"}
SAME = {"p", "p₁", "V", "x′", "x″", "S_x′", "S_x″"}
# what is found in several ways
WAYS = ("flywheel_inertia", "whole_inertia", "wittenbauer_slope", "excess_work")
# wanted and reached
SPEED = {"δ"}


@pytest.fixture(scope="module", params=EXAMPLES, ids=lambda one: one.stem)
def example(request):
    return request.param.read_text("utf-8"), crankwork.analyse(crankwork.read(request.param))


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_no_symbol_of_an_equation_stands_flat_in_a_table(example, language):
    source, results = example
    blocks = note_of(results, NoteOptions(language=language, figures=False)).blocks
    worked = [one for one in blocks if isinstance(one, Equation)]
    known = {one.symbol or equation_symbol(one.step, language) for one in worked}
    known |= {entry.symbol for one in worked for entry in one.legend}
    flat = set()
    for table in (one for one in blocks if isinstance(one, Table)):
        runs = [run for heading in table.headings for run in heading]
        # names and symbols stand in the first two columns
        runs += [cell for row in table.rows for cell in row[:2]]
        for run in runs:
            if isinstance(run, str) and not UNIT.match(run):
                flat |= {one for one in re.split(r"[\s,;()=]+", run) if one in known and one not in source}
    # z is also the point where burning ends
    assert flat <= {"–", "", "z"}


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_every_symbol_of_a_table_has_letters_that_slant(example, language):
    _, results = example
    for table in note_of(results, NoteOptions(language=language, figures=False)).blocks:
        for heading in table.headings if isinstance(table, Table) else ():
            for run in heading:
                if isinstance(run, Math) and isinstance(run.content, str):
                    assert symbol_box(run.content) != Upright(run.content), run.content


def test_the_numbers_of_a_substance_stay_at_their_letters():
    box = symbol_box("M_H₂O")
    assert [type(part).__name__ for part in box.below.parts] == ["Script", "Upright"]


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_a_symbol_of_an_equation_stands_for_one_thing(example, language):
    _, results = example
    meanings, values = defaultdict(set), defaultdict(set)
    for one in note_of(results, NoteOptions(language=language, figures=False)).blocks:
        if isinstance(one, Equation):
            for entry in one.legend:
                meanings[entry.symbol].add(entry.text)
            if not isinstance(one.step, Formula) and not one.step.key.startswith(WAYS):
                values[one.symbol or equation_symbol(one.step, language)].add(one.step.key)
    twice = {shown for found in (meanings, values) for shown, of in found.items() if len(of) > 1}
    assert twice <= {*SCHOOL[language], *SAME}


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_a_symbol_of_a_table_of_values_stands_for_one_row(example, language):
    _, results = example
    tables = [
        one for one in note_of(results, NoteOptions(language=language, figures=False)).blocks if isinstance(one, Table)
    ]
    rows = [row for one in tables if one.label in ("t:data", "t:summary") for row in one.rows]
    shown = Counter(row[1].content for row in rows if isinstance(row[1], Math))
    assert {symbol for symbol, count in shown.items() if count > 1} <= SPEED

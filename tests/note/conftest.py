"""What the tests of the note share: every formula registered, and a note with every kind of block."""

from __future__ import annotations

import datetime as dt
import functools
import math
from collections.abc import Callable
from pathlib import Path

import pytest

import crankwork
from crankwork.dynamics import piston_forces as forces
from crankwork.errors import CrankworkError
from crankwork.formula.calculation_lines import FormulaLine, Snapshot
from crankwork.formula.expression import FORMULAS, record
from crankwork.formula.traced_value import given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads import gas
from crankwork.note.document import (
    Bibliography,
    Bold,
    Citation,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    Note,
    PageBreak,
    Paragraph,
    Person,
    Reference,
    Table,
    TitlePage,
)
from crankwork.note.lines import lines_of
from crankwork.quantities import LANGUAGES, Language
from crankwork.show.scene import Drawing, line

HOSTILE = "# $x$ *a* _b_ @c <d> & \\e `f` ~g \"h\" 'i' #{panic()} ]] $ // /* ${k} </p> --"
DRAWING = Drawing("drawing", "en", 70.0, 35.0, (line((0.0, 0.0), (70.0, 35.0)),))


@functools.cache
def _results(file: Path | str, way: str) -> crankwork.Results:
    settings = [f"method.kinematics={way}"]
    try:
        if isinstance(file, Path):
            return crankwork.analyse(crankwork.read(file, settings))
        return crankwork.analyse(crankwork.read_machine(crankwork.template(file), file, settings))
    except CrankworkError:
        assert way == "textbook"
        return _results(file, "exact")


@pytest.fixture(scope="session")
def results_of() -> Callable[[Path | str, str], crankwork.Results]:
    """Results of an example or a template by a method, exact where it has no other."""
    return _results


@pytest.fixture(scope="session")
def groups_of():
    """Give the groups of lines that a note shows, at chosen crank angles."""

    def found(results, *degrees):
        return lines_of(results, *degrees)

    return found


@pytest.fixture(scope="session")
def steps(formulas) -> list[FormulaLine]:
    """A step of every registered formula; what is put in matters only to how it is printed."""
    return [
        FormulaLine(one.quantity, one, dict.fromkeys(one.arguments, 0.1234567), 0.7654321) for one in formulas.values()
    ]


def sample(language: Language) -> Note:
    """Return a note with every kind of block and text that every format could take for its own."""
    line = Snapshot(CrankGrid.from_degrees, 0.0).step
    area = line(gas.piston_area(math.pi, given("bore", 0.1058)))
    speed = line(mean_piston_speed(given("stroke", 0.1058), given("", 2300.0)))
    mass = line(total("reciprocating_mass", [given("piston_mass", 0.1395), given("rod_small_end_mass", 0.065)]))
    rows = [[f"{k}", f"{k / 7:.3f}", HOSTILE] for k in range(60)]
    blocks = (
        TitlePage(
            institution=(HOSTILE, "Trường Ậỗữ"),
            above=(HOSTILE,),
            below=("Thuyết minh Ậỗữ",),
            people=(Person("Выполнил", ("А. Б. <c@d>", "Nguyễn"), signs=True), Person("Supervisor", (HOSTILE,))),
            place="2026-11-21",
        ),
        Contents(),
        PageBreak(),
        Heading(1, HOSTILE, label="first"),
        Heading(2, "Động học"),
        Paragraph((HOSTILE, Bold("Сила"), Math("v_п.ср"), Math(record(gas.swept_volume)), Citation("den_hartog_1956"))),
        Paragraph((Reference("first"), Reference("area"), Reference("drawing"), Reference("wide"))),
        Equation(area, label="area"),
        Equation(speed),
        Equation(mass),
        Equation(FORMULAS[forces.side_force.__name__]),
        Table(HOSTILE, (("n",), ("x, ", Math("x_1")), ("text",)), rows, wide=True, align="crl", label="wide"),
        Figure(DRAWING, HOSTILE, HOSTILE, label="drawing"),
        ItemList(((HOSTILE,), (Math("ω"),))),
        ItemList((("one",), ("two",))),
        Heading(1, "References", numbered=False),
        Bibliography(),
    )
    date = dt.date(2026, 11, 21)
    return Note(HOSTILE, language, blocks, ("А. Б. <c@d>", "Nguyễn"), date, ("den_hartog_1956",))


@pytest.fixture(scope="session")
def samples() -> dict[str, Note]:
    """A note with every kind of block, in each language."""
    return {language: sample(language) for language in LANGUAGES}


@pytest.fixture(scope="session")
def hostile() -> str:
    """Text in which every format finds its own marks."""
    return HOSTILE


@pytest.fixture(scope="session")
def drawing() -> Drawing:
    """A small drawing."""
    return DRAWING

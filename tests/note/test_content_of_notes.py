"""What holds of every note, and what a teacher looks for in it: given masses, textbook forms, numbers that matter."""

from __future__ import annotations

import math
import re
from collections import Counter
from itertools import pairwise

import pytest

from crankwork.formula.calculation_lines import DelayedLine, FormulaLine, ValueLine
from crankwork.formula.expression import evaluate
from crankwork.locale import translate
from crankwork.machine import Document
from crankwork.note.document import Equation, Figure, ItemList, Math, Note, Paragraph, Reference, Table
from crankwork.note.equations import line_parts
from crankwork.note.layout import EQUALS
from crankwork.note.numbering import numbering
from crankwork.note.sections import cover
from crankwork.note.web import web
from crankwork.quantities import LANGUAGES
from crankwork.sources import source_language
from each import failing, for_each
from note.built import key_of
from notes import blocks, figures, nomenclature, note, printed, shown, tables, value, value_rows, words, worked

# every kind of machine; in the light part two engines, a linkage and a driven one in each language
LIGHT = [(name, one) for name in ("spark-engine", "petrol-four", "press-geometry", "boom") for one in LANGUAGES]
OTHERS = [
    (name, language)
    for language, names in {
        "en": "two-stroke loaded-shaper cylinder-between-links crank-by-table press",
        "ru": "v8-diesel andrews-squeezer elbow parallelogram",
        "vi": "radial-five knuckle-press gas-by-law driven-slider punching-machine",
    }.items()
    for name in names.split()
]
# as the files of the machines have them, and symbols
NAMES = """
    bed block boom coupler cylinder line lower piston punch rocker rod slot upper arm ram pitman link plunger pump
    spring checks const turning figure max min sin cos IVC EVO III
"""
ENGLISH = """
    the of and with from at force crank rod angle table figure load speed per mean largest least pressure torque work
    value point row what is are by on filling heating fuel loss mechanical cylinder journal link joint
"""


@pytest.fixture(scope="module", params=["light", pytest.param("others", marks=pytest.mark.slow)])
def notes(request) -> dict[str, Note]:
    """Return notes by machine and language, with figures in one of the languages."""
    chosen = LIGHT if request.param == "light" else OTHERS
    return {f"{name}-{one}": note(name, one, figures=one == "ru") for name, one in chosen}


@pytest.mark.slow
def test_equations_give_the_values_of_the_results(notes):
    def check(one):
        for step in (block.step for block in blocks(one, Equation)):
            if isinstance(step, FormulaLine):
                found = evaluate(step.expression, step.values)
                assert math.isclose(found, step.value, rel_tol=1e-12, abs_tol=1e-300), step.key
            if (wanted := one.results.summary.get(key_of(one.results, step.key))) is not None:
                assert math.isclose(step.value, wanted, rel_tol=1e-12), step.key

    assert failing(notes, check) == {}


@pytest.mark.slow
def test_every_single_value_with_a_line_is_worked(notes, groups_of):
    def check(one):
        said = {(block.step.key.partition(".")[0], block.step.value) for block in blocks(one, Equation)}
        steps = [step for group in groups_of(one.results) for step in group.lines if step.key in one.results.summary]
        for step in steps:
            same = step.key in worked(one) or (step.key.partition(".")[0], step.value) in said
            assert same or isinstance(step, ValueLine | DelayedLine), step.key

    assert failing(notes, check) == {}


def test_everything_is_numbered_referred_to_and_explained_once(notes):
    def check(one):
        numbers = zip(one.blocks, numbering(one).blocks, strict=True)
        counted = [number for block, number in numbers if isinstance(block, Equation)]
        assert counted == [str(count) for count in range(1, len(counted) + 1)]
        labels = {block.label for block in one.blocks if isinstance(block, Table | Figure) and ":" in block.label}
        said = {run.label for block in blocks(one, Paragraph) for run in block.runs if isinstance(run, Reference)}
        assert labels <= said
        entries = Counter((row[0].content, row[1]) for row in nomenclature(one))
        assert [entry for entry, count in entries.items() if count > 1] == []
        own = [source_language(key) == one.language for key in numbering(one).sources]
        assert own == sorted(own, reverse=True)
        drawn = figures(one)
        assert [name for name, block in drawn.items() if block.alt in ("", block.caption)] == []
        if "pressure" in drawn:
            without = {name for name, block in drawn.items() if not re.search(r"\d", block.alt)}
            assert without <= {
                "phase_stars",
                "wittenbauer",
                "balance_ellipses",
                "cylinder_torques",
                "main_wear",
                "scheme",
            }

    assert failing(notes, check) == {}


def test_notes_speak_one_language(notes):
    def check(one):
        found = {word for text in words(one) for word in re.findall(r"[^\W\d_]+", text)} - set(NAMES.split())
        if one.language == "ru":
            assert [word for word in found if re.fullmatch("[A-Za-z]{3,}", word) and word[-3:] not in "minmax"] == []
        if one.language == "vi":
            assert {word.lower() for word in found} & set(ENGLISH.split()) == set()

    assert failing(notes, check) == {}


@pytest.mark.slow
def test_no_equation_says_a_number_or_a_function_twice(notes):
    def check(one):
        for equation in shown(one):
            for line in equation.lines:
                parts, side = [], []
                for box in (*line.parts, EQUALS):
                    if box == EQUALS:
                        parts.append(tuple(side))
                        side = []
                    else:
                        side.append(box)
                assert len(set(parts)) == len(parts), equation.text
                # 5 = 5 N, and nothing in two units; a sum may begin with its own sign
                sums = any("+" in str(box) for box in line.parts)
                starts = any(after[: len(before)] == before for before, after in pairwise(parts))
                assert sums or not starts, equation.text
            assert not re.search(r"= −?0 \S+ = ", equation.text), equation.text

    assert failing(notes, check) == {}


def test_no_number_is_pi_or_what_rounding_leaves(notes):
    left = "1[.,]57079|10⁻(¹[¹²³⁴⁵⁶⁷⁸⁹]|[²³⁴⁵⁶⁷⁸⁹][⁰¹²³⁴⁵⁶⁷⁸⁹])"

    def check(one):
        cells = [str(getattr(cell, "content", cell)) for table in blocks(one, Table) for row in table.rows
                 for cell in row]  # fmt: skip
        assert [text for text in (*printed(one), *cells) if re.search(r"[.,]14159265", text)] == []
        assert [text for text in printed(one) if re.search(left, text)] == []

    assert failing(notes, check) == {}


def test_symbols_in_tables_are_set_as_in_equations(notes):
    def check(one):
        found = tables(one)
        cells = [cell for table in blocks(one, Table) for row in table.rows for cell in row]
        flat = [cell for cell in cells if isinstance(cell, str)]
        assert [cell for cell in flat if "²" in cell.partition(" = ")[2]] == []
        if "points" in found:
            assert [cell for cell in flat if "_" in cell] == []
            said = {str(cell.content) for cell in cells if isinstance(cell, Math)}
            assert {"D", "n"} <= said
            assert any(text.startswith("F_T² + F_B² = F_Q²") for text in said) == (one.language == "en")

    assert failing(notes, check) == {}


def test_a_page_has_the_tables_and_nothing_that_is_missing(notes):
    def check(one):
        page = re.sub(r"<(style|script|svg).*?</\1>", " ", web(one).decode(), flags=re.DOTALL)
        assert page.count("<table") >= len(blocks(one, Table))
        assert not (found := re.search(r"[{}]|None|\bnan\b", re.sub(r"<[^>]+>", " ", page))), found

    # in one language of each machine
    assert failing({key.rpartition("-")[0]: one for key, one in notes.items()}, check) == {}


# --- what single notes say


def given(name: str, language: str) -> dict[str, str]:
    """Return the data of a note by symbol."""
    return {row[1].content: row[2] for row in tables(note(name, language))["data"].rows if isinstance(row[1], Math)}


def test_masses_stand_among_the_data_as_they_are_given():
    """Mass and share of the rod, or its parts; what is worked out is not listed."""
    found = given("petrol-four", "ru")
    assert (found["m_ш"], found["k_1"]) == ("0,716", "0,275")
    assert not {"m_шп", "m_шк", "b"} & set(found)
    parts = [one for one in printed(note("petrol-four", "ru")) if one.startswith("m_шп = m_ш·b/L = 0,716·")]
    assert [one.rpartition(" = ")[2] for one in parts] == ["0,1969 кг"]
    assert {"m_A", "m_B"} <= set(given("spark-engine", "vi"))


@pytest.mark.slow
@for_each(
    ("name", "stated", "derived"),
    [("v8-diesel", {"S", "λ"}, {"R", "L"}), ("petrol-four", {"R", "λ"}, {"S", "L"}), ("two-stroke", {"S", "L"}, {"R"})],
)
def test_what_is_worked_out_is_not_listed_as_given(name, stated, derived):
    assert stated <= set(given(name, "ru"))
    assert not derived & set(given(name, "ru"))


def test_a_textbook_note_has_velocity_and_acceleration_in_one_formula():
    found = printed(note("slider-crank", "ru"))
    assert "v = R·ω·(sin φ + λ/2·sin 2φ) = 0,075·261,667·(0,5 + 0,25/2·0,866025) = 11,937 м/с" in found
    assert "j = R·ω²·(cos φ + λ·cos 2φ) = 0,075·261,667²·(0,866025 + 0,25·0,5) = 5089,12 м/с²" in found
    assert not [one for one in found if one.startswith(("S_x′ =", "S_x″ ="))]
    # an exact one has the transfer functions on the way
    assert any(one.startswith("S_x′ = ") for one in printed(note("petrol-four", "ru")))


def test_compression_and_expansion_have_exponents_of_their_own():
    for language in LANGUAGES:
        found = note("spark-engine", language)
        text = " ".join(printed(found))
        assert "^n_1 = " in text
        assert "^n_2 = " in text
        (told,) = (one for one in blocks(found, Paragraph) if Math("n_1") in one.runs)
        assert Math("n_2") in told.runs


def test_values_by_the_piston_area_are_those_of_the_tables():
    found = note("spark-engine", "vi")
    worked_out = next(one for one in printed(found) if one.startswith("P_1 = P_kt + P_j = "))
    assert worked_out.endswith(" = 3,25336 + (−0,739836) = 2,51353 MPa")
    assert next(row[3] for row in tables(found)["along"].rows if row[0] == "390") == "2,513528"
    assert not [one for one in printed(note("spark-engine", "ru")) if one.startswith("P = ") and "МПа" in one]


@for_each(
    ("name", "wanted"),
    [
        ("press-geometry", ["M_Σ,max", "M_Σ,min", "H_5", "R_max,O"]),
        ("punching-machine", ["P_дв", "M_ср", "J_м", "δ"]),
    ],
)
def test_a_conclusion_says_the_numbers_that_matter(name, wanted):
    found = note(name, "ru")
    first, all_rows = (
        [row[1].content for row in value_rows(found, label) if row[0]] for label in ("glance", "summary")
    )
    assert first[: len(wanted)] == wanted
    # and all of them together with others
    assert set(wanted) <= set(all_rows)


@for_each("language", LANGUAGES)
def test_the_conclusion_of_an_engine_is_a_few_sentences_with_the_numbers_that_matter(language):
    found = note("petrol-four", language, full=False)
    rows = value_rows(found, "glance")
    said = ["".join(map(str, item)) for item in blocks(found, ItemList)[-1].items]
    assert 5 <= len(said) <= 8
    # power, mean and ends of the torque, ends of the force on the pin, flywheel
    for row in [*rows[:6], rows[7]]:
        assert any(f"{row[2]}\u00a0{row[3]}" in text for text in said), row


def test_one_cylinder_has_no_table_of_sums():
    found = {name: "total" in tables(note(name, "vi")) for name in ("spark-engine", "petrol-four")}
    assert found == {"spark-engine": False, "petrol-four": True}


@pytest.mark.slow
def test_a_name_has_no_underscore_in_print():
    # the first one of a symbol begins its subscript
    found = note("andrews-squeezer")
    rows = [
        str(getattr(cell, "content", cell)) for table in tables(found).values() for row in table.rows for cell in row
    ]
    assert [one for one in (*rows, *printed(found)) if "P_K" in one] == []
    assert "largest joint force, P 3" in rows


def test_the_acceleration_of_an_inertia_force_stands_before_it():
    found = printed(note("spark-engine", "vi"))
    (acceleration,) = (k for k, one in enumerate(found) if one.startswith("j_qt = R·ω²·(cos α + λ_qt·cos 2α) = "))
    assert acceleration < next(k for k, one in enumerate(found) if one.startswith("P_j = −m_j·j_qt = "))


def test_only_a_note_that_computes_the_motion_says_so():
    for language in LANGUAGES:
        computed = translate("sentences.linkage_computed", language)
        told = {name: computed in " ".join(words(note(name, language))) for name in ("press", "press-geometry")}
        assert told == {"press": False, "press-geometry": True}
        page = cover(Document(author=("", " "), supervisor=" ", group="M-31"), language, "note")
        # a name that is left open has no line
        assert [one.names for one in page.people] == [("M-31",)]


@pytest.mark.slow
@for_each(("name", "language"), [("v8-diesel", "en"), ("v8-diesel", "ru"), ("two-stroke", "vi")])
def test_the_laws_of_the_gas_pressure_are_listed_stretch_by_stretch(name, language):
    table = tables(note(name, language))["laws"]
    ends = [[value(cell) for cell in row[:2]] for row in table.rows]
    assert (ends[0][0], ends[-1][1]) == (0.0, 720.0 if name == "v8-diesel" else 360.0)
    assert all(one[1] == after[0] for one, after in pairwise(ends))
    laws = [row[2] if isinstance(row[2], str) else line_parts(row[2].content, language)[0] for row in table.rows]
    if name == "v8-diesel":
        assert sum("p_a·(V_(a)/V)^n_1" in one for one in laws) == 3
        assert sum("p_z·(V_(z)/V)^n_2" in one for one in laws) == 1

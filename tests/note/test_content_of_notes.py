"""What a teacher looks for in a note: given masses, textbook forms, distinct symbols, the numbers that matter."""

import re
from itertools import pairwise
from pathlib import Path

import pytest

import crankwork
from crankwork.locale import say
from crankwork.machine import Document
from crankwork.note.contents import note_of
from crankwork.note.cover import cover
from crankwork.note.document import Equation, ItemList, Math, Paragraph, Table
from crankwork.note.equations import line_parts, printed_equation
from crankwork.note.layout import EQUALS
from crankwork.note.numbering import numbering
from crankwork.note.options import NoteOptions
from crankwork.sources import source_language

EXAMPLES = Path(__file__).parents[2] / "examples"


def _note(name: str, language: str, **options):
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    return note_of(results, NoteOptions(language=language, figures=False, **options))


def _equations(found) -> list[str]:
    worked = (printed_equation(one, found.language).text for one in found.blocks if isinstance(one, Equation))
    return [one.replace("\u00a0", " ") for one in worked]


def _symbols(found, label: str) -> dict[str, str]:
    table = next(one for one in found.blocks if isinstance(one, Table) and one.label == label)
    return {row[1].content: row[2] for row in table.rows if isinstance(row[1], Math)}


def test_mass_and_share_of_the_rod_stand_among_the_data_and_give_its_parts():
    found = _note("petrol-four", "ru")
    given = _symbols(found, "t:data")
    assert (given["m_ш"], given["k_1"]) == ("0,716", "0,275")
    assert not {"m_шп", "m_шк", "b"} & set(given)
    assert any(one.startswith("m_шп = m_ш·b/L = 0,716·") and one.endswith("= 0,1969 кг") for one in _equations(found))


def test_masses_at_the_ends_stand_among_the_data_where_they_are_given():
    assert {"m_A", "m_B"} <= set(_symbols(_note("spark-engine", "vi"), "t:data"))


def test_a_textbook_note_has_velocity_and_acceleration_in_one_formula():
    found = _equations(_note("slider-crank", "ru"))
    assert "v = R·ω·(sin φ + λ/2·sin 2φ) = 0,075·261,667·(0,5 + 0,25/2·0,866025) = 11,937 м/с" in found
    assert "j = R·ω²·(cos φ + λ·cos 2φ) = 0,075·261,667²·(0,866025 + 0,25·0,5) = 5089,12 м/с²" in found
    assert not [one for one in found if one.startswith(("S_x′ =", "S_x″ ="))]


def test_an_exact_note_has_the_transfer_functions_on_the_way():
    assert any(one.startswith("S_x′ = ") for one in _equations(_note("petrol-four", "ru")))


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_compression_and_expansion_have_exponents_of_their_own(language):
    found = _note("spark-engine", language)
    text = " ".join(_equations(found))
    assert "^n_1 = " in text
    assert "^n_2 = " in text
    told = next(one for one in found.blocks if isinstance(one, Paragraph) and Math("n_1") in one.runs)
    assert Math("n_2") in told.runs


def test_values_by_the_piston_area_are_those_of_the_tables():
    found = _note("spark-engine", "vi")
    worked = next(one for one in _equations(found) if one.startswith("P_1 = P_kt + P_j = "))
    assert worked.endswith("N; P_1/F_p = 2,51353 MPa")
    table = next(one for one in found.blocks if isinstance(one, Table) and one.label == "t:along")
    assert next(row[3] for row in table.rows if row[0] == "390") == "2,513528"
    plain = _equations(_note("spark-engine", "ru"))
    assert not [one for one in plain if "/F_п = " in one.partition("; ")[2]]


@pytest.mark.parametrize(
    ("name", "symbols"),
    [
        ("v8-diesel", ["N_e", "N_iΣ", "M_Σср"]),
        ("press-geometry", ["M_Σ,max", "H_punch", "R_max,O"]),
        ("punching-machine", ["P_дв", "M_ср", "L_изб", "J_м", "δ"]),
    ],
)
def test_a_conclusion_says_the_numbers_that_matter(name, symbols):
    found = _note(name, "ru")
    at = next(
        k
        for k, one in enumerate(found.blocks)
        if isinstance(one, Paragraph) and "Основные результаты:" in str(one.runs[0])
    )
    items = found.blocks[at + 1]
    assert isinstance(items, ItemList)
    assert [item[1].content for item in items.items][: len(symbols)] == symbols


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_sources_in_the_language_of_the_note_stand_first(language):
    keys = list(numbering(_note("petrol-four", language)).sources)
    own = [source_language(key) == language for key in keys]
    assert own == sorted(own, reverse=True)


def test_one_cylinder_has_no_table_of_sums():
    labels = {one.label for one in _note("spark-engine", "vi").blocks if isinstance(one, Table)}
    assert "t:total" not in labels
    assert "t:total" in {one.label for one in _note("petrol-four", "vi").blocks if isinstance(one, Table)}


def _strings(found):
    """Yield what a note prints as text, from its titles, tables and equations."""
    for one in found.blocks:
        if isinstance(one, Table):
            yield one.caption
            yield from (cell if isinstance(cell, str) else str(cell.content) for row in one.rows for cell in row)
    yield from _equations(found)


@pytest.mark.parametrize(("name", "language"), [("andrews-squeezer", "en"), ("two-stroke", "vi"), ("atkinson", "ru")])
def test_pi_is_a_letter(name, language):
    assert not [one for one in _strings(_note(name, language)) if "14159265" in one]


def test_a_name_has_no_underscore_in_print():
    # the first one of a symbol begins its subscript
    rows = [one for one in _strings(_note("andrews-squeezer", "en")) if "P" in one]
    assert not [one for one in rows if "P_K" in one]
    assert "largest joint force, P K3" in rows


def test_the_acceleration_of_an_inertia_force_stands_before_it():
    found = _equations(_note("spark-engine", "vi"))
    acceleration = next(at for at, one in enumerate(found) if one.startswith("j_qt = R·ω²·(cos α + λ_qt·cos 2α) = "))
    assert acceleration < next(at for at, one in enumerate(found) if one.startswith("P_j = −m_j·j_qt = "))


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_only_a_note_that_computes_the_motion_says_so(language):
    told = {
        name: " ".join(run for one in _note(name, language).blocks if isinstance(one, Paragraph)
                       for run in one.runs if isinstance(run, str))
        for name in ("press", "press-geometry")
    }  # fmt: skip
    computed = say("sentences.linkage_computed", language)
    assert (computed in told["press"], computed in told["press-geometry"]) == (False, True)


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_no_equation_says_a_number_or_a_function_twice(language):
    results = crankwork.analyse(crankwork.read(EXAMPLES / "knuckle-press.toml"))
    shown = [
        printed_equation(one, language)
        for one in note_of(results, NoteOptions(language=language, figures=False)).blocks
        if isinstance(one, Equation)
    ]
    for one in shown:
        for line in one.lines:
            parts, side = [], []
            for box in line.parts:
                if box == EQUALS:
                    parts.append(tuple(side))
                    side = []
                else:
                    side.append(box)
            parts.append(tuple(side))
            assert len(set(parts)) == len(parts), one.text
            # 5 = 5 N, and nothing in two units
            assert not any(after[: len(before)] == before for before, after in pairwise(parts)), one.text
        assert not re.search(r"= −?0 \S+ = ", one.text), one.text
        assert "1.57079" not in one.text.replace(",", "."), one.text


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_a_name_that_is_left_open_has_no_line_on_the_cover(language):
    page = cover(Document(author=("", " "), supervisor=" ", group="M-31"), language, "note")
    assert [one.names for one in page.people] == [("M-31",)]


@pytest.mark.parametrize(("name", "language"), [("v8-diesel", "en"), ("v8-diesel", "ru"), ("two-stroke", "vi")])
def test_the_laws_of_the_gas_pressure_are_listed_stretch_by_stretch(name, language):
    found = _note(name, language)
    table = next(one for one in found.blocks if isinstance(one, Table) and one.label == "t:laws")
    ends = [[float(cell.replace(",", ".")) for cell in row[:2]] for row in table.rows]
    assert (ends[0][0], ends[-1][1]) == (0.0, 720.0 if name == "v8-diesel" else 360.0)
    assert all(one[1] == after[0] for one, after in pairwise(ends))
    laws = [row[2] if isinstance(row[2], str) else line_parts(row[2].content, language)[0] for row in table.rows]
    if name == "v8-diesel":
        assert sum("p_a·(V_(a)/V)^n_1" in one for one in laws) == 3
        assert sum("p_z·(V_(z)/V)^n_2" in one for one in laws) == 1

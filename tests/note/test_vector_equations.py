"""Vector equations and plans in notes of linkages, and what links are called there."""

import re

import numpy as np
import pytest

from crankwork.analysis.vector_polygons import worked_position
from crankwork.locale import LANGUAGES, texts
from crankwork.note.document import Equation, Figure, Heading, Paragraph, Table
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from each import for_each
from machine_texts import analysed
from notes import blocks, note, results, tables, words

CASES = ["press-geometry", "crank-shaper", "toggle-press"]
# a word that a school uses for something else as well
ALSO = {"ru": set(), "vi": {"piston"}}


def number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


def printed_vectors(one, order, column):
    """Return the vectors of a printed table by symbol, from their angle and value."""
    rows = tables(one)[f"compared_{('velocities', 'accelerations')[order]}"].rows
    return {
        row[0].content: number(row[column]) * np.exp(1j * np.radians(number(row[1]))) for row in rows if row[1] != "–"
    }


@for_each("name", CASES)
def test_the_printed_vectors_of_an_equation_add_up(name):
    found = note(name, "ru")
    for order in (0, 1):
        known = printed_vectors(found, order, 4)
        largest = max(map(abs, known.values()))
        texts_ = [
            block.printed.text for block in blocks(found, Equation) if block.printed and " = " in block.printed.text
        ]
        sums = [
            one.split(" = ")
            for text in texts_
            for one in text.split("; ")
            if one.startswith("va"[order]) and " = " in one
        ]
        assert len(sums) >= 3
        for left, right in sums:
            total = sum(known.get(part, 0.0) for part in right.split(" + "))
            # angles are printed to a tenth of a degree, values to four digits
            assert abs(total - known.get(left, 0.0)) < 3e-3 * largest, (left, right)


def test_a_crank_alone_has_no_vector_equations():
    text = 'fixed_points.O = ["0 mm", "0 mm"]\ncrank = { pivot = "O", pin = "A", radius = "1 m", speed = "9 rpm" }'
    assert "plan_velocities" not in tables(note_of(analysed(text), NoteOptions(full=True)))


@for_each("name", CASES)
def test_the_difference_is_that_of_both_columns_and_of_the_size_of_a_reading(name):
    for key in ("compared_velocities", "compared_accelerations"):
        for row in tables(note(name, "ru"))[key].rows:
            if row[3] == "–":
                # too short to be compared
                assert number(row[2]) <= 2
                continue
            drawn, exact = number(row[3]), number(row[4])
            if row[6] != "–":
                assert number(row[6]) == pytest.approx(
                    100 * (drawn - exact) / exact, abs=0.2 + 0.06 * 100 / abs(exact) * 1e-2
                )
            if row[2] != "–":
                # a length is read to half a millimetre, and is off by a few of them
                length = number(row[2])
                assert 2 * length == round(2 * length)
                assert abs(drawn - exact) < 8 * drawn / length if length else True


def test_the_analytical_column_is_that_of_the_results():
    found, known = results("press-geometry"), note("press-geometry", "ru")
    at = found.columns_at(np.array([30.0]))
    rows = {row[0].content: number(row[4]) for order in ("velocities", "accelerations")
            for row in tables(known)[f"compared_{order}"].rows}  # fmt: skip
    keys = {
        "v_B": "point_velocity.B", "v_S2": "point_velocity.S2", "a_D": "point_acceleration.D",
        "ω_3": "link_angular_velocity.rocker", "ε_2": "link_angular_acceleration.rod",
    }  # fmt: skip
    for symbol, key in keys.items():
        assert rows[symbol] == pytest.approx(float(at[key][0]), rel=6e-4), symbol


@for_each("language", LANGUAGES)
def test_english_compares_its_plans_in_the_full_note_only(language):
    short = tables(note("press-geometry", language, full=False))
    assert ("compared_velocities" in short) == (language != "en")
    assert ("plan_velocities" in short) == (language == "en")
    assert "compared_velocities" in tables(note("press-geometry", language))


@for_each("language", ["ru", "vi"])
def test_names_of_templates_are_words_of_the_language(language):
    english = {key for key, word in texts("parts", "en").items() if key not in ALSO[language]}
    for name in (*CASES, "four-bar", "whitworth"):
        found = note(name, language, full=False, figures=True)
        runs = [run for block in blocks(found, Paragraph) for run in block.runs]
        for table in blocks(found, Table):
            runs += [*(cell for row in table.rows for cell in row), *(run for title in table.headings for run in title)]
        said = [str(getattr(run, "content", run)) for run in runs]
        said += [block.text for block in blocks(found, Heading)] + [block.caption for block in blocks(found, Figure)]
        said += [item.text for block in blocks(found, Figure) for item in block.drawing.items if hasattr(item, "text")]
        said += list(words(found))
        pieces = {word for text in said for word in re.findall(r"[a-z_]{3,}", text)}
        assert pieces & english == set(), (name, pieces & english)


def test_a_name_of_the_user_stands_as_it_is():
    from crankwork import analyse, note_of, read_machine, template
    from crankwork.note.options import NoteOptions

    text = template("four-bar").replace("coupler", "Koppel").replace("rocker", "Schwinge")
    found = tables(note_of(analyse(read_machine(text)), NoteOptions(language="ru", figures=False)))
    assert [row[1] for row in found["links"].rows] == ["кривошип", "Koppel", "Schwinge"]


def test_a_title_may_be_stated_in_each_language():
    titles = {language: note("press-geometry", language).title for language in LANGUAGES}
    assert titles["en"] == "Press, motion from geometry"
    assert titles["ru"].startswith("Кулисный пресс")
    assert titles["vi"].startswith("Máy dập")


def test_a_slider_that_drives_begins_the_vector_equations():
    """Its law gives its velocity along the guide; the reactions follow from moments, and its force closes the plan."""
    found = note("driven-slider", "ru", full=False, figures=True)
    printed_equations = [block.printed.text for block in blocks(found, Equation) if block.printed is not None]
    assert "v_A = v_B + v_AB; v_A = v_O + v_AO" in printed_equations
    assert any("F_q = 0" in text for text in printed_equations)
    results_at = results("driven-slider").columns_at(np.array([worked_position(results("driven-slider"))]))
    speed = abs(results_at["driver_velocity"][0])
    rows = {row[0].content: row for row in tables(found)["compared_velocities"].rows}
    assert number(rows["v_B"][4]) == pytest.approx(speed, rel=1e-3)
    assert abs(number(rows["v_B"][6])) < 1.0

"""Numbers of blocks and sources, the lines of an equation, and text that no format can hold."""

from __future__ import annotations

import math
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.dynamics import piston_forces as forces
from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.formula import traced_value
from crankwork.formula.calculation_lines import DelayedLine, Snapshot, ValueLine
from crankwork.formula.expression import FORMULAS
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads import gas
from crankwork.note.captions import caption, place_in_source, printed_unit
from crankwork.note.document import Citation, Equation, Figure, Heading, Note, Paragraph, Reference, Table, plain_text
from crankwork.note.equations import printed_equation, shown_values
from crankwork.note.layout import SPACE, Fence, Row, Sign, Upright, row, width
from crankwork.note.legends import legend
from crankwork.note.math import enough_digits
from crankwork.note.numbering import numbering
from crankwork.note.sections import WRITERS, check_format, written_note
from crankwork.note.symbols import number_box, symbol_box
from crankwork.quantities import LANGUAGES
from crankwork.units import UNITS
from crankwork.working_cycle import grinevetsky
from each import for_each


def line(value):
    return Snapshot(CrankGrid.from_degrees, 0.0).step(value)


def number(value, key=""):
    return traced_value.given(key, value)


STEP = line(mean_piston_speed(number(0.09), number(3000.0)))


def numbered(*blocks):
    return numbering(Note("t", "ru", blocks))


def test_sections_equations_tables_and_figures_are_counted_apart(drawing):
    headings = [Heading(1, "a"), Heading(2, "b"), Heading(3, "c"), Heading(2, "d"), Heading(1, "e", numbered=False),
                Heading(1, "f"), Heading(2, "g")]  # fmt: skip
    assert numbered(*headings).blocks == ("1", "1.1", "1.1.1", "1.2", "", "2", "2.1")
    blocks = [Equation(STEP, label="e"), Table("t", (("a",),), [], label="t"), Table("", (("a",),), []),
              Figure(drawing, "f", "f", label="f"), Table("u", (("a",),), []), Equation(STEP, label="z")]  # fmt: skip
    numbers = numbered(*blocks)
    assert numbers.blocks == ("1", "1", "1", "1", "2", "2")
    assert [numbers.reference(label) for label in "etfz"] == ["(1)", "1", "1", "(2)"]


def test_sources_are_numbered_as_the_text_comes_to_them_those_in_its_language_first():
    book, other = "den_hartog_1956", "norton_2012"
    cited = [Paragraph((Citation(f"{one}, p. 12"),)) for one in (book, other, book)]
    numbers = numbered(*cited, Equation(STEP))
    assert list(numbers.sources) == ["kolchin_demidov_2008", book, other]
    assert [numbers.citation(f"{book}, p. 12"), numbers.citation(book)] == ["[2, с. 12]", "[2]"]


def test_what_cannot_be_numbered_or_does_not_fit_is_refused():
    with pytest.raises(CrankworkError, match="nobody"):
        numbered(Paragraph((Citation("nobody"),)))
    with pytest.raises(CrankworkError, match='label "x"'):
        numbered(Heading(1, "a", label="x"), Heading(1, "b", label="x"))
    with pytest.raises(CrankworkError, match="elsewhere"):
        written_note(Note("t", "en", (Paragraph((Reference("elsewhere"),)),)), "note.html")
    with pytest.raises(ValueError, match="2 entries"):
        Table("t", (("a",), ("b",)), [["1", "2"], ["3"]])


def test_captions_and_places_in_sources_follow_the_custom_of_each_language():
    assert [caption("figure", "3", "a", one) for one in LANGUAGES] == ["Figure 3. a", "Рисунок 3 – a", "Hình 3. a"]
    assert [caption("table", "3", "a", one) for one in LANGUAGES] == ["Table 3. a", "Таблица 3 – a", "Bảng 3. a"]
    places = {
        "ch. 6, p. 7": ("гл. 6, с. 7", "ch. 6, tr. 7"),
        "vol. 2, ch. 8": ("т. 2, гл. 8", "tập 2, ch. 8"),
        "ch. 6 (offset mechanism)": ("гл. 6", "ch. 6"),
    }
    for place, (russian, vietnamese) in places.items():
        assert [place_in_source(place, one) for one in LANGUAGES] == [place, russian, vietnamese]


# --- equations


def test_an_equation_goes_from_symbols_to_numbers_to_the_unit_of_the_tables():
    shown = printed_equation(Equation(line(gas.piston_area(math.pi, number(0.1)))), "ru")
    assert shown.text.endswith("= 0,00785398\u00a0м² = 78,5398\u00a0см²")
    assert len(shown.lines) == 1
    assert sum(one == Sign("=", "relation") for one in shown.lines[0].parts) == 4
    # a long one repeats its symbol on every line
    lines = printed_equation(Equation(STEP), "en", 9.0).lines
    assert len(lines) == 3
    assert {line.parts[:2] for line in lines} == {(symbol_box("S_p"), Sign("=", "relation"))}
    # one without numbers prints its symbols only
    assert printed_equation(Equation(FORMULAS["rod_transfer_1"]), "en").text == "β′ = λ·cos φ/cos β"


@pytest.mark.slow
def test_lines_are_not_wider_than_the_text(steps):
    """A fraction cannot be divided; everything else can."""
    for step in steps:
        # a sign and a factor of six digits stand before it, or of more
        beside = 6.0 + 0.5 * (enough_digits(step) - 6)
        for line in printed_equation(Equation(step), "en", 30.0).lines:
            widest = max(width(part) for part in line.parts)
            assert width(line) <= max(30.0, widest + beside), step.formula.name


@given(value=st.floats(-1e12, 1e12), language=st.sampled_from(LANGUAGES))
def test_the_printed_value_is_the_rounding_of_the_exact_one(value, language):
    """How a number prints is tested with the boxes; here, that it is this number that ends the line, and this unit."""
    ends = (*row(number_box(value, language)[0]).parts, SPACE, Upright("м/с" if language == "ru" else "m/s"))
    assert printed_equation(Equation(STEP._replace(value=value)), language).lines[-1].parts[-len(ends) :] == ends


def signs(box):
    for part in box.parts if isinstance(box, Row) else [box]:
        if isinstance(part, Sign) and part.text:
            yield part.text
        if isinstance(part, Fence):
            yield from signs(part.inside)


def test_what_adds_up_prints_its_terms():
    terms = [number(1.5, "piston_mass"), number(-0.5, "rod_small_end_mass")]
    shown = printed_equation(Equation(line(traced_value.total("reciprocating_mass", terms))), "en")
    assert shown.text == "m_rec = m_p + m_1 = 1.5 + (−0.5) = 1\u00a0kg"
    assert [one for line in shown.lines for one in signs(line)] == ["=", "+", "=", "+", "−", "="]
    product = line((number(0.5, "efficiency.1") * number(0.5, "efficiency.2")).named("efficiency"))
    assert printed_equation(Equation(product), "en").text == "η = η_1·η_2 = 0.5·0.5 = 0.25"
    # what comes later prints where it came from
    later = DelayedLine("tangential_force.5", "tangential_force", 300.0, -1536.25)
    shown = printed_equation(Equation(later, symbol="T_5"), "ru")
    assert shown.text == "T_5 = T(300°) = −1536,25\u00a0Н"
    assert list(signs(shown.lines[0])) == ["=", "=", "−"]


def test_a_legend_names_the_unit_in_which_the_formula_takes_a_number_once():
    entries = {one.symbol: one.text for one in legend(STEP, "ru")}
    assert entries == {"S": "ход поршня, м", "n": "частота вращения, мин⁻¹"}
    kelvin = legend(line(grinevetsky.combustion_kelvin(number(2500.0), number(273.15))), "en")
    assert kelvin[0].text == "temperature at the end of burning, °C"
    for key, unit in (("compression_celsius", "°C"), ("compression_temperature", "K")):
        heat = (number(one) for one in (0.9, 78000.0, 22.0))
        entries = legend(line(grinevetsky.isochoric_energy(*heat, number(487.0, key))), "en")
        assert entries[-1].text == f"temperature at the end of compression, {unit}"


# --- units


def test_a_value_is_shown_in_the_unit_of_its_formula_and_in_that_of_the_tables():
    assert shown_values(line(forces.angular_speed(number(3.0), number(30.0)))) == [(3.0, "rad/s")]
    assert shown_values(ValueLine("gas_pressure", 2e6)) == [(2e6, "Pa"), (2.0, "MPa")]
    assert shown_values(ValueLine("gas_pressure", 0.0)) == [(0.0, "Pa"), (0.0, "MPa")]
    assert printed_unit("hp (brit)", "en") == "hp (brit)"
    assert shown_values(line(gas.piston_area(number(4.0), number(1.0)))) == [(1.0, "m2"), (1e4, "cm2")]


def test_no_unit_prints_with_a_star_or_a_plain_power():
    shown = {(unit, language): printed_unit(unit, language) for unit in UNITS for language in LANGUAGES}
    assert [key for key, text in shown.items() if not text or "*" in text] == []
    russian = {unit: shown[unit, "ru"] for unit in ("m", "m2", "Pa", "J/(kg*K)", "kg*m", "kPa")}
    wanted = ["м", "м²", "Па", "Дж/(кг·К)", "кг·м", "кПа"]
    assert list(russian.values()) == wanted


# --- text and formats


@given(text=st.text())
def test_text_has_no_character_that_xml_cannot_hold(text):
    shown = plain_text(text)
    assert all(unicodedata.category(one) not in ("Cc", "Cs") for one in shown)
    shown.encode("utf-8")
    assert plain_text(shown) == shown
    # letters are composed
    assert plain_text("e\u0302\u0301") == "ế"


def test_the_ending_tells_the_format():
    with pytest.raises(CrankworkError, match=r"\.pdf, \.docx, \.html"):
        check_format("note.odt")
    assert written_note(Note("t", "en", ()), "NOTE.HTML").startswith(b"<!DOCTYPE html>")
    assert set(WRITERS) == {".pdf", ".docx", ".html"}


@for_each(("name", "package"), [("note.pdf", "typst"), ("note.docx", "docx")])
def test_without_its_package_a_format_says_what_to_install(name, package):
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(__import__("sys").modules, package, None)
        with pytest.raises(MissingExtraError, match=r"pip install .*\[report\]"):
            written_note(Note("t", "en", ()), name)

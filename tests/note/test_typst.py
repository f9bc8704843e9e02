"""The note as PDF: all formulas compile, text comes out as it went in, bytes are the same every time."""

from __future__ import annotations

import functools
import shutil
import subprocess

import pytest

from crankwork.errors import CrankworkError
from crankwork.note.document import Equation, Figure, Math, Note, Paragraph, Table, TitlePage
from crankwork.note.pdf import pdf
from crankwork.quantities import LANGUAGES, QUANTITIES
from each import for_each


def text_of(data: bytes, *options: str) -> str:
    if not shutil.which("pdftotext"):
        pytest.skip("pdftotext of poppler-utils is not installed")
    run = subprocess.run(["pdftotext", *options, "-", "-"], input=data, capture_output=True, check=True)
    return run.stdout.decode("utf-8")


@pytest.fixture(scope="module")
def sample_pdf(samples):
    return functools.cache(lambda language: pdf(samples[language]))


@for_each("language", LANGUAGES)
def test_a_note_is_a_tagged_archivable_pdf_with_the_same_bytes_every_time(samples, sample_pdf, language):
    data = sample_pdf(language)
    assert data.startswith(b"%PDF-1.7")
    assert b"/MarkInfo" in data
    assert b"pdfaid:part>2<" in data
    assert pdf(samples[language]) == data


@pytest.mark.programs
@for_each("language", LANGUAGES)
def test_text_comes_out_as_it_went_in(sample_pdf, hostile, language):
    shown = " ".join(text_of(sample_pdf(language)).split())
    wanted = (hostile, "Thuyết minh Ậỗữ", "А. Б. <c@d>", "Động học", "Сила")
    assert [word for word in wanted if word not in shown] == []
    shown = text_of(sample_pdf(language), "-layout")
    mark = "." if language == "en" else ","
    assert [one for one in ("87.9146", "8.11133", "0.2045") if one.replace(".", mark) not in shown] == []


@pytest.mark.slow
def test_every_formula_compiles_with_symbols_and_with_numbers(formulas, steps):
    assert pdf(Note("t", "ru", (*map(Equation, steps), *map(Equation, formulas.values()))))


@pytest.mark.programs
def test_numbers_of_formulas_are_in_the_pdf(steps):
    shown = text_of(pdf(Note("t", "vi", tuple(map(Equation, steps[::8])))))
    assert f"({len(steps[::8])})" in shown
    assert "0,1234567" in shown


@for_each("language", LANGUAGES)
def test_the_fonts_have_every_letter_of_the_tables(language):
    labels = [f"{one.label(language)} {one.symbol(language)}" for one in QUANTITIES.values()]
    assert pdf(Note("t", language, tuple(Paragraph((one,)) for one in labels)))


@for_each(("text", "code"), [("\N{GRINNING FACE}", "U+1F600"), ("\u6f22", "U+6F22")])
def test_a_character_that_the_fonts_lack_is_named(text, code):
    with pytest.raises(CrankworkError, match=code.replace("+", r"\+")):
        pdf(Note(f"Title {text}", "en", (TitlePage(),)))
    # what no PDF may hold is left out
    assert pdf(Note("a\ufeff\x07\x00\ud800\ufffeb", "en", (TitlePage(),)))


@pytest.mark.programs
def test_a_symbol_in_a_cell_has_its_subscript_below_and_a_figure_its_caption(drawing):
    # the letters of a subscript are a run of their own, and the underscore is not printed
    blocks = (Table("c", (("a",),), [[Math("V_h")]]), Figure(drawing, "caption", "what it shows"))
    shown = " ".join(text_of(pdf(Note("t", "en", blocks))).split())
    assert "a \N{MATHEMATICAL ITALIC CAPITAL V}h" in shown
    assert "Figure 1. caption" in shown


@pytest.mark.programs
def test_a_long_table_is_whole_and_has_its_header_on_every_page():
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(3000)]
    shown = text_of(pdf(Note("t", "en", (Table("c", (("count",), ("value",)), rows),))), "-layout")
    pages = [page for page in shown.split("\f") if page.strip()]
    assert len(pages) > 40
    assert all("count" in page for page in pages)
    words = set(shown.split())
    assert [row for row in rows if not set(row) <= words] == []


def test_a_drawing_is_in_the_pdf_with_its_description(drawing):
    one, other = (pdf(Note("t", "en", (Figure(drawing, "caption", alt),))) for alt in ("what it shows", "another"))
    assert one != other

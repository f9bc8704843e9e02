"""The note as PDF: all formulas compile, text comes out as it went in, bytes are the same every time."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from crankwork.errors import CrankworkError
from crankwork.note.document import Equation, Figure, Heading, Math, Note, Paragraph, Table, TitlePage
from crankwork.note.pdf import pdf
from crankwork.quantities import LANGUAGES, QUANTITIES

pytest.importorskip("typst")


def _text(data: bytes, *options: str) -> str:
    if not shutil.which("pdftotext"):
        pytest.skip("pdftotext of poppler-utils is not installed")
    run = subprocess.run(["pdftotext", *options, "-", "-"], input=data, capture_output=True, check=True)
    return run.stdout.decode("utf-8")


def test_a_note_is_a_tagged_archivable_pdf_with_the_same_bytes_every_time(note):
    data = pdf(note)
    assert data.startswith(b"%PDF-1.7")
    assert pdf(note) == data
    assert b"/MarkInfo" in data
    assert b"pdfaid:part>2<" in data


def test_text_comes_out_as_it_went_in(note, hostile):
    shown = " ".join(_text(pdf(note)).split())
    assert hostile in shown
    assert all(word in shown for word in ("Thuyết minh Ậỗữ", "А. Б. <c@d>", "Động học", "Сила"))


def test_numbers_of_the_equations_are_in_the_pdf(note):
    shown = _text(pdf(note), "-layout")
    mark = "." if note.language == "en" else ","
    assert f"87{mark}9146" in shown
    assert f"8{mark}11133" in shown
    assert f"0{mark}2045" in shown


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_formula_compiles_with_symbols_and_with_numbers(formulas, steps, language):
    data = pdf(Note("t", language, (*map(Equation, steps), *map(Equation, formulas.values()))))
    shown = _text(data)
    assert f"({len(steps) * 2})" in shown
    assert ("0,123457" if language != "en" else "0.123457") in shown


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_fonts_have_every_letter_of_the_tables(language):
    labels = [f"{one.label(language)} {one.symbol(language)}" for one in QUANTITIES.values()]
    assert pdf(Note("t", language, tuple(Paragraph((one,)) for one in labels)))


@pytest.mark.parametrize(("text", "code"), [("\N{GRINNING FACE}", "U+1F600"), ("\u6f22", "U+6F22")])
def test_a_character_that_the_fonts_lack_is_named(text, code):
    with pytest.raises(CrankworkError, match=code.replace("+", r"\+")):
        pdf(Note(f"Title {text}", "en", (TitlePage(),)))


def test_characters_that_no_pdf_may_hold_are_left_out():
    assert pdf(Note("a\ufeff\x07\x00\ud800\ufffeb", "en", (TitlePage(),)))


def test_a_symbol_in_a_cell_has_its_subscript_below():
    # the letters of a subscript are a run of their own, and the underscore is not printed
    assert _text(pdf(Note("t", "en", (Table("c", (("a",),), [[Math("V_h")]]),)))).split()[-3:] == [
        "a",
        "\N{MATHEMATICAL ITALIC CAPITAL V}h",
        "1",
    ]


def test_a_long_table_has_its_header_on_every_page():
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(400)]
    shown = _text(pdf(Note("t", "en", (Table("c", (("count",), ("value",)), rows),))), "-layout")
    pages = [page for page in shown.split("\f") if page.strip()]
    assert len(pages) > 5
    assert all("count" in page for page in pages)
    assert all(f"{k / 7:.3f}" in shown for k in range(400))


def test_a_table_of_ten_thousand_rows_is_whole():
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(10_000)]
    shown = _text(pdf(Note("t", "ru", (Heading(1, "h"), Table("c", (("a",), ("b",)), rows, wide=True)))))
    assert f"{9999 / 7:.3f}" in shown


def test_a_drawing_is_in_the_pdf_with_its_description(drawing):
    data = pdf(Note("t", "en", (Figure(drawing, "caption", "what it shows"),)))
    assert "Figure 1. caption" in _text(data)
    assert data != pdf(Note("t", "en", (Figure(drawing, "caption", "something else"),)))

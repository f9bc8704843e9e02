"""The command `report`: what it writes, what it refuses, and what is left on the disk when it fails."""

from __future__ import annotations

import errno
import io
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from crankwork.description.machine_file import template

CHECKOUT = Path(__file__).parents[2]
EXAMPLES = CHECKOUT / "examples"
PRESS = str(EXAMPLES / "press.toml")
HOSTILE = "# $x$ *a* <b> & \\e"
NAMES = {
    "coupler =": '"co up#$*<>&\\\\" =',
    "rocker  =": '"r/2" =',
    "\nC =": '\n"C<#$*&\\\\>" =',
    '"C", "B"': '"C<#$*&\\\\>", "B"',
}
FORMATS = [pytest.param(".pdf", marks=pytest.mark.programs), ".docx", ".html"]


def _words(path: str) -> str:
    """Return the text of a note, whatever its format."""
    data = Path(path).read_bytes()
    if path.endswith(".docx"):
        return zipfile.ZipFile(io.BytesIO(data)).read("word/document.xml").decode("utf-8")
    if path.endswith(".html"):
        return data.decode("utf-8")
    if not shutil.which("pdftotext"):
        pytest.skip("pdftotext of poppler-utils is not installed")
    run = subprocess.run(["pdftotext", "-", "-"], input=data, capture_output=True, check=True)
    return run.stdout.decode("utf-8")


def test_a_note_is_written_and_said_in_its_language(crankwork) -> None:
    for language, said, heading, ending in (
        ("en", "Written to", "Driving torque", "html"),
        ("ru", "Записано в", "Расчёт КПД механизма", "html"),
        ("vi", "Đã ghi vào", "Hiệu suất của cơ cấu", "docx"),
    ):
        name = f"my {language} note.{ending}"
        answer = crankwork("report", PRESS, "-o", name, "--lang", language, "--no-figures")
        assert (answer.code, answer.out, answer.err) == (0, f"{said} {name}\n", "")
        assert heading in _words(name)
    assert len(list(Path().iterdir())) == 3


@pytest.mark.parametrize("ending", FORMATS)
def test_title_and_author_come_out_as_they_went_in_and_names_too(crankwork, machine_file, ending) -> None:
    name, author = machine_file(*NAMES.items(), name="four-bar"), "Петров П. П. # $y$"
    options = ("--title", HOSTILE, "--author", author, "--no-figures", "--lang", "ru")
    answer = crankwork("report", name, "-o", f"a{ending}", *options)
    assert (answer.out, answer.err) == (f"Записано в a{ending}\n", "")
    shown = _words(f"a{ending}")
    for text in (HOSTILE, author, "C<#$*&\\>", "co up#$*<>&\\"):
        escaped = text if ending == ".pdf" else text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        assert escaped in shown


def test_figures_are_left_out_where_that_is_asked_for(crankwork) -> None:
    assert crankwork("report", PRESS, "-o", "a.html").code == 0
    assert crankwork("report", PRESS, "-o", "b.html", "--no-figures").code == 0
    drawn, plain = (_words(f"{name}.html") for name in "ab")
    assert ("<svg" in drawn, "<svg" in plain) == (True, False)
    assert drawn.count("Figure") > plain.count("Figure")


def test_a_character_without_a_glyph_is_named_in_a_pdf_and_kept_elsewhere(crankwork, check_refusals) -> None:
    asked = ("--title", "Пресс \U0001f600", "--no-figures")
    check_refusals([(("report", PRESS, "-o", "a.pdf", *asked), one) for one in ("U+1F600", ".docx or .html")])
    assert not list(Path().iterdir())
    assert crankwork("report", PRESS, "-o", "a.html", *asked).code == 0
    assert "\U0001f600" in _words("a.html")


def test_an_empty_title_gives_way_to_a_generic_one(crankwork, machine_file) -> None:
    name = machine_file(text=template("four-bar").replace('title = "Four-bar linkage"', ""))
    assert crankwork("report", name, "-o", "a.html", "--title", "  ", "--lang", "ru", "--no-figures").code == 0
    assert "<h1>Плоский рычажный механизм" in _words("a.html").replace(' class="title"', "")


REFUSED = [
    (("-o", "a.txt"), "a.txt: no format of a note has this ending; end it in .pdf, .docx, .html"),
    (("-o", "note"), "note: no format of a note has this ending; end it in .pdf, .docx, .html"),
    ((), "-o: is missing; write -o NOTE, see --help"),
    (("-o", "no/a.html"), "no/a.html: there is no folder no; make it or choose another place"),
    (("-o", "folder.html"), "folder.html: is a folder; give a file name"),
    (("-o", "mine.html/a.html"), "there is no folder mine.html; make it"),
    (("-o", "mine.html"), "mine.html: exists already; choose another name or add --overwrite"),
    (("-o", "a\0.html"), "cannot be written"),
    (("-o", "a.html", "--lang", "de"), "--lang: de is not possible; write en, ru or vi"),
    (("-o", "a.html", "--school", "de"), "--school: de is not possible; write en, ru or vi"),
    (("-o", "a.html", "--per-area"), "--per-area: needs the piston area; give cylinder.bore in the file"),
    (("-o", "a.html", "--set", "crank.sped=1"), "--set crank.sped: unknown key; did you mean speed?"),
    (("-o", "a.html", "--method", "foo"), "--method: "),
]


def test_what_cannot_be_is_refused_in_one_line(check_refusals, monkeypatch) -> None:
    Path("folder.html").mkdir()
    Path("mine.html").write_text("mine", encoding="utf-8")
    check_refusals((("report", PRESS, *options), told) for options, told in REFUSED)
    # before anything is computed
    monkeypatch.setattr(os, "access", lambda *_: False)
    told = "a.html: cannot be written (. is not a writable folder); choose another place"
    check_refusals([(("report", "there is no such.toml", "-o", "a.html"), told)])


def test_overwriting_replaces_a_note_and_a_full_disk_keeps_the_old_one(crankwork, check_refusals, monkeypatch) -> None:
    Path("a.html").write_text("mine", encoding="utf-8")
    asked = ("report", PRESS, "-o", "a.html", "--overwrite", "--no-figures")
    assert crankwork(*asked).code == 0
    assert Path("a.html").read_bytes().startswith(b"<!DOCTYPE html>")

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    told = "a.html: запись невозможна (no space left on device)"
    check_refusals([((*asked, "--lang", "ru"), told)])
    assert [one.name for one in Path().iterdir()] == ["a.html"]


def test_all_missing_parts_are_named_at_once_with_how_to_install_them(crankwork, check_refusals, monkeypatch) -> None:
    told = f"this note needs an optional part; install it with: pip install -e '{CHECKOUT}[report]'"
    for name, missing in (("a.pdf", ["typst"]), ("a.docx", ["docx"]), ("a.docx", ["typst", "docx", "ezdxf"])):
        with monkeypatch.context() as without:
            for one in missing:
                without.setitem(sys.modules, one, None)
            sheets = ["--sheets"] if len(missing) > 1 else []
            check_refusals([(("report", PRESS, "-o", name, *sheets), told)])


@pytest.mark.slow
def test_sheets_stand_beside_the_note_on_the_paper_that_is_asked_for(crankwork, check_refusals) -> None:
    asked = ("report", PRESS, "-o", "n.html", "--no-figures")
    answer = crankwork(*asked, "--sheets", "--author", "Petrov")
    beside = ["n-sheet-1.pdf", "n-sheet-1.svg", "n-sheet-1.dxf"]
    assert answer.out == f"Written to n.html, {', '.join(beside)}\n"
    assert sorted(one.name for one in Path().iterdir()) == sorted(["n.html", *beside])
    plain = Path("n-sheet-1.svg").read_text(encoding="utf-8")
    answer = crankwork(*asked, "--paper", "A3", "--grid", "--overwrite")
    assert answer.code == 0, answer.err
    drawn = Path("n-sheet-1.svg").read_text(encoding="utf-8")
    assert ('viewBox="0 0 841 594"' in plain, 'viewBox="0 0 420 297"' in drawn) == (True, True)
    # the author, and the thin lines of the grid
    assert [(">Petrov<" in one, 'stroke-width="0.05"' in one) for one in (plain, drawn)] == [
        (True, False),
        (False, True),
    ]
    Path("n.html").unlink()
    check_refusals([((*asked, "--sheets"), "n-sheet-1.pdf: exists already")])


@pytest.mark.slow
@pytest.mark.parametrize("ending", FORMATS)
def test_a_table_of_a_thousand_rows_is_whole(crankwork, machine_file, ending) -> None:
    name = machine_file(text=template("scotch-yoke"))
    answer = crankwork("report", name, "-o", f"a{ending}", "--full", "--step", "0.36", "--no-figures")
    assert answer.code == 0
    shown = _words(f"a{ending}")
    assert [step for step in (1, 501, 999) if f"{step * 0.36:.6g}" not in shown] == []


def test_options_of_the_calculation_reach_the_note(crankwork, machine_file) -> None:
    name = machine_file(text=template("four-bar"))
    plain = crankwork(
        "report", name, "-o", "a.html", "--full", "--no-figures", "--step", "45", "--set", "crank.speed=200 rpm"
    )
    assert plain.code == 0
    shown = _words("a.html")
    assert "20.944" in shown
    assert ">315<" in shown
    assert ">190<" not in shown


def test_the_school_orders_the_sections(crankwork, machine_file) -> None:
    name = machine_file()
    for school in ("en", "ru", "vi"):
        assert crankwork("report", name, "-o", f"{school}.html", "--no-figures", "--school", school).code == 0
    headings = {school: re.findall(r"<h2[^>]*>\d+ ([^<]*)", _words(f"{school}.html")) for school in ("en", "ru", "vi")}
    assert "Method" in headings["en"]
    assert [heading for heading in headings["en"] if heading != "Method"] == headings["ru"]
    assert headings["vi"].index("Wear diagram of the crankpin") > headings["vi"].index("Diagram of the total torque")

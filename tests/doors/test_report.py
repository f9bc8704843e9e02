"""The command `report`: what it writes, what it refuses, and what is left on the disk when it fails."""

from __future__ import annotations

import errno
import io
import os
import shutil
import subprocess
import sys
import zipfile
from importlib.util import find_spec
from pathlib import Path

import pytest

from crankwork import files
from crankwork.description.machine_file import template

CHECKOUT = Path(__file__).parents[2]
EXAMPLES = CHECKOUT / "examples"
PRESS = str(EXAMPLES / "press.toml")
HOSTILE = "# $x$ *a* <b> & \\e"
NAMES = """
[fixed_points]
O = ["0 mm", "0 mm"]
"C<#$*&\\\\>" = ["200 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "62.5 mm"
speed = "100 rpm"
[links]
"co up#$*<>&\\\\" = { joins = ["A", "B_1"], length = "175 mm", mass = "1.5 kg", centre = ["80 mm", "40 mm"] }
"r/2" = { joins = ["C<#$*&\\\\>", "B_1"], length = "112.5 mm", mass = "1 kg", centre = ["56 mm", "0 mm"] }
[branch]
B_1 = 1
"""
FORMATS = [
    pytest.param(ending, marks=pytest.mark.skipif(not find_spec(needed), reason=f"{needed} is not installed"))
    for ending, needed in ((".pdf", "typst"), (".docx", "docx"), (".html", "crankwork"))
]


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


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize(("language", "said"), [("en", "Written to"), ("ru", "Записано в"), ("vi", "Đã ghi vào")])
def test_a_note_is_written_and_said_in_its_language(crankwork, ending, language, said) -> None:
    answer = crankwork("report", PRESS, "-o", f"my note{ending}", "--lang", language, "--no-figures")
    assert (answer.code, answer.out, answer.err) == (0, f"{said} my note{ending}\n", "")
    assert [one.name for one in Path().iterdir()] == [f"my note{ending}"]
    heading = {"en": "Driving torque", "ru": "Расчёт КПД механизма", "vi": "Hiệu suất của cơ cấu"}[language]
    assert heading in _words(f"my note{ending}")


@pytest.mark.parametrize("ending", FORMATS)
def test_title_author_and_figures_come_from_the_options(crankwork, ending) -> None:
    options = ("--title", "Мой пресс", "--author", "Петров П. П.", "--lang", "ru")
    assert crankwork("report", PRESS, "-o", f"a{ending}", *options).code == 0
    assert crankwork("report", PRESS, "-o", f"b{ending}", *options, "--no-figures").code == 0
    for name in ("a", "b"):
        shown = _words(name + ending)
        assert "Мой пресс" in shown
        assert "Петров П. П." in shown
    drawn, plain = (_words(f"{name}{ending}").count("Рис") for name in "ab")
    assert drawn > plain


@pytest.mark.parametrize("ending", FORMATS)
def test_marks_of_every_format_in_titles_and_names_come_out_as_they_went_in(crankwork, machine_file, ending) -> None:
    name = machine_file(text=NAMES)
    options = ("--title", HOSTILE, "--author", HOSTILE, "--no-figures")
    assert crankwork("report", name, "-o", f"a{ending}", *options).err == ""
    shown = _words(f"a{ending}")
    for text in (HOSTILE, "C<#$*&\\>", "co up#$*<>&\\"):
        escaped = text if ending == ".pdf" else text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        assert escaped in shown


def test_a_character_without_a_glyph_is_named_in_a_pdf_and_kept_elsewhere(crankwork, check_mistakes) -> None:
    pytest.importorskip("typst")
    answer = crankwork("report", PRESS, "-o", "a.pdf", "--title", "Пресс \U0001f600", "--no-figures")
    check_mistakes(answer)
    assert "U+1F600" in answer.err
    assert ".docx or .html" in answer.err
    assert not list(Path().iterdir())
    assert crankwork("report", PRESS, "-o", "a.html", "--title", "Пресс \U0001f600", "--no-figures").code == 0
    assert "\U0001f600" in _words("a.html")


@pytest.mark.parametrize("title", ["", "  "])
def test_an_empty_title_gives_way_to_a_generic_one(crankwork, machine_file, title) -> None:
    name = machine_file(text=template("four-bar").replace('title = "Four-bar linkage"', ""))
    options = ("--title", title, "--lang", "ru", "--no-figures")
    assert crankwork("report", name, "-o", "a.html", *options).code == 0
    assert "<h1>Плоский рычажный механизм" in _words("a.html").replace(' class="title"', "")


REFUSED = {
    "unknown ending": (("-o", "a.txt"), "a.txt: no format of a note has this ending; end it in .pdf, .docx, .html"),
    "no ending": (("-o", "note"), "note: no format of a note has this ending; end it in .pdf, .docx, .html"),
    "no output": ((), "-o: is missing; write -o NOTE, see --help"),
    "missing folder": (("-o", "no/a.html"), "no/a.html: there is no folder no; make it or choose another place"),
    "a folder": (("-o", "folder.html"), "folder.html: is a folder; give a file name"),
    "a file as folder": (("-o", "mine.html/a.html"), "there is no folder mine.html; make it"),
    "there already": (("-o", "mine.html"), "mine.html: exists already; choose another name or add --overwrite"),
    "unusable name": (("-o", "a\0.html"), "cannot be written"),
    "language": (("-o", "a.html", "--lang", "de"), "--lang: de is not possible; write en, ru or vi"),
    "school": (("-o", "a.html", "--school", "de"), "--school: de is not possible; write en, ru or vi"),
    "per area": (("-o", "a.html", "--per-area"), "--per-area: needs the piston area; give cylinder.bore in the file"),
    "setting": (("-o", "a.html", "--set", "crank.sped=1"), "--set crank.sped: unknown key; did you mean speed?"),
    "method": (("-o", "a.html", "--method", "foo"), '--method: '),
}  # fmt: skip


@pytest.mark.parametrize(("options", "answered"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_is_refused_in_one_line(crankwork, check_mistakes, options, answered) -> None:
    Path("folder.html").mkdir()
    Path("mine.html").write_text("mine", encoding="utf-8")
    answer = crankwork("report", PRESS, *options)
    check_mistakes(answer)
    (line,) = answer.mistakes
    assert answered in line
    assert sorted(one.name for one in Path().iterdir()) == ["folder.html", "mine.html"]
    assert Path("mine.html").read_text("utf-8") == "mine"


def test_a_folder_that_cannot_be_written_is_refused_before_the_computing(
    crankwork, check_mistakes, monkeypatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    answer = crankwork("report", "there is no such.toml", "-o", "a.html")
    check_mistakes(answer)
    assert "a.html: cannot be written (. is not a writable folder); choose another place" in answer.err


def test_overwriting_replaces_a_note_and_a_full_disk_keeps_the_old_one(crankwork, check_mistakes, monkeypatch) -> None:
    Path("a.html").write_text("mine", encoding="utf-8")
    assert crankwork("report", PRESS, "-o", "a.html", "--overwrite", "--no-figures").code == 0
    old = Path("a.html").read_bytes()
    assert old.startswith(b"<!DOCTYPE html>")

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    answer = crankwork("report", PRESS, "-o", "a.html", "--overwrite", "--no-figures", "--lang", "ru")
    check_mistakes(answer)
    assert "a.html: запись невозможна (no space left on device)" in answer.err
    assert {one.name: one.read_bytes() for one in Path().iterdir()} == {"a.html": old}


def test_of_several_files_all_are_replaced_or_none(monkeypatch) -> None:
    files.write_files({"a": b"1", "b": b"1"})
    calls: list[int] = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) == 2:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(files.CrankworkError, match=r"^b: cannot be written"):
        files.write_files({"a": b"2", "b": b"2"}, overwrite=True)
    assert {one.name: one.read_bytes() for one in Path().iterdir()} == {"a": b"1", "b": b"1"}


@pytest.mark.parametrize(
    ("name", "missing", "extra"),
    [("a.pdf", "typst", "report"), ("a.docx", "docx", "report")],
)
def test_a_missing_part_is_named_with_how_to_install_it(
    crankwork, check_mistakes, monkeypatch, name, missing, extra
) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    answer = crankwork("report", PRESS, "-o", name)
    check_mistakes(answer)
    assert f"install it with: pip install -e '{CHECKOUT}[{extra}]'" in answer.err
    assert not list(Path().iterdir())


def test_all_missing_parts_are_named_at_once(crankwork, check_mistakes, monkeypatch) -> None:
    for missing in ("typst", "docx", "ezdxf"):
        monkeypatch.setitem(sys.modules, missing, None)
    answer = crankwork("report", PRESS, "-o", "a.docx", "--sheets")
    check_mistakes(answer)
    wanted = f"install it with: pip install -e '{CHECKOUT}[report]'\n"
    assert answer.err == f"this note needs an optional part; {wanted}"


def test_sheets_stand_beside_the_note(crankwork) -> None:
    pytest.importorskip("typst")
    pytest.importorskip("ezdxf")
    answer = crankwork("report", PRESS, "-o", "n.html", "--no-figures", "--sheets", "--author", "Petrov")
    beside = ["n-sheet-1.pdf", "n-sheet-1.svg", "n-sheet-1.dxf"]
    assert answer.out == f"Written to n.html, {', '.join(beside)}\n"
    assert sorted(one.name for one in Path().iterdir()) == sorted(["n.html", *beside])
    again = crankwork("report", PRESS, "-o", "n.html", "--no-figures", "--sheets", "--overwrite")
    assert again.code == 0
    Path("n.html").unlink()
    assert "n-sheet-1.pdf: exists already" in crankwork("report", PRESS, "-o", "n.html", "--sheets").err


@pytest.mark.parametrize("ending", FORMATS)
def test_a_table_of_thousands_of_rows_is_whole(crankwork, machine_file, ending) -> None:
    name = machine_file(text=template("scotch-yoke"))
    answer = crankwork("report", name, "-o", f"a{ending}", "--step", "0.072", "--no-figures")
    assert answer.code == 0
    shown = _words(f"a{ending}")
    assert all(shown.count(f"{step * 0.072:.6g}") >= 1 for step in (1, 2501, 4999))


def test_options_of_the_calculation_reach_the_note(crankwork, machine_file) -> None:
    name = machine_file(text=template("four-bar"))
    plain = crankwork("report", name, "-o", "a.html", "--no-figures", "--step", "45", "--set", "crank.speed=200 rpm")
    assert plain.code == 0
    shown = _words("a.html")
    assert "20.944" in shown
    assert ">315<" in shown
    assert ">190<" not in shown


def test_the_school_orders_the_sections(crankwork) -> None:
    name = str(EXAMPLES / "press-geometry.toml")
    for school in ("en", "ru"):
        assert crankwork("report", name, "-o", f"{school}.html", "--no-figures", "--school", school).code == 0
    assert _words("en.html").index("Main results") < _words("en.html").index("Position plans")
    assert _words("ru.html").rindex("Main results") > _words("ru.html").rindex("Position plans")


def test_sheets_have_the_paper_that_is_asked_for(crankwork) -> None:
    answer = crankwork("report", PRESS, "-o", "p.html", "--no-figures", "--paper", "A3", "--grid")
    assert answer.code == 0, answer.err
    drawn = Path("p-sheet-1.svg").read_text(encoding="utf-8")
    assert 'viewBox="0 0 420 297"' in drawn
    plain = crankwork("report", PRESS, "-o", "q.html", "--no-figures", "--paper", "A3")
    assert plain.code == 0
    assert len(Path("q-sheet-1.svg").read_text(encoding="utf-8")) < len(drawn)

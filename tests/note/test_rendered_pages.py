"""Notes as a reader sees them: PDF by poppler, Word by LibreOffice, the web page printed by a browser.

Every word must lie within the page, nothing may be a replacement character, and all three must hold the same numbers.
"""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from crankwork.note.document import Heading, Note, Person, Table, TitlePage
from crankwork.note.sections import written_note
from each import failing, for_each
from notes import note

# LibreOffice, poppler and a browser show the pages
pytestmark = pytest.mark.programs
WORD = re.compile(r'<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>')
PAGE = re.compile(r'<page width="([\d.]+)" height="([\d.]+)">')
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


class Printed(NamedTuple):
    """Pages of a PDF: their sizes [pt], and their words with their boxes."""

    pages: list[tuple[float, float]]
    words: list[tuple[int, tuple[float, ...], str]]

    @property
    def text(self) -> str:
        return " ".join(word for _, _, word in self.words)


def _program(*names: str) -> str:
    found = next((path for name in names if (path := shutil.which(name))), None)
    if found is None:
        pytest.skip(f"{names[0]} is not installed")
    return found


def _printed(pdf: Path) -> Printed:
    boxes = subprocess.run(
        [_program("pdftotext"), "-bbox", str(pdf), "-"], capture_output=True, text=True, check=True
    ).stdout
    pages: list[tuple[float, float]] = []
    words = []
    for line in boxes.splitlines():
        if page := PAGE.search(line):
            pages.append((float(page[1]), float(page[2])))
        elif word := WORD.search(line):
            words.append((len(pages) - 1, tuple(map(float, word.groups()[:4])), word[5]))
    return Printed(pages, words)


def _empty_ends(pdf: Path) -> list[float]:
    """Return which share of each page below its last line is empty, its number left out."""
    run = subprocess.run([_program("pdftoppm"), "-r", "20", "-gray", str(pdf)], capture_output=True, check=True)
    data, shares = run.stdout, []
    while data:
        size = re.match(rb"P5\s(\d+) (\d+)\s255\s", data)
        assert size is not None
        width, height = int(size[1]), int(size[2])
        page = np.frombuffer(data, np.uint8, width * height, size.end()).reshape(height, width)
        body = page[int(0.06 * height) : int(0.93 * height)]
        inked = np.flatnonzero((body < 200).any(axis=1))
        shares.append(1.0 - (inked[-1] + 1) / len(body) if inked.size else 1.0)
        data = data[size.end() + width * height :]
    return shares


def _print_word(folder: Path) -> Path:
    """Print the Word note of a folder by LibreOffice."""
    subprocess.run(
        [_program("soffice", "libreoffice"), f"-env:UserInstallation=file://{folder}/profile", "--headless",
         "--convert-to", "pdf:writer_pdf_Export", "--outdir", str(folder / "word"), str(folder / "note.docx")],
        capture_output=True, check=True, timeout=180,
    )  # fmt: skip
    return folder / "word" / "note.pdf"


# an engine and a press: letters of two languages, long and short notes
@pytest.fixture(scope="module", params=[("spark-engine", "vi"), ("press", "ru")], ids="-".join)
def rendered(request, tmp_path_factory):
    """A note, what stands on its pages by format, and the folder of its files."""
    folder = tmp_path_factory.mktemp("note")
    found = note(*request.param, figures=True)
    for ending in ("pdf", "docx", "html"):
        (folder / f"note.{ending}").write_bytes(written_note(found, f"note.{ending}"))
    _print_word(folder)
    _browse(folder, "--no-pdf-header-footer", f"--print-to-pdf={folder}/web.pdf", str(folder / "note.html"))
    files = {"pdf": "note.pdf", "word": "word/note.pdf", "web": "web.pdf"}
    return found, {kind: _printed(folder / path) for kind, path in files.items()}, folder


def _browse(folder: Path, *options: str) -> str:
    fixed = ("--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder}/browser")
    run = subprocess.run([_program(*BROWSERS), *fixed, *options], capture_output=True, check=True, timeout=180)
    return run.stdout.decode("utf-8")


# a page in a frame as wide as the screen of a telephone, and after it how wide its parts are
FRAME = """<!DOCTYPE html><meta charset="utf-8"><iframe style="width:420px;height:900px;border:0" srcdoc="{}"></iframe>
<pre></pre><script>onload = () => {{
  const page = document.querySelector("iframe").contentDocument, edge = one => one.getBoundingClientRect();
  const equations = [...page.querySelectorAll(".equation")].map(one => {{
    const lines = one.querySelector(".lines"), mark = one.querySelector(".mark"), box = edge(lines);
    return [box.left, box.right, edge(mark).right, edge(mark).top - box.bottom,
            page.defaultView.getComputedStyle(lines).overflowX];
  }});
  document.querySelector("pre").textContent = JSON.stringify({{page: page.documentElement.scrollWidth, equations}});
}}</script>"""


def test_a_narrow_screen_shows_or_scrolls_every_formula(tmp_path):
    """On a screen of 420 px: the width of the page, and the edges of its equations [px]."""
    page = written_note(note("petrol-four", "ru"), "note.html").decode("utf-8")
    (tmp_path / "frame.html").write_text(FRAME.format(html.escape(page)), encoding="utf-8")
    shown = _browse(tmp_path, "--dump-dom", str(tmp_path / "frame.html"))
    narrow = json.loads(shown.rpartition("<pre>")[2].partition("</pre>")[0])
    assert len(narrow["equations"]) > 50
    for left, right, mark, below, overflow in narrow["equations"]:
        assert (overflow, right - left > 360, mark <= 420, below >= 0) == ("auto", True, True, True)
    assert narrow["page"] <= 420


def test_every_word_lies_on_its_page_and_no_letter_is_replaced(rendered):
    def check(shown):
        assert len(shown.pages) >= 5
        outside = [
            (page + 1, word)
            for page, (left, top, right, bottom), word in shown.words
            if left < 12 or top < 8 or right > shown.pages[page][0] - 12 or bottom > shown.pages[page][1] - 8
        ]
        assert outside == []
        # LibreOffice prints an inverted question mark where a formula lacks something, and drops what follows
        assert [mark for mark in "\ufffd\u25a1\u00bf" if mark in shown.text] == []

    assert failing(rendered[1], check) == {}


def test_the_three_hold_the_same_numbers(rendered):
    numbers = [set(re.findall(r"\d+,\d{2,}", shown.text)) for shown in rendered[1].values()]
    common = set.intersection(*numbers)
    assert len(common) > 100
    # what breaks over a line in one of them may be missing there
    assert len(common) > 0.97 * max(map(len, numbers))


def test_no_word_of_a_table_is_divided(rendered):
    found, shown, _ = rendered
    said = [run for one in found.blocks if isinstance(one, Table)
            for some in (*one.headings, *one.rows) for run in some if isinstance(run, str)]  # fmt: skip
    words = {word.strip("(),;:") for one in said for word in one.split()}
    assert len(words) > 100
    for kind in ("pdf", "word"):
        # commas and brackets may stand beside a word, and a formula is words of its own
        known = {word.strip("(),;:") for _, _, word in shown[kind].words}
        assert sorted(word for word in words - known if re.fullmatch(r"[\w.,−]+", word)) == [], kind


def test_the_contents_of_word_have_pages_and_hardly_a_page_is_nearly_empty(rendered):
    found, shown, folder = rendered
    titles = [block.text for block in found.blocks if isinstance(block, Heading) and block.level <= 2]
    contents = [word for page, _, word in shown["word"].words if page <= 1]
    pages = [int(number[1]) for word in contents if (number := re.search(r"\.{2,}(\d+)$", word))]
    assert len(pages) == len(titles)
    assert pages == sorted(pages)
    assert pages[-1] <= len(shown["word"].pages)
    _, *shares, _ = _empty_ends(folder / "word" / "note.pdf")
    # there may be one, where what is estimated has gone astray
    assert sum(one > 0.4 for one in shares) <= 1


@for_each(("name", "language"), [("press-start", "en"), ("punching-machine", "ru")])
def test_no_page_between_cover_and_end_is_nearly_empty(name, language, tmp_path):
    (tmp_path / "note.pdf").write_bytes(written_note(note(name, language, figures=True), "note.pdf"))
    _, *shares, _ = _empty_ends(tmp_path / "note.pdf")
    assert max(shares) < 0.4


def test_no_page_of_a_long_word_note_is_nearly_empty(tmp_path):
    (tmp_path / "note.docx").write_bytes(written_note(note("two-stroke", "vi", figures=True), "note.docx"))
    _, *shares, _ = _empty_ends(_print_word(tmp_path))
    assert max(shares) < 0.4


@for_each(
    ("language", "words"),
    [("en", "Table 1 (continued)"), ("ru", "Продолжение таблицы 1"), ("vi", "Bảng 1 (tiếp theo)")],
)
def test_a_table_that_goes_on_says_so_on_every_page_but_its_first(language, words, tmp_path):
    path = tmp_path / "note.pdf"
    for rows, times in ((20, 0), (150, 2)):
        table = Table("c", (("a",), ("b",)), [(str(k), "1.5") for k in range(rows)])
        path.write_bytes(written_note(Note("t", language, (table,)), "note.pdf"))
        assert _printed(path).text.count(words) == times


@for_each("letter", ["W", "Щ", "Ậ"])
def test_a_word_of_300_letters_stays_on_the_cover(tmp_path, letter):
    word = 300 * letter
    cover = TitlePage((word,), ("Subject",), (), (Person("Author", (word,), signs=True),), "City")
    (tmp_path / "note.pdf").write_bytes(written_note(Note("Title", "en", (cover,)), "note.pdf"))
    shown = _printed(tmp_path / "note.pdf")
    assert sum(one.count(letter) for _, _, one in shown.words) == 600
    assert len(shown.pages) == 1
    assert all(box[0] >= 0 and box[2] <= shown.pages[0][0] for _, box, _ in shown.words)

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

import crankwork
from crankwork.note.contents import note_of, written_note
from crankwork.note.document import Heading, Note, Person, Table, TitlePage
from crankwork.note.options import NoteOptions

EXAMPLES = Path(__file__).parents[2] / "examples"
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


@pytest.fixture(scope="module", params=[("spark-engine", "vi"), ("petrol-four", "ru"), ("press", "ru")], ids="-".join)
def printed(request, tmp_path_factory):
    name, language = request.param
    folder = tmp_path_factory.mktemp("note")
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    note = note_of(results, NoteOptions(language=language))
    for ending in ("pdf", "docx", "html"):
        (folder / f"note.{ending}").write_bytes(written_note(note, f"note.{ending}"))
    _print_word(folder)
    browser = _program(*BROWSERS)
    subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
         f"--user-data-dir={folder}/browser", f"--print-to-pdf={folder}/web.pdf", str(folder / "note.html")],
        capture_output=True, check=True, timeout=180,
    )  # fmt: skip
    shown = {"pdf": folder / "note.pdf", "word": folder / "word" / "note.pdf", "web": folder / "web.pdf"}
    return note, {kind: _printed(path) for kind, path in shown.items()}, shown


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


@pytest.fixture(scope="module")
def narrow(tmp_path_factory):
    """The web page on a screen of 420 px: its width, and the edges of its equations [px]."""
    folder = tmp_path_factory.mktemp("narrow")
    browser = _program(*BROWSERS)
    results = crankwork.analyse(crankwork.read(EXAMPLES / "petrol-four.toml"))
    page = written_note(note_of(results, NoteOptions(language="ru")), "note.html").decode("utf-8")
    (folder / "frame.html").write_text(FRAME.format(html.escape(page)), encoding="utf-8")
    shown = subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom", f"--user-data-dir={folder}/browser",
         str(folder / "frame.html")],
        capture_output=True, check=True, timeout=180,
    ).stdout.decode("utf-8")  # fmt: skip
    return json.loads(shown.rpartition("<pre>")[2].partition("</pre>")[0])


def test_a_narrow_screen_shows_or_scrolls_every_formula(narrow):
    assert len(narrow["equations"]) > 50
    for left, right, mark, below, overflow in narrow["equations"]:
        assert overflow == "auto"
        assert right - left > 360
        assert mark <= 420
        assert below >= 0
    assert narrow["page"] <= 420


@pytest.mark.parametrize("kind", ["pdf", "word", "web"])
def test_every_word_lies_on_its_page(printed, kind):
    shown = printed[1][kind]
    assert len(shown.pages) >= 5
    outside = [
        (page + 1, word)
        for page, (left, top, right, bottom), word in shown.words
        if left < 12 or top < 8 or right > shown.pages[page][0] - 12 or bottom > shown.pages[page][1] - 8
    ]
    assert outside == []


@pytest.mark.parametrize("kind", ["pdf", "word", "web"])
def test_no_letter_is_replaced(printed, kind):
    # LibreOffice prints an inverted question mark where a formula lacks something, and drops what follows
    assert [mark for mark in "\ufffd\u25a1\u00bf" if mark in printed[1][kind].text] == []


def test_the_three_hold_the_same_numbers(printed):
    numbers = [set(re.findall(r"\d+,\d{2,}", shown.text)) for shown in printed[1].values()]
    common = set.intersection(*numbers)
    assert len(common) > 100
    # what breaks over a line in one of them may be missing there
    assert len(common) > 0.97 * max(map(len, numbers))


@pytest.mark.parametrize("kind", ["pdf", "word"])
def test_no_word_of_a_table_is_divided(printed, kind):
    note, shown, _ = printed
    said = [
        run for block in note.blocks if isinstance(block, Table)
        for some in (*block.headings, *block.rows) for run in some if isinstance(run, str)
    ]  # fmt: skip
    # commas and brackets may stand beside a word, and a formula is words of its own
    known = {word.strip("(),;:") for _, _, word in shown[kind].words}
    words = {word.strip("(),;:") for one in said for word in one.split()}
    assert len(words) > 100
    assert sorted(word for word in words - known if re.fullmatch(r"[\w.,−]+", word)) == []


def test_the_contents_of_word_have_pages(printed):
    note, shown, _ = printed
    titles = [block.text for block in note.blocks if isinstance(block, Heading) and block.level <= 2]
    contents = [word for page, _, word in shown["word"].words if page == 1]
    pages = [int(found[1]) for word in contents if (found := re.search(r"\.{2,}(\d+)$", word))]
    assert len(pages) == len(titles)
    assert pages == sorted(pages)
    assert pages[-1] <= len(shown["word"].pages)


@pytest.mark.parametrize(
    ("name", "language"), [("two-stroke", "vi"), ("press-start", "en"), ("punching-machine", "ru")]
)
def test_no_page_between_cover_and_end_is_nearly_empty(name, language, tmp_path):
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    path = tmp_path / "note.pdf"
    path.write_bytes(written_note(note_of(results, NoteOptions(language=language)), "note.pdf"))
    _, *shares, _ = _empty_ends(path)
    assert max(shares) < 0.4


def test_hardly_a_page_of_word_is_nearly_empty(printed):
    _, *shares, _ = _empty_ends(printed[2]["word"])
    # the four-cylinder engine has one, where what is estimated has gone astray
    assert sum(one > 0.4 for one in shares) <= 1


@pytest.mark.parametrize(("name", "language"), [("v8-diesel", "ru"), ("two-stroke", "vi")])
def test_no_page_of_a_long_word_note_is_nearly_empty(name, language, tmp_path):
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    (tmp_path / "note.docx").write_bytes(written_note(note_of(results, NoteOptions(language=language)), "note.docx"))
    _, *shares, _ = _empty_ends(_print_word(tmp_path))
    assert max(shares) < 0.4


@pytest.mark.parametrize(
    ("language", "words"),
    [("en", "Table 1 (continued)"), ("ru", "Продолжение таблицы 1"), ("vi", "Bảng 1 (tiếp theo)")],
)
def test_a_table_that_goes_on_says_so_on_every_page_but_its_first(language, words, tmp_path):
    path = tmp_path / "note.pdf"
    for rows, times in ((20, 0), (120, 2)):
        table = Table("c", (("a",), ("b",)), [(str(k), "1.5") for k in range(rows)])
        path.write_bytes(written_note(Note("t", language, (table,)), "note.pdf"))
        assert _printed(path).text.count(words) == times


@pytest.mark.parametrize("letter", ["W", "Щ", "Ậ"])
def test_a_word_of_300_letters_stays_on_the_cover(tmp_path, letter):
    word = 300 * letter
    cover = TitlePage((word,), ("Subject",), (), (Person("Author", (word,), signs=True),), "City")
    (tmp_path / "note.pdf").write_bytes(written_note(Note("Title", "en", (cover,)), "note.pdf"))
    printed = _printed(tmp_path / "note.pdf")
    assert sum(one.count(letter) for _, _, one in printed.words) == 600
    assert len(printed.pages) == 1
    assert all(box[0] >= 0 and box[2] <= printed.pages[0][0] for _, box, _ in printed.words)

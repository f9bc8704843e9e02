"""Pages of examples in a real browser."""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Callable, Generator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import crankwork
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of, written_note
from crankwork.page.document import page as written
from crankwork.quantities import Language
from page.slid import EXAMPLES, document

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

USUAL = {"reduced_motion": "reduce", "viewport": {"width": 1300, "height": 900}}


@cache
def of_example(name: str, language: Language = "en") -> bytes:
    """Return the page of an example, or the web page of its note."""
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name.removeprefix('note-')}.toml"))
    if name.startswith("note-"):
        return written_note(note_of(results, NoteOptions(full=True, language=language)), "note.html")
    return written(results, language)


@pytest.fixture(scope="session")
def written_of() -> Callable[..., bytes]:
    """Return the page of an example, or the web page of its note, written once."""
    return of_example


@pytest.fixture(scope="session")
def stored() -> Callable[[bytes], dict[str, Any]]:
    """What is stored in a page."""

    def read(written: bytes) -> dict[str, Any]:
        letters = re.search(rb'id="data">([^<]*)<', written)
        assert letters is not None
        return json.loads(gzip.decompress(base64.b64decode(letters[1])))

    return read


class Watched:
    """Pages of files, of which none may ask for anything else, and no script may fail."""

    def __init__(self, browser: Browser, folder: Path) -> None:
        self.browser, self.folder = browser, folder
        self.pages: dict[str, Page] = {}
        self.asked: list[str] = []
        self.failed: list[str] = []

    def open(self, name: str, text: bytes, **look: object) -> Page:
        """Open a page in a look of its own, or the one that was opened so before, with its cursor at the beginning."""
        mark = f"{name} {look}"
        if mark in self.pages:
            return self._as_at_first(self.pages[mark], **look)
        path = self.folder / f"{len(self.pages)}.html"
        path.write_bytes(text)
        page = self.browser.new_context(**USUAL | look).new_page()
        page.on("request", lambda request: self.asked.append(request.url.rpartition("/")[2]))
        page.on("pageerror", lambda error: self.failed.append(str(error)))
        page.on("console", lambda message: self.failed.append(message.text))
        page.goto(path.as_uri())
        if look.get("java_script_enabled", True):
            page.wait_for_selector("html.live")
        assert self.asked.pop() == path.name
        self.pages[mark] = page
        return page

    def _as_at_first(self, page: Page, **look: object) -> Page:
        page.bring_to_front()
        page.set_viewport_size({**USUAL, **look}["viewport"])
        page.emulate_media(media="screen")
        page.mouse.move(1, 1)
        page.evaluate("document.activeElement.blur(); scrollTo(0, 0); document.getElementById('filed')?.click();")
        page.keyboard.press("Escape")
        page.keyboard.press("Home")
        return page

    def checked(self) -> None:
        """Nothing may have been asked for but pages, and no script may have failed."""
        found = [*self.asked, *self.failed]
        self.asked.clear()
        self.failed.clear()
        assert found == []


@pytest.fixture(scope="session")
def watched(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Generator[Watched]:
    """All pages that are open, one of each look."""
    pages = Watched(browser, tmp_path_factory.mktemp("pages"))
    yield pages
    for page in pages.pages.values():
        page.context.close()


@pytest.fixture
def opened(watched: Watched) -> Generator[Callable[..., Page]]:
    """Open the page of an example."""
    yield lambda name, language="en", **look: watched.open(f"{name}-{language}", of_example(name, language), **look)
    watched.checked()


@pytest.fixture
def slid(watched: Watched) -> Generator[Callable[..., Page]]:
    """Open a page with sliders, where its file has them."""
    yield lambda name, language="en", **look: watched.open(
        f"slid-{name}-{language}", document(name, language).encode(), **look
    )
    watched.checked()

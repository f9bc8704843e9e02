"""Pages of examples in a real browser."""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

import crankwork
from crankwork.note.contents import note_of, written_note
from crankwork.note.options import NoteOptions
from crankwork.page.document import page as written
from crankwork.quantities import Language
from page.slid import document

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="session")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, Language], Path]:
    """The page of an example as a file, or the web page of its note, written once."""
    folder = tmp_path_factory.mktemp("pages")

    def page_of(name: str, language: Language = "en") -> Path:
        path = folder / f"{name}-{language}.html"
        if not path.exists():
            results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name.removeprefix('note-')}.toml"))
            if name.startswith("note-"):
                path.write_bytes(written_note(note_of(results, NoteOptions(language=language)), "note.html"))
            else:
                path.write_bytes(written(results, language))
        return path

    return page_of


@pytest.fixture(scope="session")
def stored() -> Callable[[bytes], dict[str, Any]]:
    """What is stored in a page."""

    def read(written: bytes) -> dict[str, Any]:
        letters = re.search(rb'id="data">([^<]*)<', written)
        assert letters is not None
        return json.loads(gzip.decompress(base64.b64decode(letters[1])))

    return read


@contextmanager
def watched(browser: Browser) -> Generator[Callable[..., Page]]:
    """Open pages of files; at the end nothing else may have been asked for, and no script may have failed."""
    contexts, asked, failed = [], [], []

    def open_file(path: Path, **look: object) -> Page:
        context = browser.new_context(**look)
        contexts.append(context)
        page = context.new_page()
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: failed.append(str(error)))
        page.on("console", lambda message: failed.append(message.text))
        page.goto(path.as_uri())
        if look.get("java_script_enabled", True):
            page.wait_for_selector("html.live")
        return page

    yield open_file
    for context in contexts:
        context.close()
    assert failed == []
    assert all(url.startswith("file:") for url in asked)
    assert len(asked) == len(contexts)


@pytest.fixture
def opened(browser: Browser, pages: Callable[[str, Language], Path]) -> Generator[Callable[..., Page]]:
    """Open the page of an example."""
    with watched(browser) as open_file:
        yield lambda name, language="en", **look: open_file(pages(name, language), **look)


@pytest.fixture
def slid(browser: Browser, tmp_path: Path) -> Generator[Callable[..., Page]]:
    """Open a page with sliders."""
    usual = {"reduced_motion": "reduce", "viewport": {"width": 1300, "height": 900}}

    with watched(browser) as open_file:

        def open_page(name: str, language: Language = "en", change: Callable[[str], str] = str, **look: object) -> Page:
            path = tmp_path / f"{name}-{language}.html"
            path.write_bytes(change(document(name, language)).encode())
            return open_file(path, **(usual | look))

        yield open_page

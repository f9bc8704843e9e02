"""The studio as it is started, and as a browser shows it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import pytest

from crankwork import cli
from studio.hands import settled

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, Page

USUAL = {"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce"}


class Started(NamedTuple):
    """A studio that runs: its address, its token, and what it has complained of."""

    address: str
    token: str
    complaints: Path


@contextmanager
def studio_of(folder: Path, *arguments: str) -> Generator[Started]:
    """Start the studio as the command line does."""
    words = [sys.executable, "-m", "crankwork", "studio", *arguments, "--no-browser"]
    source = str(Path(cli.__file__).parents[2])
    complaints = folder / "complaints.txt"
    with (
        complaints.open("w") as told,
        subprocess.Popen(
            words,
            env=os.environ | {"PYTHONPATH": source, "CRANKWORK_CACHE": str(folder / "cache")},
            stdout=subprocess.PIPE,
            stderr=told,
            text=True,
        ) as running,
    ):
        try:
            found = re.fullmatch(r"(http://[\d.:]+/)\?token=(\S+)\s*", running.stdout.readline())
            assert found is not None, complaints.read_text()
            yield Started(found[1], found[2], complaints)
        finally:
            running.kill()


@pytest.fixture(scope="session")
def start():
    """What starts a studio of its own."""
    return studio_of


@pytest.fixture(scope="session")
def started(tmp_path_factory: pytest.TempPathFactory) -> Generator[Started]:
    """A studio that nothing was given to; nothing may fail in it, whatever it is asked."""
    with studio_of(tmp_path_factory.mktemp("studio")) as one:
        yield one
        assert one.complaints.read_text() == ""


@pytest.fixture(scope="session")
def window(browser: Browser) -> Generator[BrowserContext]:
    """A window of the usual look, in which pages come and go."""
    context = browser.new_context(**USUAL)
    yield context
    context.close()


@pytest.fixture
def seen(browser: Browser, started: Started, window: BrowserContext) -> Generator[Callable[..., Page]]:
    """Open the studio; no script may fail, and nothing may be asked of anybody else."""
    pages, asked, failed = [], [], []

    def open_studio(one: Started = started, language: str = "en", **look: object) -> Page:
        page = (browser.new_context(**USUAL | look) if look else window).new_page()
        pages.append(page)
        page.set_default_timeout(60_000)
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: failed.append(str(error)))
        page.on("console", lambda message: failed.append(message.text))
        page.goto(f"{one.address}?token={one.token}&lang={language}")
        page.wait_for_selector(".figures svg")
        return page

    yield open_studio
    for page in pages:
        (page if page.context == window else page.context).close()
    assert failed == []
    assert [url for url in asked if not url.startswith(("http://127.0.0.1:", "data:", "blob:http://127.0.0.1:"))] == []


@pytest.fixture
def filed(seen: Callable[..., Page], tmp_path: Path) -> Generator[Callable[..., tuple[Page, Path]]]:
    """Start a studio with a file; return the page that shows it, and the file. Nothing may fail in it."""
    with ExitStack() as running:

        def open_file(text: str, name: str = "mine.toml") -> tuple[Page, Path]:
            path = tmp_path / name
            path.write_text(text, encoding="utf-8")
            one = running.enter_context(studio_of(tmp_path, str(path)))
            page = seen(one)
            running.callback(lambda: one.complaints.read_text() and pytest.fail(one.complaints.read_text()))
            running.callback(page.close)
            settled(page)
            return page, path

        yield open_file

"""The studio as it is started, and as a browser shows it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import pytest
from playwright.sync_api import Browser, Page

from crankwork import cli


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


@pytest.fixture
def seen(browser: Browser, started: Started) -> Generator[Callable[..., Page]]:
    """Open the studio; no script may fail, and nothing may be asked of anybody else."""
    contexts, asked, failed = [], [], []

    def open_studio(one: Started = started, language: str = "en", **look: object) -> Page:
        context = browser.new_context(
            **{"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce", **look}
        )
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: failed.append(str(error)))
        page.on("console", lambda message: failed.append(message.text))
        page.goto(f"{one.address}?token={one.token}&lang={language}")
        page.wait_for_selector(".figures svg")
        return page

    yield open_studio
    for context in contexts:
        context.close()
    assert failed == []
    assert [url for url in asked if not url.startswith(("http://127.0.0.1:", "data:", "blob:http://127.0.0.1:"))] == []

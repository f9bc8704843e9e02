"""The documentation site as it is built: no warning, no broken link, and search finds words of all three languages."""

from __future__ import annotations

import json
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

import machines
from crankwork.quantities import QUANTITIES

MAKER = Path(__file__).parents[2] / "docs" / "generate" / "make_site.py"
SEARCHED = ("stroke", "ход", "hành", "trình")
# quantities that no machine of the repository has in its results; may only become fewer
WITHOUT_EXAMPLE = 22
# pages that stand alone; only that they are there is of interest
ALONE = "interactive"


class Page(HTMLParser):
    """Names of the places of a page, and where it leads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.places: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.places.add(value)
            elif (name in ("href", "src") and value) and tag != "base":
                self.links.append(value)


def broken_links(site: Path) -> list[str]:
    """Return the links of all pages that lead nowhere: no such file, or no such place in it."""
    pages = {path: Page(path.read_text("utf-8")) for path in site.rglob("*.html") if ALONE not in path.parts}
    broken = []
    for path, page in pages.items():
        for link in page.links:
            address = urlsplit(link)
            if address.scheme or address.netloc:
                continue
            target = (path.parent / unquote(address.path)).resolve() if address.path else path
            place = unquote(address.fragment)
            if not target.is_file() or (place and target in pages and place not in pages[target].places):
                broken.append(f"{path.relative_to(site)}: {link}")
    return broken


@pytest.mark.slow
def test_few_quantities_have_no_machine_that_shows_them():
    owners = machines.owners({name: machines.keys_of_machine(name) for name in machines.names()})
    assert len(QUANTITIES.keys() - owners.keys()) <= WITHOUT_EXAMPLE


@pytest.mark.slow
def test_the_site_is_built_without_warnings_and_without_broken_links(tmp_path):
    pytest.importorskip("sphinx", reason="needs the extra docs")
    made = subprocess.run(
        [sys.executable, str(MAKER), str(tmp_path)], capture_output=True, text=True, check=False, timeout=1500
    )
    assert made.returncode == 0, made.stdout[-3000:] + made.stderr[-3000:]
    site = (tmp_path / "site").resolve()
    assert broken_links(site) == []
    index = (site / "searchindex.js").read_text("utf-8")
    terms = json.loads(index.removeprefix("Search.setIndex(").rstrip(";)"))["terms"]
    assert [word for word in SEARCHED if word not in terms] == []

"""Takes pictures of pages and of the studio, light and dark, wide and narrow, in three languages, to be looked at."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import crankwork
from campaigns.marked import ROOT
from crankwork.locale import LANGUAGES
from crankwork.page.document import page as written

LOOKS = {
    "wide": {"viewport": {"width": 1440, "height": 900}, "color_scheme": "light"},
    "dark": {"viewport": {"width": 1440, "height": 900}, "color_scheme": "dark"},
    "phone": {"viewport": {"width": 390, "height": 844}, "color_scheme": "light"},
}


def pages(names: list[str], folder: Path) -> Iterator[tuple[str, str]]:
    """Yield what a page of each machine and the studio that shows it are called, and their addresses."""
    from studio.conftest import studio_of

    for name in names:
        path = ROOT / "examples" / f"{name}.toml"
        results = crankwork.analyse(crankwork.read(path))
        for language in LANGUAGES:
            made = folder / f"{name}-{language}.html"
            made.write_bytes(written(results, language))
            yield f"page-{name}-{language}", made.as_uri()
        with studio_of(folder, str(path)) as studio:
            for language in LANGUAGES:
                yield f"studio-{name}-{language}", f"{studio.address}?token={studio.token}&lang={language}"


def main() -> int:
    """Write the pictures."""
    from playwright.sync_api import sync_playwright

    from conftest import BROWSERS

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=3, help="so many examples, the first by name")
    parser.add_argument("-o", "--output", type=Path, default=Path("screenshots"), metavar="FOLDER")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    names = [one.stem for one in sorted((ROOT / "examples").glob("*.toml"))][: arguments.count]
    program = next(path for name in BROWSERS if (path := shutil.which(name)))
    with sync_playwright() as playwright, TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        for name, address in pages(names, Path(folder)):
            for look, options in LOOKS.items():
                context = browser.new_context(reduced_motion="reduce", **options)
                page = context.new_page()
                page.goto(address)
                page.wait_for_selector("svg")
                page.screenshot(path=arguments.output / f"{name}-{look}.png")
                context.close()
        browser.close()
    sys.stdout.write(f"{len(list(arguments.output.glob('*.png')))} pictures in {arguments.output}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

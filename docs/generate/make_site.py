"""Makes the documentation site: `python docs/generate/make_site.py` writes it into the folder `site`.

The pages of `docs/site`, the decision records and the generated pages come together in `build/docs`, which Sphinx
reads. With the name of a folder, both are written into that folder.
"""

from __future__ import annotations

import concurrent.futures
import os
import re
import shutil
import sys
import time
from collections.abc import Iterable
from pathlib import Path

from sphinx.cmd.build import build_main

import api_pages
import command_pages
import example_pages
import filled_pages
import key_pages
import machines
import quantity_pages
import validation_pages
from crankwork.locale import LANGUAGES

ROOT = Path(__file__).parents[2]
_FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else None
SOURCE, SITE = (_FOLDER / "docs", _FOLDER / "site") if _FOLDER else (ROOT / "build" / "docs", ROOT / "site")
_STARTED = time.monotonic()
_LINK = re.compile(r"\]\(\.\./\.\./(?P<path>[^)]+)\)")
# what a page of the site says of a place in the repository
_PLACES = {"examples": "gallery/index.md", "tests/literature": "validation/index.md",
           "src/crankwork/quantities": "reference/en/results/index.md"}  # fmt: skip
_NAMES = {"en": "English", "ru": "По-русски", "vi": "Tiếng Việt"}


def say(what: str) -> None:
    """Tell what has been done."""
    sys.stdout.write(f"{time.monotonic() - _STARTED:5.0f} s  {what}\n")
    sys.stdout.flush()


def _write(folder: Path, pages: Iterable[tuple[str, str]]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, written in pages:
        (folder / f"{name}.md").write_text(written, encoding="utf-8")


def _machines() -> dict[str, dict[str, str]]:
    """Write the gallery, return a key of each quantity by the machine whose results have it."""
    gallery, interactive = SOURCE / "gallery", SOURCE / "interactive"
    gallery.mkdir()
    interactive.mkdir()
    examples = [name for name in machines.names() if re.fullmatch(r"examples/.*\.toml", name)]
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as processes:
        written = {name: processes.submit(example_pages.write, name, gallery, interactive) for name in examples}
        others = {name: processes.submit(machines.keys_of_machine, name) for name in machines.names()
                  if name not in written}  # fmt: skip
        titles = {Path(name).stem: done.result()[0] for name, done in written.items()}
        keys = {name: done.result()[1] for name, done in written.items()}
        keys |= {name: done.result() for name, done in others.items()}
    _write(gallery, [("index", example_pages.index(titles))])
    return keys


def _references(keys: dict[str, dict[str, str]]) -> None:
    owners = machines.owners(keys)
    for language in LANGUAGES:
        folder = SOURCE / "reference" / language
        _write(folder / "keys", key_pages.pages(language))
        _write(folder / "results", quantity_pages.pages(language, owners))
        _write(
            folder,
            [("commands", command_pages.page(language)), ("nomenclature", quantity_pages.nomenclature(language))],
        )
        toctree = "```{toctree}\n:maxdepth: 1\n\nkeys/index\nresults/index\ncommands\nnomenclature\n```\n"
        _write(folder, [("index", f"# {_NAMES[language]}\n\n{toctree}")])
    _write(SOURCE / "reference", [("api", api_pages.page())])
    shutil.copy(ROOT / "docs" / "terms.md", SOURCE / "reference")


def _decisions() -> None:
    folder = SOURCE / "decisions"
    shutil.copytree(ROOT / "docs" / "decisions", folder)
    names = "\n".join(sorted(path.stem for path in folder.glob("*.md")))
    toctree = f"```{{toctree}}\n:maxdepth: 1\n\n{names}\n```\n"
    _write(folder, [("index", f"# Decisions\n\nWhy things are as they are.\n\n{toctree}")])


def _guide() -> None:
    """Bring the guide, to which the README leads: links to files of the repository lead to pages of the site."""
    folder = SOURCE / "guide"
    folder.mkdir()
    for path in sorted((ROOT / "docs" / "guide").glob("*.md")):
        _write(folder, [(path.stem, _LINK.sub(_place_in_site, path.read_text(encoding="utf-8")))])
    shutil.copy(ROOT / "README.md", SOURCE)


def _place_in_site(match: re.Match[str]) -> str:
    path = match["path"]
    folder, _, name = path.rpartition("/")
    example = name.removesuffix(".toml") if folder == "examples" and name.endswith(".toml") else ""
    return f"](../{_PLACES.get(path) or (f'gallery/{example}.md' if example else path)})"


def _fill(path: Path) -> None:
    written = path.read_text(encoding="utf-8")
    if filled_pages.is_filled(written):
        path.write_text(filled_pages.filled(path, written), encoding="utf-8")


def main() -> int:
    """Make the site, return the exit status."""
    for folder in (SOURCE, SOURCE.with_name("doctrees"), SITE):
        shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs" / "site", SOURCE)
    shutil.copytree(ROOT / "examples", SOURCE / "examples")
    comparisons = SOURCE / "comparisons.json"
    tests = validation_pages.start(comparisons)
    try:
        keys = _machines()
        say("machines")
        _references(keys)
        _decisions()
        say("references")
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
            list(threads.map(_fill, sorted(SOURCE.rglob("*.md"))))
        _guide()
        say("commands of pages")
        notes = validation_pages.finish(tests, comparisons)
    finally:
        tests.kill()
    comparisons.unlink()
    _write(SOURCE / "validation", validation_pages.pages(notes))
    index = SOURCE / "index.md"
    index.write_text(index.read_text(encoding="utf-8").replace("VALIDATION", validation_pages.short(notes)), "utf-8")
    say("validation")
    status: int = build_main(
        [
            "-q",
            "-W",
            "--keep-going",
            "-j",
            "auto",
            "-b",
            "html",
            "-d",
            str(SOURCE.with_name("doctrees")),
            str(SOURCE),
            str(SITE),
        ]
    )
    shutil.copytree(SOURCE / "interactive", SITE / "interactive")
    shutil.copytree(ROOT / "docs" / "images", SITE / "images")
    say(f"site: {SITE / 'index.html'}")
    return status


if __name__ == "__main__":
    sys.exit(main())

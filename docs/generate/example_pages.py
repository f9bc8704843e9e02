"""The gallery: every example with its figure, its file, its main numbers and its interactive page."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import crankwork
from crankwork.page.document import page as interactive_page
from crankwork.report.figures import figure_names
from html_text import raw, text
from machines import ROOT, analysed, keys_of

_LINES = 14
# the figure that shows most of an example, the first that it has
_FIGURES = ("torque", "piston_forces", "indicator", "slider_motion", "torsion", "speed", "turning_moment")


def _figure(results: crankwork.Results) -> str:
    names = figure_names(results, "en")
    return next((name for name in _FIGURES if name in names), names[0] if names else "")


def _comment(path: Path) -> str:
    """Return the first paragraph of the comment that a file begins with."""
    lines = path.read_text(encoding="utf-8").splitlines()
    head = lines[: next(at for at, one in enumerate(lines) if not one.startswith("#"))]
    return "\n".join(line[1:].strip() for line in head).partition("\n\n")[0].replace("\n", " ")


def write(name: str, folder: Path, pages: Path) -> tuple[str, dict[str, str]]:
    """Write the page of an example into a folder and its interactive page into another; return its title and keys."""
    path, results = ROOT / name, analysed(name)
    (pages / f"{path.stem}.html").write_bytes(interactive_page(results, "en"))
    picture = ""
    if figure := _figure(results):
        (folder / f"{path.stem}.svg").write_text(results.figure(figure).styled("colour").svg, encoding="utf-8")
        picture = f"![{figure.replace('_', ' ')} of the example]({path.stem}.svg)"
    (folder / f"{path.stem}.md").write_text(_page(path, results, picture), encoding="utf-8")
    return results.machine.title or path.stem, keys_of(results)


def _page(path: Path, results: crankwork.Results, picture: str) -> str:
    summary = "\n".join(crankwork.summary_text(results).splitlines()[:_LINES])
    link = f'<p><a href="../interactive/{path.stem}.html">The interactive page of {text(path.name)}</a></p>'
    return (
        f"# {results.machine.title or path.stem}\n\n{_comment(path)}\n\n{picture}\n\n"
        f"{raw([link])}\n"
        f"## Main numbers\n\n```text\n{summary}\n```\n\n"
        f"## The file\n\n```{{literalinclude}} ../examples/{path.name}\n:language: toml\n```\n"
    )


def index(titles: Mapping[str, str]) -> str:
    """Return the page that lists the examples by the names of their files."""
    cards = [
        f'<a class="card" href="{name}.html"><img src="../_images/{name}.svg" alt=""><span>{text(title)}</span></a>'
        for name, title in titles.items()
    ]
    names = "\n".join(titles)
    shown = raw(['<div class="cards">', *cards, "</div>"])
    return (
        "# Gallery\n\nEvery example of the repository: one figure, the file, its main numbers, and the page that "
        f"`crankwork page` makes of it.\n\n{shown}\n"
        f"```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    )

"""Pieces of HTML that the generated pages share."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Sequence

_CODE = re.compile(r"`([^`]+)`")


def text(words: object) -> str:
    """Return words as HTML; what stands between backticks is code."""
    return _CODE.sub(r"<code>\1</code>", html.escape(str(words), quote=False))


def code(words: object) -> str:
    """Return words as code."""
    return f"<code>{html.escape(str(words), quote=False)}</code>"


def sentence(words: str) -> str:
    """Return a phrase of the program as a sentence."""
    words = words.strip()
    return f"{words[:1].upper()}{words[1:]}{'' if words.endswith(('.', '!', '?')) else '.'}" if words else ""


def raw(lines: Iterable[str]) -> str:
    """Return HTML as a block of a Markdown page."""
    return "```{raw} html\n" + "\n".join(line for line in lines if line.strip()) + "\n```\n"


def entry(identity: str, name: str, said: str, facts: Sequence[tuple[str, str]], tag: str = "") -> str:
    """Return an entry of a reference: its name, a sentence, and facts as pairs of HTML; empty facts are left out."""
    rows = "".join(f"<div><dt>{text(title)}</dt><dd>{fact}</dd></div>" for title, fact in facts if fact)
    mark = f' <span class="entry-tag">{text(tag)}</span>' if tag else ""
    return (
        f'<div class="entry" id="{html.escape(identity)}"><p class="entry-name">'
        f'<a href="#{html.escape(identity)}">{code(name)}</a>{mark}</p>'
        f'<p class="entry-said">{said}</p><dl class="entry-facts">{rows}</dl></div>'
    )


def table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; cells are HTML. On a narrow screen each cell is headed by the title of its column."""
    head = "".join(f"<th>{text(heading)}</th>" for heading in headings)
    body = "".join(
        "<tr>"
        + "".join(
            f'<td data-title="{html.escape(title)}">{cell}</td>' for title, cell in zip(headings, row, strict=True)
        )
        + "</tr>\n"
        for row in rows
    )
    inside = f"<thead><tr>{head}</tr></thead><tbody>\n{body}</tbody>"
    return f'<div class="wide-table"><table class="rows">{inside}</table></div>'

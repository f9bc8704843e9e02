"""Bars on the error stream, once something has taken more than a second."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import click


@contextlib.contextmanager
def bar() -> Iterator[Callable[[float], None]]:
    """Give a function that is told the part that is done, and shows it once a second has passed."""
    started = time.monotonic()
    shown: Any = None  # click does not say what its bars are

    def told(share: float) -> None:
        nonlocal shown
        if shown is None and time.monotonic() - started > 1 and sys.stderr.isatty():
            shown = click.progressbar(length=1000, file=sys.stderr)
        if shown is not None:
            shown.update(max(round(1000 * share) - shown.pos, 0))

    try:
        yield told
    finally:
        if shown is not None:
            click.echo(err=True)


def with_progress(steps: Iterable[dict[str, bytes]], count: int) -> dict[str, bytes]:
    """Gather the files of a folder, with a bar on the error stream once a second has passed."""
    contents: dict[str, bytes] = {}
    with bar() as told:
        for done, files in enumerate(steps, start=1):
            contents |= files
            told(done / count)
    return contents


@contextlib.contextmanager
def counting(total: int) -> Iterator[Callable[[int], None]]:
    """Give a function that is told how many are done, and shows the rate and the time left."""
    first: tuple[int, float] | None = None
    with click.progressbar(length=total, file=sys.stderr, width=24, show_pos=True) as shown:

        def told(count: int) -> None:
            nonlocal first
            # what an earlier run has done goes by at once, and says nothing about the rate
            first = first if first is not None else (count, time.monotonic())
            passed = time.monotonic() - first[1]
            if passed > 1 and sys.stderr.isatty():
                shown.label = f"{(count - first[0]) / passed:,.0f}/s".replace(",", " ")
                shown.update(count - shown.pos)

        yield told

"""Progress bars on the error stream, shown after one second."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import click


@contextlib.contextmanager
def progress_bar() -> Iterator[Callable[[float], None]]:
    """Yield a function that takes the finished fraction, and shows it once a second has passed."""
    started = time.monotonic()
    shown: Any = None  # click does not type its bars

    def show(share: float) -> None:
        nonlocal shown
        if shown is None and time.monotonic() - started > 1 and sys.stderr.isatty():
            shown = click.progressbar(length=1000, file=sys.stderr)
        if shown is not None:
            shown.update(max(round(1000 * share) - shown.pos, 0))

    try:
        yield show
    finally:
        if shown is not None:
            click.echo(err=True)


def with_progress(steps: Iterable[dict[str, bytes]], count: int) -> dict[str, bytes]:
    """Collect the files of a folder, with a progress bar."""
    contents: dict[str, bytes] = {}
    with progress_bar() as progress:
        for done, files in enumerate(steps, start=1):
            contents |= files
            progress(done / count)
    return contents


@contextlib.contextmanager
def counting(total: int) -> Iterator[Callable[[int], None]]:
    """Yield a function that takes the finished number, and shows the rate and the time left."""
    first: tuple[int, float] | None = None
    with click.progressbar(length=total, file=sys.stderr, width=24, show_pos=True) as shown:

        def show(count: int) -> None:
            nonlocal first
            # exclude results of an earlier run from the rate
            first = first if first is not None else (count, time.monotonic())
            passed = time.monotonic() - first[1]
            if passed > 1 and sys.stderr.isatty():
                shown.label = f"{(count - first[0]) / passed:,.0f}/s".replace(",", " ")
                shown.update(count - shown.pos)

        yield show

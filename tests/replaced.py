"""Formulas of the package replaced for a while."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from crankwork.formula.expression import Formula


@contextmanager
def replaced_formula(entry: Formula, function: Callable[..., Any]) -> Iterator[None]:
    """Let another function be a formula for a while, wherever it is called, traced or replayed.

    `function`: what is called in its place, with the same arguments.
    """
    own = entry.function
    object.__setattr__(entry, "function", functools.wraps(own)(function))
    try:
        yield
    finally:
        object.__setattr__(entry, "function", own)

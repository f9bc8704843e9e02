"""What an argument of a formula stands for."""

from __future__ import annotations

from typing import NamedTuple


class Argument(NamedTuple):
    """The quantity behind an argument of a formula; `pattern` places its symbol, `cos {}`.

    `extra` is a second quantity where the pattern takes two; without a quantity the pattern is the symbol itself.
    `meaning` says in the three languages, `en | ru | vi`, what a symbol is that no quantity explains.
    """

    quantity: str
    pattern: str = "{}"
    extra: str = ""
    meaning: str = ""

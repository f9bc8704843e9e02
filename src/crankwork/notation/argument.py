"""What an argument of a formula stands for."""

from __future__ import annotations

from typing import NamedTuple


class Argument(NamedTuple):
    """The quantity behind an argument of a formula; `pattern` places its symbol, `cos {}`.

    `extra` is a second quantity where the pattern takes two; without a quantity the pattern is the symbol itself.
    What a symbol is that no quantity explains is a text, `arguments.NAME`. `unit` is stated
    where the formulas take it in another unit than the SI unit of the quantity, or no quantity tells.
    """

    quantity: str
    pattern: str = "{}"
    extra: str = ""
    unit: str = ""

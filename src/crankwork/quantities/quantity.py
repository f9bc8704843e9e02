"""What a row of the table of quantities holds."""

from __future__ import annotations

from typing import Literal, NamedTuple

Language = Literal["en", "ru", "vi"]
LANGUAGES: tuple[Language, ...] = ("en", "ru", "vi")


class Quantity(NamedTuple):
    """One row of the table. `per_area_unit` is set where the quantity may be given per piston area."""

    key: str
    unit: str
    symbols: tuple[str, str, str]
    labels: tuple[str, str, str]
    definition: str
    per_area_unit: str = ""

    def symbol(self, language: Language = "en") -> str:
        """Return the symbol used in books of that language."""
        return self.symbols[LANGUAGES.index(language)]

    def label(self, language: Language = "en") -> str:
        """Return the name of the quantity in that language."""
        return self.labels[LANGUAGES.index(language)]


def row(key: str, unit: str, symbols: str, labels: str, definition: str, per_area_unit: str = "") -> Quantity:
    """Return a row: symbols `EN|RU|VI`, labels `en | ru | vi`; symbols that are the same are not repeated."""
    en, *others = symbols.split("|")
    ru, vi = [*others, en, en][:2] if len(others) != 1 else (others[0], en)
    one, two, three = labels.split(" | ")
    return Quantity(key, unit, (en, ru, vi), (one, two, three), definition, per_area_unit)

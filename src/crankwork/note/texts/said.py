"""One thing said in each language."""

from __future__ import annotations

from typing import NamedTuple


class Said(NamedTuple):
    """Words in English, Russian and Vietnamese, in the order of `quantities.LANGUAGES`."""

    en: str
    ru: str
    vi: str

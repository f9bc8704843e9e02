"""The fixed words around the blocks of a note in each language."""

from __future__ import annotations

import datetime as dt
import re

from crankwork.quantities import LANGUAGES, Language

_WORDS = {
    "figure": ("Figure {}. {}", "Рисунок {} – {}", "Hình {}. {}"),
    "table": ("Table {}. {}", "Таблица {} – {}", "Bảng {}. {}"),
    "contents": ("Contents", "Содержание", "Mục lục"),
    "where": ("where", "где", "trong đó"),
}
_PLACES = {
    "ch.": ("ch.", "гл.", "chương"),
    "sec.": ("sec.", "разд.", "mục"),
    "p.": ("p.", "с.", "tr."),
    "pp.": ("pp.", "с.", "tr."),
    "eq.": ("eq.", "ф-ла", "công thức"),
    "fig.": ("fig.", "рис.", "hình"),
    "table": ("table", "табл.", "bảng"),
    "vol.": ("vol.", "т.", "tập"),
    "ex.": ("ex.", "прим.", "ví dụ"),
    "example": ("example", "пример", "ví dụ"),
}
_PLACE = re.compile(r"(?<!\w)(?:ch\.|vol\.|sec\.|pp\.|p\.|eq\.|fig\.|table|ex\.|example)(?!\w)")
_REMARK = re.compile(r"\s*\([^)]*\)")
LANGUAGE_TAGS: dict[Language, str] = {"en": "en-GB", "ru": "ru-RU", "vi": "vi-VN"}


def fixed_word(key: str, language: Language) -> str:
    """Return a word or pattern: `figure`, `table`, `contents`, `where`."""
    return _WORDS[key][LANGUAGES.index(language)]


def caption(kind: str, number: str, text: str, language: Language) -> str:
    """Return the line under a `figure` or over a `table`."""
    return fixed_word(kind, language).format(number, text)


def place_in_source(place: str, language: Language) -> str:
    """Return chapter, page or equation of a source as that language abbreviates it.

    Examples
    --------
    >>> place_in_source("ch. 6", "ru")
    'гл. 6'
    """
    # a remark in parentheses is in English
    place = place if language == "en" else _REMARK.sub("", place)
    return _PLACE.sub(lambda found: _PLACES[found[0]][LANGUAGES.index(language)], place)


def printed_date(date: dt.date, language: Language) -> str:
    """Return a date in figures, as that language orders them."""
    return {"en": f"{date:%Y-%m-%d}", "ru": f"{date:%d.%m.%Y}", "vi": f"{date:%d/%m/%Y}"}[language]

"""The bibliography: what a key in a formula or a docstring stands for."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from crankwork.resources import read_resource

_ENTRY = re.compile(r"^@(?P<kind>\w+)\{(?P<key>\w+),$(?P<body>.*?)^\}$", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^  (?P<name>\w+) = \{(?P<value>.*)\},$", re.MULTILINE)
_CYRILLIC, _VIETNAMESE = re.compile("[а-яё]"), re.compile("[ăđơưạ-ỹ]")

# the same matter in the books of the reader's school: by language, for a quantity or for all that is taken from a place
_MOTION, _WORK = ("piston_velocity", "piston_acceleration"), ("work_per_cycle", "energy_fluctuation")
_BALANCE = ("order_inertia_force", "free_force", "counterweight_moment")
_SCHOOLS: Mapping[str, Mapping[str, str]] = MappingProxyType({
    "en": {
        # its translation has the same chapters
        **{f"kolchin_demidov_2008, ch. {chapter}": f"kolchin_demidov_1984, ch. {chapter}" for chapter in range(1, 10)},
        "kolchin_demidov_2008, ch. 5": "heywood_1988, ch. 2",
        "kolchin_demidov_2008, ch. 6": "norton_2012, ch. 13",
        "kolchin_demidov_2008, ch. 7": "norton_2012, ch. 13",
        "lukanin_shatrov_2007, ch. 1": "norton_2012, ch. 13",
        **{f"artobolevsky_1988, ch. {chapter}": f"norton_2012, ch. {own}"
           for chapter, own in ((2, 2), (4, 4), (12, 10), (13, 11), (15, 10))},
        **dict.fromkeys(_MOTION, "norton_2012, ch. 13"),
        **dict.fromkeys(("whole_inertia", "flywheel_inertia", "wittenbauer_slope"), "norton_2012, ch. 11"),
    },
    "ru": {
        "den_hartog_1956, ch. 5": "den_hartog_1960, ch. 5",
        **dict.fromkeys(_MOTION, "kolchin_demidov_2008, ch. 6"),
        **dict.fromkeys(_BALANCE, "kolchin_demidov_2008, ch. 8"),
        **dict.fromkeys(_WORK, "artobolevsky_1988, ch. 16"),
    },
    "vi": {
        "kolchin_demidov_2008, ch. 3": "nguyen_tat_tien_2000",
        "kolchin_demidov_2008, ch. 4": "nguyen_tat_tien_2000",
        "lukanin_shatrov_2007, ch. 1": "kolchin_demidov_2008, ch. 7",
        **dict.fromkeys(_MOTION, "kolchin_demidov_2008, ch. 6"),
        **dict.fromkeys(_BALANCE, "kolchin_demidov_2008, ch. 8"),
        **dict.fromkeys(_WORK, "artobolevsky_1988, ch. 16"),
    },
})  # fmt: skip


class Source(NamedTuple):
    """One entry of the bibliography, as text; a field that the entry lacks is empty."""

    key: str
    kind: str
    title: str
    year: str
    author: str = ""
    editor: str = ""
    edition: str = ""
    publisher: str = ""
    address: str = ""
    journal: str = ""
    volume: str = ""
    number: str = ""
    pages: str = ""
    doi: str = ""


@functools.cache
def sources() -> MappingProxyType[str, Source]:
    """Return the bibliography by key."""
    entries = {}
    for entry in _ENTRY.finditer(read_resource("sources.bib")):
        fields = {field["name"]: field["value"] for field in _FIELD.finditer(entry["body"])}
        entries[entry["key"]] = Source(entry["key"], entry["kind"], **fields)
    return MappingProxyType(entries)


def cite(reference: str) -> str:
    """Return the line of a list of references.

    `reference`: key of the bibliography, with chapter, page or equation after a comma if wanted.

    Examples
    --------
    >>> cite("khurmi_gupta_2005, ch. 15")
    'Khurmi R. S., Gupta J. K. Theory of Machines. 14th ed. New Delhi: S. Chand, 2005, ch. 15.'
    """
    key, comma, place = reference.partition(",")
    source = sources()[key]
    parts = (_names(source.author or source.editor), source.title, source.edition, _publication(source))
    sentences = " ".join(part if part.endswith(".") else part + "." for part in parts if part)
    return f"{sentences.removesuffix('.')}{comma}{place}".removesuffix(".") + "."


def school_source(reference: str, language: str, quantity: str = "") -> str:
    """Return a reference, or that to the same matter in a book of the school of a language.

    Examples
    --------
    >>> school_source("kolchin_demidov_2008, ch. 5", "en"), school_source("kolchin_demidov_2008, ch. 5", "ru")
    ('heywood_1988, ch. 2', 'kolchin_demidov_2008, ch. 5')
    """
    books = _SCHOOLS.get(language, {})
    return books.get(quantity) or books.get(reference, reference) if reference else ""


def source_language(key: str) -> str:
    """Return the language of a source by the letters of its title: `ru`, `vi`, or `en` for all others.

    Examples
    --------
    >>> source_language("kolchin_demidov_2008"), source_language("norton_2012")
    ('ru', 'en')
    """
    title = sources()[key].title.lower()
    if _CYRILLIC.search(title):
        return "ru"
    return "vi" if _VIETNAMESE.search(title) else "en"


def _names(people: str) -> str:
    return ", ".join(person.replace(", ", " ") for person in people.split(" and "))


def _publication(source: Source) -> str:
    """Return where and when it appeared."""
    if source.journal:
        return f"{source.journal} {source.volume}({source.number}), {source.pages}, {source.year}"
    return f"{source.address}: {source.publisher}, {source.year}"

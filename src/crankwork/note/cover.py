"""What stands on the cover of a note, in the words of its language."""

from __future__ import annotations

import datetime as dt

from crankwork.locale import Language, say
from crankwork.machine import Document
from crankwork.note.captions import printed_date
from crankwork.note.document import Person, TitlePage

# who stands on a cover, in the order of each language, and who signs beside the name
_PEOPLE: dict[Language, tuple[str, ...]] = {
    "en": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "ru": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "vi": ("supervisor", "author", "student_number", "group", "checked_by", "standards_by", "approved_by"),
}
_SIGN = ("author", "supervisor", "checked_by", "standards_by", "approved_by")


def cover(document: Document, language: Language, subtitle: str) -> TitlePage:
    """Return the cover; `subtitle` names the kind of note where the document does not."""
    named = {key: say(f"note.cover_{key}", language, name=getattr(document, key)) for key in ("subject", "variant")}
    institution = (document.ministry, document.institution, document.faculty, document.department)
    above = (document.work, named["subject"] if document.subject else "")
    below = (document.subtitle or subtitle, document.designation, named["variant"] if document.variant else "")
    when = _when(document.date, document.year, language)
    return TitlePage(
        institution=tuple(filter(None, institution)),
        above=tuple(filter(None, above)),
        below=tuple(filter(None, below)),
        people=tuple(person for key in _PEOPLE[language] if (person := _person(document, key, language)).names),
        place=say("note.cover_place", language, city=document.city, when=when) if document.city else when,
    )


def _person(document: Document, key: str, language: Language) -> Person:
    value = getattr(document, key)
    # a name left open in the file gets no line
    names = tuple(name for name in ((value,) if isinstance(value, str) else value) if name.strip())
    label = say(f"note.cover_{'several_' if len(names) > 1 else ''}{key}", language)
    return Person(label, names, signs=language == "ru" and key in _SIGN)


def _when(date: dt.date | None, year: int, language: Language) -> str:
    """Return when a note was made as covers say it: the year alone, where reports in English give the day."""
    if date is not None:
        return printed_date(date, language) if language == "en" else str(date.year)
    return str(year) if year else ""

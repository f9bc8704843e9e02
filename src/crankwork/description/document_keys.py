"""The keys of `[document]`: title data of a note and its sheets, and the sections of the note."""

from __future__ import annotations

import datetime as dt
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from crankwork.description.schema import KeySpec, MapOf, OneOrMore, TableSpec, nearest_name
from crankwork.description.value_types import Number, Reader, Text, shown
from crankwork.locale import ErrorMessage, Language
from crankwork.machine import Document
from crankwork.quantities import QUANTITIES

# sections of notes in the order that most schools have
_ENGINE = (
    "summary", "preface", "data", "method", "cycle", "indicator", "kinematics", "displacement", "velocity",
    "acceleration", "dynamics", "inertia", "piston_forces", "crank_forces", "torque", "crankpin", "polar", "unrolled",
    "big_end", "wear", "mains", "balance", "evenness", "motor", "comparison", "checks", "conclusion", "nomenclature",
    "sources", "appendix",
)  # fmt: skip
_LINKAGE = (
    "summary", "task", "structure", "kinematics", "quality", "chambers", "forces", "balance", "reduction", "torques",
    "friction", "bearings", "harmonics", "motor", "flywheel", "law_of_motion", "transient", "comparison", "checks",
    "conclusion", "nomenclature", "sources", "appendix",
)  # fmt: skip
_TRANSFER = (
    "summary", "task", "static", "dynamic", "driving", "comparison", "checks", "conclusion", "nomenclature", "sources",
)  # fmt: skip
_TURNING = (
    "summary", "task", "moments", "energy", "motor", "flywheel", "law_of_motion", "comparison", "checks",
    "conclusion", "nomenclature", "sources",
)  # fmt: skip
_WORDS = Text(300)
_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")
_HEAD = (
    "title_en", "title_ru", "title_vi",
    "ministry", "institution", "faculty", "department", "work", "subject", "subtitle", "variant", "designation",
)  # fmt: skip
_PEOPLE = ("group", "supervisor", "checked_by", "standards_by", "approved_by", "city", "scale")


class Date(NamedTuple):
    """A day: a date of TOML, or the same as text."""

    def read(self, value: object, key: str, reader: Reader) -> dt.date | None:
        """Return the day."""
        if isinstance(value, dt.date) and not isinstance(value, dt.datetime):
            return value
        try:
            return dt.date.fromisoformat(value if isinstance(value, str) and len(value) == len("2026-05-31") else "")
        except ValueError:
            reader.add_error(key, ErrorMessage("no_day", value=shown(value)))
            return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a day."""
        return {"type": "string", "format": "date", "examples": ["2026-05-31"]}


class Section(NamedTuple):
    """The name of a section of a note."""

    options: tuple[str, ...]

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the name."""
        if isinstance(value, str) and value in self.options:
            return value
        nearest = nearest_name(value, self.options) if isinstance(value, str) else ""
        known = nearest or ", ".join(self.options)
        reader.add_error(
            key, ErrorMessage("no_section_near" if nearest else "no_section", value=shown(value), known=known)
        )
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of an enumeration."""
        return {"enum": list(self.options)}


class FigureName(NamedTuple):
    """The name of a figure, which its file has; which there are depends on results."""

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the name."""
        if isinstance(value, str) and _NAME.fullmatch(value):
            return value
        reader.add_error(key, ErrorMessage("figure_name", value=shown(value)))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a name."""
        return {"type": "string", "pattern": f"^{_NAME.pattern}$"}


class ColumnKey(NamedTuple):
    """The key of a column: a quantity, and after a dot what it is of."""

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the key."""
        kind = value.partition(".")[0] if isinstance(value, str) else ""
        if isinstance(value, str) and kind in QUANTITIES:
            return value
        known = nearest_name(kind, QUANTITIES) or "piston_force"
        reader.add_error(key, ErrorMessage("no_quantity_of_name", value=shown(value), known=known))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a key."""
        return {"type": "string", "minLength": 1}


class Figures(NamedTuple):
    """A table of figures: keys of the columns that each shows, by its name."""

    def read(self, value: object, key: str, reader: Reader) -> dict[str, tuple[str, ...]] | None:
        """Return the keys by name."""
        for name in value if isinstance(value, dict) else ():
            FigureName().read(name, f"{key}.{name}", reader)
        return MapOf(_CURVES, most=40).read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of the table."""
        return MapOf(_CURVES, most=40).schema(language) | {"propertyNames": FigureName().schema(language)}


_CURVES = OneOrMore(ColumnKey(), most=12)


def document_key(sections: tuple[str, ...]) -> KeySpec:
    """Return the key of the table for machines whose notes have these sections."""
    return KeySpec(
        TableSpec("document", {
            **dict.fromkeys(_HEAD, KeySpec(_WORDS)),
            **dict.fromkeys(("author", "student_number"), KeySpec(OneOrMore(_WORDS, most=12))),
            **dict.fromkeys(_PEOPLE, KeySpec(_WORDS)),
            "year": KeySpec(Number(1900, 2200, whole=True), instead_of=("date",)),
            "date": KeySpec(Date(), instead_of=("year",)),
            "sections": KeySpec(OneOrMore(Section(sections), most=40)),
            "sheets": KeySpec(OneOrMore(FigureName(), most=40)),
            "figures": KeySpec(Figures()),
        })
    )  # fmt: skip


ENGINE, LINKAGE = document_key(_ENGINE), document_key(_LINKAGE)
TRANSFER, TURNING = document_key(_TRANSFER), document_key(_TURNING)


def stated_document(values: Mapping[str, Any]) -> Document:
    """Return the values of the table, text without surrounding blanks."""
    stated: Mapping[str, Any] = values.get("document") or {}
    texts: dict[str, Any] = {key: value.strip() if isinstance(value, str) else value for key, value in stated.items()}
    return Document(**texts | {"year": int(texts.get("year", 0))})

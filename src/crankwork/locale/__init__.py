r"""All texts that crankwork prints, in `locale/LANGUAGE/ROOM.toml`; the key of a text is `room.name`.

A file is read when its first text is needed. It is TOML with each text on one line, `name = "text"`, a quotation mark
as \", and read by a regular expression, which is 30 times faster than tomllib.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Literal, NamedTuple, Self

from crankwork.resources import read_resource

Language = Literal["en", "ru", "vi"]
LANGUAGES: tuple[Language, ...] = ("en", "ru", "vi")
_LINE = re.compile(r'^"?([^"#=\s]+)"? = "(.*)"$', re.MULTILINE)


@functools.cache
def texts(room: str, language: Language) -> MappingProxyType[str, str]:
    """Return all texts of a file by name."""
    if language not in LANGUAGES:
        raise ValueError(ErrorMessage("option_choice", option="language", given=str(language)[:40], choices=LANGUAGES))
    written = read_resource("locale", language, f"{room}.toml")
    room_texts = dict(_LINE.findall(written))
    if "\\" in written:
        room_texts = {name: words.replace('\\"', '"') for name, words in room_texts.items()}
    return MappingProxyType(room_texts)


def translate(key: str, language: Language, **values: object) -> str:
    """Return a text with values inserted at its braces; without values the text is not formatted.

    Examples
    --------
    >>> translate("units.mm", "ru")
    'мм'
    """
    room, _, name = key.partition(".")
    text = texts(room, language)[name]
    return text.format(**values) if values else text


def decimal(text: str, language: Language) -> str:
    """Return a number as text with the decimal mark of a language.

    Examples
    --------
    >>> decimal("0.25", "ru")
    '0,25'
    """
    return text if language == "en" else text.replace(".", ",")


def has_text(key: str) -> bool:
    """Return whether a key has a text."""
    room, _, name = key.partition(".")
    return name in texts(room, "en")


def capital(words: str) -> str:
    """Return words with a capital first letter, for headings and titles of columns.

    Examples
    --------
    >>> capital("ход поршня")
    'Ход поршня'
    """
    return words[:1].upper() + words[1:]


class ErrorMessage(str):
    """An error message in English that keeps its key and values, so that `told` can translate it.

    The name is that of a text in the file `refusals`, or `room.name`. Entries of a tuple are joined by "or", those of a
    list by "and". A number is formatted as in the text, `{heat:.4g}`, by default with up to six digits, and with the
    decimal mark of the language; user input and advice are passed as text.

    Examples
    --------
    >>> str(ErrorMessage("same", others=["a", "b"]))
    'says the same as a and b; keep one of them'
    """

    __slots__ = ("name", "values")
    name: str
    values: Mapping[str, object]

    def __new__(cls, name: str, /, **values: object) -> Self:
        """Return the sentence."""
        self = super().__new__(cls, _filled(name, values, "en"))
        self.name, self.values = name, values
        return self

    def __reduce__(self) -> tuple[object, tuple[()]]:
        return functools.partial(ErrorMessage, self.name, **self.values), ()

    def cleaned(self, clean: Callable[[str], str]) -> ErrorMessage:
        """Return the message with a function applied to every text inserted in it."""
        return ErrorMessage(self.name, **{name: _each(value, clean) for name, value in self.values.items()})


def in_language(message: str, language: Language) -> str:
    """Return an error message in a language; other text is unchanged.

    Examples
    --------
    >>> in_language(ErrorMessage("same", others=["a", "b"]), "ru")
    'задаёт то же, что a и b; оставьте что-то одно'
    """
    return _filled(message.name, message.values, language) if isinstance(message, ErrorMessage) else message


def _filled(name: str, values: Mapping[str, object], language: Language) -> str:
    known = texts("refusals", language)

    def joined(value: object) -> str | _Printed:
        match value:
            case tuple() | list():
                word = known["or" if isinstance(value, tuple) else "and"]
                *leading, last = [format(joined(item)) for item in value] or [""]
                return f"{', '.join(leading)} {word} {last}" if leading else last
            case float():
                return _Printed(value, language)
            case str():
                return in_language(value, language)
            case _:
                return str(value)

    room, _, own = name.rpartition(".")
    words = texts(room, language)[own] if room else known[name]
    return words.format(**{key: joined(value) for key, value in values.items()})


class _Printed(NamedTuple):
    """A number to be inserted in a text of a language."""

    value: float
    language: Language

    def __format__(self, form: str) -> str:
        return decimal(format(self.value, form or "g"), self.language)


def _each(value: object, clean: Callable[[str], str]) -> object:
    match value:
        case ErrorMessage():
            return value.cleaned(clean)
        case float():
            return value
        case tuple() | list():
            return type(value)(_each(item, clean) for item in value)
        case _:
            return clean(str(value))

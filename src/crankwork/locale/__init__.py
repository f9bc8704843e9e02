r"""Every word that crankwork prints: one key, one text per language, in `locale/LANGUAGE/ROOM.toml`.

A key is `room.name`, and the room is the name of its file. A file is read when its first text is asked for. It is TOML,
but a text stands on one line, `name = "text"`, a quotation mark as \": so read, a thousand take 0.3 ms, by tomllib 10.
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
    """Return all texts of a room by name."""
    written = read_resource("locale", language, f"{room}.toml")
    found = dict(_LINE.findall(written))
    if "\\" in written:
        found = {name: words.replace('\\"', '"') for name, words in found.items()}
    return MappingProxyType(found)


def say(key: str, language: Language, **values: object) -> str:
    """Return a text, with values put in where it has braces; without values it is returned as it stands.

    Examples
    --------
    >>> say("units.mm", "ru")
    'мм'
    """
    room, _, name = key.partition(".")
    found = texts(room, language)[name]
    return found.format(**values) if values else found


def decimal(text: str, language: Language) -> str:
    """Return a number as text with the decimal mark of a language.

    Examples
    --------
    >>> decimal("0.25", "ru")
    '0,25'
    """
    return text if language == "en" else text.replace(".", ",")


def has_text(key: str) -> bool:
    """Return whether there is a text of that key."""
    room, _, name = key.partition(".")
    return name in texts(room, "en")


def capital(words: str) -> str:
    """Return words with a capital letter first, as headings and titles of columns have it.

    Examples
    --------
    >>> capital("ход поршня")
    'Ход поршня'
    """
    return words[:1].upper() + words[1:]


class Refusal(str):
    """What is refused, in English; it keeps its key and values, so that `told` can say it in another language.

    The name is that of a text in the room `refusals`, or `room.name`. Of the values entries of a tuple are joined by
    "or", those of a list by "and". A number is printed as the text says, `{heat:.4g}`, or else with up to six digits,
    with the decimal mark of the language; what somebody typed, or is to type, is text.

    Examples
    --------
    >>> str(Refusal("same", others=["a", "b"]))
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
        return functools.partial(Refusal, self.name, **self.values), ()

    def cleaned(self, clean: Callable[[str], str]) -> Refusal:
        """Return the sentence with something done to every text that is put in."""
        return Refusal(self.name, **{name: _each(one, clean) for name, one in self.values.items()})


def told(message: str, language: Language) -> str:
    """Return a refusal in a language; other text stays as it is.

    Examples
    --------
    >>> told(Refusal("same", others=["a", "b"]), "ru")
    'задаёт то же, что a и b; оставьте что-то одно'
    """
    return _filled(message.name, message.values, language) if isinstance(message, Refusal) else message


def _filled(name: str, values: Mapping[str, object], language: Language) -> str:
    known = texts("refusals", language)

    def joined(value: object) -> str | _Printed:
        match value:
            case tuple() | list():
                word = known["or" if isinstance(value, tuple) else "and"]
                *others, last = [format(joined(one)) for one in value] or [""]
                return f"{', '.join(others)} {word} {last}" if others else last
            case float():
                return _Printed(value, language)
            case str():
                return told(value, language)
            case _:
                return str(value)

    room, _, own = name.rpartition(".")
    words = texts(room, language)[own] if room else known[name]
    return words.format(**{key: joined(value) for key, value in values.items()})


class _Printed(NamedTuple):
    """A number that goes into a text."""

    value: float
    language: Language

    def __format__(self, form: str) -> str:
        return decimal(format(self.value, form or "g"), self.language)


def _each(value: object, clean: Callable[[str], str]) -> object:
    match value:
        case Refusal():
            return value.cleaned(clean)
        case float():
            return value
        case tuple() | list():
            return type(value)(_each(one, clean) for one in value)
        case _:
            return clean(str(value))

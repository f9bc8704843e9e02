"""Every text stands in every language, in a form that its readers and its reader in the program understand."""

from __future__ import annotations

import re
import string
import tomllib
import unicodedata
from pathlib import Path

import crankwork
from crankwork.locale import LANGUAGES, texts, translate
from each import for_each

FOLDER = Path(crankwork.__file__).parent / "locale"
ROOMS = sorted({path.stem for path in FOLDER.glob("*/*.toml")})
EVERY = [(f"{room}.{name}", language) for room in ROOMS for language in LANGUAGES for name in texts(room, language)]


def placeholders(words: str) -> set[tuple[str, str | None]]:
    """Return what is put in, and the form that it is printed in."""
    return {(field, form) for _, field, form, _ in string.Formatter().parse(words) if field is not None}


@for_each("room", ROOMS)
def test_a_room_is_toml_with_the_same_texts_in_the_same_order_in_every_language(room):
    names = [list(texts(room, language)) for language in LANGUAGES]
    assert names[0] == names[1] == names[2]
    for language in LANGUAGES:
        written = (FOLDER / language / f"{room}.toml").read_text(encoding="utf-8")
        assert tomllib.loads(written) == texts(room, language), language
        strange = [line for line in written.splitlines() if line and line[0] != "#" and not line.endswith('"')]
        assert strange == [], language


def test_what_is_put_in_is_the_same_in_every_language():
    wrong = {
        key: language
        for key, language in EVERY
        if placeholders(translate(key, language)) != placeholders(translate(key, "en"))
        or not all(one.isidentifier() for one, _ in placeholders(translate(key, language)))
    }
    assert wrong == {}


def test_texts_are_tidy():
    wrong = [
        (key, language)
        for key, language in EVERY
        if not (said := translate(key, language))
        or said != said.strip()
        or said != unicodedata.normalize("NFC", said)
        or "  " in said
    ]
    assert wrong == []


def test_no_word_mixes_letters_of_two_alphabets():
    """A Latin letter that looks Cyrillic is not found by who searches, and sounds wrong when read aloud."""
    wrong = [
        (key, language, word)
        for key, language in EVERY
        if not key.startswith(("symbols.", "marks."))
        for word in re.findall(r"[^\W\d_²³⁴]{2,}", re.sub(r"\{\w+(:[.\w]+)?\}", "", translate(key, language)))
        if len({unicodedata.name(letter).split()[0] for letter in word} - {"GREEK", "MODIFIER", "SUPERSCRIPT"}) > 1
        or (language == "vi" and re.search("[а-яё]", word.lower()))
        or (language == "en" and re.search("[^A-Za-zΑ-ω]", word))
    ]
    wrong += [
        (key, language, found[0])
        for key, language in EVERY
        if language == "ru" and (found := re.search(r"(?<![\w/=(])[aceokBCKO] (?=[а-яё]{3})", translate(key, language)))
    ]
    assert wrong == []

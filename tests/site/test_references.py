"""Every key, quantity, command, option and public name has an entry with a sentence, without building the site."""

from __future__ import annotations

import doctest
import re
import tomllib

import api_pages
import command_pages
import filled_pages
import key_pages
import quantity_pages
from crankwork.cli import commands
from crankwork.locale import LANGUAGES
from crankwork.quantities import SUBJECTS
from each import for_each

IDENTITIES = re.compile(r'class="entry" id="([^"]+)"')
SAID = re.compile(r'<p class="entry-said">(.*?)</p>')


def without(title, written):
    """Return the entries of a page that have no fact of some title."""
    entries = written.split('<div class="entry" id="')[1:]
    return [entry.partition('"')[0] for entry in entries if f"<dt>{title}</dt><dd>" not in entry]


@for_each("language", LANGUAGES)
def test_every_key_has_an_entry_with_a_sentence_and_an_example(language):
    written = "\n".join(text for _, text in key_pages.pages(language))
    wanted = {f"{table.name}.{key}" for table in key_pages.tables().values() for key in table.keys}
    assert set(IDENTITIES.findall(written)) == wanted
    assert all(len(said) > len("A.") for said in SAID.findall(written))


def test_no_key_is_explained_by_its_name():
    assert key_pages.without_meaning() == []


def test_examples_of_keys_are_toml():
    wrong = []
    for table in key_pages.tables().values():
        for key in table.keys:
            stated, _ = key_pages.example(table, key)
            try:
                tomllib.loads(stated)
            except tomllib.TOMLDecodeError:
                wrong.append(stated)
    assert wrong == []


def test_examples_that_are_made_up_are_read():
    """A value of the kind of each key, by the reader of that kind."""
    from crankwork.description.value_types import Reader

    refused = {}
    for table in key_pages.tables().values():
        for key, specs in table.keys.items():
            stated, file = key_pages.example(table, key)
            if stated and not file:
                reader = Reader()
                specs[0].kind.read(tomllib.loads(stated)[key], key, reader)
                refused |= {f"{table.name}.{key}": str(one) for one in reader.problems}
    assert refused == {}


def test_every_quantity_has_an_entry_with_a_sentence():
    written = "\n".join(text for _, text in quantity_pages.pages("ru", {}))
    assert set(IDENTITIES.findall(written)) == {row.key for rows in SUBJECTS.values() for row in rows}
    assert quantity_pages.without_name() == []


@for_each("language", LANGUAGES)
def test_every_command_and_option_has_an_entry(language):
    written = command_pages.page(language)
    assert [name for name in commands.commands if f"## `crankwork {name}`" not in written] == []
    options = {
        f"{name}{option.opts[-1]}"
        for name, command in commands.commands.items()
        for option in command.params
        if option.param_type_name == "option"
    }
    assert options <= set(IDENTITIES.findall(written))
    assert without(command_pages.WORDS[language]["example"], written) == []
    assert command_pages.without_sentence() == []


def test_every_public_name_has_an_entry_with_a_sentence():
    assert api_pages.left_out() == []


def test_examples_of_names_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    failed = []
    for name, shown in api_pages.examples().items():
        case = doctest.DocTestParser().get_doctest(shown, {}, name, None, None)
        if not case.examples or doctest.DocTestRunner(verbose=False).run(case).failed:
            failed.append(name)
        (tmp_path / "torque.svg").unlink(missing_ok=True)
    assert failed == []


def test_every_public_name_has_an_example():
    assert api_pages.without_example() == []


def test_references_say_the_same_in_every_language():
    names = {language: list(words) for language, words in key_pages.WORDS.items()}
    assert names["en"] == names["ru"] == names["vi"]
    fields = re.compile(r"\{\w+\}")
    for name, english in key_pages.WORDS["en"].items():
        if isinstance(english, str):
            wanted = sorted(fields.findall(english))
            assert [sorted(fields.findall(key_pages.WORDS[one][name])) for one in LANGUAGES] == [wanted] * 3, name


def test_every_page_that_shows_output_was_run():
    """What stands below a `$` was printed by the command, not pasted: pages have no console blocks of their own."""
    pages = (filled_pages.ROOT / "docs" / "site").rglob("*.md")
    assert [
        page.name for page in pages if re.search(r"^```(console|text)", page.read_text("utf-8"), re.MULTILINE)
    ] == []

"""Every key, quantity, command, option and public name has an entry with a sentence, without building the site."""

from __future__ import annotations

import doctest
import re
import shutil
import tomllib
from pathlib import Path

import pytest

import api_pages
import command_pages
import crankwork
import filled_pages
import key_pages
import quantity_pages
import recordings
from crankwork.cli import commands
from crankwork.locale import LANGUAGES
from crankwork.quantities import QUANTITIES, SUBJECTS
from crankwork.study.study_file import Study, load_study
from each import failing, for_each

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
    for title in ("kind", "example"):
        assert without(key_pages.WORDS[language][title], written) == []
    assert all(len(said) > len("A.") for said in SAID.findall(written))


def test_no_key_is_explained_by_its_name():
    assert key_pages.without_meaning() == []


def test_examples_of_keys_are_toml():
    wrong = []
    for stated, _ in key_pages.examples().values():
        try:
            tomllib.loads(stated)
        except tomllib.TOMLDecodeError:
            wrong.append(stated)
    assert wrong == []


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The whole files that the examples of keys are from: a path, or a text of the repository with keys added."""
    folder = tmp_path_factory.mktemp("files")
    shutil.copytree(key_pages.KEY_EXAMPLES, folder, dirs_exist_ok=True)
    shutil.copy(key_pages.ROOT / "examples" / "slider-crank.toml", folder)
    recordings.write(folder)
    changed = dict(key_pages.changed())

    def file(name):
        here = Path(name)
        if name in changed:
            return crankwork.Description(changed[name])
        return folder / here.name if here.parent.name == key_pages.KEY_EXAMPLES.name else key_pages.ROOT / here

    return file


def test_every_key_has_an_example_of_a_file():
    keys = {(table.name, key) for table in key_pages.tables().values() for key in table.keys}
    assert keys - key_pages.examples().keys() == set()


def _read(path):
    text = path.read_text("utf-8")
    return load_study(path, is_search="[search]" in text) if "[vary]" in text else crankwork.read(path)


@pytest.mark.slow
def test_files_that_examples_are_from_are_read(files):
    """Those that stand for their keys alone are analysed below, templates and expansions elsewhere."""
    names = {name for _, name in key_pages.examples().values()} - set(dict(key_pages.changed()))
    paths = {name: files(name) for name in names if not name.startswith("crankwork ")}
    assert failing(paths, _read) == {}


@pytest.mark.slow
def test_files_of_keys_alone_are_analysed_and_hold_together(files):
    here = {path.name for path in key_pages.KEY_EXAMPLES.glob("*.toml")} - {"changes.toml"}
    names = [*dict(key_pages.changed()), *(f"{key_pages.KEY_EXAMPLES.name}/{name}" for name in here)]

    def analysed(file):
        machine = _read(file) if isinstance(file, Path) else file.machine()
        assert isinstance(machine, Study) or not crankwork.analyse(machine).unmet

    assert failing({name: files(name) for name in names}, analysed) == {}


def test_every_quantity_has_an_entry_with_a_sentence():
    written = "\n".join(text for _, text in quantity_pages.pages("ru", {}))
    assert set(IDENTITIES.findall(written)) == {row.key for rows in SUBJECTS.values() for row in rows}
    for title in ("unit_shown", "si", "symbol"):
        assert without(quantity_pages.WORDS["ru"][title], written) == []
    assert quantity_pages.without_name() == []


def test_the_definition_of_a_quantity_tells_its_sign_in_every_language():
    wrong = {}
    for quantity in QUANTITIES.values():
        said = {language: quantity.definition(language) for language in LANGUAGES}
        signs = {one: bool(re.search(key_pages.WORDS[one]["sign_in_definition"], said[one])) for one in LANGUAGES}
        if len({*signs.values()}) > 1 or said["vi"] == said["en"] or not re.search("[а-яё]{3}", said["ru"]):
            wrong[quantity.key] = said
    assert wrong == {}


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


@pytest.mark.slow
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

"""What was opened last is offered again: by its path if it stands in a file, else by its text."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.studio.hands import begin, field, settled, source
from tests.studio.test_answers import EXAMPLES
from tests.studio.test_server import talked

from crankwork import cli
from crankwork.description.machine_file import template
from crankwork.studio.recent import Recent, recent


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "crankwork" / "recent.json"


def test_the_last_one_comes_first_and_each_stands_there_once(cache):
    for name in ("a", "b", "a"):
        recent(Recent(name, f"text of {name}"))
    recent(Recent("/home/c.toml"))
    assert recent() == [("/home/c.toml", None), ("a", "text of a"), ("b", "text of b")]
    for number in range(20):
        recent(Recent(str(number), ""))
    assert [one.name for one in recent()] == ["19", "18", "17", "16", "15", "14", "13", "12"]
    recent(Recent("large", "x" * (1 << 20)))
    recent(Recent("no letters\udcff", ""))
    assert recent()[0].name == "19"


@pytest.mark.parametrize(
    "found",
    ["[", "{}", "[3]", '[["a"]]', '[["a", 3]]', '[["../a.toml", null]]', "[" * 100_000, "\0", '[["", ""]]', "1e999"],
    ids=range(10),
)
def test_a_damaged_list_is_an_empty_one_and_is_written_anew(cache, found):
    cache.parent.mkdir(parents=True)
    cache.write_text(found, encoding="utf-8")
    assert recent() == []
    assert recent(Recent("a", "b")) == [("a", "b")]


def test_where_nothing_can_be_kept_nothing_is_offered(cache, monkeypatch):
    cache.mkdir(parents=True)
    assert recent(Recent("a", "b")) == []
    monkeypatch.setenv("CRANKWORK_CACHE", str(Path(__file__)))
    assert recent(Recent("a", "b")) == []


def test_programs_that_open_machines_at_once_lose_none(cache):
    program = "import sys; from crankwork.studio.recent import *; recent(Recent(sys.argv[1], ''))"
    environment = os.environ | {"PYTHONPATH": str(Path(cli.__file__).parents[2])}
    running = [subprocess.Popen([sys.executable, "-c", program, str(number)], env=environment) for number in range(6)]
    assert [one.wait() for one in running] == [0] * 6
    assert {one.name for one in recent()} == set("012345")
    assert [one.name for one in cache.parent.iterdir()] == [cache.name]


def test_a_page_opens_and_writes_files_of_the_list_alone(tmp_path, start):
    own, other = tmp_path / "own.toml", tmp_path / "other.toml"
    for path in (own, other):
        path.write_text(template("press"), encoding="utf-8")
    with start(tmp_path) as started, talked(started) as socket:
        assert json.loads(socket.recv())["recent"] == []

        def ask(**question):
            socket.send(json.dumps({"n": 1, "text": "# new\n", "kept": template("press"), "name": "x", **question}))
            return json.loads(socket.recv())

        for path in (own, other, "/etc/hostname"):
            assert "text" not in ask(do="recent", name=str(path))
            assert "not among" in ask(do="recent", name=str(path))["refusals"][0]["text"]
        assert "handed" in ask(do="save", path=str(own))
        assert own.read_text("utf-8") == template("press")
        recent(Recent(str(own)))
        assert ask(do="recent", name=str(own))["path"] == str(own)
        own.write_text("# somebody else\n", encoding="utf-8")
        assert "conflict" in ask(do="save", path=str(own))
        own.unlink()
        told = ask(do="recent", name=str(own))["refusals"][0]["text"]
        assert told.endswith("; open the file from where it is now")
        assert str(own) in told
        assert "handed" in ask(do="save", path=str(other))
        assert other.read_text("utf-8") == template("press")


def test_a_file_that_was_opened_before_is_opened_again_and_saved(seen, start, tmp_path):
    path = tmp_path / "my press.toml"
    path.write_text(template("press"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        seen(one).close()
    with start(tmp_path) as one:
        page = seen(one, language="ru")
        assert page.locator("#title").inner_text() == "Шарнирный четырёхзвенник"
        options = page.locator("#template optgroup").first.locator("option")
        assert options.all_text_contents() == [f"my press.toml – {tmp_path}"]
        page.select_option("#template", str(path))
        page.wait_for_function("() => document.getElementById('save').title.includes('my press.toml')")
        settled(page)
        field(page, "crank.speed").fill("33 rpm")
        field(page, "crank.speed").press("Enter")
        settled(page)
        page.locator("#save").click()
        page.wait_for_selector("#notice:not([hidden])")
        assert '"33 rpm"' in path.read_text("utf-8")
        # undone to what stands in no file, it is handed over, and stays in the list by its title
        begin(page, "engine")
        title = page.locator("#title").inner_text()
        with page.expect_download():
            page.locator("#save").click()
        settled(page)
        assert options.all_text_contents() == [title, f"my press.toml – {tmp_path}"]
        path.unlink()
        text = source(page)
        page.select_option("#template", str(path))
        page.wait_for_function("() => document.getElementById('notice').textContent.includes('my press.toml')")
        # it is offered no more; the notice may be that of the disk
        page.wait_for_function("() => document.querySelector('#template optgroup').childElementCount === 1")
        assert options.all_text_contents() == [title]
        assert source(page) == text
        assert page.locator("body.stale").count() == 0
        field(page, "crank.speed").fill("1000 rpm")
        field(page, "crank.speed").press("Enter")
        settled(page)
        page.select_option("#template", title)
        page.wait_for_function("text => document.getElementById('source').value === text", arg=text)


def test_a_file_that_another_page_saved_is_read_as_it_is_now(seen, start, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(template("four-bar"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        path.write_text(template("four-bar").replace("100 rpm", "77 rpm"), encoding="utf-8")
        page = seen(one)
        assert field(page, "crank.speed").input_value() == "77 rpm"
        page.reload()
        page.wait_for_selector(".figures svg")
        field(page, "crank.speed").fill("78 rpm")
        field(page, "crank.speed").press("Enter")
        settled(page)
        page.locator("#save").click()
        page.wait_for_function("() => document.getElementById('notice').textContent.startsWith('Saved')")
        assert '"78 rpm"' in path.read_text("utf-8")
        # a text that is no machine is saved and said to be none; one that is longer than any is neither
        text = page.locator("#source")
        page.locator("#text-tab").click()
        text.fill("[[[[")
        page.wait_for_selector("#refusals li")
        settled(page)
        page.locator("#save").click()
        page.wait_for_function("() => document.getElementById('notice').textContent.includes('no machine yet')")
        assert path.read_text("utf-8") == "[[[["
        text.evaluate("one => { one.value = '#'.repeat(7e6); one.dispatchEvent(new Event('input')); }")
        page.wait_for_function("() => document.querySelector('#refusals li')?.textContent.includes('longer than any')")


def test_what_a_machine_lacks_has_no_room(seen, start, tmp_path):
    path = tmp_path / "press.toml"
    path.write_text(next(one for one in EXAMPLES if one.stem == "press").read_text("utf-8"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        page = seen(one)
        settled(page)
        # neither checks nor a mechanism
        assert "0/0" not in page.locator("#results").inner_text()
        assert page.locator("#film").is_hidden()

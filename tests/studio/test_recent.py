"""What was opened last is offered again: by its path if it stands in a file, else by its text."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from crankwork import cli
from crankwork.description.machine_file import template
from crankwork.studio.server import Recent, recent
from studio.test_server import talked


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


def test_a_damaged_list_is_an_empty_one_and_is_written_anew(cache):
    cache.parent.mkdir(parents=True)
    damaged = ("[", "{}", "[3]", '[["a"]]', '[["a", 3]]', '[["../a.toml", null]]', "[" * 100_000, "\0", '[["", ""]]')
    for found in (*damaged, "1e999"):
        cache.write_text(found, encoding="utf-8")
        assert recent() == [], found[:20]
        assert recent(Recent("a", "b")) == [("a", "b")], found[:20]


def test_where_nothing_can_be_kept_nothing_is_offered(cache, monkeypatch):
    cache.mkdir(parents=True)
    assert recent(Recent("a", "b")) == []
    monkeypatch.setenv("CRANKWORK_CACHE", str(Path(__file__)))
    assert recent(Recent("a", "b")) == []


def test_programs_that_open_machines_at_once_lose_none(cache):
    program = "import sys; from crankwork.studio.server import *; recent(Recent(sys.argv[1], ''))"
    environment = os.environ | {"PYTHONPATH": str(Path(cli.__file__).parents[2])}
    running = [subprocess.Popen([sys.executable, "-c", program, str(number)], env=environment) for number in range(4)]
    assert [one.wait() for one in running] == [0] * 4
    assert {one.name for one in recent()} == set("0123")
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

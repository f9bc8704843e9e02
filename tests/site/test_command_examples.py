"""The lines that the page of commands shows: all of them end well, and together they have every option."""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

import command_pages
import crankwork
from crankwork import cli
from each import failing, for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
# where a cluster listens, and the studio; what listens in tests has places of its own
SCHEDULER, PORT = "tcp://127.0.0.1:8786", "8765"


@pytest.fixture(autouse=True)
def _folder_of_a_reader(tmp_path, monkeypatch):
    """A folder with the examples; a million engines are a few."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(EXAMPLES, "examples")
    study = Path("examples/studies/million-engines.toml")
    written = study.read_text("utf-8")
    assert "count = 1_000_000" in written
    study.write_text(written.replace("count = 1_000_000", "count = 16"), "utf-8")


@pytest.fixture
def carried_out(monkeypatch, capsys):
    """Carry out a line in this process; its output, after it has ended well and the file that it names is there."""

    def run(line):
        words = shlex.split(line)
        monkeypatch.setattr(sys, "argv", words)
        with pytest.raises(SystemExit) as ended:
            cli.main()
        printed = capsys.readouterr()
        assert ended.value.code == 0, f"{line}: {printed.err}"
        assert printed.out.strip(), line
        if "-o" in words and "--help" not in words:
            assert Path(words[words.index("-o") + 1]).exists(), line
        return printed.out

    return run


def lines_of(command):
    return [line for line in command_pages.examples(command) if SCHEDULER not in line and PORT not in line]


def test_every_option_stands_in_an_example():
    shown = {command: set() for command in cli.commands.commands}
    for line in command_pages.examples():
        shown[shlex.split(line)[1]] |= command_pages.options_of(line)
    stated = {
        name: {option.opts[-1] for option in command_pages.options(command)}
        for name, command in cli.commands.commands.items()
    }
    assert shown == stated


@pytest.mark.slow
@for_each("command", sorted(set(cli.commands.commands) - {"sweep"}))
def test_examples_of_commands_end_well(command, carried_out):
    assert failing({line: line for line in lines_of(command)}, carried_out) == {}


@pytest.mark.data
def test_examples_of_studies_end_well(carried_out):
    assert failing({line: line for line in lines_of("sweep")}, carried_out) == {}


@pytest.mark.data
def test_the_example_of_a_cluster_ends_well(carried_out):
    import distributed

    (line,) = (line for line in command_pages.examples("sweep") if SCHEDULER in line)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=None, processes=False
    ) as cluster:
        carried_out(line.replace(SCHEDULER, cluster.scheduler_address))


@pytest.mark.slow
def test_the_example_of_the_studio_serves_a_page_until_it_is_interrupted():
    (line,) = (line for line in command_pages.examples("studio") if PORT in line)
    own = os.environ | {"PYTHONPATH": str(Path(crankwork.__file__).parents[1]), "CRANKWORK_CACHE": "cache"}
    words = [sys.executable, "-m", *shlex.split(line.replace(PORT, "0"))]
    with subprocess.Popen(words, env=own, stdout=subprocess.PIPE, text=True) as studio:
        try:
            with_cookies = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
            with with_cookies.open(studio.stdout.readline().strip()) as answer:
                assert 'lang="vi"' in answer.read().decode()
            studio.send_signal(signal.SIGINT)
            assert studio.wait(30) in (0, 130)
        finally:
            studio.kill()

"""The program among others: pipes that close, disks that fill, terminals that know no Unicode, and what it loads."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import crankwork as package

HEAVY = ("matplotlib", "pydantic", "scipy", "xlsxwriter")
ENVIRONMENT = os.environ | {"PYTHONPATH": str(Path(package.__file__).parents[1]), "PYTHON": sys.executable}
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the shell is that of Unix")


@pytest.fixture
def shell(machine_file):
    """Run a line of the shell in which `crankwork` is the program and my.toml a crank gear."""
    machine_file(name="slider-crank")

    def run(line: str, **more: str) -> tuple[int, str, str]:
        words = ["bash", "-c", 'crankwork() { "$PYTHON" -m crankwork "$@"; }; ' + line]
        ended = subprocess.run(
            words, env=ENVIRONMENT | more, capture_output=True, encoding="utf-8", timeout=60, check=False
        )
        return ended.returncode, ended.stdout, ended.stderr

    return run


@pytest.mark.slow
def test_streams_that_close_or_are_full_are_no_traceback(shell) -> None:
    # a reader that leaves early is no error to talk about
    found = {line: shell(line)[1:] for line in (
        "crankwork run my.toml | head -1", "crankwork run my.toml >&-", "crankwork check none.toml 2>&-",
        "crankwork >&- 2>&-",
    )}  # fmt: skip
    assert list(found.values()) == [("Slider-crank mechanism\n", ""), *[("", "")] * 3]
    told = "the output cannot be written (no space left on device); send it elsewhere\n"
    assert shell("crankwork run my.toml > /dev/full") == (2, "", told)


@pytest.mark.slow
def test_a_locale_without_unicode_prints_all_the_same(shell, crankwork) -> None:
    expected = crankwork("run", "my.toml", "--lang", "vi").out
    for variables in (
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        {"PYTHONIOENCODING": "koi8-r"},
    ):
        assert shell("crankwork run my.toml --lang vi", **variables) == (0, expected, ""), variables


def test_a_name_that_is_no_text_is_refused_in_one_line(machine_file, check_refusals) -> None:
    # as Python reads what is no UTF-8 on the command line
    name = machine_file()
    check_refusals(
        [(("check", "\udcff.toml"), "no such file"), (("run", name, "--set", "title=\udcff"), "--set title: ")]
    )


def test_a_first_answer_loads_nothing_that_draws_or_writes_workbooks(machine_file, crankwork) -> None:
    name, found = machine_file(), {}
    code = (
        "import sys; from crankwork import cli\n"
        "try: cli.main()\n"
        f"finally: print(*[name for name in {HEAVY!r} if name in sys.modules], 'heavy', file=sys.stderr)"
    )
    for arguments in (("run", name), ("schema",)):
        command = [sys.executable, "-c", code, *arguments]
        loaded = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=False, timeout=60)
        if (loaded.stderr, loaded.stdout) != ("heavy\n", crankwork(*arguments).out):
            found[arguments] = loaded.stderr
    assert found == {}

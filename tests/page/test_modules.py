"""The modules of the browser: their types, and that they can be joined."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from crankwork.browser import modules, script
from crankwork.resources import read_resource

ROOM = Path(__file__).parents[2] / "src" / "crankwork" / "browser"
COMPILER = Path(sys.prefix) / "node" / "node_modules" / "typescript" / "bin" / "tsc"
TYPES = "--noEmit --allowJs --checkJs --strict --target es2022 --module es2022 --moduleResolution bundler"


@pytest.fixture
def node() -> str:
    found = shutil.which("node")
    if found is None or not COMPILER.exists():
        pytest.skip("node and typescript are not installed")
    return found


@pytest.mark.programs
def test_types_of_all_modules_agree(node) -> None:
    files = sorted(map(str, ROOM.glob("*.js")))
    libraries = ["--lib", "es2022,dom,dom.iterable"]
    told = subprocess.run(
        [node, COMPILER, *TYPES.split(), *libraries, *files], capture_output=True, text=True, check=False
    )
    assert told.stdout == ""


def test_names_at_the_top_of_modules_are_told_apart() -> None:
    tops = re.compile(r"^(?:export )?(?:async )?(?:class|function\*?|const|let) (\w+)", re.MULTILINE)
    names = Counter(name for one in modules() for name in tops.findall(read_resource("browser", f"{one}.js")))
    assert [name for name, count in names.items() if count > 1] == []


def test_a_joined_script_has_every_module_once_and_no_import() -> None:
    joined = script("page")
    assert not re.search(r"^\s*(import|export)\b", joined, re.MULTILINE)
    assert joined.count("class Cursor") == joined.count("class Figure") == 1
    assert joined.index("class Cursor") < joined.index("new Cursor(")

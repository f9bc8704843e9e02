"""Tests with values that crankwork did not make only become more, and so do their numbers."""

from __future__ import annotations

import runpy
from pathlib import Path

HERE = Path(__file__).parent
COUNTED = runpy.run_path(str(HERE / "outside_values.py"))


def test_no_outside_value_is_lost_and_every_one_is_listed() -> None:
    listed = dict(line.rsplit(" ", 1) for line in (HERE / "outside_values.txt").read_text("utf-8").splitlines())
    found = dict(COUNTED["counted"](HERE.parent))
    fewer = {name: (int(count), found.get(name)) for name, count in listed.items() if found.get(name, 0) < int(count)}
    assert fewer == {}, "tests or numbers are gone: (listed, found)"
    assert sorted(found.keys() - listed.keys()) == [], "list them as outside_values.py prints them"


def test_numbers_of_cases_tables_and_helpers_are_counted(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(
        "import pytest\n"
        "pytestmark = pytest.mark.elsewhere\n"
        "TABLE = [(1.5, 2.5), (3, 4)]\n"
        "OTHER = 9\n"
        "def twice(x): return 2 * x\n"
        "@pytest.mark.parametrize('x', [7, 8])\n"
        "def test_one(x): assert twice(x) == TABLE and 'b' == 5.0\n"
        "def test_none(): assert True\n",
        "utf-8",
    )
    assert dict(COUNTED["counted"](tmp_path)) == {"test_it.py::test_one": 8, "test_it.py::test_none": 0}

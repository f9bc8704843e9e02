"""Lists of a machine file in the columns of a table: the same machine as with the lists written out."""

from __future__ import annotations

import re

import pytest

import crankwork
from crankwork.errors import InputError
from each import for_each

PRESS = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "50 mm"
speed = "60 rpm"
[guides]
bed = { through = "O", angle = "270 deg" }
[links]
rod = { joins = ["A", "B"], length = "300 mm" }
[sliders]
ram = { guide = "bed", pin = "B" }
[[loads]]
kind = "process"
slider = "ram"
"""
LISTS = 'at = ["0 mm", "60 mm", "100 mm"]\nforce = ["0 kN", "1.5 kN", "200 kN"]\n'
TABLE = "Press of 2024\n\ns;F;note\n[mm];[kN];\n0;0;a\n60;1,5;b\n100;200;c\n"


@pytest.fixture
def read(tmp_path):
    """Return the machine of a text beside a table."""

    def reading(text: str, table: str = TABLE):
        (tmp_path / "f.csv").write_text(table, encoding="utf-8")
        return crankwork.read_machine(text, folder=tmp_path)

    return reading


def refusal(read, *given: str) -> str:
    with pytest.raises(InputError) as caught:
        read(*given)
    (problem,) = caught.value.problems
    return f"{problem.key}: {problem.message}"


@for_each("columns", [
    'at = "s"\nforce = "F"\n',
    "at = 1\nforce = 2\n",
    'at = { column = 1, unit = "mm" }\nforce = { column = "F", unit = "kN" }\n',
    'at = "s"\nforce = ["0 kN", "1.5 kN", "200 kN"]\n',
])  # fmt: skip
def test_columns_of_a_file_are_lists(read, columns):
    assert read(f'{PRESS}file = "f.csv"\n{columns}').loads == read(PRESS + LISTS).loads


NAMED = 'file = "f.csv"\nat = "s"\nforce = "F"\n'
BROKEN = {
    "no file": (NAMED.replace("f.csv", "g.csv"), TABLE, "loads.1..file: .*no such file"),
    "no column": (NAMED.replace('"F"', '"G"'), TABLE, 'loads.1..force: f.csv, line 3: there is no column "G"'),
    "no unit": (NAMED, TABLE.replace("[kN]", ""), 'write force = . column = "F", unit = "N" .'),
    "another unit": (NAMED, TABLE.replace("[kN]", "[bar]"), "has no unit that would do"),
    "a bad cell": (NAMED, TABLE.replace("1,5", "x"), 'force: f.csv, line 6: "x" is not a number'),
    "no reference": (f"file = 'f.csv'\n{LISTS}", TABLE, "loads.1..file: is a file of which no column is named"),
    "no form": (NAMED.replace('"F"', "{ col = 2 }"), TABLE, "force: is no column; write force = "),
    "nothing beside it": ('at = "s"\nforce = ["1 N", "2 N"]\n', TABLE, "at: is neither a list .*; write .*and file ="),
}  # fmt: skip


@for_each(("keys", "table", "expected"), BROKEN.values(), ids=BROKEN)
def test_a_column_that_is_none_is_told_with_its_fix(read, keys, table, expected):
    message = refusal(read, PRESS + keys, table)
    assert re.search(expected, message), message


TRANSFER = """
[crank]
speed = "60 rpm"
[transfer]
{angles}
{torque}
[transfer.bodies.ram]
mass = "12 kg"
{velocity}
"""


def test_transfer_functions_stand_in_a_file(read):
    rows = [(30.0 * k, 0.1 * k * (12 - k), 5.0 - k) for k in range(12)]
    lists = {
        "angles": f"angles = {[f'{one[0]} deg' for one in rows]}",
        "velocity": f"velocity = {[f'{one[1]:.6f} mm' for one in rows]}",
        "torque": f"static_torque = {[f'{one[2]} N*m' for one in rows]}",
    }
    columns = {
        "angles": 'file = "f.csv"\nangles = 1',
        "velocity": 'velocity = { column = "v", unit = "mm" }',
        "torque": 'static_torque = "M"',
    }
    table = "phi (deg)\tv\tM [Nm]\n" + "\n".join(f"{a}\t{v:.6f}\t{m}" for a, v, m in rows)
    assert read(TRANSFER.format(**columns), table).transfer == read(TRANSFER.format(**lists), table).transfer

"""Measured pressure: what is read, and how a file that cannot be one is refused."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

MACHINE = """
[crank]
radius = "45 mm"
speed = "3000 rpm"
[rod]
length = "160 mm"
[cylinder]
bore = "85 mm"
compression_ratio = 9.0
[gas]
cycle = "720 deg"
[gas.measured]
file = "pressure.csv"
pressure_unit = "bar"
"""


def _pressure(degrees: float) -> float:
    return 1.0 + 40.0 * math.exp(-(((degrees - 372.0) / 40.0) ** 2))


def _rows(step: int = 2, separator: str = ",", mark: str = ".") -> list[str]:
    values = [(degrees, f"{_pressure(degrees):.6f}".replace(".", mark)) for degrees in range(0, 721, step)]
    return [f"{degrees}{separator}{value}" for degrees, value in values]


WHOLE = "\n".join(_rows())


@pytest.fixture
def written(machine_file):
    """Write the machine file, and the pressure file unless it is None."""

    def write(pressure: str | bytes | None, *changes: tuple[str, str]) -> str:
        if pressure is not None:
            Path("pressure.csv").write_bytes(pressure if isinstance(pressure, bytes) else pressure.encode())
        return machine_file(*changes, text=MACHINE)

    return write


def _with_line(number: int, text: str) -> str:
    lines = _rows()
    lines[number - 1] = text
    return "\n".join(lines)


BROKEN = {
    "a gap": ("\n".join(_rows()[:100] + _rows()[120:]), "line 101: gap from 198 to 240 deg", "fill in the missing"),
    "backwards": (_with_line(50, "90,2.0"), "line 50: the angle goes backwards, from 96 to 90 deg", "sort the rows"),
    "text in a cell": (_with_line(7, "12,n/a"), 'line 7: "n/a" is not a number', "correct or remove the row"),
    "an empty cell": (_with_line(7, "12,"), 'line 7: "" is not a number', "correct or remove the row"),
    "nan": (_with_line(7, "12,nan"), 'line 7: "nan" is not a number', "correct or remove the row"),
    "inf": (_with_line(7, "12,1e999"), 'line 7: "1e999" is not a number', "correct or remove the row"),
    "underscores": (_with_line(7, "12,1_0"), 'line 7: "1_0" is not a number', "correct or remove the row"),
    "a missing cell": (_with_line(7, "12"), "line 7: 1 columns where line 1 has 2", "correct the row"),
    "decimal commas between commas": (",".join(["0"] * 2) + "\n2,1,5\n", "line 2: 3 columns", "by semicolons"),
    "decimal commas throughout": ("0,1,5\n2,1,6\n4,1,7", "line 1: 3 columns without headings", "by semicolons"),
    "too few degrees": ("\n".join(_rows()[:300]), "the samples cover 598 deg; one cycle is 720 deg", "record it whole"),
    "too few rows": ("0,1\n360,2\n720,1", "only 3 samples", "at least 8"),
    "empty": ("", "line 1: the file is empty", "a column of crank angle and one of pressure"),
    "blank": ("\n\n  \n# nothing\n", "line 1: the file is empty", "a column of crank angle"),
    "only a heading": ("angle,pressure\n", "line 1: only a heading", "write rows of numbers"),
    "one column": ("1.0\n2.0\n", "line 1: only one column", "write crank angle and pressure"),
    "binary": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "is a binary file", "give a text file"),
    "an endless cell": ('0,"' + "9" * 200_000 + '"\n', "line 1: the line is far too long", "a table of numbers"),
    "missing": (None, "no such file", "check the path"),
}  # fmt: skip


def test_a_broken_pressure_file_is_refused_with_its_line(crankwork, written, check_mistakes) -> None:
    failures = {}
    begin = "my.toml:13: gas.measured.file: pressure.csv", "my.toml:12: gas.measured: pressure.csv"
    for name, (pressure, wrong, advice) in BROKEN.items():
        Path("pressure.csv").unlink(missing_ok=True)
        answer = crankwork("run", written(pressure), "-o", "out")
        check_mistakes(answer)
        line, *others = answer.mistakes
        # of columns without headings each is asked for
        assert len(others) <= (name == "decimal commas throughout")
        if not line.startswith(begin) or wrong not in line or advice not in line:
            failures[name] = line
    assert failures == {}
    assert not Path("out").exists()


def test_a_missing_column_or_unit_is_told_with_what_there_is(written, check_refusals) -> None:
    unit = 'pressure_unit = "bar"'
    name = written("phi,p\n" + WHOLE, (unit, f'{unit}\npressure_column = "p2"'))
    check_refusals([(("check", name), 'line 1: there is no column "p2"; the headings are: phi, p')])
    name = written(WHOLE, (unit, ""))
    units = 'pressure_unit = "bar" or pressure_unit = "kgf/cm2"'
    check_refusals([(("check", name), f"gas.measured.pressure_unit: is missing; write {units}")])


SPELLINGS = {
    "semicolons and decimal commas": "\n".join(_rows(separator=";", mark=",")),
    "tabs": "\n".join(_rows(separator="\t")),
    "blanks": "\n".join(_rows(separator="   ")),
    "a heading": "angle,pressure\n" + WHOLE,
    "a byte order mark": "\ufeff" + WHOLE,
    "lines as Windows ends them": WHOLE.replace("\n", "\r\n"),
    "words in an old encoding": f"угол;давление\n{WHOLE.replace(',', ';')}".encode("cp1251"),
    "as Excel saves Unicode": ("угол\tдавление\n" + WHOLE.replace(",", "\t")).encode("utf-16"),
    "comments and empty lines": "# made in the laboratory, twice\n\n" + WHOLE + "\n\n",
}


def test_the_same_samples_written_otherwise_are_the_same_pressure(crankwork, written) -> None:
    def found(pressure: str | bytes, *changes: tuple[str, str]) -> dict[str, object]:
        return crankwork("run", written(pressure, *changes), "--json").results

    expected = found(WHOLE)
    assert expected["summary"]["gas_pressure_max"]["value"] == pytest.approx(4.1, rel=1e-3)
    assert [name for name, pressure in SPELLINGS.items() if found(pressure) != expected] == []
    # columns are found by their headings
    columns = 'pressure_unit = "bar"\nangle_column = "phi"\npressure_column = "p"'
    pressure = "n,p,phi\n" + "\n".join(f"7,{row.split(',')[1]},{row.split(',')[0]}" for row in _rows())
    assert found(pressure, ('pressure_unit = "bar"', columns)) == expected

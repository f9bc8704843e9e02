"""Tables of numbers as test benches and programs write them: every cell where it stands, whatever is around it."""

from __future__ import annotations

import contextlib
import zipfile

import numpy as np
import pytest
import xlsxwriter

from crankwork.description.table_file import read_table
from crankwork.errors import CrankworkError
from each import for_each

ANGLES = np.arange(0.0, 721.0, 2.0)
PRESSURES = np.round(1 + 40 * np.exp(-(((ANGLES - 372) / 40) ** 2)), 6)


def _rows(separator: str, mark: str = ".", end: str = "") -> str:
    rows = (f"{angle:g}{separator}{pressure:.6f}" for angle, pressure in zip(ANGLES, PRESSURES, strict=True))
    return "\n".join(row.replace(".", mark) + end for row in rows)


PREAMBLE = "Diesel-RK 4.3\nProject = D-245\nRPM = 1500; bore = 110 mm\nStep = 2.0, deg\nP,0 = 0.1 MPa\n\n"
WRITTEN = {
    "commas": _rows(","),
    "comma and blank": _rows(", "),
    "semicolons and decimal commas": _rows(";", ","),
    "tabs and decimal commas": _rows("\t", ","),
    "blanks": _rows("   "),
    "blanks and decimal commas": _rows("   ", ","),
    "aligned": "\n".join(f"{a:10.1f} {p:14.6f}" for a, p in zip(ANGLES, PRESSURES, strict=True)),
    "a trailing tab": _rows("\t", end="\t"),
    "a trailing semicolon": "phi;p;\n" + _rows(";", end=";"),
    "quoted decimal commas": "\n".join(
        f'"{a:.1f}","{p:.6f}"'.replace(".", ",") for a, p in zip(ANGLES, PRESSURES, strict=True)
    ),
    "a title, headings and units": "Test of 12.05.2020\n\nphi;p\n[°CA];[bar]\n" + _rows(";"),
    "units above": "Title\ndeg\tbar\nphi\tp\n" + _rows("\t"),
    "a preamble": PREAMBLE + "Angle, deg  Pressure, bar\n----------------\n" + _rows("   "),
    "comments": "# made twice\n% 2020\n" + _rows(",") + "\n# end\n",
    "a count of rows": "361\n" + _rows(" "),
    "lines as old computers end them": _rows(",").replace("\n", "\r"),
}


@for_each("text", WRITTEN.values(), ids=WRITTEN)
@for_each("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_the_same_numbers_written_otherwise_are_the_same_table(tmp_path, text, encoding):
    (tmp_path / "p.csv").write_bytes(text.encode(encoding))
    table = read_table(tmp_path / "p.csv")
    found = table.columns((0, 1))
    assert found[:, 0].tolist() == ANGLES.tolist()
    assert found[:, 1].tolist() == PRESSURES.tolist()
    lines = text.replace("\r", "\n").split("\n")
    assert "20" in lines[table.lines[10] - 1]
    if "bar" in text:
        assert table.units == ("deg", "bar")


HEADINGS = {
    "phi [deg];p [bar]": ("deg", "bar"),
    "Winkel [Grad];Druck (bar)": ("deg", "bar"),
    "Crank angle, deg;Pressure, MPa": ("deg", "MPa"),
    "phi / rad;p / kPa": ("rad", "kPa"),
    "Угол ПКВ, град;Давление, МПа": ("deg", "MPa"),
    "CA;p_cyl": ("", ""),
    "angle_deg;pressure_bar": ("deg", "bar"),
    "ALPHA [°KW];PCYL1 [BAR(a)]": ("deg", "bar"),
    "phi [deg ATDC];p [mbar]": ("deg", "hPa"),
    "góc quay (độ);áp suất (kgf/cm²)": ("deg", "kgf/cm2"),
    "n;P [kW]": ("", "kW"),
    "phi;p, kg/cm2": ("", "kgf/cm2"),
}


def _has_letters(encoding, text):
    with contextlib.suppress(UnicodeEncodeError):
        return bool(text.encode(encoding))
    return False


ENCODED = [
    (heading, units, encoding)
    for heading, units in HEADINGS.items()
    for encoding in ("utf-8", "cp1251", "latin-1")
    if _has_letters(encoding, heading)
]


@for_each(("heading", "units", "encoding"), ENCODED)
def test_units_stand_in_headings(tmp_path, heading, units, encoding):
    (tmp_path / "p.csv").write_bytes(f"{heading}\n{_rows(';')}".encode(encoding))
    table = read_table(tmp_path / "p.csv")
    assert table.names == tuple(heading.split(";"))
    assert table.units == units
    assert table.heading == 1


def test_columns_have_names_and_numbers(tmp_path):
    (tmp_path / "p.csv").write_text(
        "t [s]\tphi [deg]\tp 1 [bar]\tp 2\tnote\n0\t1\t2\t3\tok\n1\t2\t3\t\tok\n2\t3\t4\t5\tx\n"
    )
    table = read_table(tmp_path / "p.csv")
    assert [table.position(one) for one in ("phi [deg]", "phi", "PHI", 2, "p 1", "p 2")] == [1, 1, 1, 1, 2, 3]
    assert table.columns((1, 2)).tolist() == [[1, 2], [2, 3], [3, 4]]
    with pytest.raises(CrankworkError, match=r'p.csv, line 3: "" is not a number'):
        table.columns((1, 3))
    with pytest.raises(CrankworkError, match=r'p.csv, line 1: there is no column "q"; the headings are: t \[s\], phi'):
        table.position("q")
    with pytest.raises(CrankworkError, match=r"p.csv, there is no column 6; the table has 5"):
        table.position(6)


def test_two_decimal_marks_in_one_table_are_told(tmp_path):
    (tmp_path / "p.csv").write_text("phi;p;day\n0;999,5;1.5.2020\n1;1000,5;2.5.2020\n2;1.000;2.5.2020\n")
    table = read_table(tmp_path / "p.csv")
    assert table.columns((0,)).tolist() == [[0], [1], [2]]
    with pytest.raises(CrankworkError, match=r'line 4: "1.000" has another decimal mark than the numbers before it'):
        table.columns((0, 1))


def test_one_heading_of_two_columns_is_asked_about(tmp_path):
    (tmp_path / "p.csv").write_text("phi,p,p\n0,1,2\n1,2,3\n2,3,4\n")
    with pytest.raises(CrankworkError, match=r'"p" stands above columns 2 and 3; write the number of one of them'):
        read_table(tmp_path / "p.csv").position("p")


def _workbook(path, **sheets):
    with xlsxwriter.Workbook(path) as book:
        for name, rows in sheets.items():
            sheet = book.add_worksheet(name)
            for at, row in enumerate(rows):
                sheet.write_row(at, 1, row)


ROWS = [
    ("Test of 2024", "ВМТ"),
    (),
    ("phi", "p"),
    ("[°]", "[bar]"),
    *zip(ANGLES.tolist(), PRESSURES.tolist(), strict=True),
]


def test_a_workbook_is_a_table(tmp_path):
    _workbook(tmp_path / "p.xlsx", first=ROWS, empty=[])
    table = read_table(tmp_path / "p.xlsx")
    assert (table.names, table.units) == (("", "phi", "p"), ("", "deg", "bar"))
    assert (table.heading, table.lines[0]) == (3, 5)
    assert table.columns((1, 2)).tolist() == [list(one) for one in ROWS[4:]]


def test_a_sheet_of_several_is_asked_for(tmp_path):
    _workbook(tmp_path / "p.xlsx", first=ROWS, second=ROWS[:40])
    with pytest.raises(CrankworkError, match=r'p.xlsx, write sheet = "first"; the sheets are "first" or "second"'):
        read_table(tmp_path / "p.xlsx")
    assert len(read_table(tmp_path / "p.xlsx", sheet="second").rows) == 36
    with pytest.raises(CrankworkError, match=r'the sheets are "first" or "second"'):
        read_table(tmp_path / "p.xlsx", sheet="third")


@pytest.mark.slow
@for_each(
    "data", [b"PK\x03\x04", b"PK\x03\x04" + b"x" * 99, "a zip", "a bomb", "entities", "no encoding", "a spoilt byte"]
)
def test_what_is_no_workbook_is_refused(tmp_path, data):
    path = tmp_path / "p.xlsx"
    if isinstance(data, bytes):
        path.write_bytes(data)
    else:
        _workbook(path, first=ROWS)
        with zipfile.ZipFile(path) as book:
            parts = {name: book.read(name) for name in book.namelist()}
        if data == "a zip":
            del parts["xl/workbook.xml"]
        if data == "a bomb":
            parts["xl/worksheets/sheet1.xml"] = b" " * (300 << 20)
        if data == "entities":
            parts["xl/workbook.xml"] = b'<!DOCTYPE x [<!ENTITY a "b">]>' + parts["xl/workbook.xml"]
        if data == "no encoding":
            parts["xl/workbook.xml"] = parts["xl/workbook.xml"].replace(b"UTF-8", b"UTF-X")
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as book:
            for name, part in parts.items():
                book.writestr(name, part)
        if data == "a spoilt byte":
            with zipfile.ZipFile(path) as book:
                at = book.getinfo("xl/worksheets/sheet1.xml").header_offset + 60
            packed = path.read_bytes()
            path.write_bytes(packed[:at] + bytes(64) + packed[at + 64 :])
    with pytest.raises(CrankworkError, match=r"p.xlsx, is no workbook of Excel|larger than 256 MB"):
        read_table(path)


def test_a_sheet_of_a_text_is_refused(tmp_path):
    (tmp_path / "p.csv").write_text(WRITTEN["commas"])
    with pytest.raises(CrankworkError, match="is no workbook and has no sheets; leave sheet out"):
        read_table(tmp_path / "p.csv", sheet="first")

"""The cells of a sheet of an Excel workbook as lines of text, columns separated by tabs."""

from __future__ import annotations

import io
import posixpath
import re
import zipfile
import zlib
from collections.abc import Iterator
from xml.etree import ElementTree as ET

from crankwork import files
from crankwork.locale import ErrorMessage

START = b"PK\x03\x04"
_LARGEST = 4 * files.MAX_DATA_FILE
# errors of damaged, encrypted or differently packed parts
_BROKEN = (zipfile.BadZipFile, zlib.error, ET.ParseError, LookupError, EOFError, RuntimeError, OSError)
_MOST_ROWS, _MOST_COLUMNS = 1_048_576, 16_384
_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_ID = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_MERGED = re.compile(r'<mergeCell ref="([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})\2"')
_CELL = re.compile(r"([A-Z]{1,3})([0-9]{1,7})")


def workbook_text(data: bytes, sheet: str | None = None) -> str:
    """Return the text of a sheet, by name or the only sheet with content; ValueError with the names of sheets."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as book:
            _check_size(book)
            return _sheet_text(book, sheet)
    except _BROKEN:
        raise ValueError(ErrorMessage("workbook_none")) from None


def _sheet_text(book: zipfile.ZipFile, wanted: str | None) -> str:
    related = {link.get("Id", ""): link.get("Target", "") for link in _root(book, "xl/_rels/workbook.xml.rels")}
    sheets = {
        sheet_element.get("name", ""): posixpath.join("xl", related[sheet_element.get(_ID, "")]).lstrip("/")
        for sheet_element in _root(book, "xl/workbook.xml").iter(f"{_MAIN}sheet")
    }
    filled = [name for name, member in sheets.items() if b"<v>" in _read(book, member)]
    if wanted not in sheets and (wanted is not None or len(filled) != 1):
        known = tuple(f'"{title[:60]}"' for title in list(sheets)[:12])
        raise ValueError(ErrorMessage("workbook_sheet", known=known, example=f'"{(filled or list(sheets))[0][:60]}"'))
    words = []
    if "xl/sharedStrings.xml" in book.namelist():
        words = [_words(item) for item in _root(book, "xl/sharedStrings.xml").iter(f"{_MAIN}si")]
    data, rows = _read(book, sheets[filled[0] if wanted is None else wanted]), list[list[str]]()
    for number, row in _rows(data, words):
        rows += [[] for _ in range(number - 1 - len(rows))]
        rows.append(row)
    # a heading over merged columns is that of each
    for first, start, last in _MERGED.findall(data.decode(errors="replace")):
        left, number, right = _column(first) - 1, int(start) - 1, min(_column(last), _MOST_COLUMNS)
        if number < len(rows) and left < len(rows[number]) and right > left + 1:
            rows[number][left:right] = [rows[number][left]] * (right - left)
    return "\n".join("\t".join(row) for row in rows)


def _check_size(book: zipfile.ZipFile) -> None:
    """Raise if the parts of a workbook are too large."""
    if sum(member.file_size for member in book.infolist()) > _LARGEST:
        raise ValueError(ErrorMessage("workbook_large", size=_LARGEST >> 20))


def _read(book: zipfile.ZipFile, name: str) -> bytes:
    """Return a part of a workbook; raise if it has external references."""
    data = book.read(name)
    if b"<!DOCTYPE" in data or b"\0" in data:
        raise ValueError(ErrorMessage("workbook_none"))
    return data


def _root(book: zipfile.ZipFile, name: str) -> ET.Element:
    return ET.fromstring(_read(book, name))  # noqa: S314 - as above


def _words(element: ET.Element) -> str:
    return " ".join("".join(text.text or "" for text in element.iter(f"{_MAIN}t")).split())


def _rows(data: bytes, words: list[str]) -> Iterator[tuple[int, list[str]]]:
    """Yield the number and the cells of every row, from the first column on."""
    number = 0
    for _, row in ET.iterparse(io.BytesIO(data)):  # noqa: S314 - as above
        if row.tag != f"{_MAIN}row":
            continue
        stated = row.get("r", "")
        number = max(number + 1, min(int(stated), _MOST_ROWS)) if stated.isdecimal() else number + 1
        cells: list[str] = []
        for cell in row.iter(f"{_MAIN}c"):
            match = _CELL.fullmatch(cell.get("r", ""))
            cells += [""] * (min(_column(match[1]), _MOST_COLUMNS) - 1 - len(cells)) if match else []
            cells.append(_shown(cell, words))
        row.clear()
        yield number, cells


def _column(letters: str) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - 64
    return number


def _shown(cell: ET.Element, words: list[str]) -> str:
    kind, value = cell.get("t", "n"), cell.findtext(f"{_MAIN}v", "")
    if kind == "s":
        return words[int(value)] if value.isdecimal() and int(value) < len(words) else ""
    return _words(cell) if kind == "inlineStr" else " ".join(value.split())

"""Tables of numbers as test benches and programs write them: words before the numbers, any separator and encoding.

Lists of a machine file that refer to their columns are replaced before values are read.
"""

from __future__ import annotations

import codecs
import contextlib
import copy
import csv
import io
import itertools
import math
import posixpath
import re
import unicodedata
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import numpy as np

from crankwork import files
from crankwork.description.schema import ListOf, MapOf, NumberOr, TableSpec
from crankwork.description.value_types import Quantity, Reader, ValueType
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.units import EXAMPLES, UNITS, first_spelling, known_unit

# lines in which the numbers must begin, and characters in a line
_FIRST_LINES = 2000
_LONGEST_LINE = 131_072
_LARGEST = 1e12
_FEWEST_ROWS = 3
# lines below a table with one number on each
_MOST_WORDS = 12
_MARKS = ("#", "%", "!", "//")
_BLANKS = re.compile(r"\s{2,}|\t")
# separators in order of preference; None: blanks
_SEPARATORS = (";", "\t", ",", None)
_BRACKETED = re.compile(r"(.*\S)\s*[\[(]\s*([^\[\]()]*(?:\([^()]*\))?)\s*[\])]\.?")
_BRACKETS = re.compile(r"[\[(].*?[\])]")
_DIVIDING = re.compile(r"\s*[,/]\s*|\s+|_")
_IN_BRACKETS = re.compile(r"[\[(](.*)[\])]")
_NUMBER_LAST = re.compile(r"(?:^|[\s_,/=@])\d[\d.,]*$")
# suffixes of units of crank angle, and of pressure
_OF_CRANK = re.compile(
    r"(?:^ca|^пкв|(?<=.)[\s.]*(?:ca|kw|пкв|п\.к\.в|[ab]\.?tdc|abdc|(?:после|після|до|перед|от|від|từ|sau|trước|truoc|nach|vor)\s*(?:вмт|đct|dct|ot))f?)"
    r"(?:[\s,(]+[^\d/]*)?\.?$",
    re.IGNORECASE,
)
_OF_REFERENCE = re.compile(
    r"(?<=..)[\s(]*(?:absolute|abs|gauge|a|g|абс\w*|изб\w*|надл\w*|dư|tuyệt đối)\.?\)?$", re.IGNORECASE
)
# unknown units of derivatives by the angle and of other quantities
_QUOTIENT = re.compile(r"[\w°³²·*^%]{1,8}(?:/[\w°³²·*^]{1,8}){1,3}")
_UNITLESS = ("", "-", "–", "1", "[-]", "[]", "(-)", "%")
_UNIT_NAMES = {
    **dict.fromkeys(("degree", "degrees", "cad", "grad", "градусы", "градусов", "гр"), "deg"),
    # kg/cm2 in old files means kgf/cm2
    **dict.fromkeys(("kg/cm2", "kg/cm²", "кг/см2", "кг/см²"), "kgf/cm2"),
    **dict.fromkeys(("radian", "radians", "радианы"), "rad"),
}
# short units differ by their capitals
_BY_CASE = {name.casefold(): name for name in reversed(UNITS) if len(name) > 2}
# numbers with marks between thousands, by the mark between them: 1.013,1 and 1,013.1
_THOUSANDS = {
    mark: re.compile(rf"[+-]?\d{{1,3}}(?:{re.escape(mark)}\d{{3}})*(?:{re.escape(other)}\d+)?")
    for mark, other in ((".", ","), (",", "."))
}
_WITH_THOUSANDS = {
    mark: re.compile(rf"(?<![\d.,])\d{{1,3}}(?:[{mark}]\d{{3}})+[{other}]\d+")
    for mark, other in ((".", ","), (",", "."))
}
# spaces that do not break, between thousands
_HARD_SPACES = re.compile(r"(?<=\d)[\u00a0\u202f\u2009](?=\d{3})")
_ABSENT = ("n/a", "na", "nan", "-", "–", "--", "#n/a")
_CYRILLIC = re.compile(rb"[\xc0-\xff\xa8\xb8]{3}")
START = b"PK\x03\x04"
_LARGEST_BOOK = 4 * files.MAX_DATA_FILE
# errors of damaged, encrypted or differently packed parts
_BROKEN = (zipfile.BadZipFile, zlib.error, ET.ParseError, LookupError, EOFError, RuntimeError, OSError)
_MOST_ROWS, _MOST_COLUMNS = 1_048_576, 16_384
_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_ID = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_MERGED = re.compile(r'<mergeCell ref="([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})\2"')
_CELL = re.compile(r"([A-Z]{1,3})([0-9]{1,7})")
_REFERENCE = {"column", "unit"}


@dataclass(frozen=True)
class FileTable:
    """The block of numbers in a file: headings of its columns, their units, and its rows as they are written."""

    file: str
    names: tuple[str, ...]  # As in the file, with the unit in them; empty if missing
    units: tuple[str, ...]  # As in the table of units; empty if missing or unknown
    written: tuple[str, ...]  # Units as the file writes them
    heading: int  # Line of the headings, or of the first row without them
    lines: Sequence[int] = field(repr=False)  # Line of every row
    rows: Sequence[str] = field(repr=False)
    separator: str | None
    thousands: str = ""  # Mark between thousands
    notices: tuple[tuple[str, Mapping[str, float | str]], ...] = ()  # How the file was read

    def position(self, column: str | float) -> int:
        """Return the index of a column by its heading, with or without its unit, or by its number."""
        count = len(self.names)
        if not isinstance(column, str):
            if not 1 <= column <= count:
                raise self.refused("table_number", number=f"{column:g}", count=str(count))
            return int(column) - 1
        column = unicodedata.normalize("NFC", column).strip()
        for spell in (str, lambda name: _split_unit(name)[0], lambda name: _split_unit(name)[0].casefold()):
            indices = [index for index, name in enumerate(self.names) if name and spell(name) == spell(column)]
            if len(indices) > 1:
                numbers = [str(index + 1) for index in indices]
                raise self.refused("table_twice", line=self.heading, name=column, numbers=numbers)
            if indices:
                return indices[0]
        known = ", ".join(name or "–" for name in self.names)[:200]
        raise self.refused("measured_absent", line=self.heading, name=column, known=known)

    def label(self, position: int) -> str:
        """Return number and heading of a column for a message."""
        name = self.names[position]
        return f'{position + 1} ("{name[:60]}")' if name else str(position + 1)

    def columns(self, positions: Sequence[int]) -> Array:
        """Return the numbers of some columns, shape (rows, columns); raise with the line of every invalid cell."""
        text = self.rows
        has_commas = self.separator != "," and any("," in row for row in text)
        has_both = has_commas and any("." in row for row in text)
        if has_commas:
            text = [row.replace(",", ".") for row in text]
        # uneven rows are read cell by cell
        with contextlib.suppress(ValueError):
            if not (has_both or self.thousands) and not any('"' in row for row in text) and self._is_even(text):
                numbers = np.loadtxt(text, delimiter=self.separator, usecols=positions, comments=None, ndmin=2)
                if np.all(np.abs(numbers) < _LARGEST):
                    return numbers
        marks: set[str] = set()
        mistakes, cells = list[str](), list[list[float]]()
        for line, row in zip(self.lines, self.rows, strict=True):
            try:
                cells.append(self._numbers(line, row, positions, marks))
            except CrankworkError as error:
                mistakes += error.args
        if mistakes:
            raise CrankworkError(*mistakes)
        return np.array(cells)

    def readable(self, position: int) -> Array:
        """Return the numbers of a column in the rows that have one, 0 without any."""
        cells = (_cells(row, self.separator)[position : position + 1] for row in self.rows)
        numbers = (_float(cell) for cell in itertools.chain.from_iterable(cells))
        return np.array([number for number in numbers if number is not None and abs(number) < _LARGEST] or [0.0])

    def _is_even(self, rows: Iterable[str]) -> bool:
        """Return whether every row has as many cells as there are columns."""
        if self.separator is None:
            return all(len(row.split()) == len(self.names) for row in rows)
        wanted = (len(self.names) - 1, len(self.names))
        counts = {row.count(self.separator) for row in rows}
        # an extra separator ends every row, or is a mistake
        return counts == {wanted[0]} or (
            counts == {wanted[1]} and all(row.rstrip(" ").endswith(self.separator) for row in self.rows)
        )

    def _numbers(self, line: int, row: str, positions: Sequence[int], marks: set[str]) -> list[float]:
        """Return the numbers of a row; `marks`: the decimal marks so far, only one is allowed."""
        cells = _cells(row, self.separator)
        while len(cells) > len(self.names) and not cells[-1].strip():
            cells.pop()
        if len(cells) != len(self.names):
            values = {"line": line, "count": len(cells), "first": self.lines[0], "wanted": len(self.names)}
            raise self.refused("measured_columns", **values)
        if self.thousands:
            pattern = _THOUSANDS[self.thousands]
            cells = [cell.replace(self.thousands, "") if pattern.fullmatch(cell.strip()) else cell for cell in cells]
        numbers = [_float(cells[position]) for position in positions]
        for number, position in zip(numbers, positions, strict=True):
            if number is None or not abs(number) < _LARGEST:
                raise self.refused("measured_no_number", line=line, cell=cells[position].strip()[:40])
            own = {mark for mark in ".," if mark in cells[position]}
            if len(marks | own) > 1:
                raise self.refused("table_marks", line=line, cell=cells[position].strip()[:40])
            marks |= own
        return [number for number in numbers if number is not None]

    def refused(self, name: str, /, **values: object) -> CrankworkError:
        """Return an error about the file."""
        return CrankworkError(ErrorMessage("in_file", file=self.file, mistake=ErrorMessage(name, **values)))


def read_table(path: str | Path, *, name: str = "", sheet: str | None = None) -> FileTable:
    """Return the table of numbers in a text or an Excel workbook, wherever it begins.

    `name`: of the file in messages; `sheet`: of a workbook. CrankworkError with line and advice if there is no table.
    """
    path = Path(path)
    called = name or path.name
    try:
        text = unicodedata.normalize("NFC", _text(files.read_data(path), path, sheet)).replace("\N{MINUS SIGN}", "-")
        return _table(_HARD_SPACES.sub("", text), called)
    except ValueError as error:
        raise CrankworkError(ErrorMessage("in_file", file=called, mistake=error.args[0])) from None


def read_list(path: str | Path, *, name: str = "", sheet: str | None = None) -> list[tuple[int, float]]:
    """Return numbers one after another, several or one on a line, with their lines; words above them are left out."""
    numbers = list[tuple[int, float]]()
    for line, content in enumerate(_text(files.read_data(path), Path(path), sheet).splitlines(), start=1):
        for cell in re.split(r"[\s;]+", content.strip()):
            number = _float(cell.replace("\N{MINUS SIGN}", "-"))
            if number is not None and math.isfinite(number):
                numbers.append((line, number))
            elif cell and numbers:
                mistake = ErrorMessage("measured_no_number", line=line, cell=cell[:20])
                raise CrankworkError(ErrorMessage("in_file", file=name, mistake=mistake))
    return numbers


def _table(text: str, name: str) -> FileTable:
    """Return the table in a text."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if max(map(len, lines)) > _LONGEST_LINE:
        line = next(number for number, content in enumerate(lines, start=1) if len(content) > _LONGEST_LINE)
        raise ValueError(ErrorMessage("measured_cell", line=line))
    lines = [_unframed(content) for content in lines]
    filled = _filled(lines)
    if not filled:
        raise ValueError(ErrorMessage("measured_empty"))
    separator, start, count = _block([lines[number - 1] for number in filled[:_FIRST_LINES]])
    notices = list[tuple[str, Mapping[str, float | str]]]()
    # decimal commas look like commas between columns
    is_single = start < 0 or (separator == "," and any("," not in lines[number - 1] for number in filled[start:]))
    if is_single and _row_by_row(lines, filled):
        notices.append(("table_one_a_line", {"file": name}))
        filled = _filled(lines)
        separator, start, count = _block([lines[number - 1] for number in filled[:_FIRST_LINES]])
    if start < 0:
        single = next((number for number in filled if _float(lines[number - 1].strip(" \t;")) is not None), 0)
        raise ValueError(
            ErrorMessage("measured_one_column" if single else "measured_heading", line=single or filled[0])
        )
    # headings stand again at the top of every page
    above = {lines[number - 1].strip() for number in filled[:start]}
    numbers = [number for number in filled[start:] if lines[number - 1].strip() not in above]

    def begins_with_number(line: int) -> bool:
        return _float(next((cell for cell in _cells(lines[line - 1], separator) if cell.strip()), "")) is not None

    while begins_with_number(numbers[0]) and not begins_with_number(numbers[-1]):
        numbers.pop()
    if numbers[-1] < filled[-1]:
        notices.append(("table_footer", {"file": name, "line": str(filled[filled.index(numbers[-1]) + 1])}))
    if separator == "," and count > 2 and lines[numbers[0] - 2].count(",") + 1 == count / 2:
        raise ValueError(ErrorMessage("table_commas", line=numbers[0]))
    rows = [lines[number - 1] for number in numbers]
    width = len(_cells(rows[0], separator))
    heading, names, written = _headings(lines[: numbers[0] - 1], separator, (count, width))
    units = tuple(unit_of(unit) for unit in written)
    thousands = _thousands(numbers, rows, separator)
    if thousands:
        notices.append(("table_thousands", {"file": name, "mark": thousands}))
    table = FileTable(name, names, units, written, heading or numbers[0], numbers, rows, separator)
    return replace(table, thousands=thousands, notices=tuple(notices))


def _thousands(numbers: Sequence[int], rows: Sequence[str], separator: str | None) -> str:
    """Return the mark between thousands, empty for none; raise if few numbers have one."""
    # between commas only cells in quotes have thousands
    quoted = rows if separator != "," else ["".join(row.split('"')[1::2]) for row in rows]
    for mark, pattern in _WITH_THOUSANDS.items():
        marked = [(line, match[0]) for line, row in zip(numbers, quoted, strict=True) if (match := pattern.search(row))]
        if marked and len(marked) < _FEWEST_ROWS:
            line, cell = marked[0]
            raise ValueError(ErrorMessage("table_slip", line=line, cell=cell, number=cell.replace(mark, "")))
        if marked:
            return mark
    return ""


def _filled(lines: Sequence[str]) -> list[int]:
    """Return the numbers of the lines that hold something other than marks and comments."""
    return [
        number
        for number, content in enumerate(lines, start=1)
        if content.strip(" \t;,\ufeff") and not content.lstrip().startswith(_MARKS)
    ]


def _unframed(line: str) -> str:
    """Return a line of a table drawn with bars, as Markdown has it, between tabs; other lines are unchanged."""
    content = line.strip(" \ufeff")
    if content and set(content) <= set("|+-:= "):
        return ""
    return (
        content[1:-1].replace("|", "\t")
        if content.startswith("|") and content.endswith("|") and content != "|"
        else line
    )


def _row_by_row(lines: list[str], filled: Sequence[int]) -> bool:
    """Join the rows of a table whose cells stand one below the other; return whether it is one.

    The first number of each row rises evenly, as a crank angle does.
    """
    cells = [lines[number - 1].strip(" \t;,\ufeff") for number in filled]
    values = [_float(cell) for cell in cells]
    first = next((index for index, value in enumerate(values) if value is not None), len(values))
    # what is not a number and not a missing one ends the table
    words = (
        index for index in range(first, len(cells)) if values[index] is None and cells[index].lower() not in _ABSENT
    )
    end = next(words, len(cells))
    numbers = np.array(values[first:end], float)
    for count in range(2, 7 if end > len(cells) - _MOST_WORDS else 2):
        steps = np.diff(numbers[::count])
        if len(numbers) % count or len(steps) < _FEWEST_ROWS or not 0 < steps.max() < 1.5 * steps.min():
            continue
        begins = first - count if first >= count else first
        if end < len(cells):
            lines[filled[end] - 1], cells[end + 1 :] = " ".join(cells[end:]), [""] * len(cells[end + 1 :])
        for index in [*range(begins, end), *range(end + 1, len(cells))]:
            is_first = (index - begins) % count == 0
            lines[filled[index] - 1] = "\t".join(cells[index : min(index + count, end)]) if is_first else ""
        return True
    return False


def _block(lines: Sequence[str]) -> tuple[str | None, int, int]:
    """Return the separator of the numbers, the index of their first line, -1 for none, and the count of columns."""
    best: tuple[int, str | None, int, int] = (0, None, -1, 0)
    # rows of numbers only, else rows with at least half of numbers
    for share in (1.0, 0.5):
        for separator in _SEPARATORS:
            cells = [_without_end(_cells(line, separator)) for line in lines]
            rows = [index for index, row in enumerate(cells) if _share(row) >= share]
            if not rows:
                continue
            count, times = Counter(len(cells[index]) for index in rows).most_common(1)[0]
            if times <= best[0]:
                continue
            start = next(index for index in rows if len(cells[index]) == count)
            # include rows with a non-numeric cell; reading them reports the line
            while start and len(cells[start - 1]) == count and _float(cells[start - 1][0]) is not None:
                start -= 1
            best = (times, separator, start, count)
        if best[0]:
            break
    return best[1:]


def _share(cells: Sequence[str]) -> float:
    """Return the share of numbers among nonempty cells, 0 for fewer than two numbers."""
    filled = [_float(cell) is not None for cell in cells if cell.strip()]
    return sum(filled) / len(filled) if sum(filled) > 1 else 0.0


def _without_end(cells: list[str]) -> list[str]:
    """Return cells without empty last cells."""
    last = max((index for index, cell in enumerate(cells) if cell.strip()), default=0)
    return cells[: last + 1]


def _cells(line: str, separator: str | None) -> list[str]:
    if separator is None:
        return line.split()
    if '"' not in line:
        return line.split(separator)
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True))


def _headings(
    lines: Sequence[str], separator: str | None, counts: tuple[int, int]
) -> tuple[int, tuple[str, ...], tuple[str, ...]]:
    """Return the line of the headings, 0 for none, the headings, and the unit of each column as written.

    `counts`: of the columns with numbers, and with empty ones after them.
    """
    nearest = list(_divided(lines, separator, counts))
    of_units = next((cells for _, cells in nearest if _are_units(cells)), None)
    named = [(number, cells) for number, cells in nearest if cells is not of_units]
    line, names = named[0] if named else (0, ("",) * counts[0])
    for _, cells in named[1:]:
        # a heading of two lines names some columns in the upper one
        names = tuple(name or upper for name, upper in zip(names, cells, strict=True))
    units = tuple(_split_unit(name)[1] for name in names)
    for _, cells in named[1:]:
        above = (_split_unit(cell)[1] for cell in cells)
        units = tuple(unit or upper * bool(unit_of(upper)) for unit, upper in zip(units, above, strict=True))
    return line, names, of_units or units


def _divided(
    above: Sequence[str], separator: str | None, counts: tuple[int, int]
) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield the last two lines above the numbers, the nearest first, while they have as many cells as the numbers."""
    written = [(number, content) for number, content in enumerate(above, start=1) if content.strip(" \t;,-=+|_#%")]
    for number, content in written[:-3:-1]:
        line = content.strip("\ufeff ")
        for mark in _MARKS:
            line = line.removeprefix(mark)
        # a line of the preamble, unless brackets tell what zero is
        splits = _splits(line, separator) if "=" not in _BRACKETS.sub("", line) else ()
        cells = next((cells for cells in splits if len(cells) in counts and any(cell.strip() for cell in cells)), None)
        if cells is None:
            return
        yield number, tuple(_plain(cell) for cell in cells[: counts[0]])


def _plain(cell: str) -> str:
    """Return a heading as printable text on one line."""
    return " ".join("".join(character if character.isprintable() else " " for character in cell).split()).strip('"')


def _splits(line: str, separator: str | None) -> Iterator[list[str]]:
    """Yield the cells of a heading for each possible separator."""
    for mark in (separator, ";", "\t", ","):
        if mark is not None and mark in line:
            cells = _cells(line, mark)
            yield cells
            yield _without_end(cells)
    yield _BLANKS.split(line.strip())
    yield _words(line)


def _words(line: str) -> list[str]:
    """Return the words of a heading, each with the unit in brackets after it."""
    joined: list[str] = []
    for word in line.split():
        if joined and (word.startswith(("[", "(")) or joined[-1].count("[") > joined[-1].count("]")):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    return joined


def _are_units(cells: Sequence[str]) -> bool:
    """Return whether cells are a line of units: some are known, and the others are no words."""
    known = [bool(unit_of(cell)) for cell in cells]
    bracketed = [cell.strip().startswith(("[", "(")) for cell in cells]
    return any(known) and all(
        is_known or inside or cell.strip() in _UNITLESS or bool(_QUOTIENT.fullmatch(cell.strip()))
        for is_known, inside, cell in zip(known, bracketed, cells, strict=True)
    )


def _split_unit(heading: str) -> tuple[str, str]:
    """Return a heading without its unit, and the unit as written."""
    match = _BRACKETED.fullmatch(heading.strip())
    if match:
        # a remark may follow the unit
        before = ("", "") if unit_of(match[2]) else _split_unit(match[1])
        return before if unit_of(before[1]) else (match[1].rstrip(" ,/"), match[2])
    for mark in _DIVIDING.finditer(heading.strip()):
        name, unit = heading.strip()[: mark.start()], heading.strip()[mark.end() :]
        # 800 rpm is an operating point, not a unit
        if name and unit_of(unit) and not name.isdecimal() and not _NUMBER_LAST.search(name):
            return name, unit
    return heading.strip(), ""


def unit_of(written: str) -> str:
    """Return a unit as spelled in the table of units, empty if unknown.

    Examples
    --------
    >>> unit_of("[°CA]"), unit_of("BAR(a)"), unit_of("furlong")
    ('deg', 'bar', '')
    """
    text = written.strip()
    inside = _IN_BRACKETS.fullmatch(text)
    text = (inside[1] if inside else text).strip()
    for spelling in (text, _OF_CRANK.sub("", text) or "deg", _OF_REFERENCE.sub("", text)):
        if text and (unit := _known_unit(spelling)):
            return unit
    return ""


def _known_unit(text: str) -> str:
    name = _UNIT_NAMES.get(text.casefold(), text)
    name = known_unit(name) or _BY_CASE.get(name.casefold(), "")
    return first_spelling(UNITS[name]) if name else ""


def _float(cell: str) -> float | None:
    cell = cell.strip()
    for mark, pattern in _THOUSANDS.items():
        if "." in cell and "," in cell and pattern.fullmatch(cell):
            cell = cell.replace(mark, "")
    try:
        return None if "_" in cell else float(cell.replace(",", "."))
    except ValueError:
        return None


def _text(data: bytes, path: Path, sheet: str | None) -> str:
    """Return bytes as text in their likely encoding, or the text of a sheet of a workbook."""
    if data.startswith(START):
        return workbook_text(data, sheet)
    if sheet is not None:
        raise ValueError(ErrorMessage("workbook_needed"))
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode("utf-16")
    if b"\0" in data:
        raise CrankworkError(ErrorMessage("path_binary", path=path, line=data.count(b"\n", 0, data.index(0)) + 1))
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Cyrillic words are sequences of bytes above 0xC0; in Latin-1 these bytes are single
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode("cp1251" if _CYRILLIC.search(data) else "latin-1")
        return data.decode("latin-1")


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
        words = [_shared_words(item) for item in _root(book, "xl/sharedStrings.xml").iter(f"{_MAIN}si")]
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
    if sum(member.file_size for member in book.infolist()) > _LARGEST_BOOK:
        raise ValueError(ErrorMessage("workbook_large", size=_LARGEST_BOOK >> 20))


def _read(book: zipfile.ZipFile, name: str) -> bytes:
    """Return a part of a workbook; raise if it has external references."""
    data = book.read(name)
    if b"<!DOCTYPE" in data or b"\0" in data:
        raise ValueError(ErrorMessage("workbook_none"))
    return data


def _root(book: zipfile.ZipFile, name: str) -> ET.Element:
    return ET.fromstring(_read(book, name))  # noqa: S314 - as above


def _shared_words(element: ET.Element) -> str:
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
    return _shared_words(cell) if kind == "inlineStr" else " ".join(value.split())


class _Place(NamedTuple):
    """A key whose value names a column: its table, the type of its entries, and its path."""

    holder: dict[str, Any]
    name: str
    entry: ValueType
    path: str


def resolve_file_columns(values: dict[str, Any], keys: TableSpec, reader: Reader) -> dict[str, Any]:
    """Return values with names of columns replaced by their numbers; report missing columns."""
    if not any(path for path, _, _ in _tables("", values, keys)):
        return values
    values = copy.deepcopy(values)
    for path, table, kind in _tables("", values, keys):
        file = table["file"]
        places = list(_places(path, table, kind))
        if not places:
            example = next(name for name, key in kind.keys.items() if _takes_columns(key.kind))
            reader.add_error(f"{path}.file", ErrorMessage("file_unused", example=example))
        sheet = table["sheet"] if isinstance(table.get("sheet"), str) else None
        try:
            read = read_table(reader.folder / file, name=file, sheet=sheet) if places else None
        except CrankworkError as error:
            # consequences of an unreadable file are not reported
            reader.add_error(f"{path}.file", *error.args, meant=path)
            read = None
        reader.notices += [(code, dict(details)) for code, details in read.notices] if read else []
        for place in places if read else ():
            try:
                place.holder[place.name] = _numbers_of(read, place) if read else []
            except CrankworkError as error:
                reader.add_error(place.path, *error.args, meant=path)
                del place.holder[place.name]
    return values


def _tables(path: str, value: object, kind: object) -> Iterator[tuple[str, dict[str, Any], TableSpec]]:
    """Yield the tables that name a file for their columns."""
    match kind:
        case TableSpec(keys=keys) if isinstance(value, dict):
            if isinstance(value.get("file"), str) and any(_takes_columns(key.kind) for key in keys.values()):
                yield path, value, kind
            for name, key in keys.items():
                yield from _tables(f"{path}.{name}".lstrip("."), value.get(name), key.kind)
        case ListOf(entry=TableSpec() as entry) if isinstance(value, list):
            for number, item in enumerate(value, start=1):
                yield from _tables(f"{path}[{number}]", item, entry)


def _places(path: str, table: dict[str, Any], kind: TableSpec) -> Iterator[_Place]:
    """Yield the keys of a table, and of those in it, that name a column."""
    for name, key in kind.keys.items():
        value = table.get(name)
        match key.kind:
            case ListOf(entry=entry, from_file=True) if value is not None and not isinstance(value, list):
                yield _Place(table, name, entry, f"{path}.{name}")
            case MapOf(entry=TableSpec() as inner) if isinstance(value, dict):
                for own, table_value in value.items():
                    if isinstance(table_value, dict):
                        yield from _places(f"{path}.{name}.{own}", table_value, inner)


def _takes_columns(kind: object) -> bool:
    return isinstance(kind, ListOf) and kind.from_file


def _numbers_of(table: FileTable, place: _Place) -> list[Any]:
    """Return the numbers of a column, with the unit of the machine file or else of the table."""
    value = place.holder[place.name]
    stated = value if isinstance(value, dict) and set(value) <= _REFERENCE else {"column": value}
    column, unit = stated.get("column"), stated.get("unit", "")
    if not isinstance(column, str | int) or isinstance(column, bool) or not isinstance(unit, str):
        raise CrankworkError(ErrorMessage("column_form", key=place.name))
    position = table.position(column)
    numbers: list[float] = table.columns((position,))[:, 0].tolist()
    unit = (known_unit(unit) or unit) if unit else table.units[position]
    entry = place.entry
    if isinstance(entry, NumberOr):
        # a column without a unit that has no other numbers is one of shares
        entry = entry.quantity if unit or not 0.0 <= min(numbers) <= max(numbers) <= 1.0 else entry.number
    if not isinstance(entry, Quantity):
        return numbers
    if unit not in UNITS or UNITS[unit].dimension not in entry.dimensions:
        example = EXAMPLES[entry.dimensions[0]].split()[1]
        name = f'"{column}"' if isinstance(column, str) else str(column)
        raise table.refused("column_unit", column=table.label(position), key=place.name, name=name, unit=example)
    return [f"{number!r} {unit}" for number in numbers]

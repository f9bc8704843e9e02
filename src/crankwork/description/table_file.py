"""Tables of numbers as test benches and programs write them: words before the numbers, any separator and encoding."""

from __future__ import annotations

import codecs
import contextlib
import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from crankwork import files
from crankwork.description.workbook import START, workbook_text
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.units import UNITS

# lines in which the numbers must begin, and characters in one line
_FIRST_LINES = 2000
_LONGEST_LINE = 131_072
_LARGEST = 1e12
_MARKS = ("#", "%", "!", "//")
_BLANKS = re.compile(r"\s{2,}|\t")
# separators in the order in which they are believed; None: blanks
_SEPARATORS = (";", "\t", ",", None)
_BRACKETED = re.compile(r"(.*\S)\s*[\[(]\s*([^\[\]()]*(?:\([^()]*\))?)\s*[\])]\.?")
_DIVIDING = re.compile(r"\s*[,/]\s*|\s+|_")
_IN_BRACKETS = re.compile(r"[\[(](.*)[\])]")
_NUMBER_LAST = re.compile(r"(?:^|[\s_,/=@])\d[\d.,]*$")
# what stands behind a unit of crank angle, and behind one of pressure
_OF_CRANK = re.compile(r"(?:^ca|^пкв|(?<=.)[\s.]*(?:ca|kw|пкв|п\.к\.в|atdc|abdc|btdc))\.?$", re.IGNORECASE)
_OF_REFERENCE = re.compile(r"(?<=..)[\s(]*(?:absolute|abs|gauge|a|g|абс|изб)\.?\)?$", re.IGNORECASE)
# units that are not in the table, of derivatives by the angle and of other quantities
_QUOTIENT = re.compile(r"[\w°³²·*^%]{1,8}(?:/[\w°³²·*^]{1,8}){1,3}")
_UNITLESS = ("", "-", "–", "1", "[-]", "[]", "(-)", "%")
_SPOKEN = {
    **dict.fromkeys(("degree", "degrees", "cad", "grad", "градусы", "градусов", "гр"), "deg"),
    # as weights once were forces
    **dict.fromkeys(("kg/cm2", "kg/cm²", "кг/см2", "кг/см²"), "kgf/cm2"),
    **dict.fromkeys(("radian", "radians", "радианы"), "rad"),
}
_FIRST = {unit: name for name, unit in reversed(UNITS.items())}
# short units differ by their capitals
_BY_CASE = {name.casefold(): name for name in reversed(UNITS) if len(name) > 2}
_CYRILLIC = re.compile(rb"[\xc0-\xff\xa8\xb8]{3}")


@dataclass(frozen=True)
class FileTable:
    """The block of numbers in a file: headings of its columns, their units, and its rows as they are written."""

    file: str
    names: tuple[str, ...]  # As the file writes them, with a unit that stands in them; empty where there is none
    units: tuple[str, ...]  # As the table of units spells them; empty where there is none, or one that is unknown
    written: tuple[str, ...]  # Units as the file writes them
    heading: int  # Line of the headings, or of the first row where there are none
    lines: Sequence[int] = field(repr=False)  # Line of every row
    rows: Sequence[str] = field(repr=False)
    separator: str | None

    def position(self, column: str | float) -> int:
        """Return the position of a column that is named by its heading, with or without its unit, or by its number."""
        count = len(self.names)
        if not isinstance(column, str):
            if not 1 <= column <= count:
                raise self.refused("table_number", number=f"{column:g}", count=str(count))
            return int(column) - 1
        for spell in (str, lambda name: _apart(name)[0], lambda name: _apart(name)[0].casefold()):
            found = [at for at, name in enumerate(self.names) if name and spell(name) == spell(column.strip())]
            if len(found) > 1:
                numbers = [str(at + 1) for at in found]
                raise self.refused("table_twice", line=self.heading, name=column, numbers=numbers)
            if found:
                return found[0]
        known = ", ".join(name or "–" for name in self.names)[:200]
        raise self.refused("measured_absent", line=self.heading, name=column, known=known)

    def told(self, position: int) -> str:
        """Return the number of a column with its heading, for a message."""
        name = self.names[position]
        return f'{position + 1} ("{name[:60]}")' if name else str(position + 1)

    def columns(self, positions: Sequence[int]) -> Array:
        """Return the numbers of some columns, shape (rows, columns); raise with the line of what is none."""
        text = self.rows
        has_commas = self.separator != "," and any("," in one for one in text)
        has_both = has_commas and any("." in one for one in text)
        if has_commas:
            text = [one.replace(",", ".") for one in text]
        # the cells of a row that is not like the others are looked at one by one
        with contextlib.suppress(ValueError):
            if not has_both and not any('"' in one for one in text) and self._is_even(text):
                found = np.loadtxt(text, delimiter=self.separator, usecols=positions, comments=None, ndmin=2)
                if np.all(np.abs(found) < _LARGEST):
                    return found
        marks: set[str] = set()
        return np.array([self._numbers(*one, positions, marks) for one in zip(self.lines, self.rows, strict=True)])

    def _is_even(self, rows: Iterable[str]) -> bool:
        """Return whether every row has as many cells as there are columns."""
        if self.separator is None:
            return all(len(one.split()) == len(self.names) for one in rows)
        wanted = (len(self.names) - 1, len(self.names))
        counts = {one.count(self.separator) for one in rows}
        # one separator more than the others is at the end of every row, or a mistake
        return counts == {wanted[0]} or (counts == {wanted[1]} and self._ends_in_separator())

    def _ends_in_separator(self) -> bool:
        return all(one.rstrip(" ").endswith(self.separator or " ") for one in self.rows)

    def _numbers(self, line: int, row: str, positions: Sequence[int], marks: set[str]) -> list[float]:
        """Return the numbers of a row; `marks` are the decimal marks so far, of which there is to be one."""
        cells = _cells(row, self.separator)
        if len(cells) == len(self.names) + 1 and not cells[-1].strip():
            cells.pop()
        if len(cells) != len(self.names):
            values = {"line": line, "count": len(cells), "first": self.lines[0], "wanted": len(self.names)}
            raise self.refused("measured_columns", **values)
        found = [_float(cells[at]) for at in positions]
        for number, at in zip(found, positions, strict=True):
            if number is None or not abs(number) < _LARGEST:
                raise self.refused("measured_no_number", line=line, cell=cells[at].strip()[:40])
            marks |= {mark for mark in ".," if mark in cells[at]}
            if len(marks) > 1:
                raise self.refused("table_marks", line=line, cell=cells[at].strip()[:40])
        return [number for number in found if number is not None]

    def refused(self, name: str, /, **values: object) -> CrankworkError:
        """Return what is said of the file."""
        return CrankworkError(Refusal("in_file", file=self.file, mistake=Refusal(name, **values)))


def read_table(path: str | Path, *, name: str = "", sheet: str | None = None) -> FileTable:
    """Return the table of numbers in a text or an Excel workbook, wherever it begins.

    `name`: what messages call the file; `sheet`: that of a workbook. CrankworkError if there is none, with the line and
    what to write.
    """
    path = Path(path)
    called = name or path.name
    try:
        return _table(_text(files.read_data(path), path, sheet), called)
    except ValueError as error:
        raise CrankworkError(Refusal("in_file", file=called, mistake=error.args[0])) from None


def _table(text: str, name: str) -> FileTable:
    """Return the table in a text."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if max(map(len, lines)) > _LONGEST_LINE:
        line = next(number for number, one in enumerate(lines, start=1) if len(one) > _LONGEST_LINE)
        raise ValueError(Refusal("measured_cell", line=line))
    filled = [
        number
        for number, one in enumerate(lines, start=1)
        if one.strip(" \t;,\ufeff") and not one.lstrip().startswith(_MARKS)
    ]
    if not filled:
        raise ValueError(Refusal("measured_empty"))
    separator, start, count = _block([lines[number - 1] for number in filled[:_FIRST_LINES]])
    if start < 0:
        single = next((one for one in filled if _float(lines[one - 1].strip(" \t;")) is not None), 0)
        told = "measured_one_column" if single else "measured_heading"
        raise ValueError(Refusal(told, line=single or filled[0]))
    numbers = filled[start:]
    if separator == "," and count > 2 and lines[numbers[0] - 2].count(",") + 1 == count / 2:
        raise ValueError(Refusal("table_commas", line=numbers[0]))
    heading, names, written = _headings(lines[: numbers[0] - 1], separator, count)
    rows = [lines[number - 1] for number in numbers]
    units = tuple(unit_of(one) for one in written)
    return FileTable(name, names, units, written, heading or numbers[0], numbers, rows, separator)


def _block(lines: Sequence[str]) -> tuple[str | None, int, int]:
    """Return the separator of the numbers, the first of the lines that has them, -1 for none, and how many columns."""
    best: tuple[int, str | None, int, int] = (0, None, -1, 0)
    # rows of nothing but numbers; else columns of words beside two of numbers
    for share in (1.0, 0.5):
        for separator in _SEPARATORS:
            cells = [_without_end(_cells(one, separator)) for one in lines]
            rows = [at for at, one in enumerate(cells) if _share(one) >= share]
            if not rows:
                continue
            count, times = Counter(len(cells[at]) for at in rows).most_common(1)[0]
            if times <= best[0]:
                continue
            start = next(at for at in rows if len(cells[at]) == count)
            # a row with a cell that is no number is a row, which is told when it is read
            while start and len(cells[start - 1]) == count and _float(cells[start - 1][0]) is not None:
                start -= 1
            best = (times, separator, start, count)
        if best[0]:
            break
    return best[1:]


def _share(cells: Sequence[str]) -> float:
    """Return how many of the cells that hold something are numbers, none where there are not two."""
    filled = [_float(one) is not None for one in cells if one.strip()]
    return sum(filled) / len(filled) if sum(filled) > 1 else 0.0


def _without_end(cells: list[str]) -> list[str]:
    """Return cells without an empty one behind the last separator."""
    return cells[:-1] if len(cells) > 1 and not cells[-1].strip() else cells


def _cells(line: str, separator: str | None) -> list[str]:
    if separator is None:
        return line.split()
    if '"' not in line:
        return line.split(separator)
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True))


def _headings(above: Sequence[str], separator: str | None, count: int) -> tuple[int, tuple[str, ...], tuple[str, ...]]:
    """Return the line of the headings, zero for none, the headings, and the unit of each column as it is written."""
    nearest = list(_divided(above, separator, count))
    of_units = next((one for _, one in nearest if _are_units(one)), None)
    line, names = next(((at, one) for at, one in nearest if one is not of_units), (0, ("",) * count))
    return line, names, of_units or tuple(_apart(one)[1] for one in names)


def _divided(above: Sequence[str], separator: str | None, count: int) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield the last two lines above the numbers, if they have as many cells as these, the nearest first."""
    written = [(number, one) for number, one in enumerate(above, start=1) if one.strip(" \t;,-=+|_#%")]
    for number, one in written[:-3:-1]:
        line = one.strip("\ufeff ")
        for mark in _MARKS:
            line = line.removeprefix(mark)
        ways = _ways(line, separator) if "=" not in line else ()
        cells = next((cells for cells in ways if len(cells) == count and any(cell.strip() for cell in cells)), None)
        if cells is None:
            return
        yield number, tuple(_plain(cell) for cell in cells)


def _plain(cell: str) -> str:
    """Return a heading that can be printed, on one line."""
    return " ".join("".join(one if one.isprintable() else " " for one in cell).split()).strip('"')


def _ways(line: str, separator: str | None) -> Iterator[list[str]]:
    """Yield the cells of a heading by each mark that may separate it."""
    for mark in (separator, ";", "\t", ","):
        if mark is not None and mark in line:
            cells = _cells(line, mark)
            yield cells
            yield _without_end(cells)
    yield _BLANKS.split(line.strip())
    yield _words(line)


def _words(line: str) -> list[str]:
    """Return the words of a heading, each with the unit in brackets behind it."""
    joined: list[str] = []
    for word in line.split():
        if joined and (word.startswith(("[", "(")) or joined[-1].count("[") > joined[-1].count("]")):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    return joined


def _are_units(cells: Sequence[str]) -> bool:
    """Return whether cells are a line of units: some are known, and no other is a word."""
    known = [bool(unit_of(one)) for one in cells]
    bracketed = [one.strip().startswith(("[", "(")) for one in cells]
    return any(known) and all(
        one or inside or cell.strip() in _UNITLESS or bool(_QUOTIENT.fullmatch(cell.strip()))
        for one, inside, cell in zip(known, bracketed, cells, strict=True)
    )


def _apart(heading: str) -> tuple[str, str]:
    """Return a heading without its unit, and the unit as it is written."""
    found = _BRACKETED.fullmatch(heading.strip())
    if found:
        return found[1].rstrip(" ,/"), found[2]
    for mark in _DIVIDING.finditer(heading.strip()):
        name, unit = heading.strip()[: mark.start()], heading.strip()[mark.end() :]
        # 800 rpm is where something was measured, and not its unit
        if name and unit_of(unit) and not name.isdecimal() and not _NUMBER_LAST.search(name):
            return name, unit
    return heading.strip(), ""


def unit_of(written: str) -> str:
    """Return a unit as the table of units spells it, however it is written in a file; empty if it is not known.

    Examples
    --------
    >>> unit_of("[°CA]"), unit_of("BAR(a)"), unit_of("furlong")
    ('deg', 'bar', '')
    """
    text = written.strip()
    inside = _IN_BRACKETS.fullmatch(text)
    text = (inside[1] if inside else text).strip()
    for one in (text, _OF_CRANK.sub("", text) or "deg", _OF_REFERENCE.sub("", text)):
        if text and (found := _known_unit(one)):
            return found
    return ""


def _known_unit(text: str) -> str:
    name = _SPOKEN.get(text.casefold(), text)
    name = name if name in UNITS else _BY_CASE.get(name.casefold(), "")
    return _FIRST[UNITS[name]] if name else ""


def _float(cell: str) -> float | None:
    try:
        return None if "_" in cell else float(cell.strip().replace(",", "."))
    except ValueError:
        return None


def _text(data: bytes, path: Path, sheet: str | None) -> str:
    """Return bytes as text in the encoding that they seem to have, and a workbook as the text of a sheet."""
    if data.startswith(START):
        return workbook_text(data, sheet)
    if sheet is not None:
        raise ValueError(Refusal("workbook_needed"))
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode("utf-16")
    if b"\0" in data:
        raise CrankworkError(Refusal("path_binary", path=path, line=data.count(b"\n", 0, data.index(0)) + 1))
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # words in Cyrillic are letters above 0xC0 in a row; in Latin-1 these stand alone, as degrees and umlauts do
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode("cp1251" if _CYRILLIC.search(data) else "latin-1")
        return data.decode("latin-1")

"""The title block of GOST 2.104, form 1: 185 x 55 mm in the lower right corner."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.note.sheets.words import Words
from crankwork.show.scene import SMALL, TEXT, TITLE, Box, Item, Text, line, printable, rectangle, text_width

BLOCK = Box(0.0, 0.0, 185.0, 55.0)
_COLUMNS = (7.0, 17.0, 40.0, 55.0, 65.0)
_ROLES = ("drawn", "checked", "technology", "", "standards", "approved")
_HEADS = ("change", "sheet", "document", "signature", "date")
_LONGEST = 80


class TitleBlock(NamedTuple):
    """What the title block says; what is empty is left to be filled in by hand.

    `designation` is the number of the document, `name` replaces the title of the sheet, `scale` and `mass` stand as
    they are written.
    """

    designation: str = ""
    name: str = ""
    organisation: str = ""
    material: str = ""
    drawn_by: str = ""
    checked_by: str = ""
    standards_by: str = ""
    approved_by: str = ""
    scale: str = ""
    mass: str = ""
    letter: str = ""
    sheet: int = 1
    sheets: int = 1


def title_block(block: TitleBlock, title: str, place: Box, words: Words) -> list[Item]:
    """Return the title block.

    `title`: what the sheet shows, where the block has no name of its own.
    """
    items = [rectangle(place, "thick", 1.0), *_lines(place), *_people(block, place, words)]
    right = [
        (125.0, 47.5, 60.0, 15.0, block.designation, TITLE + 2),
        (100.0, 27.5, 35.0, 25.0, block.name or title, TITLE),
        (100.0, 7.5, 35.0, 15.0, block.material, TEXT),
        (160.0, 7.5, 25.0, 15.0, block.organisation, TEXT),
        (142.5, 37.5, 7.5, 5.0, words.say("letter"), SMALL),
        (158.5, 37.5, 8.5, 5.0, words.say("mass"), SMALL),
        (176.0, 37.5, 9.0, 5.0, words.say("scale"), SMALL),
        (142.5, 27.5, 7.5, 15.0, block.letter, TEXT),
        (158.5, 27.5, 8.5, 15.0, block.mass, TEXT),
        (176.0, 27.5, 9.0, 15.0, block.scale, TEXT),
        (145.0, 17.5, 10.0, 5.0, f"{words.say('sheet')} {block.sheet}", SMALL),
        (170.0, 17.5, 15.0, 5.0, f"{words.say('sheets')} {block.sheets}", SMALL),
    ]
    for x, y, half, tall, text, height in right:
        items += _written((place.left + x, place.bottom + y), printable(text, _LONGEST), 2 * half - 2, tall, height)
    return items


def corner_cell(block: TitleBlock, frame: Box) -> list[Item]:
    """Return the cell in the upper left corner, 70 x 14 mm, with the designation upside down."""
    cell = Box(frame.left, frame.top - 14.0, 70.0, 14.0)
    text = printable(block.designation, _LONGEST)
    height = _fitting(text, cell.width - 4, TITLE)
    return [
        rectangle(cell, "thick", 1.0),
        Text((cell.left + cell.width / 2, cell.bottom + 7 + height / 2), text, height, "middle", 180.0),
    ]


def _lines(place: Box) -> list[Item]:
    """Return the lines of the form: thick around the fields, thin between empty rows."""
    x, y = place.left, place.bottom
    items: list[Item] = [line((x + at, y), (x + at, y + 55), "thick") for at in (17.0, 40.0, 55.0, 65.0)]
    items.append(line((x + 7, y + 30), (x + 7, y + 55), "thick"))
    for row in range(1, 11):
        kind = "thick" if row in (6, 7) else "thin"
        items.append(line((x, y + 5 * row), (x + 65, y + 5 * row), "thick" if kind == "thick" else "thin"))
    for start, end in (
        ((65, 40), (185, 40)), ((65, 15), (185, 15)), ((135, 0), (135, 40)), ((135, 35), (185, 35)),
        ((135, 20), (185, 20)), ((150, 20), (150, 40)), ((167, 20), (167, 40)), ((155, 15), (155, 20)),
    ):  # fmt: skip
        items.append(line((x + start[0], y + start[1]), (x + end[0], y + end[1]), "thick"))
    items += [line((x + at, y + 20), (x + at, y + 35)) for at in (140.0, 145.0)]
    return items


def _people(block: TitleBlock, place: Box, words: Words) -> list[Item]:
    """Return the heads of the columns to the left, and who did what."""
    items: list[Item] = []
    lefts = (0.0, *_COLUMNS[:-1])
    for key, left, right in zip(_HEADS, lefts, _COLUMNS, strict=True):
        middle = (place.left + (left + right) / 2, place.bottom + 32.5)
        items += _written(middle, words.say(key), right - left - 0.6, 5.0, SMALL)
    names = (block.drawn_by, block.checked_by, "", "", block.standards_by, block.approved_by)
    for count, (role, name) in enumerate(zip(_ROLES, names, strict=True)):
        foot = place.bottom + 25 - 5 * count + 1.25
        if role:
            text = words.say(role)
            items.append(Text((place.left + 0.8, foot), text, _fitting(text, 15.6, SMALL)))
        if name:
            text = printable(name, _LONGEST)
            items.append(Text((place.left + 17.8, foot), text, _fitting(text, 21.6, SMALL)))
    return items


def _fitting(text: str, room: float, height: float) -> float:
    """Return a height of letters at which a text fits into a room."""
    return min(height, height * room / max(text_width(text, height), 1e-9))


def _written(middle: tuple[float, float], text: str, room: float, tall: float, height: float) -> list[Item]:
    """Return a text around a middle, in as many rows as the field has room for, smaller if it is long."""
    if not text:
        return []
    rows = [text]
    while tall >= 10 and len(rows) < 3 and max(text_width(one, height) for one in rows) > room:
        rows = _broken(text, len(rows) + 1)
    height = min(tall / (1.75 * len(rows)), *(_fitting(one, room, height) for one in rows))
    step = 1.7 * height
    top = middle[1] + step * (len(rows) - 1) / 2 - height / 2
    return [Text((middle[0], top - step * count), one, height, "middle") for count, one in enumerate(rows)]


def _broken(text: str, count: int) -> list[str]:
    """Return a text in a number of rows of about equal length, broken between words."""
    rows, length = [""], text_width(text) / count
    for word in text.split():
        if rows[-1] and len(rows) < count and text_width(f"{rows[-1]} {word}") > 1.08 * length:
            rows.append(word)
        else:
            rows[-1] = f"{rows[-1]} {word}".strip()
    return rows

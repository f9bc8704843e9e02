"""What a drawing looks like where it is shown: in print, in colour, or on dark ground."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

from crankwork.show.scene import Drawing, Item, Polyline, pen_of

Theme = Literal["print", "colour", "dark"]
THEMES: tuple[Theme, ...] = get_args(Theme)


class Look(NamedTuple):
    """Colours of ground and letters, and of curves by how many dashes and gaps their lines have."""

    ground: str
    ink: str
    curves: dict[int, str]


# colours that those who confuse red and green tell apart (Okabe and Ito); curves keep their dashes
_LOOKS: dict[Theme, Look] = {
    "print": Look("#ffffff", "#000000", {}),
    "colour": Look("#ffffff", "#000000", {0: "#0072b2", 2: "#d55e00", 4: "#009e73"}),
    "dark": Look("#14171c", "#e8e8e8", {0: "#56b4e9", 2: "#e69f00", 4: "#2fc79a"}),
}
_DOTTED: dict[Theme, str] = {"colour": "#a6548a", "dark": "#dd9fc4"}
# a dash shorter than this is a dot, in widths of its line
_DOT = 1.5
_BLACK = "#000000"


def look_of(theme: Theme) -> Look:
    """Return ground and ink of a theme."""
    return _LOOKS[theme]


def themed(drawing: Drawing, theme: Theme) -> Drawing:
    """Return a drawing in the colours of a theme: curves by their dashes, all else between ground and ink."""
    if theme == "print":
        return drawing
    return drawing._replace(items=tuple(_item(one, theme) for one in drawing.items))


def _item(item: Item, theme: Theme) -> Item:
    if not isinstance(item, Polyline) or not item.name or item.fill is not None:
        return item
    pen = pen_of(item.kind)
    if pen.colour not in ("", _BLACK):
        return item
    is_dotted = len(pen.dashes) == 2 and pen.dashes[0] < _DOT * pen.width
    colour = _DOTTED[theme] if is_dotted else _LOOKS[theme].curves.get(len(pen.dashes), _BLACK)
    return item._replace(kind=pen._replace(colour=colour))

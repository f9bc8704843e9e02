"""Themes of drawings: in print, in colour, or on dark ground."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

from crankwork.show.scene import Drawing, Item, Polyline, pen_of

Theme = Literal["print", "colour", "dark", "black"]
# those that a user may ask for; sheets are black
THEMES: tuple[Theme, ...] = get_args(Theme)[:-1]


class Palette(NamedTuple):
    """Colours of ground and ink, and of curves by their dashes; other lines have the colour of ink."""

    ground: str
    ink: str
    curves: dict[str, str]


# colours that people with red-green blindness can distinguish (Okabe and Ito); curves keep their dashes
_PALETTES: dict[Theme, Palette] = {
    # black, one accent and grey
    "print": Palette(
        "#ffffff", "#000000", {"solid": "#000000", "dashed": "#0072b2", "dash-dot": "#737373", "dotted": "#000000"}
    ),
    "black": Palette("#ffffff", "#000000", {}),
    "colour": Palette(
        "#ffffff", "#000000", {"solid": "#0072b2", "dashed": "#d55e00", "dash-dot": "#009e73", "dotted": "#a6548a"}
    ),
    "dark": Palette(
        "#14171c", "#e8e8e8", {"solid": "#56b4e9", "dashed": "#e69f00", "dash-dot": "#2fc79a", "dotted": "#dd9fc4"}
    ),
}
_DASHED = {0: "solid", 2: "dashed", 4: "dash-dot"}
KINDS = (*_DASHED.values(), "dotted")
# colours of filled parts
_FILLS: dict[str, dict[Theme, str]] = {
    "gas": {"colour": "#0072b2", "dark": "#56b4e9"},
    "flash": {"colour": "#e69f00", "dark": "#f0e442"},
    "force": {"colour": "#d55e00", "dark": "#e69f00"},
}
# a dash shorter than this is a dot, in widths of its line
_DOT = 1.5
_BLACK = "#000000"


def palette_of(theme: Theme) -> Palette:
    """Return ground and ink of a theme."""
    return _PALETTES[theme]


def themed(drawing: Drawing, theme: Theme) -> Drawing:
    """Return a drawing in the colours of a theme: curves by their dashes, other items between ground and ink."""
    return drawing._replace(items=tuple(themed_item(item, theme) for item in drawing.items))


def fill_colours(theme: Theme) -> dict[str, str]:
    """Return the fill colours of a theme by the name of the filled part."""
    return {name: colours.get(theme, _BLACK) for name, colours in _FILLS.items()}


def curve_kind(item: Polyline) -> str:
    """Return the dashes of a curve, which define its colour; empty for items without such a colour."""
    pen = pen_of(item.kind)
    if not item.name or item.fill is not None or not pen.width or pen.colour not in ("", _BLACK):
        return ""
    is_dotted = len(pen.dashes) == 2 and pen.dashes[0] < _DOT * pen.width
    return "dotted" if is_dotted else _DASHED.get(len(pen.dashes), "")


def themed_item(item: Item, theme: Theme) -> Item:
    """Return an item in the colours of a theme."""
    if not isinstance(item, Polyline):
        return item
    pen = pen_of(item.kind)
    if item.fill is not None:
        filled = _FILLS.get(item.name) if pen.colour in ("", _BLACK) else None
        return item if filled is None else item._replace(kind=pen._replace(colour=filled.get(theme, "")))
    kind = curve_kind(item)
    return item._replace(kind=pen._replace(colour=_PALETTES[theme].curves.get(kind, ""))) if kind else item

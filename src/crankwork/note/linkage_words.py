"""Words of the note of a linkage put together with symbols, numbers and names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from crankwork.locale import Language, say, texts
from crankwork.note.captions import note_text
from crankwork.note.document import Figure, Heading, Math, Runs
from crankwork.note.printed_units import printed_unit
from crankwork.note.words import NoteWords
from crankwork.quantities import QUANTITIES
from crankwork.quantities.quantity import own_name
from crankwork.report.figure_data import kind_of
from crankwork.report.language import called
from crankwork.report.language import symbol as key_symbol
from crankwork.show.scene import Drawing

# what of a link or point: its guide, the arm from a joint, the load on it
_PARTS = frozenset(
    (
        "guide",
        "shaking",
        "weight",
        "arm",
        "arms",
        "place",
        "carried",
        "load",
        "both",
        "normal",
        "start",
        "free",
        "preload",
        "piece",
        "end",
        "from",
        "damper",
    )
)
_WITHIN = str.maketrans({".": ",", "/": ":", "′": "'", "″": "'"})


class Words(NoteWords):
    """What the note of a linkage says, in one language; positions are times where a law with a period drives. [s]

    `is_partial`: whether the crank goes to and fro between dead positions.
    """

    def __init__(self, language: Language, period: float = 0.0, *, is_partial: bool = False) -> None:
        super().__init__(language)
        self.period, self.is_partial = period, is_partial

    def place(self, degrees: float) -> tuple[Math, float, str]:
        """Return symbol, value and unit of a position: a crank angle, or a time."""
        if self.period:
            return Math(self.symbol("time")), degrees / 360.0 * self.period, "s"
        return Math(self.symbol("crank_angle")), degrees, "deg"

    def reached_at(self) -> Runs:
        """Return the heading of a column of positions at which values are reached."""
        symbol, _, unit = self.place(0.0)
        return (self.column("at") + " ", symbol, ", °" if unit == "deg" else f", {printed_unit(unit, self.language)}")

    def heading(self, key: str, level: int = 1, label: str = "") -> Heading:
        """Return a heading of a section; those of conclusion, bibliography and appendix have no number."""
        numbered = not key.startswith(("conclusion", "sources", "appendix"))
        return Heading(level, self.title(key), numbered=numbered, label=label)

    def caption(self, key: str) -> str:
        """Return the caption of a table."""
        return note_text(f"captions.{key}", self.language)

    def way(self, key: str) -> str:
        """Return the name of a way to find a flywheel."""
        return say("report.exact" if key == "exact" else f"report.way_{key}", self.language)

    def figure(self, name: str, drawing: Drawing) -> Figure:
        """Return a figure with caption and description."""
        number = name.removeprefix(kind_of(name)).removeprefix("_")
        caption = note_text(f"figures.{kind_of(name)}", self.language) + (f", {number}" if number else "")
        seen = say(f"seen.{kind_of(name)}", self.language)
        return Figure(drawing, caption, seen, label=f"figure:{name}")

    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`, the name of what it belongs to in the subscript."""
        kind, _, name = key.partition(".")
        shown = QUANTITIES[kind].symbol(self.language) if kind in QUANTITIES else key_symbol(kind, self.language)
        return owned_symbol(kind, shown, name, self.language) if name else shown

    def titled(self, key: str, unit: str | None = None) -> Runs:
        """Return the heading of a column of a table: symbol and unit, that of the quantity if none is given."""
        unit = printed_unit(QUANTITIES[key.partition(".")[0]].unit if unit is None else unit, self.language)
        symbol = Math(self.symbol(key))
        return (symbol, f", {unit}") if unit else (symbol,)

    def column_texts(self, values: Sequence[float], *, digits: int = 4) -> list[str]:
        """Return numbers of one column with as many decimals as give the largest that many digits."""
        largest = max((abs(one) for one in values if one == one), default=0.0)  # noqa: PLR0124 - not a number
        if not largest:
            return ["0"] * len(values)
        whole = len(f"{largest:.0f}") if largest >= 1 else 1 - _leading_zeros(largest)
        if whole < -digits:
            return [self.number(one, digits=digits) for one in values]
        decimals = max(digits - whole, 0)
        return [self.fixed(one, decimals) for one in values]


def subscript(name: str) -> str:
    """Return the name of a link or point for the subscript of a symbol, without what would end it or divide it.

    Examples
    --------
    >>> subscript("upper rod.x")
    'upper-rod,x'
    >>> subscript("P_coupler")
    'P_coupler'
    """
    return "-".join(name.translate(_WITHIN).split())


def owned_symbol(kind: str, shown: str, name: str, language: Language) -> str:
    """Return the symbol of a quantity with the name of the link or point that it belongs to in the subscript.

    Examples
    --------
    >>> owned_symbol("joint_force_x", "R_x", "A", "en"), owned_symbol("point_x", "x", "upper rod.guide", "en")
    ('R_x,A', 'x_upper-rod,g')
    """
    told = own_name(kind, name)
    # of the centre of mass of a link
    owner, *parts = told.split(" ", 1) if told.startswith("S ") else told.split(".")
    marks = texts("marks", language)
    names = [called(owner, language), *(marks[one] if one in _PARTS else called(one, language) for one in parts)]
    name = subscript(".".join(names))
    if "_i" in shown and not kind.startswith("indicated"):
        return shown.replace("_i", f"_{name}", 1)
    return f"{shown}{',' if '_' in shown else '_'}{name}"


def _leading_zeros(value: float) -> int:
    """Return how many zeros stand after the decimal mark before the first digit, and one more."""
    return int(f"{value:.0e}".partition("e-")[2] or 0)


def named(columns: Mapping[str, object], *kinds: str) -> list[str]:
    """Return the keys of columns that are of some kinds, in their order within each kind."""
    return [key for kind in kinds for key in columns if key.partition(".")[0] == kind]

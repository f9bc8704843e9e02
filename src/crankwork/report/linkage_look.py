"""What figures of linkages share: the look, a quantity for any key, and scales as drawings on paper state them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities import LANGUAGES, QUANTITIES, Language, Quantity
from crankwork.report.figure_look import LOOK, math_symbol, over_crank_angle
from crankwork.report.language import number, unit_name
from crankwork.units import from_si

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS_PER_MM = 72 / 25.4
_TITLES = {
    "position_plans": ("Position plans of the mechanism", "Планы положений механизма", "Họa đồ vị trí của cơ cấu"),
    "velocity_plan": ("Velocity plan", "План скоростей", "Họa đồ vận tốc"),
    "acceleration_plan": ("Acceleration plan", "План ускорений", "Họa đồ gia tốc"),
    "wittenbauer": ("Energy–mass diagram (Wittenbauer)", "Диаграмма энергомасс (Виттенбауэра)",
                    "Đồ thị Wittenbauer"),
    "speed": ("Angular speed of the crank over one cycle", "Угловая скорость кривошипа за цикл",
              "Vận tốc góc của khâu dẫn trong một chu kỳ"),
}  # fmt: skip

# a linkage has a crank, no crankshaft
_CRANK_ANGLE = QUANTITIES["crank_angle"]._replace(
    labels=("crank angle", "угол поворота кривошипа", "góc quay của tay quay")
)


class Style(NamedTuple):
    """How a figure of a linkage is written: language, order of the links by number, how the numbers were made."""

    language: Language = "en"
    links: tuple[str, ...] = ()
    method: str = ""


PLAIN = Style()


def linkage_title(name: str, language: Language) -> str:
    """Return what a figure of a linkage shows, for its caption.

    Parameters
    ----------
    name : str
        `position_plans`, `velocity_plan`, `acceleration_plan`, `wittenbauer` or `speed`.
    language : str
        Language of the title.
    """
    return _TITLES[name][LANGUAGES.index(language)]


@contextmanager
def figure_look() -> Iterator[None]:
    """Draw in the one look of all figures, whatever the settings of matplotlib are, and leave those alone.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    try:
        import matplotlib as mpl  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError("drawing figures", "figures") from None
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(LOOK)
        yield


def quantity_of(key: str, rows: Mapping[str, Quantity]) -> Quantity:
    """Return name, symbol and unit of a key; those of `joint_force.A` are those of `joint_force`, with A added.

    Parameters
    ----------
    key : str
        A key of the table of quantities, alone or followed by a dot and the name of a point or link.
    rows : mapping of str to Quantity
        Further rows; they go before the table.

    Raises
    ------
    CrankworkError
        If neither holds the key.
    """
    base, _, name = key.partition(".")
    row = rows.get(key) or rows.get(base) or QUANTITIES.get(base)
    if row is None:
        raise CrankworkError(f"{base} is not a quantity that figures know; give its row")
    if not name or key in rows:
        return row
    shown = name.replace("_", " ")
    one, two, three = (f"{text}{',' if '_' in text else '_'}{shown}" for text in row.symbols)
    en, ru, vi = (f"{text}, {shown}" for text in row.labels)
    return row._replace(key=key, symbols=(one, two, three), labels=(en, ru, vi))


def displayed_values(row: Quantity, values: Array) -> Array:
    """Return SI values in the display unit of a quantity."""
    return values * float(from_si(1.0, row.unit)) if row.unit else values


def axis_title(row: Quantity, language: Language) -> str:
    """Return the axis title of a quantity: name, symbol, unit."""
    unit = unit_name(row.unit, language)
    return f"{row.label(language)} {math_symbol(row.symbol(language))}" + (f", {unit}" if unit else "")


def over_drive_angle(axes: Axes, end: float, language: Language) -> None:
    """Make the horizontal axis the angle of the crank of a linkage from 0 to `end`. [deg]"""
    over_crank_angle(axes, end, language)
    axes.set_xlabel(axis_title(_CRANK_ANGLE, language))


def round_scale(least: float) -> float:
    """Return the smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not less.

    Examples
    --------
    >>> round_scale(0.013), round_scale(0.3), round_scale(0.5)
    (0.02, 0.4, 0.5)
    """
    power = math.floor(math.log10(least))
    for one in (1, 2, 2.5, 4, 5, 10):
        scale = float(f"{one}e{power}")
        if scale >= least * (1 - 1e-9):
            return scale
    return 10.0 ** (power + 1)


def scale_text(symbol: str, value: float, unit: str, language: Language) -> str:
    """Return a scale as drawings state it, `mu_v = 0.02 (m/s)/mm`."""
    name = unit_name(unit, language)
    name = f"({name})" if "/" in name else name
    return f"{math_symbol(symbol)} = {number(value, language)} {name}/{unit_name('mm', language)}"

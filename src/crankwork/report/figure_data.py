"""What the figures of one machine share: fine columns, language and units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from crankwork.analysis import Results, columns, harmonic_columns
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.quantities import LANGUAGES, Language
from crankwork.report.engine_figure_words import ENGINE_TITLES
from crankwork.report.figure_look import quantity_title
from crankwork.report.language import displayed

_STEP = 0.5
_AFTER = 1e-6
_TITLES = {
    "kinematics": ("Displacement, velocity and acceleration of the piston",
                   "Перемещение, скорость и ускорение поршня", "Chuyển vị, vận tốc và gia tốc của piston"),
    "pressure": ("Gas pressure over the crank angle", "Развёрнутая индикаторная диаграмма",
                 "Đồ thị công khai triển theo góc quay trục khuỷu"),
    "indicator": ("Indicator diagram", "Индикаторная диаграмма", "Đồ thị công"),
    "piston_forces": ("Forces along the cylinder axis", "Силы, действующие по оси цилиндра",
                      "Các lực dọc trục xylanh"),
    "rod_forces": ("Force along the rod and side force", "Сила вдоль шатуна и боковая сила",
                   "Lực dọc tâm thanh truyền và lực ngang"),
    "crankpin_forces": ("Tangential and radial force on the crankpin",
                        "Тангенциальная и радиальная силы на шатунной шейке",
                        "Lực tiếp tuyến và lực pháp tuyến trên chốt khuỷu"),
    "torque": ("Crank torque of one cylinder", "Крутящий момент одного цилиндра", "Mômen quay của một xylanh"),
    "crankpin_polar": ("Polar diagram of the load on the crankpin",
                       "Полярная диаграмма нагрузок на шатунную шейку", "Đồ thị phụ tải tác dụng lên chốt khuỷu"),
    **ENGINE_TITLES,
}  # fmt: skip


def figure_title(name: str, language: Language) -> str:
    """Return what a figure shows, for its caption.

    Parameters
    ----------
    name : str
        A name that `figures` gives.
    language : str
        Language of the title.

    Returns
    -------
    str
        The title, without number and full stop.
    """
    kind, _, last = name.rpartition("_")
    if last.isdecimal() and kind in _TITLES:
        return f"{_TITLES[kind][LANGUAGES.index(language)]}, {last}"
    return _TITLES[name][LANGUAGES.index(language)]


class Drawn(NamedTuple):
    """What is drawn: results, fine columns in SI and their angles [deg], language, piston area or None [m2]."""

    results: Results
    columns: Mapping[str, Array]
    degrees: Array
    language: Language
    area: float | None

    @property
    def per_area(self) -> bool:
        """Whether forces are per piston area."""
        return self.area is not None

    def values(self, key: str) -> Array:
        """Return a column in its display unit."""
        return self.columns[key] * displayed(key, 1.0, per_area=self.area)

    def title(self, key: str) -> str:
        """Return the axis title of a quantity."""
        return quantity_title(key, self.language, per_area=self.per_area)


def drawn_from(results: Results, language: Language, *, per_area: bool) -> Drawn:
    """Return what the figures share, computed finer than the tables.

    Parameters
    ----------
    results : Results
        The results.
    language : str
        Language of names, units and numbers.
    per_area : bool
        Divide forces by the piston area.

    Returns
    -------
    Drawn
        Columns over one cycle, with every corner of the pressure among the angles.

    Raises
    ------
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    area = results.summary.get("piston_area") if per_area else None
    if per_area and area is None and "piston_force" in results.columns:
        raise CrankworkError("forces per piston area need cylinder.bore")
    grid = CrankGrid.steps(_STEP, results.machine.cycle, special=_corners(results))
    dense = columns(results.solved, grid)
    if not results.method.is_exact:
        dense |= harmonic_columns(results.solved, grid)
    return Drawn(results, dense, grid.degrees, language, area)


def _corners(results: Results) -> tuple[float, ...]:
    """Return the angles where the pressure may have a corner or, just behind them, a jump. [deg]"""
    if results.solved.space is None:
        return ()
    diagram = results.solved.space.diagram
    angles = {segment.start for segment in diagram.segments} | {angle for angle, _ in diagram.named.values()}
    last = results.machine.cycle - _AFTER
    return tuple(angles | {angle + _AFTER for angle in angles if angle < last})

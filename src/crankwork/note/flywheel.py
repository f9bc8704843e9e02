"""Flywheel, motor and speed in a note."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis.motor_choice import SERIES_SOURCE, selection_of
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.locale import capital
from crankwork.note.document import Block, Bold, Citation, Math, Paragraph
from crankwork.note.lines import WHEEL_SIZES
from crankwork.note.material import Material
from crankwork.note.parts import (
    At,
    Head,
    Lines,
    Listed,
    Part,
    Places,
    Section,
    Shown,
    Text,
    When,
    amount,
    drawn,
    either,
    every,
    full,
    has,
    has_torques,
    lacks,
    number,
    turning,
    works,
)
from crankwork.note.tables import angle_table, position_tables, quantity_column
from crankwork.note.torque import HARMONICS, ONE, repeat_interval
from crankwork.quantities.key import key_of

_OF_ALL = ("work_per_cycle", "energy_fluctuation", *WHEEL_SIZES)
# of the speed over a cycle, that in which a flywheel is found first
_FIGURES = ("wittenbauer", "excess_work", "crank_speed")
# rows of a table over the angle of a shaft
_MOST_ROWS = 120
# a speed changes little
_DIGITS = defaultdict(lambda: 4, crank_speed=6)
_COLUMNS = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip


def _by_methods(material: Material) -> Iterator[Block]:
    """Yield the lines of every method under its name, and the table of what they find."""
    words, summary, lines, last = material.words, material.results.summary, material.lines("flywheel"), ""
    methods = [key_of(key).owner for key in summary if key.startswith("flywheel_inertia.")]
    marks = _marks(methods, material)
    # where all is not shown, the way that leaves nothing out
    shown_lines = lines if material.full else [line for line in lines if "exact" in line.key.split(".")]
    for line in shown_lines:
        method = next((name for name in methods if name in line.key.split(".")), last or methods[0])
        if material.full and method != last and line.key not in _OF_ALL:
            yield Paragraph((Bold(capital(words.way(method))), ":"))
            last = method
        yield from material.worked((line,), marks, again=True)
    excess = {
        name: line.value for name in methods for line in lines if line.key in (f"excess_work.{name}", "excess_work")
    }
    rows = [
        (words.way(name), words.shown("excess_work", excess[name], digits=material.digits),
         words.shown("flywheel_inertia", summary[f"flywheel_inertia.{name}"], digits=material.digits))
        for name in methods
        if name in excess
    ]  # fmt: skip
    if not material.full and material.has_piston:
        inertias = [f"{words.way(name)} – {inertia}" for name, (_, _, inertia) in zip(excess, rows, strict=True)]
        yield words.paragraph("flywheel_others", others="; ".join(inertias[:-1]), unit=words.unit("flywheel_inertia"))
        return
    titles = ("way", words.titled("excess_work"), words.titled("flywheel_inertia"))
    yield words.paragraph("flywheel_ways")
    yield words.table("flywheels", titles, rows, "lrr", "flywheels")


def _marks(methods: list[str], material: Material) -> Mapping[str, str]:
    """Return symbols of the slopes and inertias of each method: its name does not stand in a symbol."""
    words, marks = material.words, dict[str, str]()
    for name in methods:
        for kind in ("flywheel_inertia", "whole_inertia"):
            marks[f"{kind}.{name}"] = words.symbol(kind)
        slope = words.symbol("wittenbauer_slope")
        ends = {"largest": "max", "least": "min"}
        marks[f"wittenbauer_slope.{name}"] = slope
        marks |= {f"wittenbauer_slope.{name}.{end}": f"{slope}_{mark}" for end, mark in ends.items()}
    return marks


def _over_angle(material: Material) -> Iterator[Block]:
    """Yield the table over the angle of a shaft."""
    results, degrees = material.results, material.results.grid.degrees
    stride = math.ceil(degrees.size / _MOST_ROWS)
    rows = np.unique(np.append(np.arange(0, degrees.size, stride), degrees.size - 1))
    shown = [key for key in _COLUMNS if key in results.columns]
    columns = [quantity_column(material, key, results.columns[key][rows], digits=_DIGITS[key]) for key in shown]
    return position_tables("turning", degrees[rows], columns, material.words, first=None, label="turning")


def _over_cycle(material: Material) -> Iterator[Block]:
    """Yield energy and speed over the cycle, with the figure that the flywheel is found in."""
    caption, is_short = "speed" if material.has("crank_speed") else "energy", not material.full
    until = repeat_interval(material) if is_short and material.has("total_torque") else math.inf
    table = angle_table(material, caption, ("kinetic_energy_change", "crank_speed"), until=until)
    used = ("wittenbauer",) if "wittenbauer" in material.drawn and is_short else _FIGURES
    return material.presented([table], used)


def _whole_inertia(material: Material) -> list[Block]:
    """Return how the parts of a crank gear are reduced, and the sum of those of all cylinders."""
    parts = [line for line in material.lines("reduction", "reduced_inertia") if isinstance(line, FormulaLine)]
    return material.worked([*parts, *material.lines("engine_torque", "total_reduced_inertia")])


def _exact_work(material: Material) -> Math:
    return Math(material.words.symbol("excess_work.exact"))


def _rated(material: Material) -> str:
    return material.words.amount(material.machine.drive.rated_power, "kW")


def _slip(material: Material) -> str:
    """Return the slip of the motor that is selected. [%]"""
    return material.words.number(100 * selection_of(material.machine).slip)


def _gear_ratios(material: Material) -> Iterator[Block]:
    """Yield the size of the motor that is selected, and the table of its gear ratios."""
    words, summary, slip = material.words, material.results.summary, selection_of(material.machine).slip
    size = summary.get("standard_motor_power")
    if size is None:
        yield words.paragraph("motor_beyond", source=Citation(SERIES_SOURCE))
    else:
        yield words.paragraph("motor_size", source=Citation(SERIES_SOURCE), size=words.amount(size, "kW"))
    speeds = {float(key_of(key).owner): value for key, value in summary.items() if key.startswith("motor_ratio.")}
    rows = [
        tuple(words.number(value, digits=4) for value in (speed, speed * (1 - slip), ratio))
        for speed, ratio in speeds.items()
    ]
    titles = [(words.term(key, "rpm"),) for key in ("synchronous_speed", "rated_speed")]
    yield words.table("gear_ratios", (*titles, words.titled("motor_ratio")), rows, "rrr", "gear_ratios")


def _is_wanted(material: Material) -> bool:
    """Return whether a fluctuation of the speed is wanted, for which a flywheel is found."""
    return material.machine.drive.fluctuation is not None


_FOUND: tuple[Part, ...] = (
    When(
        either(full, drawn),
        (
            Text(
                "flywheel", {"value": lambda material: material.words.number(material.machine.drive.fluctuation or 0.0)}
            ),
        ),
    ),
    _by_methods,
)
_OF_ENERGY_AND_SPEED = ("kinetic_energy_change", "crank_speed")
_OF_ENERGY = has("excess_work.mertsalov")
_IS_EXACT = every(_is_wanted, has("flywheel_inertia.exact"))
_STEADY = Text("steady", {"speed": amount("steady_speed", "rpm"), "fluctuation": number("steady_fluctuation")})
SECTIONS = (
    Section("evenness", (
        Head("evenness"), When(every(_OF_ENERGY, lacks(_IS_EXACT)), (Text("evenness_of_all"),)),
        When(every(_OF_ENERGY, _IS_EXACT), (Text("evenness_exact", {"work": _exact_work}),)),
        When(lacks(_OF_ENERGY), (Text("evenness"),)), When(either(full, lacks(_IS_EXACT)), (Lines("uniformity"),)),
        When(_IS_EXACT, (
            At("reduction"), _whole_inertia, *_FOUND,
        )),
        _over_cycle,
        When(every(full, ONE), HARMONICS),
    ), has("piston_displacement", "excess_work")),
    Section("energy", (
        Head("energy_extremes"),
        When(has("energy_extremes"), (Text("extremes_of_energy"), Listed("energy_extremes", "energy_extremes"))),
        Lines("energy_extremes"), Shown(("turning_moment", "loops")),
    ), has_torques),
    Section("flywheel", (Head("flywheel"), Lines("flywheel")), every(has_torques, works("flywheel"))),
    Section("law_of_motion", (
        Head("law_of_shaft"), When(has("crank_speed"), (Text("speed_of_shaft"),)), Lines("shaft_course"), _over_angle,
        Shown(("speed",)),
    ), lambda material: bool(material.machine.turning) and any(map(material.has, _COLUMNS))),
    Section("motor", (
        Head("motor"), Text("motor_choice", {"slip": _slip}),
        Lines("motor", ("shaft_power", "efficiency", "motor_power")),
        When(full, (Lines("motor"),)), When(lacks(full), (Lines("motor", ("motor_ratio",), first=True),)),
        _gear_ratios,
    ), every(works("motor"), lambda material: material.machine.drive.motor is None)),
    Section("motor", (Head("motor"), Text("motor", {"rated": _rated}), Lines("motor")),
            lambda material: turning(material) and material.machine.drive.motor is not None),
    Section("flywheel", (
        Head("flywheel"), When(lacks(_is_wanted), (Lines("flywheel"),)),
        When(_is_wanted, (*_FOUND, Shown(("wittenbauer",)))),
    ), every(turning, has("excess_work"))),
    Section("law_of_motion", (
        Head("law"), When(has("crank_speed"), (Text("law"), Places("speeds", _OF_ENERGY_AND_SPEED), Shown(("speed",)))),
        When(has("steady_speed"), (_STEADY,)),
    ), lambda material: turning(material) and any(map(material.has, ("crank_speed", "steady_speed")))),
)  # fmt: skip

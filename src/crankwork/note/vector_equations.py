"""Plans of velocities and accelerations in a note: vector equations by groups, the plans, what is read on them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator

import numpy as np

from crankwork.analysis.drawn_plans import ConstructedPlan, PlanScales, PlanVector, VectorEquation, constructed_plans
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.vector_polygons import POSITION_STEP, driver_rates, velocities, worked_position
from crankwork.formula.calculation_lines import ValueLine
from crankwork.locale import translate
from crankwork.locale.numbers import unit_name
from crankwork.mechanism.mechanism import Crank
from crankwork.note.document import Block, Cell, Equation, Figure, Math, Reference, Run, Runs, Table
from crankwork.note.equations import value_box
from crankwork.note.layout import (
    DOT,
    EQUALS,
    PRODUCT,
    Box,
    Fraction,
    Marked,
    PrintedEquation,
    Row,
    Script,
    Sign,
    Upright,
    row,
)
from crankwork.note.material import Material
from crankwork.note.sheets.packing import in_grid
from crankwork.note.sheets.plans import Scales
from crankwork.note.symbols import number_box, symbol_box
from crankwork.note.wording import Words
from crankwork.report.display import symbol
from crankwork.report.look import Style
from crankwork.report.plans import acceleration_plan, vector_mark, velocity_plan
from crankwork.show.scene import Drawing

# to which points and lengths are laid off and read on paper, and what is long beside it [mm]
READING, _LONG = 0.5, 20.0
_SIGNS, _UNITS, _ROTARY = ("v", "a"), ("m/s", "m/s2"), ("rad/s", "rad/s2")
_TURNING = ("speed", "angular_acceleration")
_NOISE = 1e-9
_DIGITS = 4


def vector_plans(material: Material) -> Iterator[Block]:
    """Yield the equations of all groups, both plans, and the values read on them beside the exact ones."""
    results, words, mechanism = material.results, material.words, material.machine.mechanism
    degrees, links = worked_position(results), material.structure.links if material.structure is not None else ()
    figure, scales = _figure(material, degrees, links)
    plans = constructed_plans(results, degrees, scales, links)
    if plans is None or not isinstance(mechanism.driver, Crank):
        yield from material.presented((), ("velocity_plan", "acceleration_plan"))
        return
    yield words.paragraph("vector_equations", value=words.place_text(degrees))
    beneath = velocities(mechanism, sample_motion(mechanism, [degrees]), 0, 1.0, links).coincident
    if beneath:
        points = (words.phrase("beneath", point=point, link=str(link), other=other)
                  for point, (link, other) in beneath.items())  # fmt: skip
        yield words.paragraph("coincident", points="; ".join(points))
    for order, plan in enumerate(plans):
        yield words.paragraph(("velocity_equations", "acceleration_equations")[order])
        for group in plan.groups:
            lines = [line for equation in group.equations for line in _lines(equation, order, words)]
            lines += [
                line for equation in group.equations for part in equation.right for line in _worked(part, plans, words)
            ]
            printed = PrintedEquation(tuple(lines), _text(group.equations, order))
            yield Equation(ValueLine("", 0.0), printed=printed)
    if material.options.figures:
        yield words.paragraph("see_construction", figures=Reference("f:velocity_plan"))
        yield Figure(figure, figure.title, translate("seen.velocity_plan", words.language), label="f:velocity_plan")
        material.leave_out("velocity_plan", "acceleration_plan")
    compared = material.full or material.order != "en"
    tables = [_table(plan, order, scales, words, compared=compared) for order, plan in enumerate(plans)]
    values: dict[str, Run | Runs] = {
        "length": _scale("l", 1e3 * scales.length, "mm", words),
        "reading": words.number(scales.precision),
    }
    first, second = (Reference(table.label) for table in tables)
    yield words.paragraph(
        "read_on_plans" if compared else "plan_vectors", velocities=first, accelerations=second, **values
    )
    yield from tables


def _figure(material: Material, degrees: float, links: tuple[str, ...]) -> tuple[Drawing, PlanScales]:
    """Return both plans beside each other, and the scales at which the note draws plans."""
    results, language, scales = material.results, material.words.language, Scales()
    mechanism, style = results.machine.mechanism, Style(language, links, results.period)
    moved, rates = sample_motion(mechanism, [degrees]), driver_rates(results, results.columns_at(np.array([degrees])))
    first, second, number = float(rates.first[0]), float(rates.second[0]), round(degrees / POSITION_STEP)
    drawn = (
        lambda: scales.kept("v", 0, velocity_plan(mechanism, moved, 0, first, style, number)),
        lambda: scales.kept("a", 0, acceleration_plan(mechanism, moved, 0, first, second, style, number)),
    )
    plans = in_grid(drawn, 2, translate("headings.polygons", language), language, str)
    (plot,) = material.drawings["position_plans"].plots
    return plans, PlanScales(1.0 / plot.metre, scales.of("v", 0), scales.of("a", 0), READING)


def _scale(sign: str, value: float, unit: str, words: Words) -> Runs:
    per = unit_name(unit, words.language)
    shown = f"({per})" if "/" in per else per
    return Math(f"μ_{sign}"), f"\u00a0=\u00a0{words.number(value)}\u00a0{shown}/{unit_name('mm', words.language)}"


def _name(vector: PlanVector, order: int, words: Words) -> str:
    mark = vector_mark(vector.kind, words.language) if order else ""
    return f"{_SIGNS[order]}_{vector.name}{mark}"


def _vector(vector: PlanVector, order: int, words: Words) -> Box:
    """Return a vector, underlined as often as there is something known of it."""
    box = symbol_box(_name(vector, order, words))
    assert isinstance(box, Script)  # noqa: S101 - its points are in the subscript
    marked: Box = Script(Marked(box.base, words.mark("vector")), box.below, box.above)
    for _ in range(vector.known):
        marked = Marked(marked, "line")
    return marked


def _lines(equation: VectorEquation, order: int, words: Words) -> Iterator[Row]:
    """Yield a vector equation with the lines along which what is not known of it lies."""
    parts: list[Box] = [_vector(equation.left, order, words)]
    for index, vector in enumerate(equation.right):
        parts += [Sign("+") if index else EQUALS, _vector(vector, order, words)]
    for vector in (*equation.right, *([] if equation.right else [equation.left])):
        if vector.line:
            where = vector.line[1:]
            shown = words.phrase("along_guide", link=where) if where.isdecimal() else where
            comma = (
                []
                if len(parts) == 1
                else [Sign(",", "comma"), Upright("\u2009"), symbol_box(_name(vector, order, words))]
            )
            parts += [*comma, Sign(vector.line[0], "relation"), Upright(shown)]
    yield row(*parts)


def _text(equations: Iterable[VectorEquation], order: int) -> str:
    """Return vector equations in words for those who cannot see them."""
    sign = _SIGNS[order]
    return "; ".join(
        f"{sign}_{equation.left.name} = " + " + ".join(f"{sign}_{part.name}" for part in equation.right)
        for equation in equations if equation.right
    ) or f"{sign}_{next(iter(equations)).left.name}"  # fmt: skip


def _worked(part: PlanVector, plans: tuple[ConstructedPlan, ConstructedPlan], words: Words) -> Iterator[Row]:
    """Yield the scalar that goes with a part of a relative velocity or acceleration, worked with its numbers."""
    language, size = words.language, abs(part.exact)
    rate, below = abs(plans[0].turning.get(part.link, (0.0, 0.0))[0]), f"_{part.name}"
    speed, turn = (symbol(key, language) + f"_{part.link}" for key in _TURNING)

    def line(left: str, formula: Box, numbers: Box, value: float, unit: str) -> Row:
        return row(
            symbol_box(left), EQUALS, formula, EQUALS, numbers, EQUALS, value_box(value, unit, language, _DIGITS)
        )

    def figure(value: float) -> Box:
        return number_box(value, language, _DIGITS)[0]

    arm = symbol_box(f"l{below}")
    match part.kind:
        case "relative":
            quotient = Fraction(symbol_box(f"v{below}"), arm), Fraction(figure(size), figure(part.arm))
            yield line(speed, *quotient, size / part.arm, "rad/s")
        case "tangential":
            quotient = (
                Fraction(symbol_box(f"a{below}{vector_mark(part.kind, language)}"), arm),
                Fraction(figure(size), figure(part.arm)),
            )
            yield line(turn, *quotient, size / part.arm, "rad/s2")
        case "normal":
            formula = row(Script(*_base(speed), Upright("2")), PRODUCT, arm)
            yield line(
                _name(part, 1, words),
                formula,
                row(Script(figure(rate), None, Upright("2")), DOT, figure(part.arm)),
                size,
                "m/s2",
            )
        case "coriolis" if rate:
            formula = row(figure(2), PRODUCT, symbol_box(speed), PRODUCT, symbol_box(f"v{below}"))
            yield line(
                _name(part, 1, words),
                formula,
                row(figure(2), DOT, figure(rate), DOT, figure(size / 2 / rate)),
                size,
                "m/s2",
            )


def _base(name: str) -> tuple[Box, Box | None]:
    box = symbol_box(name)
    return (box.base, box.below) if isinstance(box, Script) else (box, None)


def _table(plan: ConstructedPlan, order: int, scales: PlanScales, words: Words, *, compared: bool) -> Table:
    """Return the vectors of a plan and the rates of the links, read and exact; `compared`: else exact alone."""
    every = [
        vector for group in plan.groups for equation in group.equations for vector in (equation.left, *equation.right)
    ]
    vectors = {(vector.name, vector.kind): vector for vector in (*every, *plan.similar)}
    most, scale = max(abs(vector.exact) for vector in vectors.values()), scales[1 + order]
    unit, rotary = (unit_name(names[order], words.language) for names in (_UNITS, _ROTARY))
    rows: list[tuple[Cell, ...]] = []
    for vector in vectors.values():
        size = abs(vector.exact)
        if size <= _NOISE * most:
            continue
        angle = math.degrees(cmath.phase(vector.exact)) % 360.0
        length, read = (vector.length, vector.length * scale) if compared else (size / scale, size)
        rows.append((
            Math(_name(vector, order, words)), words.fixed(angle, 1), words.fixed(length, 1),
            *_values(read, size, unit, words, compared=compared, known=size / scale > scales.precision),
        ))  # fmt: skip
    for link, (exact, drawn) in plan.turning.items():
        if abs(exact) > _NOISE * most and link != 1:
            name = Math(f"{symbol(_TURNING[order], words.language)}_{link}")
            rows.append((name, "–", "–", *_values(drawn, exact, rotary, words, compared=compared, known=True)))
    values = ("by_plan", "analytic", "unit", "deviation") if compared else ("value", "unit")
    caption = f"{'compared' if compared else 'plan'}_{('velocities', 'accelerations')[order]}"
    return words.table(
        caption,
        ("vector", "direction", "on_plan", *values),
        rows,
        "crr" + ("rrcr" if compared else "rc"),
        f"t:{caption}",
    )


def _values(drawn: float, exact: float, unit: str, words: Words, *, compared: bool, known: bool) -> tuple[str, ...]:
    """Return the last cells of a row; `known`: whether the vector is longer than what can be read."""
    if not compared:
        return words.number(exact, digits=_DIGITS), unit
    off = words.fixed(100.0 * (drawn - exact) / exact, 2) if known else "–"
    return words.number(drawn, digits=_DIGITS), words.number(exact, digits=_DIGITS), unit, off

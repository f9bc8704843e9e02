"""Worked steps as lines of mathematics: symbol = formula = numbers = value.

A formula computes in SI, or in the unit that it states, so the numbers put in and the value after them are printed in
those units; only then is the line true as it stands. Where the value is shown elsewhere in another unit, it follows
after one more sign of equality: `P = ... = 41200 W = 41.2 kW`. Values have six significant digits, and the numbers put
in as many as give the printed value again; all are roundings: no value is computed from rounded numbers.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType

from crankwork.formula.calculation_lines import DelayedLine, FormulaLine, Line, SumLine, ValueLine, without_noise
from crankwork.formula.expression import Expression, Formula, Operation, Symbol, evaluate, record, takes_angle, text
from crankwork.locale import texts
from crankwork.locale.numbers import number
from crankwork.notation import ARGUMENTS
from crankwork.note.captions import display_unit, printed_unit
from crankwork.note.document import Equation
from crankwork.note.layout import (
    EQUALS,
    SPACE,
    Apply,
    Box,
    Fence,
    Fraction,
    Letter,
    PrintedEquation,
    Row,
    Script,
    Sign,
    Upright,
    broken,
    leads_with_sign,
    row,
    width,
)
from crankwork.note.math import RESULT_DIGITS, enough_digits, formula_box, is_exact_pi, whole_degrees
from crankwork.note.symbols import OF_MASSES, number_box, owned_symbol, symbol_box
from crankwork.quantities import QUANTITIES, SUBJECTS, Language, base_key
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.display import is_per_area, key_unit
from crankwork.report.display import symbol as key_symbol
from crankwork.units import UNITS, coherent_unit, from_si, to_si

LINE_WIDTH = 33.0
_MANY = 8
_SHORT_NAME = 3
# letters of the name of a point of a diagram at most
_POINT = 2
_OF_HARMONICS = (
    "harmonic_cosine", "harmonic_sine", "harmonic_amplitude", "harmonic_phase", "phase_sum", "total_harmonic_cosine",
    "total_harmonic_sine", "total_harmonic_amplitude", "total_harmonic_phase",
)  # fmt: skip
_AT_POINTS = ("cylinder_volume", "diagram_pressure")
# parts of quantities of links that are no links or points
NO_LINKS = (
    "exact", "start", "drive", "all", "mean", "min", "of_cylinder", "of_piston", "of_rod", "rotating", "knuckle_pins",
)  # fmt: skip
_OF_ORDERS = ("free_force", "free_moment", "shaking_moment_amplitude")
_WITHOUT_ORDER = ("rotating", "counterweights")
_TIGHT_UNITS = ("°", "%")
_AREA = Symbol("A")
Values = list[tuple[float, str]]
# mean over the cycle: of which quantity
_MEANS: Mapping[str, str] = MappingProxyType(
    {
        "mean_torque": "crank_torque",
        "mean_driving_torque": "static_torque",
        "mean_total_torque": "total_torque",
        "mean_crankpin_load": "crankpin_load",
        "mean_bearing_load": "bearing_load",
    }
)


def printed_equation(block: Equation, language: Language, limit: float = LINE_WIDTH) -> PrintedEquation:
    """Return the lines of an equation."""
    if block.printed is not None:
        return block.printed
    block, ends = _to_print(block)
    left = symbol_box(block.symbol or equation_symbol(block.step, language))
    parts: list[Box] = []
    for part in (*_definition(block, language), *_parts(block.step, language, block.digits, ends)):
        if parts and isinstance(part, Row) and Row(part.parts[:-2]) == row(parts[-1]):
            # the same number follows with its unit
            parts.pop()
        if _bare(part) != left and (not parts or part != parts[-1]):
            parts.append(part)
    lines = list(_lines(left, parts, limit))
    if block.digits < RESULT_DIGITS and len(lines) > 1 and isinstance(block.step, FormulaLine) and len(ends) > 1:
        # no line of its own for the same value in another unit
        shorter = list(_lines(left, [*parts[:-2], parts[-1]], limit))
        lines = shorter if len(shorter) < len(lines) else lines
    return PrintedEquation(tuple(lines), _plain(block, language, ends))


def _to_print(block: Equation) -> tuple[Equation, list[tuple[float, str]]]:
    """Return an equation with its values as they are printed, by the piston area where that is known."""
    if isinstance(block.step, Formula):
        return block, []
    step = without_noise(block.step)
    step, ends = by_area(step, block.area) if block.area else (step, distinct_values(step))
    return replace(block, step=step), ends


def _bare(box: Box) -> Box:
    """Return a function of a symbol as the symbol of its value is written: without parentheses."""
    match box:
        case Apply(name, Fence(Row((Letter() | Script() as inside,)))):
            return Apply(name, inside)
    return box


def equation_symbol(step: Line | Formula, language: Language) -> str:
    """Return the symbol on the left of an equation, as `base_subscript`."""
    if isinstance(step, Formula):
        return QUANTITIES[step.quantity].symbol(language)
    if base_key(step.key) not in QUANTITIES:
        return QUANTITIES[step.formula.quantity].symbol(language) if isinstance(step, FormulaLine) else step.key
    kind, name = key_of(step.key)
    shown = key_symbol(kind, language)
    # a point or a number tells parts of a quantity apart; a whole word would make no symbol
    return f"{shown}{',' if '_' in shown else '_'}{name}" if name and len(name) <= _SHORT_NAME else shown


# quantities that links, points, chambers and masses in planes have, whose names are any words
OF_LINKS = frozenset(
    row.key
    for name in ("linkage", "chambers", "balance")
    for row in SUBJECTS[name]
    if name != "balance" or row.key.startswith(OF_MASSES)
)


# loads of any bearing that are known as those of a crankpin too
_OF_CRANKPIN = {"mean_bearing_load": "mean_crankpin_load", "bearing_load_max": "crankpin_load_max"}


def own_key(key: str) -> str:
    """Return the key under which a value has its symbol and its name, where it is known under two."""
    kind, *names = key.split(".")
    if kind in _OF_CRANKPIN and names[:1] == ["crankpin"]:
        return ".".join((_OF_CRANKPIN[kind], *names[1:]))
    return key


def value_symbol(key: str, language: Language) -> str:
    """Return the symbol of a value as `base_subscript`, with its marks in the subscript."""
    kind, *names = own_key(key).split(".")
    if base_key(kind) not in QUANTITIES:
        return kind
    shown = equation_symbol(ValueLine(kind, 0.0), language)
    is_owned = base_key(kind) in OF_LINKS or (kind in _AT_POINTS and len("".join(names[:1])) > _POINT)
    if is_owned and names and names[0] not in NO_LINKS:
        return owned_symbol(kind, shown, ".".join(names), language)
    known = texts("marks", language)
    if kind in _OF_ORDERS and names and names[0] in _WITHOUT_ORDER:
        # rotating parts have no order
        shown = shown.partition("_")[0]
    if kind in _OF_HARMONICS and names:
        return f"{shown}{',' if '_' in shown else '_'}{number(float('.'.join(names)), language)}"
    marks = [known.get(name, number_of(name)) for name in names]
    # points and numbers are marks; a whole word would be too long for a subscript
    below = ",".join(mark for mark, name in zip(marks, names, strict=True) if name in known or len(mark) <= _SHORT_NAME)
    if kind in _AT_POINTS and below:
        # the clearance volume has the subscript that the point at the end of compression has
        below = f"({below})"
    return f"{shown}{',' if '_' in shown else '_'}{below}" if below else shown


def _symbols(step: FormulaLine, language: Language) -> dict[str, str]:
    """Return the symbols of the arguments that stand for one of several values."""
    symbols = {name: value_symbol(key, language) for name, key in step.named}
    # what a value is made of, and goes by its name, stands apart from it
    return symbols | {name: _in_parentheses(symbols[name]) for name, key in step.named if key == step.key}


def _in_parentheses(shown: str) -> str:
    base, _, below = shown.partition("_")
    return f"{base}_({below})" if below and not below.startswith("(") else shown


def _lines(left: Box, parts: list[Box], limit: float) -> Iterator[Row]:
    """Yield lines that fit; each begins with the symbol on the left, or with the sign at which it was divided."""
    line = left if not parts else row(left, EQUALS, parts[0])
    for part in parts[1:]:
        longer = row(line, EQUALS, part)
        if width(longer) <= limit:
            line = longer
            continue
        yield from broken(row(line), limit)
        line = row(left, EQUALS, part)
    yield from broken(row(line), limit)


def _definition(block: Equation, language: Language) -> tuple[Box, ...]:
    box = definition_box(block.defined, language) if block.defined else None
    return () if box is None else (box,)


def _parts(step: Line | Formula, language: Language, least: int, ends: list[tuple[float, str]]) -> Iterator[Box]:
    """Yield the boxes between the equal signs, the values at the end last."""
    match step:
        case Formula():
            yield formula_box(record(step.shown), None, language)
            return
        case FormulaLine(values=values):
            yield formula_box(step.written, None, language, symbols=_symbols(step, language))
            digits = enough_digits(step, least)
            yield formula_box(step.written, values, language, digits=digits, symbols=_symbols(step, language))
        case DelayedLine(of=column, degrees=degrees):
            yield row(symbol_box(value_symbol(column, language)), Fence(value_box(degrees, "deg", language)))
        case SumLine(terms=terms):
            # terms without a name are numbers only
            if len(terms) <= _MANY and all(term.key for term in terms):
                yield _sum_of_symbols(step, language)
            if len(terms) > 1:
                digits = enough_digits(step, least)
                yield _joined([number_box(term.value, language, digits)[0] for term in terms])
    for value, unit in ends:
        yield value_box(value, unit, language, least)


def _sum_of_symbols(step: SumLine, language: Language) -> Box:
    return _joined([symbol_box(value_symbol(term.key, language)) for term in step.terms])


def formula_of(step: FormulaLine, language: Language) -> Box:
    """Return the formula of a step in symbols."""
    return formula_box(step.written, None, language, symbols=_symbols(step, language))


def symbolic(step: Line, language: Language) -> Box | None:
    """Return the formula or the sum of a step in symbols, if it has one."""
    match step:
        case FormulaLine():
            return formula_of(step, language)
        case SumLine(terms=terms) if len(terms) > 1 and all(term.key for term in terms):
            return _sum_of_symbols(step, language)
    return None


def _joined(boxes: list[Box]) -> Box:
    parts: list[Box] = []
    for box in boxes:
        parts += [Sign("+"), Fence(box) if leads_with_sign(box) else box] if parts else [box]
    return row(*parts) if len(parts) > 1 else parts[0] if parts else Upright("0")


def shown_values(step: Line) -> list[tuple[float, str]]:
    """Return the value of a step in the unit of its formula, and in the unit of the tables where that is another."""
    formula = step.formula if isinstance(step, FormulaLine) else None
    known = formula is not None or base_key(step.key) in QUANTITIES
    shown = display_unit(step.key, formula) if known else ""
    stated = formula.unit if formula else None
    if stated is None:
        own = coherent_unit(shown)
        stated = own if own not in UNITS or UNITS[own].factor == 1.0 else stated
    if stated is None:
        return [(float(from_si(step.value, shown)), shown)]
    if stated in UNITS and shown in UNITS and not _same_dimension(stated, shown):
        # one formula for drivers that slide and that turn
        stated = coherent_unit(shown)
    if stated == shown or not _same_dimension(stated, shown):
        return [(step.value, stated)]
    si = step.value if UNITS[stated].factor == 1.0 else to_si(step.value, stated)
    return [(step.value, stated), (float(from_si(si, shown)), shown)]


def distinct_values(step: Line) -> list[tuple[float, str]]:
    """Return the values at the end of a line, once where both units give the same number; degrees keep both."""
    first, *further = shown_values(step)
    return [first, *further] if first[0] or any(value for value, _ in further) else [first]


def _same_dimension(first: str, second: str) -> bool:
    return first == second or (first in UNITS and second in UNITS and UNITS[first].dimension == UNITS[second].dimension)


def value_box(value: float, unit: str, language: Language, digits: int = RESULT_DIGITS) -> Box:
    """Return a number with its unit."""
    box, _ = number_box(value, language, digits)
    name = printed_unit(unit, language)
    if not name:
        return box
    return row(box, *([] if name in _TIGHT_UNITS else [SPACE]), Upright(name))


def value_text(value: float, unit: str, language: Language, digits: int = RESULT_DIGITS) -> str:
    """Return a number with its unit as text."""
    name = printed_unit(unit, language)
    return number(value, language, digits=digits) + ("" if not name or name in _TIGHT_UNITS else "\u00a0") + name


def _plain(block: Equation, language: Language, ends: list[tuple[float, str]]) -> str:
    """Return an equation as one line of text."""
    step = block.step
    parts = [block.symbol or equation_symbol(step, language)]
    if block.defined:
        parts += [part for part in (definition_text(block.defined, language),) if part]
    if isinstance(step, Formula):
        return " = ".join([*parts, text(record(step.shown), None, language)])
    return " = ".join([*parts, *line_parts(step, language, least=block.digits, ends=ends)])


def line_parts(
    step: Line,
    language: Language,
    symbols: Mapping[str, str] = MappingProxyType({}),
    *,
    least: int = RESULT_DIGITS,
    ends: list[tuple[float, str]] | None = None,
) -> list[str]:
    """Return the parts of a line between the equal signs, as text: symbols, numbers, values with units.

    `symbols`: those that stand for some operands here, by argument name, or by key in a sum; `least`: digits of values;
    `ends`: the values at the end where they are not those of the step.
    """
    parts, digits = [], enough_digits(step, least)
    if isinstance(step, FormulaLine):
        put_in = {name: value for name, value in step.values.items() if not is_exact_pi(name, value)}
        printed = {name: number(value, language, digits=digits) for name, value in put_in.items()}
        shown = {**_symbols(step, language), **symbols}
        printed |= _angles(step, language)
        parts = [text(step.written, shown, language), text(step.written, printed, language)]
    elif isinstance(step, DelayedLine):
        parts = [f"{value_symbol(step.of, language)}({value_text(step.degrees, 'deg', language)})"]
    elif isinstance(step, SumLine) and step.terms:
        names = [symbols.get(term.key) or value_symbol(term.key, language) for term in step.terms]
        numbers = [number(term.value, language, digits=digits) for term in step.terms]
        fenced = (f"({printed})" if printed.startswith("−") else printed for printed in numbers[1:])
        parts = [" + ".join(names), " + ".join([numbers[0], *fenced])]
    while parts and parts[-1] == number(step.value, language, digits=least):
        # the same number follows with its unit
        parts.pop()
    parts += [value_text(value, unit, language, least) for value, unit in ends or distinct_values(step)]
    return [part for index, part in enumerate(parts) if not index or part != parts[index - 1]]


def _angles(step: FormulaLine, language: Language) -> dict[str, str]:
    """Return angles that are put in as whole degrees, of a step that is a function of an angle alone."""
    tree = step.expression
    if not (isinstance(tree, Operation) and takes_angle(tree.function) and isinstance(tree.operands[0], Symbol)):
        return {}
    degrees = whole_degrees(tree.operands[0], step.values)
    return {} if degrees is None else {tree.operands[0].name: f"{number(degrees, language)}°"}


def by_area(step: Line, area: float) -> tuple[Line, Values]:
    """Return a step whose value is divided by the piston area, and its values with their units.

    `area`: [m2].
    """
    value, unit = step.value / area, key_unit(step.key, per_area=True)
    shown, si = float(from_si(value, unit)), coherent_unit(unit)
    if isinstance(step, SumLine):
        terms = [term._replace(value=float(from_si(term.value / area, unit))) for term in step.terms]
        return step._replace(terms=tuple(terms), value=shown), [(shown, unit)]
    if not isinstance(step, FormulaLine):
        return step._replace(value=shown), [(shown, unit)]
    match step.expression:
        case Operation(operator.mul, (factor, Symbol() as other)) if other == _AREA:
            # a force of a pressure
            kept = {name: put_in for name, put_in in step.values.items() if name != _AREA.name}
            return step._replace(tree=factor, values=kept, value=value), [(value, si), (shown, unit)]
    forces = _forces(step)
    values = {name: put_in / area if name in forces else put_in for name, put_in in step.values.items()}
    if not forces or not math.isclose(evaluate(step.expression, values), value, rel_tol=1e-9, abs_tol=1e-9):
        return step, [(step.value, coherent_unit(key_unit(step.key))), (shown, unit)]
    if {*forces.values()} != {unit}:
        return step._replace(values=values, value=value), [(value, si), (shown, unit)]
    values |= {name: float(from_si(values[name], unit)) for name in forces}
    return step._replace(values=values, value=shown), [(shown, unit)]


def with_area(step: FormulaLine, area: float) -> FormulaLine:
    """Return a step whose forces and masses are those of the whole piston: each times the area. [m2]"""
    forces = _forces(step)
    if not forces or step.expression is None:
        return step
    values = {name: put_in / area if name in forces else put_in for name, put_in in step.values.items()}
    return step._replace(tree=_times_area(step.expression, forces), values={**values, _AREA.name: area})


def _times_area(tree: Expression, names: dict[str, str]) -> Expression:
    match tree:
        case Symbol(name) if name in names:
            return Operation(operator.mul, (tree, _AREA))
        case Operation(function, operands):
            return Operation(function, tuple(_times_area(operand, names) for operand in operands))
    return tree


def _forces(step: FormulaLine) -> dict[str, str]:
    """Return the arguments of a step that may be given by the piston area, each with its unit then."""
    named = dict(step.named)
    kinds = {
        name: key_of(named[name]).quantity if name in named else ARGUMENTS[name].quantity
        for name in step.values
        if name in named or name in ARGUMENTS
    }
    known = {name: kind for name, kind in kinds.items() if kind and base_key(kind) in QUANTITIES}
    return {name: key_unit(kind, per_area=True) for name, kind in known.items() if is_per_area(kind)}


def definition_box(key: str, language: Language) -> Box | None:
    """Return the definition of a value, None where there is none to print."""
    kind = key_of(key).quantity
    if kind == "indicated_work":
        return row(Upright("∮"), _over("diagram_pressure", "cylinder_volume", language))
    if key == "excess_work":
        energy = _symbol("kinetic_energy_change", language)
        return row(Upright("max"), SPACE, energy, Sign("−"), Upright("min"), SPACE, energy)
    if key == "excess_work.exact":
        return row(_tangent("max", language), Sign("−"), _tangent("min", language))
    if kind == "plane_angle":
        return Apply(Upright("arctg" if language == "ru" else "arctan"), Fence(row(*_of_plane(key, language))))
    if kind in _MEANS:
        share = Fraction(Upright("1"), _symbol("cycle_angle", language))
        return row(share, Upright("∫"), _over(_MEANS[kind], "crank_angle", language))
    return None


def definition_text(key: str, language: Language) -> str:
    """Return the definition as one line of text, empty where there is none."""
    kind = key_of(key).quantity
    named = (*_MEANS, *_MEANS.values(), "crank_angle", "cycle_angle", "kinetic_energy_change")
    names = {name: QUANTITIES[name].symbol(language) for name in named}
    if kind == "indicated_work":
        return f"∮ {QUANTITIES['diagram_pressure'].symbol(language)} d{QUANTITIES['cylinder_volume'].symbol(language)}"
    if key == "excess_work":
        return f"max {names['kinetic_energy_change']} − min {names['kinetic_energy_change']}"
    if key == "excess_work.exact":
        slope, inertia = (QUANTITIES[name].symbol(language) for name in ("wittenbauer_slope", "total_reduced_inertia"))
        return " − ".join(
            f"{end}({names['kinetic_energy_change']} − {inertia}·{slope}_{end})" for end in ("max", "min")
        )
    if kind == "plane_angle":
        up, across = (value_symbol(f"plane_moment_{axis}.{key_of(key).owner}", language) for axis in "yx")
        return f"{'arctg' if language == 'ru' else 'arctan'}({up}/{across})"
    if kind in _MEANS:
        return f"1/{names['cycle_angle']}·∫ {names[_MEANS[kind]]} d{names['crank_angle']}"
    return ""


def _of_plane(key: str, language: Language) -> tuple[Box, ...]:
    up, across = (symbol_box(value_symbol(f"plane_moment_{axis}.{key_of(key).owner}", language)) for axis in "yx")
    return up, Sign("/", "slash"), across


# of which torque the kinetic energy takes what is beyond the mean: its mean, and the sign that it has there
_BEYOND = {"total_torque": ("mean_total_torque", ""), "static_torque": ("mean_driving_torque", "−")}


def integral_text(torque_key: str, language: Language) -> str:
    """Return the integral of a torque beyond its mean over the crank angle, empty for other keys."""
    if torque_key not in _BEYOND:
        return ""
    mean, sign = _BEYOND[torque_key]
    torque, mean, phi = (QUANTITIES[name].symbol(language) for name in (torque_key, mean, "crank_angle"))
    return f"{sign}∫({torque} − {mean}) d{phi}"


def _tangent(end: str, language: Language) -> Row:
    """Return an end of what a tangent cuts off: max (ΔT − J tan ψ_max)."""
    tangent = symbol_box(f"{QUANTITIES['wittenbauer_slope'].symbol(language)}_{end}")
    energy, inertia = _symbol("kinetic_energy_change", language), _symbol("total_reduced_inertia", language)
    return row(Upright(end), SPACE, Fence(row(energy, Sign("−"), inertia, SPACE, tangent)))


def _over(key: str, variable: str, language: Language) -> Row:
    return row(SPACE, _symbol(key, language), SPACE, Upright("d"), _symbol(variable, language))


def _symbol(key: str, language: Language) -> Box:
    return symbol_box(QUANTITIES[key].symbol(language))

"""Worked steps of notes in which forces and masses are those of a unit of the piston area."""

from __future__ import annotations

import math
import operator

from crankwork.formula.calculation_lines import FormulaLine, Line, SumLine
from crankwork.formula.expression import Expression, Operation, Symbol, evaluate
from crankwork.notation import ARGUMENTS
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import key_of
from crankwork.report.display import is_per_area, key_unit
from crankwork.units import coherent_unit, from_si

_AREA = Symbol("A")
Values = list[tuple[float, str]]


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

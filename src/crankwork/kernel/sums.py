"""Sums of columns at other crank angles, as of many cylinders, with common subexpressions calculated once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import combinations

from crankwork.kernel.graph import KernelValue, number

# relative difference of equal coefficients, for example of rounded directions of cylinders
_TOLERANCE = 1e-15
# coefficient of each column and its factor of the design; without a column, a term of the design alone
Form = dict[tuple[KernelValue | None, KernelValue | None], float]


def shared(roots: Sequence[KernelValue], values: Iterable[KernelValue]) -> dict[int, KernelValue]:
    """Return replacements of such sums by index in the graph; `values`: all of the same angle.

    Only independent terms are added here, in any order. The order of other sums may protect digits.
    """
    forms: dict[int, Form] = {}
    used = {root.index: root for root in roots}
    for value in values:
        form = _form(value, forms)
        if form is None:
            used |= {operand.index: operand for operand in value.operands}
        else:
            forms[value.index] = form
    sums = {index: forms[index] for index in used if index in forms}
    sums = {index: form for index, form in sums.items() if sum(leaf is not None for leaf, _ in form) > 1}
    while (best := _commonest(sums.values())) is not None:
        (first, second, sign), _ = best
        both = first + second if sign > 0 else first - second
        for form in sums.values():
            for factor in {factor for leaf, factor in form if leaf is first}:
                if _is_pair(form, first, second, factor) == sign:
                    form[both, factor] = form.pop((first, factor))
                    del form[second, factor]
    return {index: _sum_of(form) for index, form in sums.items()}


def _form(value: KernelValue, forms: dict[int, Form]) -> Form | None:
    """Return the terms of a sum, None if a value is no sum."""
    if value.kind == "delayed":
        return {(value, None): 1.0}
    operands = [_of_operand(operand, forms) for operand in value.operands]
    match value.kind, operands:
        case "neg", [dict() as form]:
            return _scaled(form, -1.0)
        case "add" | "sub", [dict() as left, dict() as right]:
            terms = dict(left)
            for key, amount in _scaled(right, 1.0 if value.kind == "add" else -1.0).items():
                terms[key] = terms.get(key, 0.0) + amount
            return terms
        case "mul", [dict() as left, dict() as right]:
            for form, other in ((left, value.operands[1]), (right, value.operands[0])):
                if other.is_constant:
                    return _scaled(form, number(other))
                if not other.depends_on_angle and all(factor is None for _, factor in form):
                    return {(leaf, other): amount for (leaf, _), amount in form.items()}
    return None


def _of_operand(operand: KernelValue, forms: dict[int, Form]) -> Form | None:
    if operand.depends_on_angle:
        return forms.get(operand.index)
    return {(None, None): number(operand)} if operand.is_constant else {(None, operand): 1.0}


def _scaled(form: Form, factor: float) -> Form:
    return {key: factor * amount for key, amount in form.items()}


def _is_pair(form: Form, column: KernelValue, other: KernelValue, factor: KernelValue | None) -> int:
    """Return 1 if two columns have equal coefficients, -1 if opposite ones, otherwise 0."""
    first, second = form.get((column, factor), 0.0), form.get((other, factor), 0.0)
    for sign in (1, -1):
        if first and abs(first - sign * second) <= _TOLERANCE * abs(first):
            return sign
    return 0


def _commonest(forms: Iterable[Form]) -> tuple[tuple[KernelValue, KernelValue, int], int] | None:
    """Return the pair of columns with equal coefficients in most sums, if in several."""
    counted: Counter[tuple[KernelValue, KernelValue, int]] = Counter()
    for form in forms:
        leaves = sorted((key for key in form if key[0] is not None), key=lambda key: key[0].index)  # type: ignore[union-attr]
        for (first, factor), (second, second_factor) in combinations(leaves, 2):
            if factor is second_factor and (sign := _is_pair(form, first, second, factor)):  # type: ignore[arg-type]
                counted[first, second, sign] += 1  # type: ignore[index]
    best = counted.most_common(1)
    return best[0] if best and best[0][1] > 1 else None


def _sum_of(form: Form) -> KernelValue:
    """Return the value of a sum, with columns of one coefficient added first."""
    result: KernelValue | float = 0.0
    left = dict(form)
    while left:
        (leaf, factor), amount = next(iter(left.items()))
        keys = [
            key for key in left if key[1] is factor and abs(abs(left[key]) - abs(amount)) <= _TOLERANCE * abs(amount)
        ]
        keys = [(leaf, factor)] if leaf is None else [key for key in keys if key[0] is not None]
        total: KernelValue | float = 1.0 if leaf is None else leaf
        for key in keys:
            if key[0] is not leaf and key[0] is not None:
                total = total + key[0] if left[key] * amount > 0 else total - key[0]
        for key in keys:
            del left[key]
        result = result + total * amount * (1.0 if factor is None else factor)
    assert isinstance(result, KernelValue)  # noqa: S101 - a sum has two columns at least
    return result

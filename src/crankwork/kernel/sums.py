"""Sums of columns of other crank angles, as of many cylinders, with what they share made once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import combinations

from crankwork.kernel.graph import Value, number

# amounts this near are one, as those of rounded directions of cylinders
_SAME = 1e-15
# how much there is of each column that is read, and by which factor of the design; of none, what is of designs alone
Form = dict[tuple[Value | None, Value | None], float]


def shared(roots: Sequence[Value], every: Iterable[Value]) -> dict[int, Value]:
    """Return values that stand for such sums, by the places of these in the graph; `every`: all of the same angle.

    What is added here is independent: it may be added in any order. The order of other sums may guard digits.
    """
    forms: dict[int, Form] = {}
    used = {one.at: one for one in roots}
    every = list(every)
    for one in every:
        form = _form(one, forms)
        if form is None:
            used |= {other.at: other for other in one.operands}
        else:
            forms[one.at] = form
    wanted = {at: forms[at] for at in used if at in forms and sum(leaf is not None for leaf, _ in forms[at]) > 1}
    while (best := _commonest(wanted.values())) is not None:
        (one, other, sign), _ = best
        both = one + other if sign > 0 else one - other
        for form in wanted.values():
            for factor in {factor for leaf, factor in form if leaf is one}:
                if _is_pair(form, one, other, factor) == sign:
                    form[both, factor] = form.pop((one, factor))
                    del form[other, factor]
    return {at: _made(form) for at, form in wanted.items()}


def _form(one: Value, forms: dict[int, Form]) -> Form | None:
    """Return what a value is the sum of, None where it is none."""
    if one.kind == "delayed":
        return {(one, None): 1.0}
    of = [_of_operand(other, forms) for other in one.operands]
    match one.kind, of:
        case "neg", [dict() as form]:
            return _scaled(form, -1.0)
        case "add" | "sub", [dict() as left, dict() as right]:
            found = dict(left)
            for key, amount in _scaled(right, 1.0 if one.kind == "add" else -1.0).items():
                found[key] = found.get(key, 0.0) + amount
            return found
        case "mul", [dict() as left, dict() as right]:
            for form, other in ((left, one.operands[1]), (right, one.operands[0])):
                if other.is_constant:
                    return _scaled(form, number(other))
                if not other.by_angle and all(factor is None for _, factor in form):
                    return {(leaf, other): amount for (leaf, _), amount in form.items()}
    return None


def _of_operand(one: Value, forms: dict[int, Form]) -> Form | None:
    if one.by_angle:
        return forms.get(one.at)
    return {(None, None): number(one)} if one.is_constant else {(None, one): 1.0}


def _scaled(form: Form, by: float) -> Form:
    return {key: by * amount for key, amount in form.items()}


def _is_pair(form: Form, one: Value, other: Value, factor: Value | None) -> int:
    """Return 1 where there is as much of two columns, -1 where of one as much less, otherwise 0."""
    first, second = form.get((one, factor), 0.0), form.get((other, factor), 0.0)
    for sign in (1, -1):
        if first and abs(first - sign * second) <= _SAME * abs(first):
            return sign
    return 0


def _commonest(forms: Iterable[Form]) -> tuple[tuple[Value, Value, int], int] | None:
    """Return the two columns that most sums have as much of, if there are several."""
    counted: Counter[tuple[Value, Value, int]] = Counter()
    for form in forms:
        leaves = sorted((one for one in form if one[0] is not None), key=lambda one: one[0].at)  # type: ignore[union-attr]
        for (one, factor), (other, of) in combinations(leaves, 2):
            if factor is of and (sign := _is_pair(form, one, other, factor)):  # type: ignore[arg-type]
                counted[one, other, sign] += 1  # type: ignore[index]
    best = counted.most_common(1)
    return best[0] if best and best[0][1] > 1 else None


def _made(form: Form) -> Value:
    """Return the value of a sum: columns of one amount together, times it."""
    result: Value | float = 0.0
    left = dict(form)
    while left:
        (leaf, factor), amount = next(iter(left.items()))
        alike = [key for key in left if key[1] is factor and abs(abs(left[key]) - abs(amount)) <= _SAME * abs(amount)]
        alike = [(leaf, factor)] if leaf is None else [key for key in alike if key[0] is not None]
        total: Value | float = 1.0 if leaf is None else leaf
        for key in alike:
            if key[0] is not leaf and key[0] is not None:
                total = total + key[0] if left[key] * amount > 0 else total - key[0]
        for key in alike:
            del left[key]
        result = result + total * amount * (1.0 if factor is None else factor)
    assert isinstance(result, Value)  # noqa: S101 - of two columns at least
    return result

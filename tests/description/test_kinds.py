"""Kinds of values, and what they say when a value is refused."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork import units
from crankwork.description.machine_file import FILES
from crankwork.description.schema import NumberOr, TableSpec
from crankwork.description.value_types import MeasuredValue, Number, Quantity, Reader
from each import for_each

LIMITS = [(1e-6, 30000.0), (1 / 3, 200 / 7), (1e-4, 123456.7)]


@for_each(("low", "high"), LIMITS)
@for_each("dimension", sorted(units.EXAMPLES))
def test_the_limits_that_a_refusal_tells_may_be_written(dimension: str, low: float, high: float) -> None:
    kind = Quantity((dimension,), low, high)
    unit = units.EXAMPLES[dimension].split()[1]
    told = dict(kind._out_of_range(f"1e9 {unit}", dimension).values)
    for limit in (told["low"], told["high"]):
        assert isinstance(kind.read(limit.strip('"'), "key", Reader()), MeasuredValue), limit


def kinds_of(kind: object, seen: set[int]) -> Iterator[Quantity | Number]:
    """Give the kinds of all numbers that machine files hold."""
    if id(kind) in seen:
        return
    seen.add(id(kind))
    if isinstance(kind, Quantity | Number):
        yield kind
    elif isinstance(kind, TableSpec):
        for key in kind.keys.values():
            yield from kinds_of(key.kind, seen)
    elif isinstance(kind, NumberOr):
        yield from (kind.number, *kinds_of(kind.quantity, seen))
    else:
        for below in (getattr(kind, name, None) for name in ("entry", "other")):
            if below is not None:
                yield from kinds_of(below, seen)


KINDS = list(dict.fromkeys(kind for one in FILES for kind in kinds_of(one, set())))


WRONG = (-5, 0, 1e9, 10**20, True, [], "-5", "-5,5 {unit}", "5,5", "abc", "5 bananas", "1e400 {unit}")


@for_each("wrong", WRONG, ids=repr)
def test_what_a_refusal_says_to_write_may_be_written(wrong) -> None:
    assert len(KINDS) > 60
    for kind in KINDS:
        is_text = isinstance(kind, Quantity)
        unit = units.EXAMPLES[kind.dimensions[0]].split()[1] if is_text else ""
        value = wrong.format(unit=unit) if isinstance(wrong, str) else wrong
        kind.read(value, "key", reader := Reader())
        for told in (problem.message for problem in reader.problems):
            said = [told.values[name] for name in ("example", "point", "low", "high") if name in told.values]
            # a limit that is told as exceeded may not be written itself
            said = said[1:] if told.name.endswith("_above") else said
            for fix in (text for one in said for text in (one if isinstance(one, tuple) else [one])):
                kind.read(fix.strip('"') if is_text else float(fix), "key", again := Reader())
                assert again.problems == [], (kind, value, told)

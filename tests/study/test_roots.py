"""Roots of functions that are known: crossings, touches, jumps, poles, stretches without a value."""

from __future__ import annotations

import math

import numpy as np
import pytest

from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage
from crankwork.study.roots import find_roots

PLACES = np.linspace(0.0, 10.0, 401)


def gaps(x: float) -> float:
    if x < 2:
        raise CrankworkError(ErrorMessage("this"))
    if 7 < x < 8:
        raise CrankworkError(ErrorMessage("the_number"))
    if 8 <= x < 8.503:
        raise CrankworkError(ErrorMessage("this"))
    return math.sqrt(x - 2) - 0.5


CROSSINGS = {
    "sine": (math.sin, [0.0, math.pi, 2 * math.pi, 3 * math.pi], ["rising", "falling", "rising", "falling"]),
    "at a place looked at": (lambda x: x - 5.0, [5.0], ["rising"]),
    "flat": (lambda x: (x - 3.3) ** 3, [3.3], ["rising"]),
    "steep": (lambda x: math.copysign(math.sqrt(abs(x - 3.31)), 3.31 - x), [3.31], ["falling"]),
    "two between places": (lambda x: (x - 3.3) * (x - 3.3001), [3.3, 3.3001], ["falling", "rising"]),
    "at both ends": (lambda x: x * (10.0 - x), [0.0, 10.0], ["rising", "falling"]),
    "beside a stretch": (gaps, [2.25], ["rising"]),
    "beside a pole": (lambda x: 1 / (x - 3.33) + 1.0, [2.33], ["falling"]),
}


def test_every_change_of_sign_is_refined():
    wrong = {}
    for name, (function, expected, kinds) in CROSSINGS.items():
        roots = find_roots(function, PLACES).roots
        places = pytest.approx(expected, rel=1e-12, abs=1e-12)
        if [one.at for one in roots] != places or [one.kind for one in roots] != kinds:
            wrong[name] = roots
    assert wrong == {}


TOUCHES = {
    "parabola": (lambda x: (x - 3.3333) ** 2, 3.3333, 1e-12),
    "from below": (lambda x: -1.0 - math.sin(x), 1.5 * math.pi, 1e-12),
    "a little steeper on one side": (lambda x: (x + 1) / 6.4 - 1 - math.log((x + 1) / 6.4), 5.4, 1e-12),
    "between steep sides": (lambda x: math.cosh(3 * (x - 4.123456789)) - 1, 4.123456789, 1e-12),
    "beside what has no value": (lambda x: gaps(x) - math.sqrt(x - 2) + 0.5 + (x - 2.03) ** 2, 2.03, 1e-12),
    "with rounding of larger values": (lambda x: (x - 3.3333) ** 2 + 1e-13 * math.sin(1e7 * x), 3.3333, 1e-11),
    "corner": (lambda x: abs(x - 3.3333), 3.3333, 1e-12),
    "corner between curves": (
        lambda x: math.expm1(3.3333 - x) if x < 3.3333 else math.expm1(x - 3.3333),
        3.3333,
        1e-12,
    ),
    "at a place looked at": (lambda x: (x - 5.0) ** 2, 5.0, 1e-12),
    "fourth power": (lambda x: (x - 3.3333) ** 4, 3.3333, 1e-3),
}


def test_a_touching_root_is_told_as_such():
    wrong = {}
    for name, (function, expected, nearness) in TOUCHES.items():
        roots = find_roots(function, PLACES, 1.0).roots
        place = pytest.approx(expected, rel=0, abs=nearness * (PLACES[-1] - PLACES[0]))
        if [one.kind for one in roots] != ["touching"] or roots[0].at != place:
            wrong[name] = roots
    assert wrong == {}


def test_what_nearly_touches_is_no_root_but_the_nearest():
    for above in (1e-9, 1e-3, 1.0):
        found = find_roots(lambda x, above=above: (x - 3.3333) ** 2 + above, PLACES)
        assert found.roots == ()
        assert found.nearest.value == pytest.approx(above, rel=1e-5)


def test_two_roots_between_places_are_found_from_the_least_value():
    for below in (1e-9, 1e-6, 1e-5):
        found = find_roots(lambda x, below=below: (x - 3.3333) ** 2 - below, PLACES)
        ends = [3.3333 - math.sqrt(below), 3.3333 + math.sqrt(below)]
        assert [one.at for one in found.roots] == pytest.approx(ends, rel=1e-11)


def test_a_jump_is_no_root():
    found = find_roots(lambda x: -1.0 if x < 3.33 else x, PLACES)
    assert found.roots == ()
    (jump,) = found.jumps
    assert (jump.at, jump.before, jump.after) == pytest.approx((3.33, -1.0, 3.33), rel=1e-11)


def test_a_pole_is_a_jump():
    found = find_roots(lambda x: 1 / (x - math.pi), PLACES)
    assert found.roots == ()
    assert [one.at for one in found.jumps] == pytest.approx([math.pi])


def test_stretches_without_a_value_have_their_ends_and_reasons():
    found = find_roots(gaps, PLACES)
    assert [(one.start, one.end) for one in found.without] == [
        pytest.approx(ends, abs=1e-5) for ends in ((0.0, 2.0), (7.0, 8.0), (8.0, 8.503))
    ]
    assert [one.reason.name for one in found.without] == ["this", "the_number", "this"]


def test_zero_all_along_is_a_stretch_and_not_many_roots():
    found = find_roots(lambda x: max(0.0, x - 5.0), PLACES)
    assert (found.roots, found.jumps) == ((), ())
    assert [(one.start, one.end) for one in found.zero] == [(0.0, 5.0)]
    noise = find_roots(lambda x: 1e-16 * math.sin(1e9 * x), PLACES, 1.0)
    assert [(one.start, one.end) for one in noise.zero] == [(0.0, 10.0)]


def test_nothing_can_be_found_where_there_is_nothing():
    found = find_roots(lambda _: gaps(0.0), PLACES)
    assert (found.roots, found.nearest) == ((), None)
    assert [(one.start, one.end) for one in found.without] == [(0.0, 10.0)]


def test_no_value_may_be_infinite_or_none():
    found = find_roots(lambda x: math.nan if x > 5 else x - 1.0, PLACES)
    assert [one.at for one in found.roots] == [pytest.approx(1.0)]
    assert [(one.start, one.end) for one in found.without] == [pytest.approx((5.0, 10.0), abs=1e-5)]


def test_progress_is_told():
    parts = []
    find_roots(lambda x: x - 1.0, PLACES, progress=parts.append)
    assert (parts == sorted(parts), len(parts), parts[-1]) == (True, 401, 1.0)

"""Whatever is in a machine file, the reader gives a machine or a refusal, and nothing else."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from crankwork.analysis import analyse
from crankwork.description.machine_file import read_machine, template, template_names
from crankwork.errors import CrankworkError, InputError
from crankwork.units import UNITS

EXAMPLES = Path(__file__).parents[2] / "examples"
TEMPLATES = [template(name) for name in template_names()]
# a transient, and a table of transfer functions
TEMPLATES += [(EXAMPLES / f"{name}.toml").read_text("utf-8") for name in ("andrews-squeezer", "press")]
SET_KEYS = st.sampled_from(["rod.ratio", "crank", "gas.pieces", "x.y", "method.pi", "title"])
SETTINGS = st.lists(st.builds("{}={}".format, SET_KEYS, st.text(max_size=20)) | st.text(max_size=20), max_size=3)
VALUES = st.one_of(
    st.builds(
        lambda number, unit: f'"{number} {unit}"',
        st.sampled_from(["0", "1", "-1", "1e-9", "1e300", "1e-300", "45", "0.5", "1,1", "nan", "720"]),
        st.sampled_from(sorted(UNITS)),
    ),
    st.sampled_from(
        ["0", "1", "-1", "0.25", "4", "nan", "inf", "-inf", "1e308", "1e-308", "true", "false", "[]", "{}"]
    ),
    st.sampled_from(
        ['"exact"', '"textbook"', '"series:3"', '"series:200"', '"720 deg"', '"360 deg"', '"l/r"', '"gauge"']
    ),
    st.sampled_from(
        ["[[[]]]", '["a", "b"]', "1979-05-27", "07:32:00", '"""\nx\n"""', "0xffff", '"', "'", "[", "9" * 400]
    ),
)
# the whole of a value, its line, or a stretch of text is replaced, doubled, cut or moved
SETTING = re.compile(r"^(\w+ *)= *([^#\n]*?)( *(?:#.*)?)$", re.MULTILINE)
QUICK = settings(max_examples=120, suppress_health_check=[HealthCheck.too_slow])


def _answers(source: str) -> None:
    """Read a text and, where it is a machine, compute it; only a refusal may be raised."""
    try:
        results = analyse(read_machine(source, "my.toml"))
    except InputError as refusal:
        for line in refusal.lines():
            assert re.fullmatch(r"my\.toml(:\d+)?: [^\n\x00-\x1f]+", line), line
    except CrankworkError as refusal:
        assert re.fullmatch(r"my\.toml:\d+: [^\n]+", str(refusal)), refusal  # noqa: PT017 - both outcomes are right
    else:
        assert all(map(math.isfinite, results.summary.values())), dict(results.summary)


@pytest.mark.slow
@QUICK
@given(st.data())
def test_a_template_with_other_values_is_a_machine_or_refused(data) -> None:
    source = data.draw(st.sampled_from(TEMPLATES))
    for _ in range(data.draw(st.integers(1, 3))):
        found = data.draw(st.sampled_from(list(SETTING.finditer(source))))
        source = f"{source[: found.start(2)]}{data.draw(VALUES)}{source[found.end(2) :]}"
        if not SETTING.search(source):
            break
    _answers(source)


@pytest.mark.slow
@QUICK
@given(st.data())
def test_a_template_with_other_numbers_is_a_machine_or_refused(data) -> None:
    """Numbers that pass the reader, up to the ends of what it accepts."""
    source = data.draw(st.sampled_from(TEMPLATES))
    numbers = list(re.finditer(r"(?<=[\"= ])\d+\.?\d*(?=[ \"])", source))
    for found in sorted(
        data.draw(st.lists(st.sampled_from(numbers), min_size=1, max_size=4)), key=lambda one: -one.start()
    ):
        factor = data.draw(st.sampled_from([0, 1e-300, 1e-9, 1e-5, 1e-3, 0.1, 0.5, 2, 10, 1e3, 1e6, 1e12, 1e300]))
        source = f"{source[: found.start()]}{float(found[0]) * factor!r}{source[found.end() :]}"
    _answers(source)


@pytest.mark.slow
@QUICK
@given(st.data())
def test_a_template_with_damaged_text_is_a_machine_or_refused(data) -> None:
    source = data.draw(st.sampled_from(TEMPLATES))
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(source)))
        end = min(len(source), start + data.draw(st.integers(0, 12)))
        damage = data.draw(st.text("[]{}=\"'.,#\n\\ax1 \u00e9\u0301\u202e\x07\U0001f600", max_size=6))
        source = source[:start] + damage + source[end:]
    _answers(source)


@QUICK
@given(st.lists(st.builds("{}={}".format, SET_KEYS, VALUES), max_size=3) | SETTINGS)
def test_any_settings_give_a_machine_or_a_refusal(settings_given) -> None:
    try:
        read_machine(TEMPLATES[0], "my.toml", settings_given)
    except CrankworkError as refusal:
        assert all(re.match(r"--set|my\.toml:\d+: ", line) for line in str(refusal).split("\n"))  # noqa: PT017

"""The line of a key, wherever TOML lets it stand."""

from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from crankwork.description.toml_edit import locate
from each import for_each

SOURCE = '''# comment = 1
title = "a # b = [c]"  # d = 2
text = """
radius = 1
\\""" still text
"""
literal = \'\'\'
[crank]
\'\'\'
[crank]
radius = "1 mm"
mass.big.x = 1
"quoted key" = 1
"dot.ted" = 2
"esc\\u0061pe" = 3
[a.b]
c = { d = 1, e = { f = [1, 2] } }
list = [
  "one",   # two
  { x = 1,  y = 2 },
  [ [1], [2, 3] ],
]
date = 1979-05-27T07:32:00.5-08:00
time = 07:32:00
number = +1_000.5e-3
[[p]]
q = 1
[[p]]
q = 2
[p.r]
s = 3
[[p.t]]
u = 4
'''  # fmt: skip


@for_each(
    ("key", "line"),
    [
        ("title", 2),
        ("text", 3),
        ("literal", 7),
        ("crank", 10),
        ("crank.radius", 11),
        ("crank.mass.big.x", 12),
        ("crank.quoted key", 13),
        ("crank.dot.ted", 14),
        ("crank.escape", 15),
        ("a", 16),
        ("a.b.c.e.f[2]", 17),
        ("a.b.list[1]", 19),
        ("a.b.list[2].y", 20),
        ("a.b.list[3][2][1]", 21),
        ("a.b.date", 23),
        ("a.b.time", 24),
        ("a.b.number", 25),
        ("p[1].q", 27),
        ("p[2].q", 29),
        ("p[2].r.s", 31),
        ("p[2].t[1].u", 33),
    ],
)
def test_a_key_stands_on_its_line(key, line) -> None:
    tomllib.loads(SOURCE)
    assert locate(SOURCE)[key] == line


NAMES = st.text("abc-_019", min_size=1, max_size=3) | st.sampled_from(['"x y"', "'='", '"[#]"', '"\\""', '"."'])
VALUES = st.recursive(
    st.sampled_from(["1", "-0.5", '"#"', "'a\"b'", "true", "1979-05-27", '"""a\n"b"\n"""', "'''\n]'''", '"\\\\"']),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(lambda parts: f"[{', '.join(parts)}]"),
        st.lists(inner, max_size=3).map(lambda parts: "[\n" + "".join(f"{part}, # x ]\n" for part in parts) + "]"),
        inner.map(lambda part: f"{{ k = {part} }}".replace("\n", "") if "\n" not in part else part),
    ),
    max_leaves=6,
)
LINES = st.lists(
    st.one_of(
        st.tuples(NAMES, VALUES).map(lambda pair: f"{pair[0]} = {pair[1]}"),
        st.lists(NAMES, min_size=1, max_size=3).map(lambda names: f"[{'.'.join(names)}]"),
        st.lists(NAMES, min_size=1, max_size=2).map(lambda names: f"[[ {' . '.join(names)} ]]"),
        st.just("# comment [x] = {"),
        st.just(""),
    ),
    max_size=8,
).map("\n".join)


@given(LINES)
def test_every_key_of_valid_toml_has_a_line(source) -> None:
    try:
        values = tomllib.loads(source)
    except tomllib.TOMLDecodeError:
        return
    lines = locate(source)
    assert {key for key in _keys(values, "") if key not in lines} == set()


def _keys(value, path):
    if isinstance(value, dict):
        for name, one in value.items():
            key = f"{path}.{name}" if path else name
            yield key
            yield from _keys(one, key)
    elif isinstance(value, list):
        for number, one in enumerate(value, start=1):
            yield from _keys(one, f"{path}[{number}]")

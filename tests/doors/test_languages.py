"""What the command line refuses, it refuses in the language that it is asked for."""

from __future__ import annotations

from pathlib import Path

import pytest

WRONG = """titel = "x"
[crank]
radius = "50"
speed = 3000
[rod]
ratio = "0.25 mm"
"""


@pytest.mark.parametrize(
    ("language", "lines"),
    [
        ("en", ["1: titel: unknown key; did you mean title?",
                '3: crank.radius: "50" has no unit; write it like "30 mm"', "nothing was computed"]),
        ("ru", ["1: titel: неизвестный ключ; возможно, title?",
                '3: crank.radius: "50": нет единицы; запишите как "30 mm"', "ничего не вычислено"]),
        ("vi", ["1: titel: khoá không có; có phải title?",
                '3: crank.radius: "50": thiếu đơn vị; hãy ghi như "30 mm"', "chưa tính gì"]),
    ],
)  # fmt: skip
def test_every_mistake_of_a_file_is_told_in_the_language(crankwork, language, lines):
    Path("wrong.toml").write_text(WRONG, encoding="utf-8")
    answer = crankwork("run", "wrong.toml", "--lang", language)
    assert answer.code == 2
    told = answer.err.splitlines()
    assert [line for line in told if line.removeprefix("wrong.toml:") in lines] != []
    assert {line.removeprefix("wrong.toml:") for line in told} >= set(lines)


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (("run", "x.toml", "--lang=ru", "--foo"), "--foo: такого параметра нет; см. --help"),
        (("report", "--lang", "vi", "x.toml"), "-o: còn thiếu; hãy ghi -o NOTE, xem --help"),
        (("run", "x.toml", "--lang", "de"), "--lang: de is not possible; write en or ru or vi"),
    ],
)
def test_the_command_line_is_explained_in_the_language(crankwork, command, said):
    assert crankwork(*command).err.splitlines() == [said]


@pytest.mark.parametrize(("language", "said"), [("en", "with masses"), ("ru", "с массами"), ("vi", "có khối lượng")])
def test_what_a_file_describes_is_told_in_the_language(crankwork, language, said):
    crankwork("new", "slider-crank", "-o", "one.toml")
    answer = crankwork("check", "one.toml", "--lang", language)
    assert (answer.code, answer.err) == (0, "")
    assert said in answer.out

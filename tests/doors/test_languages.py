"""What the command line refuses, it refuses in the language that it is asked for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from crankwork.cli import commands
from crankwork.description.machine_file import template

CHECKOUT = Path(__file__).parents[2]
EXAMPLES = CHECKOUT / "examples"
ORDER = "firing_order = [1, 3, 4, 2]"
# the file, what a user writes in it, and how what is wrong begins in Russian and in Vietnamese
MISTAKES = {
    "wrong load": ("toggle-press", 'slider = "ram"', 'slider = "rm"', 'ползуна "rm" нет', 'không có con trượt "rm"'),
    "load counted wrongly": ("toggle-press", 'at = ["11 mm", "21 mm", "31 mm"]', 'at = ["1 deg", "2 deg", "3 deg"]',
                             "значения должны быть одного рода, длины", "các giá trị phải cùng loại, là chiều dài"),
    "loose link": ("four-bar", "[links]", '[links]\nz = { joins = ["B", "Y"], length = "1 m" }',
                   "z держится только на B, а в Y", "z chỉ nối tại B, và không có gì khác nối tại Y"),
    "nowhere": ("toggle-press", 'through = "E"', 'through = ["900 mm", "0 mm"]',
                "звено lower не достаёт до направляющей D", "khâu lower không với tới đường dẫn"),
    "locked slider": ("scotch-yoke", '{ through = "O", angle = "0 deg" }', '{ link = "crank", angle = "90 deg" }',
                      "yoke не может скользить, потому что yoke и block", "yoke không trượt được, vì yoke và block"),
    "branch of no joint": ("four-bar", "B = 1 ", "Z = 1 ", "у Z нет ветви", "Z không có nhánh"),
    "textbook": ("four-bar", "[branch]", '[method]\nkinematics = "textbook"\n[branch]',
                 "метод textbook есть только у кривошипов", "phương pháp textbook chỉ có ở tay quay"),
    "order repeats": ("petrol-four", ORDER, "firing_order = [1, 3, 4, 4]",
                      "1-3-4-4: цилиндр 4 назван дважды, а цилиндр 2", "1-3-4-4 ghi xi lanh 4 hai lần và thiếu"),
    "order against throws": ("petrol-four", ORDER, f'{ORDER}\nthrows = ["0 deg", "0 deg", "180 deg", "180 deg"]',
                             "коленчатый вал не допускает порядка работы", "trục khuỷu không cho phép thứ tự"),
    "common pins disagree": ("v8-diesel", 'bank_angle = "90 deg"', 'bank_angle = "60 deg"',
                             "цилиндры 1 и ", "xi lanh 1 và "),
    "unknown fuel": ("petrol-four", "excess_air = 0.96", 'fuel = "coal"',
                     'топливо "coal" неизвестно; запишите petrol или diesel', 'không có nhiên liệu "coal"'),
    "exponent of one": ("petrol-four", "1.377", "1.0", "показатель, равный 1,", "chỉ số đúng bằng 1"),
    "burning too long": ("two-stroke", '"48 deg"', '"150 deg"', "сгорание длится от", "quá trình cháy kéo dài từ"),
    "no intake": ("petrol-four", '"0.085 MPa"', '"0.005 MPa"', "при давлении в конце впуска", "áp suất cuối quá trình"),
    "unknown unit": ("four-bar", "100 rpm", "100 vg/phh", 'единица "vg/phh" неизвестна; возможно, "100 vg/ph"?',
                     'không có đơn vị "vg/phh"; có phải "100 vg/ph"?'),
    "unknown key": ("four-bar", "pin =", "pinn =", "неизвестный ключ; возможно, pin?", "khoá không có; có phải pin?"),
    "missing": ("four-bar", 'radius = "62.5 mm"', "", "отсутствует; запишите radius =", "còn thiếu; hãy ghi radius ="),
    "other method": ("petrol-four", ORDER, f'{ORDER}\n[method]\nkinematics = "x"', 'метода "x" нет',
                     'không có phương pháp "x"'),
}  # fmt: skip
# words that sentences are made of, and no key of a file
ENGLISH = re.compile(r"\b(the|is|are|it|its|has|not|of|and|or|to|there|write|leave|by|cannot|must|links?|deg|add)\b")
WRONG = """titel = "x"
[crank]
radius = "50"
speed = 3000
[rod]
ratio = "0.25 mm"
"""


def test_every_mistake_of_a_file_is_told_in_the_language(crankwork):
    Path("wrong.toml").write_text(WRONG, encoding="utf-8")
    for language, lines in {
        "en": ["1: titel: unknown key; did you mean title?",
               '3: crank.radius: "50" has no unit; write it like "50 mm"', "nothing was computed"],
        "ru": ["1: titel: неизвестный ключ; возможно, title?",
               '3: crank.radius: "50": нет единицы; запишите как "50 mm"', "ничего не вычислено"],
        "vi": ["1: titel: khoá không có; có phải title?",
               '3: crank.radius: "50": thiếu đơn vị; hãy ghi như "50 mm"', "chưa tính gì"],
    }.items():  # fmt: skip
        answer = crankwork("run", "wrong.toml", "--lang", language)
        assert answer.code == 2
        assert [line for line in lines if line not in answer.err.replace("wrong.toml:", "").splitlines()] == []


def test_the_command_line_and_files_are_explained_in_the_language(check_refusals):
    Path("wrong.toml").write_bytes(b"\xff")
    Path("my.toml").write_text(template("four-bar"), "utf-8")
    check_refusals([
        (("run", "x.toml", "--lang=ru", "--zzz"), "--zzz: такого параметра нет; см. --help"),
        (("report", "--lang", "vi", "x.toml"), "-o: còn thiếu; hãy ghi -o TỆP-GHI, xem --help"),
        (("run", "x.toml", "--lang", "de"), "--lang: de is not possible; write en, ru or vi"),
        (("run", "--lang", "ru"), "ФАЙЛ: отсутствует; запишите после команды, см. --help"),
        (("run", "x.toml", "my", "note", "--lang", "vi"),
         "my note: thừa ở đây; hãy bỏ đi, hoặc đặt các từ thuộc về nhau trong dấu ngoặc kép"),
        (("run", "a.toml", "--json=yes", "--lang", "ru"), "--json: значение не нужно; уберите знак = и то, что за ним"),
    ])  # fmt: skip
    for command, russian, vietnamese in (
        (("check", "none.toml"), "такого файла нет; проверьте путь", "không có tệp này; hãy kiểm tra đường dẫn"),
        (("check", "."), "это папка; укажите файл", "là thư mục; hãy cho một tệp"),
        (("check", "wrong.toml"), "это не текст UTF-8", "không phải văn bản UTF-8"),
        (("run", "my.toml", "-o", "wrong.toml"), "это файл; укажите папку для -o", "là tệp; hãy cho một thư mục"),
    ):
        check_refusals([((*command, "--lang", "ru"), russian), ((*command, "--lang", "vi"), vietnamese)])


def test_help_is_said_in_the_language_of_the_system_or_of_the_command_line(crankwork, monkeypatch):
    # what Click says by itself, and stand-ins for values
    clicks = r"\b(Usage|Options|Commands|Show|OPTIONS|ARGS|FILE|VALUE|default|required)\b"
    failures = {}
    for command in [(), *((name,) for name in commands.commands)]:
        monkeypatch.delenv("LC_ALL", raising=False)
        english = crankwork(*command, "--help")
        options = re.findall(r"^  (?:-\w, )?--[a-z-]+", english.out, re.MULTILINE)
        good = english[::2] == (0, "") and re.search(clicks, english.out) is not None
        for language in ("ru", "vi"):
            monkeypatch.setenv("LC_ALL", f"{language}.UTF-8")
            said = crankwork(*command, "--help").out
            good &= re.findall(r"^  (?:-\w, )?--[a-z-]+", said, re.MULTILINE) == options
            good &= re.findall(f"{clicks}|{ENGLISH.pattern}", re.sub(r"--[a-z-]+", "", said)) == []
            if command:
                good &= crankwork(*command, "--lang", language, "--help").out == said
            if not good:
                failures[*command, language] = said
    assert failures == {}


def test_what_is_refused_is_told_without_a_word_of_english(crankwork):
    failures = {}
    for mistake, (name, old, new, *sentences) in MISTAKES.items():
        source = EXAMPLES / f"{name}.toml"
        text = source.read_text("utf-8") if source.exists() else template(name)
        assert old in text
        Path("my.toml").write_text(text.replace(old, new, 1), "utf-8")
        for language, said in zip(("ru", "vi"), sentences, strict=True):
            answer = crankwork("check", "my.toml", "--lang", language)
            told = [line.partition(f": {said}")[2] for line in answer.err.splitlines() if f": {said}" in line]
            english = ENGLISH.findall(re.sub(r'"[^"]*"|\[[^]]*\]', "", told[0])) if told else ["not told"]
            if answer.code != 2 or english:
                failures[mistake, language] = (english, answer.err)
    assert failures == {}


def test_a_number_has_the_decimal_mark_of_the_language_unless_it_is_typed_into_a_file(crankwork):
    for language, mark in {"en": ".", "ru": ",", "vi": ","}.items():
        asked = ("check", str(EXAMPLES / "petrol-four.toml"), "--lang", language, "--set")
        wrong = crankwork(*asked, "cycle.intake_pressure=0.005 MPa").err
        assert f" 0{mark}005 " in wrong
        assert f" 0{mark}118 " in wrong
        wrong = crankwork(*asked, "cylinder.compression_ratio=0.5").err
        assert re.search(r"0\.5 .* 1\.001 .* 100$", wrong, re.MULTILINE)


def test_what_is_not_installed_is_told_in_the_language(crankwork, monkeypatch):
    monkeypatch.setattr("crankwork.errors.find_spec", lambda _: None)
    Path("my.toml").write_text(template("four-bar"), "utf-8")
    for language, said in (
        ("ru", f"эта записка: нужна дополнительная часть; установите её: pip install -e '{CHECKOUT}[report]'"),
        ("vi", "bản thuyết minh này cần"),
    ):
        assert said in crankwork("report", "my.toml", "-o", "note.pdf", "--lang", language).err
    answer = crankwork("run", "my.toml", "-o", "out", "--lang", "ru", "--no-figures")
    assert "примечание: запись tables.xlsx: нужна" in answer.err


def test_what_a_machine_is_and_why_it_stops_is_told_in_the_language(crankwork):
    text = template("slider-crank")
    Path("my.toml").write_text(text, "utf-8")
    for language, said in {"en": "with masses", "ru": "с массами", "vi": "có khối lượng"}.items():
        answer = crankwork("check", "my.toml", "--lang", language)
        assert (answer.code, answer.err, said in answer.out) == (0, "", True)
    text = (EXAMPLES / "petrol-four.toml").read_text("utf-8")
    slow = text.replace("5600 rpm", "600 rpm")
    Path("my.toml").write_text(slow.replace("fluctuation = 0.01", 'inertia = "1e-9 kg*m2"'), "utf-8")
    said = crankwork("check", "my.toml", "--lang", "ru").out
    assert re.search(r"средней скорости 62,8319 рад/с машина останавливается при угле .* \d+,\d град", said), said
    Path("my.toml").write_text(template("four-bar").replace("112.5 mm", "75 mm"), "utf-8")
    for language, said in (("ru", "звенья coupler и rocker не сходятся"), ("vi", "các khâu coupler và rocker không")):
        answer = crankwork("run", "my.toml", "--lang", language)
        assert (answer.code, said in answer.out) == (1, True)


@pytest.mark.parametrize(
    ("variables", "words"),
    [
        ({"LANG": "ru_RU.UTF-8"}, "ход поршня"),
        ({"LC_ALL": "vi_VN", "LANG": "ru_RU.UTF-8"}, "hành trình"),
        ({"LC_MESSAGES": "ru_UA.UTF-8"}, "ход поршня"),
        ({"LANG": "uk_UA.UTF-8"}, "stroke"),
        ({"LANG": "C"}, "stroke"),
    ],
)
def test_commands_speak_the_language_of_the_system(crankwork, machine_file, monkeypatch, variables, words) -> None:
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    path = machine_file(name="slider-crank")
    assert words in crankwork("run", path).out
    assert "stroke" in crankwork("run", path, "--lang", "en").out
    refused = crankwork("run", "nothing.toml").err
    assert ("проверьте" in refused) == (words == "ход поршня")


def test_decimal_commas_and_letters_that_need_quotes_are_told_with_the_fix(crankwork, tmp_path) -> None:
    fixes = {
        "ratio = 0,25": "0.25", "ratio = 0,25  # r/l": "0.25", "small_end = { share = 0,5 }": "0.5",
        "[цилиндр]": '["цилиндр"]', "[[нагрузки]]": '[["нагрузки"]]', "шатун = 1": '"шатун" = ...',
        "масса шатуна = 3": '"масса шатуна" = ...', "khối_lượng = 3": '"khối_lượng" = ...',
    }  # fmt: skip
    told = {}
    for line in fixes:
        (tmp_path / "my.toml").write_text(f'[crank]\nradius = "45 mm"\n[rod]\n{line}\n', encoding="utf-8")
        answers = [crankwork("check", "my.toml", "--lang", language).err for language in ("en", "ru", "vi")]
        told[line] = [one.partition("\n")[0] for one in answers]
    assert {
        line: some for line, some in told.items()
        if not all(one.startswith("my.toml:4: ") and one.endswith(fixes[line]) for one in some)
    } == {}  # fmt: skip

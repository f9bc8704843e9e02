"""The note of a linkage and of a press: what stands in it, in which order, and that its numbers are those of a book.

The numbers of the press: Курсовой проект по динамике машин, рычажный механизм пресса (Russian course project on a press
linkage), its table 4 and formulas 9 to 12; the document rounds each term of the reduced inertia before it adds them.
"""

from __future__ import annotations

import functools
import importlib
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.linkage import differences
from crankwork.description.machine_file import template
from crankwork.dynamics.efficiency import Parallel, Series
from crankwork.formula.expression import evaluate
from crankwork.formula.lines import FormulaLine
from crankwork.locale import say, texts
from crankwork.note.contents import WRITERS, note_of, sheets_of
from crankwork.note.document import Equation, Figure, Heading, ItemList, Math, Note, Paragraph, Table
from crankwork.note.equations import printed_equation
from crankwork.note.numbering import numbering
from crankwork.note.options import NoteOptions
from crankwork.note.symbols import subscript
from crankwork.note.words import Words
from crankwork.quantities import LANGUAGES

EXAMPLES = Path(__file__).parents[2] / "examples"
INERTIA = (0.263, 0.491, 1.037, 1.225, 0.907, 0.457, 0.263, 0.613, 0.959, 1.223, 1.01, 0.579)
DERIVATIVE = (0, 0.5, 0.982, -0.08, -0.76, -0.85, -0.05, 0.814, 0.646, -0.01, -0.57, -0.84)
DYNAMIC = (0, 53.656, 105.38, -8.585, -81.557, -91.215, -5.366, 87.351, 69.323, -1.073, -61.167, -90.142)
DRIVING = (121.32, 169.41, 204.12, 116.04, 181.76, -102.68, -59.77, -1.26, 19.0, -0.73, -9.04, -9.93)
ROD = (0.025, 0.032, 0.046, 0.05, 0.043, 0.031, 0.025, 0.037, 0.045, 0.05, 0.046, 0.036)
ROCKER = (0, 0.115, 0.22, 0.238, 0.193, 0.107, 0, 0.129, 0.197, 0.238, 0.21, 0.133)
MOTOR = [
    *((f"# {name}", name) for name in ("[motor]", "rated_power", "rated_speed", "overload", "pole_pairs", "ratio = ")),
    ("# [flywheel]", "[flywheel]"), ("# fluctuation", "fluctuation"),
]  # fmt: skip


@functools.cache
def results(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))


@pytest.fixture
def toggle(tmp_path) -> crankwork.Results:
    """A press with loads, motor and flywheel."""
    text = template("toggle-press")
    for old, new in MOTOR:
        assert old in text
        text = text.replace(old, new)
    (tmp_path / "toggle.toml").write_text(text, encoding="utf-8")
    return crankwork.analyse(crankwork.read(tmp_path / "toggle.toml"))


def note(name: str, **options: object) -> Note:
    return note_of(results(name), NoteOptions(**{"figures": False, **options}))


def table(found: Note, label: str) -> Table:
    return next(one for one in found.blocks if isinstance(one, Table) and one.label == label)


def column(found: Table, k: int) -> list[float]:
    return [float(row[k].replace("−", "-").replace(",", ".")) for row in found.rows]


def headings(found: Note, level: int = 1) -> list[str]:
    return [one.text for one in found.blocks if isinstance(one, Heading) and one.level == level]


def count(found: Note, kind: type) -> int:
    return sum(isinstance(one, kind) for one in found.blocks)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_press_has_its_four_tables_with_the_numbers_of_the_document(language):
    found = note("press", language=language)
    labels = [one.label for one in found.blocks if isinstance(one, Table)]
    assert labels == ["transfer", "static", "reduced", "torque", "summary"]
    transfer, static, reduced, torque = (table(found, name) for name in labels[:4])
    assert column(transfer, 0) == list(range(1, 13))
    assert column(transfer, 1) == [30.0 * k for k in range(12)]
    assert column(transfer, 2) == list(ROD)
    assert column(transfer, 6) == list(ROCKER)
    assert column(reduced, 6) == pytest.approx(INERTIA, abs=0.0015)
    assert column(reduced, 7) == list(DERIVATIVE)
    # the parts of the four bodies add up to the whole as printed
    assert np.sum([column(reduced, k) for k in range(2, 6)], axis=0) == pytest.approx(column(reduced, 6), abs=0.0008)
    assert column(torque, 2) == list(DERIVATIVE)
    assert column(torque, 3) == pytest.approx(DYNAMIC, abs=0.05)
    assert column(torque, 6) == pytest.approx(DRIVING, abs=0.05)
    assert column(static, 2) == column(torque, 4)
    assert column(static, 2) == pytest.approx(np.subtract(column(torque, 5), column(torque, 3)), abs=0.11)


def test_the_press_is_worked_at_all_positions_with_the_value_of_the_table():
    found = note("press", language="ru")
    worked = {one.symbol: one.step for one in found.blocks if isinstance(one, Equation)}
    assert [worked[f"M_дин,{k}"].value for k in range(1, 13)] == pytest.approx(DYNAMIC, abs=0.001)
    assert [worked[f"M_Σ,{k}"].value for k in range(1, 13)] == pytest.approx(DRIVING, abs=0.011)
    assert worked["J_пр"].value == pytest.approx(INERTIA[1], abs=0.0015)


def test_every_number_put_into_a_formula_gives_the_value_beside_it(toggle):
    for found in (note("press"), note("press-geometry"), note("andrews-squeezer"), note_of(toggle)):
        steps = [one.step for one in found.blocks if isinstance(one, Equation) and isinstance(one.step, FormulaLine)]
        assert len(steps) > 20
        for step in steps:
            assert evaluate(step.expression, step.values) == pytest.approx(step.value, rel=1e-12, abs=1e-300)


def test_no_rounding_of_a_zero_is_printed_as_a_number(toggle):
    blocks = note_of(toggle, NoteOptions(figures=False)).blocks
    lines = [printed_equation(one, "en").text for one in blocks if isinstance(one, Equation)]
    assert lines
    assert not [one for one in lines if re.search("10⁻(¹[¹²³⁴⁵⁶⁷⁸⁹]|[²³⁴⁵⁶⁷⁸⁹][⁰¹²³⁴⁵⁶⁷⁸⁹])", one)]


def test_tables_print_nothing_where_only_rounding_is_left():
    """A parallelogram at a steady speed needs no torque, its coupler does not turn, its rocker turns evenly."""
    found = note("parallelogram")
    for label, first, last in (("routes", 2, 8), ("torque", 2, 5), ("reduced", 3, 4), ("transfer", 7, 8)):
        assert {text for row in table(found, label).rows for text in row[first:last]} == {"0"}, label
    tables = [one for one in found.blocks if isinstance(one, Table) and one.label != "checks"]
    assert not [row for one in tables for row in one.rows if any("10⁻" in str(text) for text in row)]


def test_values_of_steps_are_those_of_the_results():
    found, whole = note("press-geometry"), results("press-geometry")
    row = int(np.argmin(np.abs(whole.grid.degrees - 30.0)))
    keys = ("reduced_inertia", "reduced_inertia_1", "dynamic_torque", "driving_torque", "point_velocity.B")
    worked = {one.step.key: one.step.value for one in found.blocks if isinstance(one, Equation)}
    for key in keys:
        assert worked[key] == pytest.approx(whole.columns[key][row], rel=1e-12)


HEADINGS = {
    "ru": [
        "Задание и исходные данные", "Структурный анализ механизма", "Кинематический анализ механизма",
        "Качественные показатели механизма", "Силовой расчёт механизма", "Уравновешивание механизма",
        "Приведение масс и сил", "Статический, динамический и суммарный движущий моменты",
        "Выбор двигателя", "Расчёт маховика", "Закон движения кривошипа", "Проверка результатов", "Заключение",
        "Список литературы", "Приложение А. Результаты расчёта за оборот кривошипа",
    ],
    "vi": [
        "Nhiệm vụ và số liệu cho trước", "Phân tích cấu trúc cơ cấu", "Phân tích động học cơ cấu",
        "Các chỉ tiêu chất lượng của cơ cấu", "Phân tích lực cơ cấu", "Cân bằng cơ cấu",
        "Thu gọn khối lượng và lực", "Mômen tĩnh, mômen động và mômen dẫn động", "Chọn động cơ", "Tính bánh đà",
        "Quy luật chuyển động của tay quay", "Kiểm tra kết quả", "Kết luận", "Tài liệu tham khảo",
        "Phụ lục: kết quả tính trong một vòng quay",
    ],
    "en": [
        "Task and data", "Main results", "Structure", "Kinematics of the mechanism",
        "Quality of the mechanism", "Forces in the joints", "Balance of the mechanism",
        "Reduced masses and forces", "Static, dynamic and driving torque", "Choice of the motor",
        "Design of the flywheel",
        "Law of motion", "Checks", "References", "Appendix: results over the whole turn",
    ],
}  # fmt: skip


@pytest.mark.parametrize("language", LANGUAGES)
def test_sections_stand_in_the_order_of_each_school(toggle, language):
    found = note_of(toggle, NoteOptions(language=language, figures=False))
    assert headings(found) == HEADINGS[language]


def test_a_school_gives_its_order_to_another_language():
    found = note("press-geometry", language="en", school="ru")
    assert headings(found)[-2:] == ["Conclusion", "References"]
    assert headings(note("press-geometry", language="ru", school="en"))[1] == "Основные результаты расчёта"


@pytest.mark.parametrize(
    ("name", "tables", "equations", "figures"),
    [("press", 5, 42, 2), ("press-geometry", 23, 239, 13), ("andrews-squeezer", 33, 393, 15)],
)
def test_how_many_tables_equations_and_figures_a_note_has(name, tables, equations, figures):
    found = note(name, language="ru", figures=True)
    assert (count(found, Table), count(found, Equation), count(found, Figure)) == (tables, equations, figures)
    assert not any(isinstance(one, Figure) for one in note(name).blocks)
    drawn = [one for one in found.blocks if isinstance(one, Figure)]
    assert all(one.alt and one.alt != one.caption for one in drawn)


def test_position_tables_have_thirteen_rows_and_fit_on_a_page():
    found = note("andrews-squeezer")
    shown = [one for one in found.blocks if isinstance(one, Table) and len(one.rows) == 13]
    assert len(shown) > 10
    assert all(len(one.headings) <= 11 and not one.wide for one in shown)
    long = [one for one in found.blocks if isinstance(one, Table) and one.rows[-1][0] == "360"]
    assert len(long) == 5
    assert all(len(one.headings) <= 11 and not one.wide for one in long)


def test_five_routes_to_the_torque_agree_and_say_by_how_much():
    shown = table(note("press-geometry"), "routes")
    assert len(shown.headings) == 8
    assert len(shown.rows) == 13
    for row in shown.rows:
        assert len(set(row[2:7])) == 1
        assert "10⁻" in row[7] or row[7] == "0"


def test_differences_are_relative_to_the_largest_torque():
    routes = [np.array([1.0, -4.0]), np.array([1.02, -4.0]), np.array([1.0, -3.9])]
    assert differences(routes) == pytest.approx([0.02 / 4, 0.1 / 4])
    assert differences([np.zeros(2), np.zeros(2)]) == pytest.approx([0, 0])


def test_forces_are_worked_where_the_loads_are_largest(toggle):
    found = note_of(toggle, NoteOptions(figures=False))
    (static,) = [one.step for one in found.blocks if isinstance(one, Equation) and one.step.key == "static_torque"]
    at = np.arange(0, 361, 30)
    rows = [int(np.argmin(np.abs(toggle.grid.degrees - one))) for one in at]
    assert static.value == pytest.approx(np.max(np.abs(toggle["static_torque"][rows])), rel=1e-12)
    assert static.value > 100


def test_the_flywheel_is_found_four_ways_and_the_motor_is_checked(toggle):
    found = note_of(toggle, NoteOptions(language="ru", figures=False))
    shown = table(found, "flywheels")
    assert [row[0] for row in shown.rows][1:] == ["метод Мерцалова", "метод Виттенбауэра", "точное решение"]
    ways = ("energy", "mertsalov", "wittenbauer", "exact")
    wanted = [toggle.summary[f"flywheel_inertia.{way}"] for way in ways]
    assert column(shown, 2) == pytest.approx(wanted, rel=1e-5)
    text = " ".join(str(run) for one in found.blocks if isinstance(one, Paragraph) for run in one.runs)
    assert "2,2\u00a0кВт" in text


def test_every_equation_is_numbered_and_every_symbol_explained_once():
    found = note("andrews-squeezer", language="ru")
    numbers = zip(found.blocks, numbering(found).blocks, strict=True)
    shown = [(one, number) for one, number in numbers if isinstance(one, Equation)]
    assert [number for _, number in shown] == [str(count) for count in range(1, len(shown) + 1)]
    explained = [entry.text for one, _ in shown for entry in one.legend]
    assert len(explained) == len(set(explained))


def test_a_note_without_a_title_has_one_of_its_kind():
    for name, titles in (("press", "tabulated"), ("press-geometry", "linkage")):
        whole = results(name)
        bare = replace(whole, solved=replace(whole.solved, machine=replace(whole.machine, title="")))
        for language in LANGUAGES:
            found = note_of(bare, NoteOptions(language=language, figures=False, author="А. Б."))
            assert found.title == say(f"headings.{titles}", language)
            assert found.authors == ("А. Б.",)
    assert note("press", title="Пресс").title == "Пресс"


def four_bar(tmp_path: Path, *changes: tuple[str, str]) -> crankwork.Results:
    text = template("four-bar")
    for old, new in changes:
        assert re.search(old, text)
        text = re.sub(old, new, text)
    (tmp_path / "four-bar.toml").write_text(text, encoding="utf-8")
    return crankwork.analyse(crankwork.read(tmp_path / "four-bar.toml"))


def test_a_linkage_that_does_not_turn_fully_keeps_the_numbers_of_its_positions(tmp_path):
    found = note_of(four_bar(tmp_path, ("62.5 mm", "150 mm")), NoteOptions(language="ru", figures=False))
    rows = table(found, "transfer").rows
    assert [(row[0], row[1]) for row in rows] == [("1", "30"), ("2", "60"), ("3", "90")]
    (notices,) = [one for one in found.blocks if isinstance(one, ItemList)]
    why = r"механизм движется только от \d+,\d+° до \d+,\d+°: звенья coupler и rocker не сходятся .* на \d+,\d+ мм.*"
    assert re.fullmatch(why, notices.items[0][0]), notices.items[0][0]


def test_what_a_crank_reaches_that_does_not_turn_fully_is_told(tmp_path):
    whole = four_bar(tmp_path, ("62.5 mm", "150 mm"))
    found = note_of(whole, NoteOptions(language="ru", figures=False))
    assert table(found, "reach").rows == [("coupler", "°", "22,5337", "80,0249"), ("rocker", "°", "181,668", "–")]
    assert "Уравновешивание механизма" in headings(found)
    # what counterweight is best is asked of whole turns only
    assert "orders" not in {one.label for one in found.blocks if isinstance(one, Table)}
    text = " ".join(str(run) for one in found.blocks if isinstance(one, Paragraph) for run in one.runs)
    assert "97,2003°" in text


def template_results(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read_machine(template(name)))


def test_ends_and_time_ratio_of_a_shaper_are_those_of_its_lever():
    found = note_of(template_results("crank-shaper"), NoteOptions(figures=False))
    rows = {row[0]: [float(one.replace("−", "-")) for one in row[2:]] for row in table(found, "ends").rows}
    # a lever touched by the circle of the crank: radius 50 mm, pivot 150 mm below
    reach = np.degrees(np.arcsin(50 / 150))
    ends = (90 - reach, 270 - reach, 90 + reach, 90 + reach, 2 * reach, (180 + 2 * reach) / (180 - 2 * reach))
    assert rows["lever"] == pytest.approx(ends, abs=0.06)
    assert rows["ram"][-1] == pytest.approx(ends[-1], rel=1e-5)


def test_extreme_transmission_angles_are_worked_where_crank_and_frame_are_in_line():
    whole = template_results("four-bar")
    found = note_of(whole, NoteOptions(figures=False))
    worked = {one.step.key: one.step.value for one in found.blocks if isinstance(one, Equation)}
    for end, base in (("min", 200 - 62.5), ("max", 200 + 62.5)):
        cosine = (175**2 + 112.5**2 - base**2) / (2 * 175 * 112.5)
        assert worked[f"transmission_angle_{end}.B"] == pytest.approx(np.arccos(cosine), rel=1e-12)
    (row,) = table(found, "limits").rows
    assert row == ("B", "51.7534", "0", "130.601", "180")


def test_instant_centres_are_worked_where_their_link_turns_and_left_out_where_not():
    whole = template_results("crank-shaper")
    found = note_of(whole, NoteOptions(figures=False))
    (shown,) = [one for one in found.blocks if isinstance(one, Table) and one.caption == "Instant centres"]
    assert [row[0] for row in shown.rows if row[2:] == ("–", "–")] == ["0", "6", "12"]
    worked = {one.step.key: one.step.value for one in found.blocks if isinstance(one, Equation)}
    # on the normal of the ram's guide in D, and on the lever through C
    at = whole.columns_at([330.0])
    assert worked["instant_centre_x.link"] == pytest.approx(at["point_x.D"][0], rel=1e-12)
    slope = np.tan(at["link_angle.lever"][0])
    height = at["point_y.C"][0] + slope * (worked["instant_centre_x.link"] - at["point_x.C"][0])
    assert worked["instant_centre_y.link"] == pytest.approx(height, rel=1e-9)


def test_the_counterweight_stands_after_the_shaking_force():
    found = note("beta-stirling")
    worked = {one.step.key: one.step.value for one in found.blocks if isinstance(one, Equation)}
    sizes = worked["shaking_force_x"], worked["shaking_force_y"]
    assert worked["shaking_force"] == pytest.approx(np.hypot(*sizes), rel=1e-12)
    # masses that swing sinusoidally along x: half of each is taken out by one that turns against it
    turning = 0.4 * 0.03 + 0.9 * 0.025 * np.exp(-1j * np.radians(60))
    assert worked["counterweight_moment"] == pytest.approx(abs(turning) / 2, rel=1e-9)
    assert column(table(found, "orders"), 1) == pytest.approx([abs(turning) * 94.24778**2, 0, 0, 0], abs=1e-3)


_WHOLE = {"en": "(one|the|whole) turn\\b", "ru": "оборот( |;|$)", "vi": "một vòng quay|cả vòng quay"}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_linkage_between_dead_positions_is_not_said_to_turn(tmp_path, language):
    found = note_of(four_bar(tmp_path, ("62.5 mm", "150 mm")), NoteOptions(language=language))
    runs = [str(run) for one in found.blocks if isinstance(one, Paragraph) for run in one.runs]
    seen = [text for one in found.blocks if isinstance(one, Figure) for text in (one.caption, one.alt)]
    captions = [one.caption for one in found.blocks if isinstance(one, Table)]
    said = [*runs, *seen, *captions, *headings(found)]
    assert say("sentences.task_partial", language) in " ".join(runs)
    assert say("headings.appendix_partial", language) in headings(found)
    assert any(one.startswith(say("captions.reactions_partial", language)) for one in captions)
    assert not [one for one in said if re.search(_WHOLE[language], one)]


def test_a_linkage_without_masses_has_its_motion_only(tmp_path):
    whole = four_bar(tmp_path, (r", mass.*?centre = (\[.*?\]|\"P\")", ""))
    assert headings(note_of(whole, NoteOptions(language="en", figures=False))) == [
        "Task and data", "Main results", "Structure", "Kinematics of the mechanism",
        "Quality of the mechanism", "References",
        "Appendix: results over the whole turn",
    ]  # fmt: skip


def test_an_accelerating_crank_is_said_and_worked(tmp_path):
    whole = four_bar(tmp_path, ('"100 rpm"', '"100 rpm"\nangular_acceleration = "5 rad/s2"'))
    found = note_of(whole, NoteOptions(figures=False))
    worked = {one.step.key: one.step for one in found.blocks if isinstance(one, Equation)}
    assert worked["dynamic_torque"].values["eps"] == 5
    runs = [run for one in found.blocks if isinstance(one, Paragraph) for run in one.runs]
    assert "Angular acceleration of the crank: " in runs


def test_the_chain_of_efficiencies_is_worked_where_it_is_known():
    whole = results("press")
    drive = replace(whole.machine.drive)
    half = Parallel((0.98, 0.98))
    object.__setattr__(drive, "chain", Series((half, 0.98, 0.99, 0.86, 0.86, 0.99, half)))
    changed = replace(whole, solved=replace(whole.solved, machine=replace(whole.machine, drive=drive)))
    found = note_of(changed, NoteOptions(language="ru", figures=False))
    worked = {one.symbol: one.step for one in found.blocks if isinstance(one, Equation)}
    assert worked["η"].value == pytest.approx(0.98**3 * 0.99**2 * 0.86**2, rel=1e-12)


def test_russian_and_vietnamese_say_nothing_in_english():
    english = {"the", "and", "of", "with", "is", "are", "crank", "link", "by"}
    for room in ("headings", "captions", "columns", "sentences", "seen", "note", "figures", "tables", "notices"):
        for key, said in texts(room, "ru").items():
            # what is to be written into a file is in its own words
            russian = re.sub(r'[\w{}.]+ = "[^"]*"|\{\w+\}(?:\.\w+)?|[\w.]+\.\w+|p–V|CO₂|const|true|rigid', "", said)
            assert not re.findall(r"[A-Za-z]{3,}", russian), (room, key)
        for key, said in texts(room, "vi").items():
            spelled = re.findall(r"[a-z]+(?![^\W\d_])", re.sub(r"\{\w+\}", "", said).lower())
            assert not english & set(spelled), (room, key)


@pytest.mark.parametrize("language", ["ru", "vi"])
def test_a_whole_note_has_no_english_but_names_and_sources(language):
    found = note("press-geometry", language=language, title="–")
    names = "rod rocker block punch slot bed press motion from geometry const"
    words = []
    for one in found.blocks:
        match one:
            case Heading(text=text):
                words.append(text)
            case Paragraph(runs):
                words += [run for run in runs if isinstance(run, str)]
            case Table(caption=caption, headings=titles, rows=rows):
                words += [caption, *(run for runs in titles for run in runs if isinstance(run, str))]
                words += [cell for row in rows for cell in row]
    spelled = {word for text in words for word in re.findall(r"\b[A-Za-z]{3,}\b", text)}
    if language == "ru":
        assert spelled <= set(names.split())
    else:
        assert not spelled & {"the", "and", "link", "links", "joint", "force", "torque", "crank", "angle", "speed"}


@pytest.mark.parametrize(
    ("language", "values", "shown"),
    [
        ("en", [0.05, -0.1234567], ["0.0500", "−0.1235"]),
        ("ru", [1234.5, -0.04], ["1234", "0"]),
        ("ru", [-99.96, 5.0], ["−100,0", "5,0"]),
        ("vi", [1.23456e-7, 0.0], ["1,235·10⁻⁷", "0"]),
        ("en", [0.0, -0.0], ["0", "0"]),
    ],
)
def test_numbers_of_a_column_have_the_same_decimals(language, values, shown):
    assert Words(language).column_texts(values) == shown


def test_names_of_links_stay_in_the_subscript():
    words = Words("ru")
    assert words.symbol("link_angular_velocity.upper rod") == "ω_upper-rod"
    assert words.symbol("joint_force.A_K5") == "R_A-K5"
    assert words.symbol("link_angular_velocity.left_rod") == "ω_left_rod"
    assert words.symbol("velocity_ratio.r/2") == "v_r:2/ω₁"
    assert subscript("a. b\tc/d") == "a,-b-c:d"
    assert words.titled("joint_force.A") == (Math("R_A"), ", Н")


@pytest.mark.parametrize("ending", list(WRITERS))
@pytest.mark.parametrize("name", ["press", "press-geometry"])
def test_bytes_are_the_same_every_time(ending, name):
    for part in {".pdf": "typst", ".docx": "docx"}.get(ending, "math").split():
        pytest.importorskip(part)
    first = WRITERS[ending](note(name, language="vi", figures=ending == ".html"))
    assert first == WRITERS[ending](note(name, language="vi", figures=ending == ".html"))
    assert len(first) > 10_000


def test_a_linkage_with_every_load_has_a_note():
    found = crankwork.analyse(crankwork.read(EXAMPLES.parent / "tests" / "machines" / "loaded-shaper.toml"))
    assert len(WRITERS[".html"](note_of(found, NoteOptions(figures=False)))) > 10_000


def test_sheets_come_in_three_formats_with_a_title_block():
    pytest.importorskip("typst")
    pytest.importorskip("ezdxf")
    found = sheets_of(results("press"), NoteOptions(language="ru", author="Петров"))
    assert list(found) == ["-sheet-1.pdf", "-sheet-1.svg", "-sheet-1.dxf"]
    assert "Петров" in found["-sheet-1.svg"].decode()
    assert found["-sheet-1.pdf"].startswith(b"%PDF")
    english = sheets_of(results("press"), NoteOptions(author="Petrov"))["-sheet-1.svg"].decode()
    assert "Petrov" in english
    assert "Created by" in english
    assert importlib.import_module("crankwork.note.sheets.linkage")

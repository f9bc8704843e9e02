"""The note of a linkage and of a press: what stands in it, in which order, and that its numbers are those of a book.

The numbers of the press: Курсовой проект по динамике машин, рычажный механизм пресса (Russian course project on a press
linkage), its table 4 and formulas 9 to 12; the document rounds each term of the reduced inertia before it adds them.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import crankwork
from crankwork.analysis.mechanism import differences
from crankwork.description.machine_file import read_machine, template
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.expression import evaluate
from crankwork.locale import texts, translate
from crankwork.machine import Document
from crankwork.note.document import Equation, Figure, ItemList, Math, Table
from crankwork.note.options import NoteOptions
from crankwork.note.sections import WRITERS, note_of, sheets_of
from crankwork.note.symbols import subscript
from crankwork.note.wording import Words
from crankwork.quantities import LANGUAGES
from each import for_each
from notes import blocks, column, figures, headings, note, printed, results, tables, words, worked

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
# a four-bar whose crank does not turn fully
PARTIAL = ("62.5 mm", "150 mm")


def changed(name, *changes):
    """Return the results of a template in which something else stands."""
    text = template(name)
    for old, new in changes:
        text, count = re.subn(old, new, text)
        assert count
    return crankwork.analyse(read_machine(text))


def note_from(found, language="en", **options):
    return note_of(found, NoteOptions(**{"full": True, "language": language, "figures": False, **options}))


@pytest.fixture(scope="module")
def toggle() -> crankwork.Results:
    """A press with loads, motor and flywheel."""
    return changed("toggle-press", *((re.escape(old), new) for old, new in MOTOR))


@pytest.fixture(scope="module")
def partial() -> crankwork.Results:
    """A four-bar whose crank does not turn fully."""
    return changed("four-bar", PARTIAL)


@for_each("language", LANGUAGES)
def test_the_press_has_its_four_tables_with_the_numbers_of_the_document(language):
    found = tables(note("press", language))
    assert list(found) == ["glance", "transfer", "static", "reduced", "torque", "summary", "nomenclature"]
    transfer, static, reduced, torque = (found[name] for name in ("transfer", "static", "reduced", "torque"))
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
    found = worked(note("press", "ru"))
    assert [found[f"M_дин,{k}"] for k in range(1, 13)] == pytest.approx(DYNAMIC, abs=0.001)
    assert [found[f"M_Σ,{k}"] for k in range(1, 13)] == pytest.approx(DRIVING, abs=0.011)
    assert found["J_пр"] == pytest.approx(INERTIA[1], abs=0.0015)


def test_tables_print_nothing_where_only_rounding_is_left():
    """A parallelogram at a steady speed needs no torque, its coupler does not turn, its rocker turns evenly."""
    found = tables(note("parallelogram"))
    for label, first, last in (("routes", 2, 8), ("torque", 2, 5), ("reduced", -1, None), ("transfer", 7, 8)):
        assert {text for row in found[label].rows for text in row[first:last]} == {"0"}, label
    rows = [row for label, one in found.items() if label != "identities" for row in one.rows]
    assert [row for row in rows if any("10⁻" in str(text) for text in row)] == []


def test_values_of_steps_are_those_of_the_results():
    whole = results("press-geometry")
    row = int(np.argmin(np.abs(whole.grid.degrees - 30.0)))
    keys = ("reduced_inertia", "reduced_inertia_1", "dynamic_torque", "driving_torque", "point_velocity.A")
    found = worked(note("press-geometry"))
    assert [found[key] for key in keys] == pytest.approx([whole.columns[key][row] for key in keys], rel=1e-12)


HEADINGS = {
    "ru": [
        "Основные результаты расчёта", "Задание и исходные данные", "Структурный анализ механизма",
        "Кинематический анализ механизма",
        "Качественные показатели механизма", "Силовой расчёт механизма", "Уравновешивание механизма",
        "Приведение масс и сил", "Моменты, приведённые к кривошипу",
        "Подшипники и шейки", "Гармоники крутящего момента",
        "Выбор двигателя", "Расчёт маховика", "Закон движения кривошипа", "Проверка результатов", "Заключение",
        "Условные обозначения", "Список литературы", "Приложение А. Результаты расчёта за оборот кривошипа",
    ],
    "vi": [
        "Các kết quả chính", "Nhiệm vụ và số liệu cho trước", "Phân tích cấu trúc cơ cấu", "Phân tích động học cơ cấu",
        "Các chỉ tiêu chất lượng của cơ cấu", "Phân tích lực cơ cấu", "Cân bằng cơ cấu",
        "Thu gọn khối lượng và lực", "Các mômen thu gọn về tay quay",
        "Ổ trục và chốt", "Các điều hoà của mômen quay", "Chọn động cơ", "Tính bánh đà",
        "Quy luật chuyển động của tay quay", "Kiểm tra kết quả", "Kết luận", "Ký hiệu", "Tài liệu tham khảo",
        "Phụ lục: kết quả tính trong một vòng quay",
    ],
    "en": [
        "Main results", "Task and data", "Structure", "Kinematics of the mechanism",
        "Quality of the mechanism", "Forces in the joints", "Balance of the mechanism",
        "Reduced masses and forces", "Torques reduced to the crank", "Bearings and pins",
        "Harmonics of the torque", "Choice of the motor",
        "Design of the flywheel",
        "Law of motion", "Checks", "Conclusion", "Nomenclature", "References", "Appendix: results over the whole turn",
    ],
}  # fmt: skip


@pytest.mark.slow
def test_sections_stand_in_the_order_of_each_school(toggle):
    assert {language: headings(note_from(toggle, language)) for language in LANGUAGES} == HEADINGS
    # a school gives its order to another language
    assert headings(note("press-geometry", "en", school="ru"))[-2:] == ["Nomenclature", "References"]
    assert headings(note("press-geometry", "ru", school="en"))[0] == "Основные результаты расчёта"


def test_how_many_tables_equations_and_figures_a_note_has():
    found = {name: note(name, "ru", figures=True) for name in ("press", "press-geometry")}
    counts = {name: [len(blocks(one, kind)) for kind in (Table, Equation, Figure)] for name, one in found.items()}
    assert counts == {"press": [7, 42, 2], "press-geometry": [33, 171, 20]}
    assert figures(note("press", "ru")) == {}


@pytest.mark.slow
def test_position_tables_have_thirteen_rows_and_fit_on_a_page():
    found = blocks(note("andrews-squeezer"), Table)
    shown = [one for one in found if len(one.rows) == 13]
    long = [one for one in found if one.rows[-1][0] == "360"]
    assert (len(found), len(long), len(shown) > 10) == (42, 5, True)
    assert [one.label for one in (*shown, *long) if len(one.headings) > 11 or one.wide] == []


def test_five_routes_to_the_torque_agree_and_say_by_how_much():
    shown = tables(note("press-geometry"))["routes"]
    assert (len(shown.headings), len(shown.rows)) == (8, 13)
    assert [row for row in shown.rows if len(set(row[2:7])) != 1 or not ("10⁻" in row[7] or row[7] == "0")] == []
    # differences are relative to the largest torque
    routes = [np.array([1.0, -4.0]), np.array([1.02, -4.0]), np.array([1.0, -3.9])]
    assert differences(routes) == pytest.approx([0.02 / 4, 0.1 / 4])
    assert differences([np.zeros(2), np.zeros(2)]) == pytest.approx([0, 0])


def test_forces_flywheel_and_motor_of_a_press_are_worked(toggle):
    found = note_from(toggle, "ru")
    static = worked(found)["static_torque"]
    # where the loads are largest
    rows = [int(np.argmin(np.abs(toggle.grid.degrees - one))) for one in np.arange(0, 361, 30)]
    assert static == pytest.approx(np.max(np.abs(toggle["static_torque"][rows])), rel=1e-12)
    assert static > 100
    for step in (one.step for one in blocks(found, Equation) if isinstance(one.step, FormulaLine)):
        assert evaluate(step.expression, step.values) == pytest.approx(step.value, rel=1e-12, abs=1e-300), step.key
    assert [one for one in printed(found) if re.search("10⁻(¹[¹²³⁴⁵⁶⁷⁸⁹]|[²³⁴⁵⁶⁷⁸⁹][⁰¹²³⁴⁵⁶⁷⁸⁹])", one)] == []
    shown = tables(found)["flywheels"]
    assert [row[0] for row in shown.rows][1:] == ["метод Мерцалова", "метод Виттенбауэра", "точное решение"]
    wanted = [toggle.summary[f"flywheel_inertia.{way}"] for way in ("energy", "mertsalov", "wittenbauer", "exact")]
    assert column(shown, 2) == pytest.approx(wanted, rel=1e-5)
    assert "2,2\u00a0кВт" in " ".join(words(found))


def test_a_note_without_a_title_has_one_of_its_kind():
    kinds = [*(("press", language, "tabulated") for language in LANGUAGES), ("press-geometry", "ru", "linkage")]
    for name, language, kind in kinds:
        whole = results(name)
        bare = replace(
            whole, solved=replace(whole.solved, machine=replace(whole.machine, title="", document=Document()))
        )
        found = note_from(bare, language, author="А. Б.")
        assert (found.title, found.authors) == (translate(f"headings.{kind}", language), ("А. Б.",))
    assert note("press", title="Пресс").title == "Пресс"


def test_a_linkage_that_does_not_turn_fully_says_what_it_reaches(partial):
    found = note_from(partial, "ru")
    shown = tables(found)
    # the positions keep their numbers
    assert [row[:2] for row in shown["transfer"].rows] == [("1", "30"), ("2", "60"), ("3", "90")]
    notices, assumed, _ = blocks(found, ItemList)
    assert assumed.items == ((("силы тяжести не учтены",)), ("трение не учтено",))
    why = r"механизм движется только от \d+,\d+° до \d+,\d+°: звенья coupler и rocker не сходятся .* на \d+,\d+ мм.*"
    assert re.fullmatch(why, notices.items[0][0]), notices.items[0][0]
    assert shown["reach"].rows == [
        ("2 (шатун)", "°", "22,5337", "80,0249"), ("3 (коромысло)", "°", "181,668", "–"),
    ]  # fmt: skip
    assert "Уравновешивание механизма" in headings(found)
    # what counterweight is best is asked of whole turns only
    assert "orders" not in shown
    assert "97,2003°" in " ".join(words(found))


@pytest.mark.slow
@for_each(
    ("language", "whole"),
    [("en", "(one|the|whole) turn\\b"), ("ru", "оборот( |;|$)"), ("vi", "một vòng quay|cả vòng quay")],
)
def test_a_linkage_between_dead_positions_is_not_said_to_turn(partial, language, whole):
    found = note_from(partial, language, figures=True)
    assert translate("sentences.task_partial", language) in " ".join(words(found))
    assert translate("headings.appendix_partial", language) in headings(found)
    captions = [one.caption for one in tables(found).values()]
    assert any(one.startswith(translate("captions.reactions_partial", language)) for one in captions)
    assert [one for one in words(found) if re.search(whole, one)] == []


def test_ends_and_time_ratio_of_a_shaper_are_those_of_its_lever():
    found = tables(note("crank-shaper"))["ends"].rows
    rows = {row[0]: [float(one.replace("−", "-")) for one in row[2:]] for row in found}
    # a lever touched by the circle of the crank: radius 50 mm, pivot 150 mm below
    reach = np.degrees(np.arcsin(50 / 150))
    ends = (90 - reach, 270 - reach, 90 + reach, 90 + reach, 2 * reach, (180 + 2 * reach) / (180 - 2 * reach))
    assert rows["2 (lever)"] == pytest.approx(ends, abs=0.06)
    assert rows["5 (ram)"][-1] == pytest.approx(ends[-1], rel=1e-5)


def test_extreme_transmission_angles_are_worked_where_crank_and_frame_are_in_line():
    found = worked(note("four-bar"))
    for end, base in (("min", 200 - 62.5), ("max", 200 + 62.5)):
        cosine = (175**2 + 112.5**2 - base**2) / (2 * 175 * 112.5)
        assert found[f"transmission_angle_{end}.B"] == pytest.approx(np.arccos(cosine), rel=1e-12)
    assert tables(note("four-bar"))["limits"].rows == [("B", "51.7534", "0", "130.601", "180")]


def test_instant_centres_are_worked_where_their_link_turns_and_left_out_where_not():
    found = note("crank-shaper")
    (shown,) = [one for one in blocks(found, Table) if one.caption == "Instant centres"]
    assert [row[0] for row in shown.rows if row[2:] == ("–", "–")] == ["0", "6", "12"]
    x, y = (worked(found)[f"instant_centre_{axis}.link"] for axis in "xy")
    # on the normal of the ram's guide in D, and on the lever through C
    at = {key: values[0] for key, values in results("crank-shaper").columns_at([330.0]).items()}
    assert x == pytest.approx(at["point_x.D"], rel=1e-12)
    height = at["point_y.C"] + np.tan(at["link_angle.lever"]) * (x - at["point_x.C"])
    assert y == pytest.approx(height, rel=1e-9)


def test_the_counterweight_stands_after_the_shaking_force():
    found = worked(note("beta-stirling"))
    sizes = found["shaking_force_x"], found["shaking_force_y"]
    assert found["shaking_force"] == pytest.approx(np.hypot(*sizes), rel=1e-12)
    # masses that swing sinusoidally along x: half of each is taken out by one that turns against it
    turning = 0.4 * 0.03 + 0.9 * 0.025 * np.exp(-1j * np.radians(60))
    assert found["counterweight_moment"] == pytest.approx(abs(turning) / 2, rel=1e-9)
    orders = column(tables(note("beta-stirling"))["orders"], 1)
    assert orders == pytest.approx([abs(turning) * 94.24778**2, 0, 0, 0], abs=1e-3)


def test_a_linkage_without_masses_has_its_motion_only():
    assert headings(note_from(changed("four-bar", (r", mass.*?centre = (\[.*?\]|\"P\")", "")))) == [
        "Main results", "Task and data", "Structure", "Kinematics of the mechanism",
        "Quality of the mechanism", "Conclusion", "Nomenclature", "References",
        "Appendix: results over the whole turn",
    ]  # fmt: skip


def test_an_accelerating_crank_is_said_and_worked():
    found = note_from(changed("four-bar", ('"100 rpm"', '"100 rpm"\nangular_acceleration = "5 rad/s2"')))
    (step,) = (one.step for one in blocks(found, Equation) if one.step.key == "dynamic_torque")
    assert step.values["eps"] == 5
    assert "Angular acceleration of the crank: " in words(found)


def test_the_chain_of_efficiencies_is_worked_where_it_is_known():
    whole = results("press")
    drive = replace(whole.machine.drive)
    half = (0.98, 0.98)
    object.__setattr__(drive, "chain", (half, 0.98, 0.99, 0.86, 0.86, 0.99, half))
    other = replace(whole, solved=replace(whole.solved, machine=replace(whole.machine, drive=drive)))
    assert worked(note_from(other, "ru"))["η"] == pytest.approx(0.98**3 * 0.99**2 * 0.86**2, rel=1e-12)


def test_russian_and_vietnamese_say_nothing_in_english():
    english = {"the", "and", "of", "with", "is", "are", "crank", "link", "by"}
    for room in ("headings", "captions", "columns", "sentences", "seen", "note", "figures", "tables", "notices"):
        for key, said in texts(room, "ru").items():
            # what is to be written into a file is in its own words
            russian = re.sub(
                r'[\w{}.]+ = (?:"[^"]*"|true)|\{\w+\}(?:\.\w+)?|[\w.]+\.\w+|p–V|CO₂|const|true|rigid|sin|cos', "", said
            )
            assert not re.findall(r"[A-Za-z]{3,}", russian), (room, key)
        for key, said in texts(room, "vi").items():
            spelled = re.findall(r"[a-z]+(?![^\W\d_])", re.sub(r"\{\w+\}", "", said).lower())
            assert not english & set(spelled), (room, key)


@for_each(
    ("language", "values", "shown"),
    [
        ("en", [0.05, -0.1234567], ["0.0500", "−0.1235"]),
        ("ru", [1234.5, -0.04], ["1234", "0"]),
        ("ru", [-99.96, 5.0], ["−99,96", "5,00"]),
        ("ru", [-99.996, 5.0], ["−100,0", "5,0"]),
        ("vi", [1.23456e-7, 0.0], ["1,235·10⁻⁷", "0"]),
        ("en", [0.0, -0.0], ["0", "0"]),
    ],
)
def test_numbers_of_a_column_have_the_same_decimals(language, values, shown):
    assert Words(language).column_texts(values) == shown


def test_names_of_links_stay_in_the_subscript():
    found = {
        "link_angular_velocity.upper rod": "ω_upper-rod",
        "joint_force.A_K5": "R_A-K5",
        "link_angular_velocity.left_rod": "ω_left_rod",
        "velocity_ratio.r/2": "v_r:2/ω₁",
    }
    assert {key: Words("ru").symbol(key) for key in found} == found
    assert subscript("a. b\tc/d") == "a,-b-c:d"
    assert Words("ru").titled("joint_force.A") == (Math("R_A"), ", Н")


@pytest.mark.slow
@for_each("ending", list(WRITERS))
def test_bytes_of_a_note_are_the_same_every_time(ending):
    first, second = (WRITERS[ending](note_from(results("press"), "vi", figures=True)) for _ in range(2))
    assert first == second
    assert len(first) > 10_000


@pytest.mark.slow
def test_sheets_come_in_three_formats_with_a_title_block():
    found = sheets_of(results("press"), NoteOptions(full=True, language="ru", author="Петров"))
    assert list(found) == ["-sheet-1.pdf", "-sheet-1.svg", "-sheet-1.dxf"]
    assert "Петров" in found["-sheet-1.svg"].decode()
    assert found["-sheet-1.pdf"].startswith(b"%PDF")
    english = sheets_of(results("press"), NoteOptions(full=True, author="Petrov"))["-sheet-1.svg"].decode()
    assert "Petrov" in english
    assert "Created by" in english

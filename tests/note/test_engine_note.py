"""The note of an engine: sections in the order of each school, tables with published numbers, steps, words."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest

import crankwork
from crankwork.errors import CrankworkError
from crankwork.locale import texts
from crankwork.note import material as materials
from crankwork.note.document import Bibliography, Equation, Heading, Paragraph
from crankwork.note.equations import printed_equation
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.wording import Words
from crankwork.quantities import LANGUAGES
from crankwork.report.figures import figures as drawn_figures
from each import for_each
from notes import ROOT, blocks, column, figures, headings, note, results, symbols, tables, value, words

SPARK, FOUR = "spark-engine", "petrol-four"
# rows of the table of the note that the example is taken from: angle, gas force, inertia force, sum [MN/m2]
PUBLISHED = (
    ("0", "0,110", "-0,956907", "-0,846907"), ("5", "0,080", "-0,950501", "-0,870501"),
    ("90", "0,080", "0,242797", "0,322797"), ("180", "0,080", "0,471312", "0,551312"),
    ("250", "0,11709", "0,430233", "0,547321"), ("350", "1,42322", "-0,931416", "0,491805"),
    ("360", "2,42322", "-0,956907", "1,466313"), ("390", "3,25336", "-0,739836", "2,513528"),
    ("505", "0,44883", "0,501923", "0,950754"), ("720", "0,11", "-0,956907", "-0,846907"),
)  # fmt: skip

MEASURED = """
[crank]
radius = "45 mm"
speed = "3000 rpm"
[rod]
length = "160 mm"
[cylinder]
bore = "85 mm"
compression_ratio = 9.0
[gas]
cycle = "720 deg"
[gas.measured]
file = "data/p-v.csv"
pressure_unit = "bar"
cycle = "mean"
shift = "-12 deg"
"""


def test_sections_stand_in_the_order_of_each_school():
    numbered = [block.text for block in note(SPARK, "vi").blocks if isinstance(block, Heading) and block.numbered]
    assert numbered == [
        "Các kết quả chính", "Bảng thông số cho trước", "Ký hiệu",
        "Đồ thị công", "Đồ thị Brick", "Đồ thị vận tốc v(α)", "Đồ thị gia tốc j(x)", "Đồ thị lực quán tính",
        "Đồ thị khai triển lực khí thể, lực quán tính và hợp lực",
        "Đồ thị lực tiếp tuyến T, lực pháp tuyến Z, lực ngang N",
        "Đồ thị tổng lực tiếp tuyến ΣT",
        "Đồ thị phụ tải tác dụng trên chốt khuỷu", "Đồ thị khai triển phụ tải Q–α",
        "Đồ thị phụ tải tác dụng lên đầu to thanh truyền", "Đồ thị mài mòn chốt khuỷu",
        "Cân bằng động cơ", "Độ không đồng đều của tốc độ và bánh đà", "Kiểm tra kết quả",
    ]  # fmt: skip
    assert headings(note(SPARK, "vi"))[:2] == ["Các kết quả chính", "Bảng thông số cho trước"]
    assert headings(note(FOUR, "vi"))[1:4] == ["Bảng thông số cho trước", "Ký hiệu", "Tính toán nhiệt"]
    assert headings(note(FOUR, "ru")) == [
        "Основные результаты расчёта", "Исходные данные", "Условные обозначения", "Тепловой расчёт",
        "Построение индикаторной диаграммы", "Кинематика кривошипно-шатунного механизма",
        "Динамика кривошипно-шатунного механизма",
        "Суммарный крутящий момент", "Силы, действующие на шатунную шейку", "Коренные шейки",
        "Уравновешивание двигателя", "Равномерность хода и маховик", "Проверка результатов", "Заключение",
        "Список литературы", "Приложение А",
    ]  # fmt: skip
    assert headings(note(FOUR, "en"))[:5] == ["Main results", "Input data", "Method", "Nomenclature", "Working cycle"]
    assert headings(note(FOUR, "en"))[-4:] == ["Checks", "Conclusion", "References", "Appendix"]
    # the school orders and the language speaks
    mixed = note(FOUR, "en", school="ru")
    assert headings(mixed)[3:5] == ["Working cycle", "Construction of the indicator diagram"]
    with pytest.raises(CrankworkError, match="take en, ru or vi"):
        note_of(results(SPARK), NoteOptions(full=True, school="de", figures=False))


def test_the_table_of_forces_is_the_published_one():
    table = tables(note(SPARK, "vi"))["along"]
    assert len(table.rows) == 145
    assert symbols(table) == ["α", "P_kt", "P_j", "P_1"]
    assert {title[1] for title in table.headings[1:]} == {", MPa"}
    rows = {row[0]: row for row in table.rows}
    assert (table.rows[0][0], table.rows[-1][0]) == ("0", "720")
    for angle, *published in PUBLISHED:
        for shown, wanted in zip(rows[angle][1:], published, strict=True):
            # the note adds rounded numbers, so its last digit may differ by one
            assert value(shown) == pytest.approx(value(wanted), abs=1.5e-6 if "," in wanted[-7:-6] else 1e-5)


def test_a_note_counts_what_it_shows():
    one = note(FOUR, "ru", figures=True)
    # all that are drawn, the machine and the senses of its angles and forces
    assert figures(one).keys() == {"machine", "scheme", *drawn_figures(results(FOUR), language="ru")}
    assert len(tables(one)) >= 20
    assert len(blocks(one, Equation)) > 180
    # as many rows as there are angles, motion for one turn only
    degrees = results(FOUR).grid.degrees
    rows = {label: len(tables(one)[label].rows) for label in ("along", "forces", "motion")}
    assert rows == {"along": len(degrees), "forces": len(degrees), "motion": int((degrees <= 360).sum())}


def test_tables_have_the_columns_of_their_school():
    found = tables(note(FOUR, "ru"))
    assert symbols(found["along"]) == ["φ", "Δp_г", "P_г", "j", "P_j", "P"]
    assert symbols(found["forces"]) == [
        "φ", "tg β", "N", "1/cos β", "S_ш", "cos(φ+β)/cos β", "K", "sin(φ+β)/cos β", "T", "M_кр",
    ]  # fmt: skip
    assert symbols(found["motion"]) == ["φ", "S_I", "S_II", "S_x", "v_I", "v_II", "v", "j_I", "j_II", "j"]
    # a table of the speed is called so only where it has the speed
    plain = tables(note(SPARK, "ru"))
    assert ("speed" in found, "speed" in plain) == (True, False)
    assert set(symbols(plain["energy"])) == {"φ", "ΔT"}


def test_method_constants_and_both_ratios_are_stated():
    text = " ".join(words(note(SPARK, "en")))
    for part in ("textbook, two terms", "3.14159265", "9.80665", "0.34", "0.25"):
        assert part in text
    assert [row[0] for row in tables(note(SPARK, "en"))["errors"].rows] == [
        "piston displacement", "piston velocity", "piston acceleration", "inertia force of the reciprocating mass",
        "force on the piston pin", "side force", "tangential force on the crankpin", "radial force on the crankpin",
        "crank torque",
    ]  # fmt: skip
    assert "errors" not in tables(note(FOUR, "en"))


def test_inertia_force_is_minus_mass_times_the_acceleration_beside_it():
    table = tables(note(FOUR, "en"))["along"]
    mass = results(FOUR).summary["reciprocating_mass"]
    assert symbols(table)[3:5] == ["a", "F_j"]
    assert column(table, 4) == pytest.approx([-mass * one / 1e3 for one in column(table, 3)], abs=1e-3)
    # where the inertia force has a ratio of its own, the acceleration of the columns is another one
    assert "a" not in symbols(tables(note(SPARK, "en"))["along"])


def test_the_heat_balance_adds_up():
    assert sum(column(tables(note(FOUR, "ru"))["heat_balance"], 2)) == pytest.approx(100, abs=5e-3)


def test_the_polytropes_pass_through_the_points_of_the_diagram():
    found = tables(note(SPARK, "vi"))
    points = {row[0]: row for row in found["points"].rows}
    first, last = found["polytropes"].rows[0], found["polytropes"].rows[-1]
    assert (first[0], last[0]) == ("1", "8,7511")
    # the expansion line starts from z at the clearance volume, the compression line from a
    assert value(first[3]) == pytest.approx(5.98, abs=1e-4)
    assert value(last[2]) == pytest.approx(value(points["a"][3]), abs=2e-4)
    # of a compressor: expansion from d to e, compression from a to c, where each piece ends
    found = tables(note("compressor"))
    points = {row[0]: row for row in found["points"].rows}
    rows = found["polytropes"].rows
    for at, ends in ((2, "ca"), (3, "de")):
        there = [row for row in rows if row[at] != "–"]
        assert len(there) < len(rows)
        for row, name in zip((there[0], there[-1]), ends, strict=True):
            assert value(row[1]) == pytest.approx(value(points[name][2]), abs=0.01), name
            assert value(row[at]) == pytest.approx(value(points[name][3]), rel=1e-4), name


def test_a_note_names_pressures_by_one_unit():
    said = " ".join(words(note(SPARK, "vi")))
    assert "MPa" in said
    assert "MN/m" not in said


@for_each(
    ("key", "unit", "factor"),
    # 1 kg/J = 3.6e9 g/(kW h), 1 W/m3 = 1e-6 kW/l
    [
        ("indicated_fuel_consumption", "г/(кВт·ч)", 3.6e9),
        ("effective_fuel_consumption", "г/(кВт·ч)", 3.6e9),
        ("power_per_litre", "кВт/л", 1e-6),
    ],
)
def test_values_of_the_cycle_end_in_the_unit_of_engineers(key, unit, factor):
    block = next(one for one in blocks(note(FOUR, "ru"), Equation) if one.step.key.partition(".")[0] == key)
    shown, ended = printed_equation(block, "ru").text.rpartition(" = ")[2].split("\u00a0")
    assert ended == unit
    assert value(shown) == pytest.approx(block.step.value * factor, rel=1e-5)


def test_measured_pressure_is_named_and_tabulated(tmp_path):
    # two cycles of a peak at 372 degrees by the file, 12 degrees late
    rows = [f"{angle};{1 + 40 * math.exp(-(((angle % 720 - 372) / 40) ** 2)):.6f}" for angle in range(0, 1441, 2)]
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "p-v.csv").write_text("\n".join(rows), encoding="utf-8")
    (tmp_path / "m.toml").write_text(MEASURED, encoding="utf-8")
    found = crankwork.analyse(crankwork.read(tmp_path / "m.toml"))
    for language in LANGUAGES:
        one = note_of(found, NoteOptions(full=True, language=language, figures=False))
        paragraphs = [
            "".join(run for run in block.runs if isinstance(run, str)) for block in blocks(one, Paragraph)
        ]  # fmt: skip
        said = next(text for text in paragraphs if "p-v.csv" in text)
        # the name of the file only, its samples and cycles
        assert "data" not in said
        assert {"721", "2"} <= set(re.findall(r"\d+", said))
        assert any("−12°" in text for text in paragraphs)
        pairs = {row[k]: value(row[k + 1]) for row in tables(one)["measured"].rows
                 for k in range(0, len(row), 2) if row[k]}  # fmt: skip
        assert len(pairs) == 73
        for angle in ("320", "360", "400"):
            assert pairs[angle] == pytest.approx(0.1 + 4 * math.exp(-(((float(angle) - 360) / 40) ** 2)), rel=1e-4)
    assert "measured" not in tables(note(SPARK, "en"))


@pytest.mark.slow
@for_each(
    ("language", "captions"),
    [
        ("en", ("load on the crankpin, crankpin 1", "load on the crankpin, crankpin 4",
                "over the crank angle, crankpins 1, 4", "Wear diagram of the crankpin, crankpins 1, 4")),
        ("ru", ("на шатунную шейку, шейка 1", "на шатунную шейку, шейка 4", "на шатунную шейку, шейки 1, 4",
                "износа шатунной шейки, шейки 1, 4")),
        ("vi", ("trên chốt khuỷu, chốt 1", "trên chốt khuỷu, chốt 4", "Q–α, các chốt 1, 4",
                "mài mòn chốt khuỷu, các chốt 1, 4")),
    ],
)  # fmt: skip
def test_figures_of_crankpins_say_which(language, captions):
    found = figures(note("v8-diesel", language, figures=True))
    names = ("crankpin_polar", "crankpin_polar_4", "crankpin_load", "crankpin_wear")
    for name, end in zip(names, captions, strict=True):
        assert found[name].caption.replace("\u00a0", " ").endswith(end)


@pytest.mark.slow
def test_a_polar_diagram_says_the_load_of_its_own_crankpin():
    drawn = figures(note("v8-diesel", "en", figures=True))
    columns = results("v8-diesel").columns
    for name, pin in (("crankpin_polar", "1"), ("crankpin_polar_4", "4")):
        largest = float(columns[f"crankpin_tangential_force.{pin}"].max())
        assert f"{Words('en').number(largest / 1e3, digits=4)}\u00a0kN" in drawn[name].alt.partition(";")[0]
    # of a crank gear with one crankpin there is no other
    one = figures(note(SPARK, "en", figures=True))["crankpin_polar"]
    assert one.caption == "Polar diagram of the load on the crankpin"


@pytest.mark.slow
@for_each(("language", "wanted"), [("en", "ΣF_rot"), ("ru", "ΣP_вр"), ("vi", "ΣP_quay")])
def test_rotating_masses_have_no_order(language, wanted):
    shown = {block.step.key: block.symbol for block in blocks(note("v8-diesel", language), Equation)}
    assert shown["free_force.rotating"] == wanted
    assert Words(language, has_names=False).symbol("free_force.2") == {"en": "ΣF_q,2"}.get(language, "ΣP_jq,2")


def test_what_is_not_known_is_left_out():
    spark = results(SPARK).machine
    motion = replace(spark, gas=None, masses=None, cylinder=None)
    one = note_of(crankwork.analyse(motion), NoteOptions(full=True, language="ru", figures=False))
    assert headings(one)[1:4] == [
        "Исходные данные", "Условные обозначения", "Кинематика кривошипно-шатунного механизма",
    ]  # fmt: skip
    assert not {"along", "total", "points"} & tables(one).keys()
    no_gas = note_of(crankwork.analyse(replace(spark, gas=None)), NoteOptions(full=True, language="vi", figures=False))
    assert "Đồ thị công" not in headings(no_gas)
    assert "Đồ thị mài mòn chốt khuỷu" in headings(no_gas)
    # nobody knows the journals of a crank gear of its own
    assert "Коренные шейки" not in headings(note(SPARK, "ru"))
    assert not any("коренная" in row[0] for row in tables(note(SPARK, "ru"))["loads"].rows)


def test_title_and_author_are_the_users():
    one = note(SPARK, "vi", title="Đồ án", author="N. V. A")
    assert (one.title, one.authors) == ("Đồ án", ("N. V. A",))
    own = results(SPARK).machine.title
    assert note(SPARK, "en").title == own
    assert note(SPARK, "vi").title == "Động cơ xăng bốn kỳ, 105,8 × 105,8 mm, 2300 vg/ph"
    # one of another language stands below what the engine is
    made = note("points-engine", "vi")
    assert made.title.startswith("Động cơ bốn kỳ, một xi lanh")
    assert "Four-stroke engine" in made.blocks[0].below
    assert blocks(one, Bibliography)


def test_forces_per_area_are_divided_once():
    plain, divided = (tables(note(SPARK, "ru", per_area=chosen)) for chosen in (False, True))
    area = results(SPARK).summary["piston_area"]
    for label, at in (("along", 4), ("crankpin", 3)):
        one, other = (value(some[label].rows[30][at]) for some in (plain, divided))
        assert one / area / 1e3 == pytest.approx(other, rel=1e-3)


def test_a_figure_that_no_section_knows_stands_in_the_appendix(monkeypatch, drawing):
    monkeypatch.setattr(materials, "drawings", lambda *_, **__: {"crankpin_polar": drawing, "main_wear": drawing})
    material = materials.Material(results(FOUR), NoteOptions(full=True, language="en"))
    assert material.remaining_figures() == ["crankpin_polar", "main_wear"]
    list(material.presented((), ["crankpin_polar"]))
    assert material.remaining_figures() == ["main_wear"]


def test_every_heading_stands_in_the_table_of_terms():
    rows = {
        tuple(cell.strip() for cell in line.strip("|").split("|")[:3])
        for line in (ROOT / "docs" / "terms.md").read_text(encoding="utf-8").splitlines()
        if line.count(" | ") == 4
    }

    def said(*rooms):
        return {tuple(texts(room, one)[key] for one in LANGUAGES) for room in rooms for key in texts(room, "en")}

    rooms = ("headings", "captions", "columns")
    assert said(*rooms) - rows == set()
    everything = said(*rooms, "kinds", "figures", "tables", "report", "quantities")
    assert rows - everything == {("en", "ru", "vi")}

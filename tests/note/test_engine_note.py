"""The note of an engine: sections in the order of each school, tables with published numbers, steps, words."""

from __future__ import annotations

import math
import re
from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

import crankwork
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import CrankworkError
from crankwork.formula.lines import DelayedLine, ValueLine
from crankwork.locale import texts
from crankwork.note import engine_material
from crankwork.note.contents import note_of
from crankwork.note.document import (
    Bibliography,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    Note,
    Paragraph,
    Reference,
    Table,
)
from crankwork.note.engine_note import engine_note
from crankwork.note.equations import printed_equation
from crankwork.note.numbering import numbering
from crankwork.note.options import NoteOptions
from crankwork.note.web import web
from crankwork.note.words import EngineWords
from crankwork.quantities import LANGUAGES
from crankwork.report.figures import figures

ROOT = Path(__file__).parents[2]
SPARK, FOUR = "spark-engine", "petrol-four"
ENGINES = (SPARK, FOUR, "v8-diesel", "radial-five", "two-stroke")
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


@cache
def results(name: str):
    return crankwork.analyse(crankwork.read(ROOT / "examples" / f"{name}.toml"))


@cache
def note(name: str, language: str, *, drawn: bool = False) -> Note:
    return engine_note(results(name), NoteOptions(language=language, figures=drawn))


def headings(one: Note, level: int = 1) -> list[str]:
    return [block.text for block in one.blocks if isinstance(block, Heading) and block.level == level]


def tables(one: Note) -> dict[str, Table]:
    return {block.label: block for block in one.blocks if isinstance(block, Table)}


def equations(one: Note) -> list[Equation]:
    return [block for block in one.blocks if isinstance(block, Equation)]


def value(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def words(one: Note):
    """Yield all words of a note but its title and sources, which are the user's and the publishers'."""
    for block in one.blocks:
        match block:
            case Heading(text=text):
                yield text
            case Paragraph(runs):
                yield from (run for run in runs if isinstance(run, str))
            case Table(caption=caption, headings=titles, rows=rows):
                yield caption
                yield from (run for title in titles for run in title if isinstance(run, str))
                yield from (entry for row in rows for entry in row if isinstance(entry, str))
            case Equation(legend=legend):
                yield from (entry.text for entry in legend)
            case Figure(caption=caption, alt=alt):
                yield from (caption, alt)
            case ItemList(items):
                yield from (run for item in items for run in item if isinstance(run, str))


def test_a_vietnamese_note_has_the_twelve_sections():
    numbered = [block.text for block in note(SPARK, "vi").blocks if isinstance(block, Heading) and block.numbered]
    assert numbered == [
        "Bảng thông số cho trước",
        "Đồ thị công", "Đồ thị Brick", "Đồ thị vận tốc v(α)", "Đồ thị gia tốc j(x)", "Đồ thị lực quán tính",
        "Đồ thị khai triển lực khí thể, lực quán tính và hợp lực",
        "Đồ thị lực tiếp tuyến T, lực pháp tuyến Z, lực ngang N",
        "Đồ thị tổng lực tiếp tuyến ΣT",
        "Đồ thị phụ tải tác dụng trên chốt khuỷu", "Đồ thị khai triển phụ tải Q–α",
        "Đồ thị phụ tải tác dụng lên đầu to thanh truyền", "Đồ thị mài mòn chốt khuỷu",
        "Kiểm tra kết quả",
    ]  # fmt: skip
    assert headings(note(SPARK, "vi"))[:2] == ["Lời nói đầu", "Bảng thông số cho trước"]
    assert headings(note(FOUR, "vi"))[:3] == ["Lời nói đầu", "Bảng thông số cho trước", "Tính toán nhiệt"]


def test_a_russian_note_goes_from_the_data_to_the_appendix():
    assert headings(note(FOUR, "ru")) == [
        "Введение", "Исходные данные", "Тепловой расчёт", "Построение индикаторной диаграммы",
        "Кинематика кривошипно-шатунного механизма", "Динамика кривошипно-шатунного механизма",
        "Суммарный крутящий момент", "Силы, действующие на шатунную шейку", "Коренные шейки и набегающие моменты",
        "Уравновешивание двигателя", "Равномерность хода и маховик", "Проверка результатов", "Заключение",
        "Список литературы", "Приложение А",
    ]  # fmt: skip


def test_an_english_report_has_method_and_results_before_the_way_to_them():
    assert headings(note(FOUR, "en"))[:4] == ["Input data", "Method", "Main results", "Working cycle"]
    assert headings(note(FOUR, "en"))[-3:] == ["Checks", "References", "Appendix"]


def test_the_school_orders_and_the_language_speaks():
    mixed = engine_note(results(FOUR), NoteOptions(language="en", school="ru", figures=False))
    assert headings(mixed)[2:4] == ["Working cycle", "Construction of the indicator diagram"]


def test_a_school_that_does_not_exist_is_refused():
    with pytest.raises(CrankworkError, match="take en, ru or vi"):
        engine_note(results(SPARK), NoteOptions(school="de", figures=False))


def test_the_table_of_forces_is_the_published_one():
    table = tables(note(SPARK, "vi"))["t:along"]
    assert len(table.rows) == 145
    assert [title[0].content for title in table.headings] == ["α", "P_kt", "P_j", "P_1"]
    assert {title[1] for title in table.headings[1:]} == {", MPa"}
    rows = {row[0]: row for row in table.rows}
    assert (table.rows[0][0], table.rows[-1][0]) == ("0", "720")
    for angle, *published in PUBLISHED:
        for printed, wanted in zip(rows[angle][1:], published, strict=True):
            # the note adds rounded numbers, so its last digit may differ by one
            assert value(printed) == pytest.approx(value(wanted), abs=1.5e-6 if "," in wanted[-7:-6] else 1e-5)


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
@pytest.mark.parametrize("name", ENGINES)
def test_every_single_value_with_a_line_is_worked(name, language, groups_of):
    found = equations(note(name, language))
    shown = {block.step.key for block in found}
    same = {(block.step.key.partition(".")[0], block.step.value) for block in found}
    one = results(name)
    for step in (step for group in groups_of(one) for step in group.lines):
        if step.key in one.summary and not isinstance(step, ValueLine | DelayedLine):
            assert step.key in shown or (step.key.partition(".")[0], step.value) in same, step.key


@pytest.mark.parametrize("name", ENGINES)
def test_equations_give_the_values_of_the_results(name):
    one = results(name)
    checked = 0
    for block in equations(note(name, "en")):
        if block.step.key in one.summary:
            assert math.isclose(block.step.value, one.summary[block.step.key], rel_tol=1e-12), block.step.key
            checked += 1
    assert checked > 20


def test_a_note_counts_what_it_shows():
    one = note(FOUR, "ru", drawn=True)
    drawn = figures(results(FOUR), language="ru")
    assert {block.label for block in one.blocks if isinstance(block, Figure)} == {f"f:{name}" for name in drawn}
    assert len(tables(one)) >= 20
    assert len(equations(one)) > 180
    # as many rows as there are angles, motion for one turn only
    rows = len(results(FOUR).grid.degrees)
    assert len(tables(one)["t:along"].rows) == len(tables(one)["t:forces"].rows) == rows
    assert len(tables(one)["t:motion"].rows) == int((results(FOUR).grid.degrees <= 360).sum())


def test_russian_tables_have_the_columns_of_russian_notes():
    found = tables(note(FOUR, "ru"))
    symbols = {label: [title[0].content for title in found[label].headings] for label in ("t:along", "t:forces")}
    assert symbols["t:along"] == ["φ", "Δp_г", "P_г", "j", "P_j", "P"]
    assert symbols["t:forces"] == [
        "φ", "tg β", "N", "1/cos β", "S", "cos(φ+β)/cos β", "K", "sin(φ+β)/cos β", "T", "M_кр",
    ]  # fmt: skip
    motion = [title[0].content for title in found["t:motion"].headings]
    assert motion == ["φ", "S_I", "S_II", "S_x", "v_I", "v_II", "v", "j_I", "j_II", "j"]


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_every_table_and_figure_is_referred_to_and_figures_say_what_they_show(language):
    one = note(SPARK, language, drawn=True)
    labels = {block.label for block in one.blocks if isinstance(block, Table | Figure)}
    said = {run.label for block in one.blocks if isinstance(block, Paragraph) for run in block.runs
            if isinstance(run, Reference)}  # fmt: skip
    assert said == labels
    assert all(re.search(r"\d", block.alt) for block in one.blocks
               if isinstance(block, Figure) and block.label not in ("f:phase_stars", "f:balance_ellipses"))  # fmt: skip
    numbering(one)


@pytest.mark.parametrize("name", ENGINES)
def test_a_symbol_is_explained_once(name):
    entries = Counter(entry for block in equations(note(name, "ru")) for entry in block.legend)
    assert entries
    assert max(entries.values()) == 1


@pytest.mark.parametrize("name", ENGINES)
def test_russian_notes_have_no_latin_words(name):
    foreign = {word for text in words(note(name, "ru")) for word in re.findall(r"[A-Za-z]{3,}", text)}
    # symbols of extreme values are written so in Russian too, and points of a diagram are names
    assert {word for word in foreign if not re.fullmatch(r"[A-Za-z]?(max|min)|IVC|EVO", word)} == set()


@pytest.mark.parametrize("name", ENGINES)
def test_vietnamese_notes_have_no_english_words(name):
    english = set(
        re.findall(
            r"\w+",
            "the of and with from at force crank rod angle table figure load speed per mean largest least pressure"
            " torque work value point row what is are by on filling heating fuel loss mechanical cylinder journal",
        )
    )
    found = {word.lower() for text in words(note(name, "vi")) for word in re.findall(r"[^\W\d_]+", text)}
    assert found & english == set()


def test_method_constants_and_both_ratios_are_stated():
    text = " ".join(words(note(SPARK, "en")))
    for part in ("textbook, two terms", "3.14159265", "9.80665", "0.34", "0.25"):
        assert part in text
    assert [row[0] for row in tables(note(SPARK, "en"))["t:errors"].rows] == [
        "piston displacement", "piston velocity", "piston acceleration", "inertia force of the reciprocating mass",
        "force on the piston pin", "side force", "tangential force on the crankpin", "radial force on the crankpin",
        "crank torque",
    ]  # fmt: skip
    assert "t:errors" not in tables(note(FOUR, "en"))


@pytest.mark.parametrize("language", LANGUAGES)
def test_symbols_in_tables_are_set_as_in_equations(language):
    for path in (FOUR, SPARK, "v8-diesel"):
        found = tables(note(path, language))
        symbols = {one.content for label in ("t:data", "t:summary", "t:points", "t:identities") for row in
                   found[label].rows for one in row[:2] if isinstance(one, Math)}  # fmt: skip
        flat = [one for table in found.values() for row in table.rows for one in row if isinstance(one, str)]
        assert not [one for one in flat if "_" in one or "²" in one.partition(" = ")[2]]
        assert {"D", "n"} <= symbols
        assert any(one.startswith("F_T² + F_B² = F_Q²") for one in symbols) == (language == "en")
        assert ("z_d" in symbols) == (path != SPARK)


def test_inertia_force_is_minus_mass_times_the_acceleration_beside_it():
    table = tables(note(FOUR, "en"))["t:along"]
    mass = results(FOUR).summary["reciprocating_mass"]
    assert [title[0].content for title in table.headings][3:5] == ["a", "F_j"]
    for row in table.rows:
        assert value(row[4]) == pytest.approx(-mass * value(row[3]), abs=1.0)
    # where the inertia force has a ratio of its own, the acceleration of the columns is another one
    assert "a" not in [title[0].content for title in tables(note(SPARK, "en"))["t:along"].headings]


def test_the_heat_balance_adds_up():
    rows = tables(note(FOUR, "ru"))["t:heat_balance"].rows
    assert sum(value(row[2]) for row in rows) == pytest.approx(100, abs=5e-3)


def test_the_polytropes_pass_through_the_points_of_the_diagram():
    found = tables(note(SPARK, "vi"))
    points = {row[0]: row for row in found["t:points"].rows}
    first, last = found["t:polytropes"].rows[0], found["t:polytropes"].rows[-1]
    assert (first[0], last[0]) == ("1", "8,7511")
    # the expansion line starts from z at the clearance volume, the compression line from a
    assert value(first[3]) == pytest.approx(5.98, abs=1e-4)
    assert value(last[2]) == pytest.approx(value(points["a"][3]), abs=2e-4)


def test_a_note_names_pressures_by_one_unit():
    said = " ".join(words(note(SPARK, "vi")))
    said += " ".join(run for table in tables(note(SPARK, "vi")).values() for title in table.headings
                     for run in title if isinstance(run, str))  # fmt: skip
    assert "MPa" in said
    assert "MN/m" not in said


@pytest.mark.parametrize("key", ["indicated_fuel_consumption", "effective_fuel_consumption", "power_per_litre"])
def test_values_of_the_cycle_end_in_the_unit_of_engineers(key):
    block = next(one for one in equations(note(FOUR, "ru")) if one.step.key.partition(".")[0] == key)
    printed = printed_equation(block, "ru").text
    assert printed.endswith("кВт/л" if key == "power_per_litre" else "г/(кВт·ч)")
    shown = value(printed.rpartition(" = ")[2].partition("\u00a0")[0])
    # 1 kg/J = 3.6e9 g/(kW h), 1 W/m3 = 1e-6 kW/l
    assert shown == pytest.approx(block.step.value * (1e-6 if key == "power_per_litre" else 3.6e9), rel=1e-5)


def test_a_polytrope_ends_where_its_piece_ends():
    one = engine_note(crankwork.analyse(read_machine(template("compressor"))), NoteOptions("en", figures=False))
    found = tables(one)
    points = {row[0]: row for row in found["t:points"].rows}
    rows = found["t:polytropes"].rows
    # expansion from d to e, compression from a to c: volumes and pressures at the ends are those of the points
    for column, ends in ((2, "ca"), (3, "de")):
        there = [row for row in rows if row[column] != "–"]
        for row, name in zip((there[0], there[-1]), ends, strict=True):
            assert value(row[1]) == pytest.approx(value(points[name][2]), abs=0.01), name
            assert value(row[column]) == pytest.approx(value(points[name][3]), rel=1e-4), name
    assert any(row[2] == "–" for row in rows)
    assert any(row[3] == "–" for row in rows)


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_measured_pressure_is_named_and_tabulated(tmp_path, language):
    # two cycles of a peak at 372 degrees by the file, 12 degrees late
    rows = [f"{angle};{1 + 40 * math.exp(-(((angle % 720 - 372) / 40) ** 2)):.6f}" for angle in range(0, 1441, 2)]
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "p-v.csv").write_text("\n".join(rows), encoding="utf-8")
    (tmp_path / "m.toml").write_text(MEASURED, encoding="utf-8")
    options = NoteOptions(language=language, figures=False)
    one = engine_note(crankwork.analyse(crankwork.read(tmp_path / "m.toml")), options)
    said = next(
        "".join(run for run in block.runs if isinstance(run, str))
        for block in one.blocks
        if isinstance(block, Paragraph) and any("p-v.csv" in run for run in block.runs if isinstance(run, str))
    )
    # the name of the file only, its samples and cycles
    assert "data" not in said
    assert {"721", "2"} <= set(re.findall(r"\d+", said))
    assert any("−12°" in run for block in one.blocks if isinstance(block, Paragraph)
               for run in block.runs if isinstance(run, str))  # fmt: skip
    table = tables(one)["t:measured"]
    pairs = {row[k]: value(row[k + 1]) for row in table.rows for k in range(0, len(row), 2) if row[k]}
    assert len(pairs) == 73
    for angle in ("320", "360", "400"):
        assert pairs[angle] == pytest.approx(0.1 + 4 * math.exp(-(((float(angle) - 360) / 40) ** 2)), rel=1e-4)
    assert "t:measured" not in tables(note(SPARK, language))


@pytest.mark.parametrize(
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
    found = {block.label: block for block in note("v8-diesel", language, drawn=True).blocks
             if isinstance(block, Figure)}  # fmt: skip
    names = ("crankpin_polar", "crankpin_polar_4", "crankpin_load", "crankpin_wear")
    for name, end in zip(names, captions, strict=True):
        assert found[f"f:{name}"].caption.endswith(end)


def test_a_polar_diagram_says_the_load_of_its_own_crankpin():
    drawn = {block.label: block for block in note("v8-diesel", "en", drawn=True).blocks if isinstance(block, Figure)}
    columns = results("v8-diesel").columns
    for name, pin in (("crankpin_polar", "1"), ("crankpin_polar_4", "4")):
        largest = float(columns[f"crankpin_tangential_force.{pin}"].max())
        tangential = drawn[f"f:{name}"].alt.partition(";")[0]
        assert EngineWords("en").number(largest, digits=4) in tangential
    # of a crank gear with one crankpin there is no other
    one = {block.label: block for block in note(SPARK, "en", drawn=True).blocks if isinstance(block, Figure)}
    assert one["f:crankpin_polar"].caption == "Polar diagram of the load on the crankpin"


def test_a_table_of_the_speed_is_called_so_only_where_it_has_the_speed():
    assert "t:speed" in tables(note(FOUR, "ru"))
    table = tables(note(SPARK, "ru"))["t:energy"]
    assert "t:speed" not in tables(note(SPARK, "ru"))
    assert {title[0].content for title in table.headings} == {"φ", "ΔT"}


@pytest.mark.parametrize(("language", "wanted"), [("en", "ΣF_rot"), ("ru", "ΣP_вр"), ("vi", "ΣP_quay")])
def test_rotating_masses_have_no_order(language, wanted):
    shown = {block.step.key: block.symbol for block in equations(note("v8-diesel", language))}
    assert shown["free_force.rotating"] == wanted
    assert EngineWords(language).symbol("free_force.2") == {"en": "ΣF_q,2"}.get(language, "ΣP_jq,2")


def test_what_is_not_known_is_left_out():
    spark = crankwork.read(ROOT / "examples" / "spark-engine.toml")
    motion = replace(spark, gas=None, masses=None, cylinder=None)
    one = engine_note(crankwork.analyse(motion), NoteOptions(language="ru", figures=False))
    assert headings(one)[1:3] == ["Исходные данные", "Кинематика кривошипно-шатунного механизма"]
    assert not {"t:along", "t:total", "t:points"} & set(tables(one))
    no_gas = engine_note(crankwork.analyse(replace(spark, gas=None)), NoteOptions(language="vi", figures=False))
    assert "Đồ thị công" not in headings(no_gas)
    assert "Đồ thị mài mòn chốt khuỷu" in headings(no_gas)


def test_nobody_knows_the_journals_of_a_crank_gear_of_its_own():
    assert "Коренные шейки и набегающие моменты" not in headings(note(SPARK, "ru"))
    assert not any("коренная" in row[0] for row in tables(note(SPARK, "ru"))["t:loads"].rows)


def test_title_and_author_are_the_users():
    one = note_of(results(SPARK), NoteOptions(language="vi", title="Đồ án", author="N. V. A", figures=False))
    assert (one.title, one.authors) == ("Đồ án", ("N. V. A",))
    assert note(SPARK, "vi").title == results(SPARK).machine.title
    assert any(isinstance(block, Bibliography) for block in one.blocks)


def test_forces_per_area_are_divided_once():
    plain, divided = (
        engine_note(results(SPARK), NoteOptions(language="ru", per_area=chosen, figures=False))
        for chosen in (False, True)
    )
    area = results(SPARK).summary["piston_area"]
    for label, column in (("t:along", 4), ("t:crankpin", 3)):
        one, other = (value(tables(some)[label].rows[30][column]) for some in (plain, divided))
        assert one / area / 1e6 == pytest.approx(other, rel=1e-3)


def test_a_figure_that_no_section_knows_stands_in_the_appendix(monkeypatch, drawing):
    monkeypatch.setattr(engine_material, "drawings", lambda *_, **__: {"crankpin_polar": drawing, "main_wear": drawing})
    material = engine_material.Material(results(FOUR), NoteOptions(language="en"))
    assert material.remaining_figures() == ["crankpin_polar", "main_wear"]
    list(material.presented((), ["crankpin_polar"]))
    assert material.remaining_figures() == ["main_wear"]


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_a_note_can_be_written(language):
    page = web(note(FOUR, language)).decode()
    assert page.count("<table") >= len(tables(note(FOUR, language)))


def test_every_heading_stands_in_the_table_of_terms():
    rows = {
        tuple(cell.strip() for cell in line.strip("|").split("|")[:3])
        for line in (ROOT / "docs" / "terms.md").read_text(encoding="utf-8").splitlines()
        if line.count(" | ") == 4
    }
    said = {
        tuple(texts(room, language)[key] for language in LANGUAGES)
        for room in ("headings", "captions", "columns")
        for key in texts(room, "en")
    }
    assert said - rows == set()
    everything = {
        tuple(texts(room, language)[key] for language in LANGUAGES)
        for room in ("headings", "captions", "columns", "kinds", "figures", "tables", "report", "quantities")
        for key in texts(room, "en")
    }
    assert rows - everything == {("en", "ru", "vi")}


@pytest.mark.parametrize(
    ("name", "given", "derived"),
    [("v8-diesel", {"S", "λ"}, {"R", "L"}), ("petrol-four", {"R", "λ"}, {"S", "L"}), ("two-stroke", {"S", "L"}, {"R"})],
)
def test_what_is_worked_out_is_not_listed_as_given(name, given, derived):
    results = crankwork.analyse(crankwork.read(ROOT / "examples" / f"{name}.toml"))
    blocks = note_of(results, NoteOptions(language="ru", figures=False)).blocks
    table = next(one for one in blocks if isinstance(one, Table) and one.label == "t:data")
    symbols = {str(cell.content) for row in table.rows for cell in row if isinstance(cell, Math)}
    assert given <= symbols
    assert not derived & symbols

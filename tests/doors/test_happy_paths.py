"""From a template to its results: summary, tables, workbook, figures, in three languages."""

from __future__ import annotations

import base64
import csv
import gzip
import hashlib
import io
import json
import re
import zipfile
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from crankwork.description.machine_file import template_names
from crankwork.quantities import LANGUAGES, QUANTITIES, base_key
from crankwork.units import UNITS

SHEET = {"x": "http://schemas.openxmlformats.org/spreadsheetml/2006/main"}
ENGINES = ("engine", "slider-crank", "compressor", "whole-engine")
SHAFTS = ("turning-moment",)
ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def _table(name: str, folder: str = "out") -> tuple[list[str], list[list[float]]]:
    heading, *rows = csv.reader(Path(folder, "tables", f"{name}.csv").read_text("utf-8").splitlines())
    return heading, [[float(cell) for cell in row] for row in rows]


def _run(crankwork, *arguments):
    answer = crankwork("run", *arguments)
    assert answer.code == 0, answer.err
    return answer


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", template_names())
def test_a_template_is_written_checked_and_computed(crankwork, name, language) -> None:
    assert crankwork("new", name, "-o", "my.toml").out == "my.toml written; check it with: crankwork check my.toml\n"
    checked = crankwork("check", "my.toml")
    assert (checked.code, checked.err) == (0, "")
    assert checked.out.startswith("my.toml: ")
    answer = _run(crankwork, "my.toml", "-o", "out", "--lang", language, "--no-figures")
    assert bool(re.search(r"\d[.]\d", answer.out)) == (language == "en")
    assert bool(re.search(r"\d,\d", answer.out)) == (language != "en")
    assert answer.err == ""
    assert answer.out.rstrip().endswith(" out")
    # a shaft with torques on it has nothing that could be drawn in motion
    drawing = set() if name in SHAFTS else {"machine.svg"}
    assert {one.name for one in Path("out").iterdir()} == {
        ".crankwork.json",
        "summary.json",
        "tables",
        "tables.xlsx",
    } | drawing
    tables = {"kinematics.csv", "forces.csv"} if name in ENGINES else {"dynamics.csv", "points.csv", "links.csv"}
    tables = {"turning.csv", "energy_extremes.csv"} if name in SHAFTS else tables
    assert tables <= {one.name for one in Path("out/tables").iterdir()}
    if not drawing:
        return
    ET.parse("out/machine.svg")  # noqa: S314 - our own drawing


def test_figures_are_drawn_unless_left_out(crankwork, machine_file) -> None:
    _run(crankwork, machine_file(name="slider-crank"), "-o", "out")
    drawn = list(Path("out/figures").glob("*.svg"))
    assert drawn
    for one in drawn:
        assert ET.parse(one).getroot().tag.endswith("svg")  # noqa: S314 - our own figure


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_an_example_is_computed(crankwork, example) -> None:
    _run(crankwork, str(example), "-o", "out", "--no-figures")


def test_json_is_one_object_with_values_and_units(crankwork, machine_file) -> None:
    answer = _run(crankwork, machine_file(("# pi = 3.14", "pi = 3.14")), "--json", "-o", "out", "--no-figures")
    data = json.loads(answer.out, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))
    assert data["method"] == "exact"
    assert data["notices"] == ["computed with π = 3.14"]
    assert answer.err == "\nWritten to out\n"
    for key, entry in data["summary"].items():
        assert set(entry) == {"value", "unit"}
        assert base_key(key) in QUANTITIES
        assert entry["unit"] in ("", *UNITS)
        assert isinstance(entry["value"], float)


def test_the_language_of_the_screen_does_not_change_the_data(crankwork, machine_file) -> None:
    name = machine_file()
    assert len({_run(crankwork, name, "--json", "--lang", language).out for language in LANGUAGES}) == 1
    assert len({_run(crankwork, name, "--lang", language).out for language in LANGUAGES}) == 3


@pytest.mark.parametrize("per_area", [False, True])
def test_a_table_begins_with_key_and_unit_of_each_column(crankwork, machine_file, per_area) -> None:
    _run(crankwork, machine_file(), "-o", "out", "--no-figures", *(["--per-area"] if per_area else []))
    for path in Path("out/tables").iterdir():
        heading, rows = _table(path.stem)
        assert heading[0] == "crank_angle [deg]"
        for column in heading:
            key, _, unit = column.removesuffix("]").partition(" [")
            quantity = QUANTITIES[key]
            assert unit == ((per_area and quantity.per_area_unit) or quantity.unit or "-")
        assert all(len(row) == len(heading) for row in rows)
    heading, _ = _table("forces")
    assert {"gas_pressure [MPa]", f"inertia_force [{'MPa' if per_area else 'N'}]", "crank_torque [N*m]"} <= set(heading)


def test_forces_per_area_are_forces_over_the_piston_area(crankwork, machine_file) -> None:
    name = machine_file()
    area = json.loads(_run(crankwork, name, "--json").out)["summary"]["piston_area"]["value"]
    _run(crankwork, name, "-o", "out", "--no-figures")
    _run(crankwork, name, "-o", "per_area", "--no-figures", "--per-area")
    (heading, plain), (_, divided) = _table("forces"), _table("forces", "per_area")
    column = heading.index("piston_force [N]")
    # N over cm2 is 0.01 MPa
    assert [row[column] for row in divided] == pytest.approx([row[column] / area / 100 for row in plain], rel=1e-12)


def test_rows_stand_at_every_step_and_at_special_angles(crankwork, machine_file) -> None:
    special = ('special_angles = ["372 deg"]', 'special_angles = ["372 deg", "30 deg", "0.5 rad", "720 deg"]')
    _run(crankwork, machine_file(special), "-o", "out", "--no-figures", "--step", "7")
    angles = [row[0] for row in _table("kinematics")[1]]
    expected = {7.0 * number for number in range(103)} | {720.0, 372.0, 30.0, 28.647889757}
    assert angles == sorted(expected)


def test_zero_and_the_end_of_the_cycle_are_the_same_state(crankwork, machine_file) -> None:
    _run(crankwork, machine_file(), "-o", "out", "--no-figures")
    _, rows = _table("kinematics")
    assert (rows[0][0], rows[-1][0]) == (0.0, 720.0)
    assert rows[0][1:] == rows[-1][1:]


def test_csv_for_excel_has_semicolons_and_commas_and_the_same_numbers(crankwork, machine_file) -> None:
    name = machine_file()
    _run(crankwork, name, "-o", "out", "--no-figures")
    _run(crankwork, name, "-o", "excel", "--no-figures", "--excel-csv")
    data = Path("excel/tables/forces.csv").read_bytes()
    assert data.startswith(b"\xef\xbb\xbfcrank_angle [deg];")
    heading, *rows = csv.reader(io.StringIO(data.decode("utf-8-sig")), delimiter=";")
    assert (heading, [[float(cell.replace(",", ".")) for cell in row] for row in rows]) == _table("forces")
    assert b"." not in data.partition(b"\n")[2]


def test_a_table_of_results_can_be_read_back_as_measured_pressure(crankwork, machine_file) -> None:
    answer = _run(crankwork, machine_file(), "-o", "out", "--no-figures", "--step", "1", "--json")
    before = json.loads(answer.out)["summary"]
    text = Path("my.toml").read_text("utf-8")
    head, tail = text[: text.index("[gas]")], text[text.index("[method]") :]
    gas = (
        '[gas]\ncycle = "720 deg"\n[gas.measured]\nfile = "out/tables/forces.csv"\npressure_unit = "MPa"\n'
        'angle_column = "crank_angle [deg]"\npressure_column = "gas_pressure [MPa]"\n'
    )
    after = json.loads(_run(crankwork, machine_file(text=head + gas + tail), "--json").out)["summary"]
    assert after["indicated_work"]["value"] == pytest.approx(before["indicated_work"]["value"], rel=2e-3)


@pytest.mark.parametrize("many", [100, 500_000])
def test_the_workbook_holds_the_same_numbers_as_the_tables(crankwork, machine_file, monkeypatch, many) -> None:
    # of many rows a workbook waits in files
    monkeypatch.setattr("crankwork.report.workbook._MANY", many)
    _run(crankwork, machine_file(), "-o", "out", "--no-figures", "--lang", "ru")
    with zipfile.ZipFile("out/tables.xlsx") as book:
        assert book.testzip() is None
        workbook = ET.fromstring(book.read("xl/workbook.xml"))  # noqa: S314 - our own workbook
        names = [sheet.get("name") for sheet in workbook.iterfind(".//x:sheet", SHEET)]
        sheets = [ET.fromstring(book.read(f"xl/worksheets/sheet{n}.xml")) for n in (4, 5, 6)]  # noqa: S314
    assert names[:4] == ["Основные результаты расчёта", "Исходные данные", "Проверка результатов", "Кинематика поршня"]
    for sheet, name in zip(sheets, ("kinematics", "harmonics", "forces"), strict=True):
        rows = sheet.findall(".//x:row", SHEET)[1:]
        values = [[float(cell.findtext("x:v", "nan", SHEET)) for cell in row] for row in rows]
        expected = _table(name)[1]
        assert len(values) == len(expected)
        # the workbook writes 16 digits
        assert [pytest.approx(row, rel=1e-15, abs=1e-300) for row in expected] == values


def test_the_explanation_in_the_readme_is_the_one_that_is_given(crankwork) -> None:
    command = ("explain", "examples/spark-engine.toml", "side_force", "--at", "390")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"`crankwork {' '.join(command)}`" in readme
    assert f"```\n{crankwork(command[0], str(ROOT / command[1]), *command[2:]).out}```" in readme


def test_three_lines_of_python_give_the_results() -> None:
    import crankwork

    machine = crankwork.read_machine(crankwork.template("engine"))
    results = crankwork.analyse(machine)
    assert crankwork.summary_text(results).startswith("Four-stroke engine\n")
    assert crankwork.read.__module__ == "crankwork.description.machine_file"
    assert set(crankwork.__all__) <= set(dir(crankwork))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = crankwork.nothing


def test_every_export_says_program_file_and_method(crankwork) -> None:
    """By the hash of the file and of what was set over it, so that results of another file are told apart."""
    crankwork("new", "engine", "-o", "engine.toml")
    digest = hashlib.sha256(Path("engine.toml").read_bytes()).hexdigest()
    told = f"crankwork {version('crankwork')}", "exact", digest
    _run(crankwork, "engine.toml", "--no-figures", "-o", "out")
    data = json.loads(Path("out/summary.json").read_text(encoding="utf-8"))
    assert (data["source"], data["method"], data["machine_file_sha256"]) == told
    parts = {"out/tables.xlsx": "docProps/core.xml", "note.docx": "docProps/core.xml"}
    for name in ("note.html", "note.docx"):
        crankwork("report", "engine.toml", "-o", name)
    for name in (*parts, "note.html"):
        if name in parts:
            with zipfile.ZipFile(name) as packed:
                text = packed.read(parts[name]).decode()
        else:
            text = Path(name).read_text(encoding="utf-8")
        assert all(one in text for one in told), name
    assert all(one.encode() in _pdf(crankwork) for one in told)
    other = json.loads(_run(crankwork, "engine.toml", "--set", "rod.ratio=0.3", "--json").out)
    assert other["machine_file_sha256"] != digest


def _pdf(crankwork) -> bytes:
    """Return the description of a note as PDF, which stands there as it is."""
    crankwork("report", "engine.toml", "-o", "note.pdf")
    return Path("note.pdf").read_bytes()


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_a_page_is_written_and_says_where_the_file_gives_a_value(crankwork, machine_file, tmp_path, language) -> None:
    page = tmp_path / "machine.html"
    answer = crankwork("page", machine_file(name="engine"), "-o", str(page), "--lang", language)
    assert answer.code == 0, answer.err
    letters = re.search(r'id="data">([^<]*)<', page.read_text(encoding="utf-8"))
    nodes = json.loads(gzip.decompress(base64.b64decode(letters[1])))["memories"]["nodes"]
    assert any(re.search(r"cylinder\.bore, \D+\d+", node.get("g", "")) for node in nodes)
    again = crankwork("page", machine_file(name="engine"), "-o", str(page))
    assert (again.code, "--overwrite" in again.err) == (2, True)
    assert crankwork("page", machine_file(name="engine"), "-o", str(tmp_path / "machine.pdf")).code == 2


def test_a_workbook_begins_with_values_givens_and_checks_and_draws_its_tables(crankwork, machine_file) -> None:
    _run(crankwork, machine_file(), "-o", "out", "--no-figures")
    with zipfile.ZipFile("out/tables.xlsx") as book:
        names = set(book.namelist())
        strings = book.read("xl/sharedStrings.xml").decode("utf-8")
        sheets = [book.read(f"xl/worksheets/sheet{n}.xml").decode("utf-8") for n in (1, 2, 3, 4)]
        styles = book.read("xl/styles.xml").decode("utf-8")
    assert {"xl/charts/chart1.xml", "xl/charts/chart2.xml", "xl/charts/chart3.xml"} <= names
    # the subscript of a symbol stands below
    assert '<vertAlign val="subscript"/>' in strings
    assert "crank.speed" in strings
    assert all('ySplit="1"' in one and 'fitToHeight="0"' in one for one in sheets)
    assert '<drawing r:id="rId1"/>' in sheets[3]
    assert 'formatCode="0.0000"' in styles

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
from itertools import cycle
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from crankwork import __version__ as VERSION  # noqa: N812 - the fixture of the command line is called crankwork here
from crankwork.description.machine_file import template_names
from crankwork.quantities import LANGUAGES, QUANTITIES, base_key
from crankwork.units import UNITS

SHEET = {"x": "http://schemas.openxmlformats.org/spreadsheetml/2006/main"}
ROOT = Path(__file__).parents[2]
ENGINES = {"kinematics.csv", "forces.csv"}
TABLES = dict.fromkeys(("engine", "slider-crank", "compressor", "whole-engine"), ENGINES)
TABLES["turning-moment"] = {"turning.csv", "energy_extremes.csv"}
TABLES["balancing"] = {"rotor.csv", "planes.csv"}
_WALKING = ("jansen", "klann", "hoecken", "chebyshev", "watt-straight-line")
TABLES |= {name: {"points.csv", "links.csv"} for name in _WALKING}
LINKAGES = {"dynamics.csv", "points.csv", "links.csv"}


def _table(name: str, folder: str = "out") -> tuple[list[str], list[list[float]]]:
    heading, *rows = csv.reader(Path(folder, "tables", f"{name}.csv").read_text("utf-8").splitlines())
    return heading, [[float(cell) for cell in row] for row in rows]


def _run(crankwork, *arguments):
    answer = crankwork("run", *arguments)
    assert answer.code == 0, answer.err
    return answer


@pytest.mark.parametrize(
    "names",
    [
        pytest.param(("engine", "press", "turning-moment"), id="some"),
        pytest.param(template_names(), id="all", marks=pytest.mark.slow),
    ],
)
def test_every_template_is_written_checked_and_computed(crankwork, names) -> None:
    failures = {}
    for name, language in zip(names, cycle(LANGUAGES), strict=False):
        file, out, found = f"{name}.toml", Path(f"out-{name}"), {}
        found["new"] = crankwork("new", name, "-o", file)[:2] == (
            0, f"{file} written; check it with: crankwork check {file}\n",
        )  # fmt: skip
        checked = crankwork("check", file)
        found["check"] = (checked.code, checked.err, checked.out.startswith(f"{file}: ")) == (0, "", True)
        answer = crankwork("run", file, "-o", str(out), "--lang", language, "--no-figures")
        found["run"] = (answer.code, answer.err, answer.out.rstrip().endswith(f" {out}")) == (0, "", True)
        marks = [mark for mark in ".," if re.search(rf"\d[{mark}]\d", answer.out)]
        found["decimal mark"] = marks == ["." if language == "en" else ","]
        # a shaft with torques or masses on it has nothing that could be drawn in motion
        drawing = set() if name in ("turning-moment", "balancing", "clutch") else {"machine.svg"}
        files = (
            {".crankwork.json", "summary.json", "tables.xlsx"} | drawing | (set() if name == "clutch" else {"tables"})
        )
        found["files"] = {one.name for one in out.iterdir()} == files
        # a clutch has values alone
        wanted = set() if name == "clutch" else TABLES.get(name, LINKAGES)
        found["tables"] = wanted <= {one.name for one in out.glob("tables/*")}
        for one in drawing:
            ET.parse(out / one)  # noqa: S314 - our own drawing
        failures |= {(name, what): answer for what, good in found.items() if not good}
    assert failures == {}


@pytest.mark.slow
def test_every_example_is_computed_with_tables_and_workbook(crankwork) -> None:
    examples = sorted((ROOT / "examples").glob("*.toml"))
    answers = {one.stem: crankwork("run", str(one), "-o", one.stem, "--no-figures") for one in examples}
    assert {name: answer.err for name, answer in answers.items() if answer.code} == {}
    assert {Path(name, "tables.xlsx").is_file() for name in answers} == {True}


def test_figures_are_drawn_unless_left_out(crankwork, machine_file) -> None:
    _run(crankwork, machine_file(name="slider-crank"), "-o", "out")
    drawn = list(Path("out/figures").glob("*.svg"))
    assert {"kinematics.svg"} < {one.name for one in drawn}
    assert {ET.parse(one).getroot().tag.rpartition("}")[2] for one in drawn} == {"svg"}  # noqa: S314 - our own figure


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
    for name in ("engine", "whitworth"):
        file = machine_file(name=name)
        assert len({_run(crankwork, file, "--json", "--lang", language).out for language in LANGUAGES}) == 1
        assert len({_run(crankwork, file, "--lang", language).out for language in LANGUAGES}) == 3


def test_tables_have_keys_units_every_step_and_special_angles_and_forces_per_area_where_asked_for(
    crankwork, machine_file
) -> None:
    special = ('special_angles = ["372 deg"]', 'special_angles = ["372 deg", "30 deg", "0.5 rad", "720 deg"]')
    name = machine_file(special)
    plain = _run(crankwork, name, "-o", "out", "--no-figures", "--step", "7", "--json")
    _run(crankwork, name, "-o", "per_area", "--no-figures", "--step", "7", "--per-area")
    for folder in ("out", "per_area"):
        for path in Path(folder, "tables").iterdir():
            heading, rows = _table(path.stem, folder)
            assert heading[0] == "crank_angle [deg]"
            for column in heading:
                key, _, unit = column.removesuffix("]").partition(" [")
                quantity = QUANTITIES[key]
                per_area = quantity.per_area_unit if folder == "per_area" else None
                assert unit == (per_area or quantity.unit or "-"), (folder, path.stem, column)
            assert all(len(row) == len(heading) for row in rows)
    (heading, forces), (_, divided) = _table("forces"), _table("forces", "per_area")
    assert {"gas_pressure [MPa]", "inertia_force [N]", "crank_torque [N*m]"} <= set(heading)
    area = json.loads(plain.out)["summary"]["piston_area"]["value"]
    column = heading.index("piston_force [N]")
    # N over cm2 is 0.01 MPa
    assert [row[column] for row in divided] == pytest.approx([row[column] / area / 100 for row in forces], rel=1e-12)
    rows = _table("kinematics")[1]
    assert [row[0] for row in rows] == sorted({7.0 * number for number in range(103)} | {720, 372, 30, 28.647889757})
    # zero and the end of the cycle are the same state
    assert rows[0][1:] == rows[-1][1:]
    # for Excel with semicolons and commas
    _run(crankwork, name, "-o", "excel", "--no-figures", "--step", "7", "--excel-csv")
    data = Path("excel/tables/forces.csv").read_bytes()
    assert data.startswith(b"\xef\xbb\xbfcrank_angle [deg];")
    begin, *rows = csv.reader(io.StringIO(data.decode("utf-8-sig")), delimiter=";")
    assert (begin, [[float(cell.replace(",", ".")) for cell in row] for row in rows]) == (heading, forces)
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
def test_the_workbook_holds_givens_checks_charts_and_the_same_numbers_as_the_tables(
    crankwork, machine_file, monkeypatch, many
) -> None:
    # of many rows a workbook waits in files
    monkeypatch.setattr("crankwork.report.results_folder._MANY", many)
    _run(crankwork, machine_file(), "-o", "out", "--no-figures", "--lang", "ru")
    with zipfile.ZipFile("out/tables.xlsx") as book:
        assert book.testzip() is None
        files = {name: book.read(name).decode("utf-8") for name in book.namelist() if name.endswith(".xml")}
    workbook = ET.fromstring(files["xl/workbook.xml"])  # noqa: S314 - our own workbook
    names = [sheet.get("name") for sheet in workbook.iterfind(".//x:sheet", SHEET)]
    assert names[:4] == ["Основные результаты расчёта", "Исходные данные", "Проверка результатов", "Кинематика поршня"]
    sheets = [files[f"xl/worksheets/sheet{number}.xml"] for number in range(1, 7)]
    for sheet, name in zip(sheets[3:], ("kinematics", "harmonics", "forces"), strict=True):
        rows = ET.fromstring(sheet).findall(".//x:row", SHEET)[1:]  # noqa: S314 - our own workbook
        values = [[float(cell.findtext("x:v", "nan", SHEET)) for cell in row] for row in rows]
        expected = _table(name)[1]
        assert len(values) == len(expected)
        # the workbook writes 16 digits
        assert [pytest.approx(row, rel=1e-15, abs=1e-300) for row in expected] == values
    assert {f"xl/charts/chart{number}.xml" for number in (1, 2, 3)} <= set(files)
    # the subscript of a symbol stands below
    texts = sheets[0] + sheets[1] + files.get("xl/sharedStrings.xml", "")
    assert '<vertAlign val="subscript"/>' in texts
    assert "crank.speed" in texts
    assert all('ySplit="1"' in one and 'fitToHeight="0"' in one for one in sheets[:4])
    assert '<drawing r:id="rId1"/>' in sheets[3]
    assert 'formatCode="0.0000"' in files["xl/styles.xml"]


def test_three_lines_of_python_give_the_results() -> None:
    import crankwork

    machine = crankwork.read_machine(crankwork.template("engine"))
    results = crankwork.analyse(machine)
    assert crankwork.summary_text(results).startswith("Four-stroke engine\n")
    assert crankwork.read.__module__ == "crankwork.description.machine_file"
    assert set(crankwork.__all__) <= set(dir(crankwork))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = crankwork.nothing


def test_every_export_says_program_file_and_method(crankwork, machine_file) -> None:
    """By the hash of the file and of what was set over it, so that results of another file are told apart."""
    file = machine_file(name="slider-crank")
    digest = hashlib.sha256(Path(file).read_bytes()).hexdigest()
    told = f"crankwork {VERSION}", "exact", digest
    _run(crankwork, file, "--no-figures", "-o", "out")
    data = json.loads(Path("out/summary.json").read_text(encoding="utf-8"))
    assert (data["source"], data["method"], data["machine_file_sha256"]) == told
    for name in ("note.html", "note.docx", "note.pdf"):
        assert crankwork("report", file, "-o", name, "--no-figures").code == 0
    for name in ("out/tables.xlsx", "note.html", "note.docx", "note.pdf"):
        written = Path(name).read_bytes()
        if written.startswith(b"PK"):
            written = zipfile.ZipFile(name).read("docProps/core.xml")
        assert [one for one in told if one.encode() not in written] == [], name
    other = json.loads(_run(crankwork, file, "--set", "rod.ratio=0.3", "--json").out)
    assert other["machine_file_sha256"] != digest


def test_a_page_is_written_and_says_where_the_file_gives_a_value(crankwork, machine_file, check_refusals) -> None:
    file = machine_file()
    answer = crankwork("page", file, "-o", "my.html", "--lang", "ru")
    assert (answer.code, answer.out, answer.err) == (0, "Записано в my.html\n", "")
    letters = re.search(r'id="data">([^<]*)<', Path("my.html").read_text(encoding="utf-8"))
    nodes = json.loads(gzip.decompress(base64.b64decode(letters[1])))["memories"]["nodes"]
    assert any(re.search(r"cylinder\.bore, строка \d+", node.get("g", "")) for node in nodes)
    wrong = {"my.html": "add --overwrite", "machine.pdf": "machine.pdf: "}
    check_refusals((("page", file, "-o", name), told) for name, told in wrong.items())

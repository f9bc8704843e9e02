"""The page as a file: what is stored in it, and that it needs nothing else."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crankwork
from crankwork.locale.numbers import number
from crankwork.note.interactive import packed
from crankwork.page.document import page
from crankwork.report.display import displayed, displayed_column
from page.slid import EXAMPLES

# an engine, and a linkage whose crank turns as a table says
NAMES = ("spark-engine", "excavator-boom")


@cache
def results_of(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))


def unpacked(column: dict[str, Any]) -> np.ndarray:
    steps = [float("nan") if one == "x" else int(one) for one in column["v"].split(" ")]
    known = np.isfinite(steps)
    values = np.full(len(steps), np.nan)
    values[known] = np.cumsum(np.array(steps)[known]) / 10.0 ** column["d"]
    return values


@given(st.lists(st.floats(-1e9, 1e9) | st.just(float("nan")), min_size=1))
def test_a_packed_column_keeps_five_digits_of_its_largest(values) -> None:
    found, largest = unpacked(packed(np.array(values), 5)), np.nanmax(np.abs([*values, 0.0]))
    np.testing.assert_allclose(found, values, rtol=0, atol=max(1e-4 * largest, 5.1e-13))


def test_pages_are_the_same_each_time_small_and_ask_for_nothing(written_of) -> None:
    assert written_of("spark-engine", "ru") == page(results_of("spark-engine"), "ru")
    for name in NAMES:
        # the longest words
        written = written_of(name, "ru")
        assert len(written) < 250_000, name
        outside = re.sub(r'xmlns="[^"]*"', "", written.decode())
        assert not re.search(r"https?://|src=|@import|url\(", outside.partition('id="data"')[0]), name


def stored_wrongly(data: dict[str, Any], results: crankwork.Results) -> list[str]:
    """Return columns of a page that are not what the tables say, and values that lead nowhere or are stored twice."""
    failures = []
    for key, column in data["columns"].items():
        wanted = displayed_column(key, results.columns[key])
        apart = np.abs(unpacked(column) - wanted)
        if np.nanmax(apart) > max(1e-4 * np.nanmax(np.abs(wanted)), 1e-9):
            failures.append(f"column {key}")
    traces = data["memories"]
    nodes, rows = traces["nodes"], len(traces["rows"])
    for at, node in enumerate(nodes):
        parts = [*node.get("o", ()), *(law for _, law in node.get("p", ())), *node.get("y", ())[:1]]
        if not (
            ("s" in node or node["k"] in data["columns"])
            and node.get("s") not in ("", "?")
            and ("t" in node or "k" in node or len(node["c"]["v"].split(" ")) == rows)
            and all(0 <= row < rows for row, _ in node.get("e", ()))
            and all(0 <= one < len(nodes) for one in parts)
            and node.get("f", 0) < max(len(traces["formulas"]), 1)
        ):
            failures.append(f"node {at}: {node}")
    shown = {*results.summary, *(key for keys in results.tables.values() for key in keys)} & set(results.trace)
    failures += [f"no {key}" for key in shown - set(traces["keys"])]
    # what tables have is stored once in their units
    columns = [key for key in data["columns"] if key in traces["keys"] and results.trace[key].varies]
    listed = [key for key in columns if nodes[traces["keys"][key]].get("k") == key]
    return failures + (columns if len(listed) < 0.9 * len(columns) else [])


def turned_wrongly(nodes: list[dict[str, Any]], results: crankwork.Results) -> list[str]:
    """Return functions of the crank angle that do not say what they are, or are another; that there are none."""
    ends = [one for one in nodes if not one.keys() & {"o", "p", "y", "g"}]
    turned = [one for one in ends if re.match(r"(?:sin |cos )?\d?(?:<i>)?[φα]", one.get("s", "")) and "c" in one]
    failures = [one["s"] for one in turned if not one["w"]] if turned else ["none"]
    for one in turned:
        counted = re.fullmatch(r"(sin|cos) (\d?)(?:<i>)?φ(?:</i>)?", one["s"])
        values, degrees = unpacked(one["c"]), results.grid.degrees
        if counted and len(values) == len(degrees):
            wanted = getattr(np, counted[1])(np.radians(float(counted[2] or 1) * degrees))
            failures += [one["s"]] if np.nanmax(np.abs(values - wanted)) > 1e-4 else []
    return failures


def test_what_is_stored_is_what_the_tables_say_once_and_leads_to_others_of_the_page(written_of, stored) -> None:
    found = {name: stored_wrongly(stored(written_of(name, "ru")), results_of(name)) for name in NAMES}
    assert found == {"spark-engine": [], "excavator-boom": []}


def test_figures_of_one_position_are_drawn_from_the_beginning_of_a_motion_to_its_end(written_of, stored) -> None:
    figures = stored(written_of("excavator-boom", "ru"))["figures"]
    drawn = [one["places"] for one in figures.values() if "places" in one]
    assert len(drawn) > 0
    for places in drawn:
        assert places[0] == 0
        assert places[-1] == pytest.approx(results_of("excavator-boom").period)


VALUE = re.compile(r'<tr><th>([^<]*)<td>(.*)<td>(?:<button data-key="?([^">]*)"?>)?([^<]*)(?:</button>)?<td>(.*)')
FIGURE = re.compile(r'<figure id="figure-([^"]*)">.*?<figcaption>([^<]*)', re.DOTALL)


def test_values_diagrams_and_tables_stand_in_order_under_their_names(written_of, stored) -> None:
    text, results = written_of("spark-engine").decode(), results_of("spark-engine")
    rows = VALUE.findall(text)
    assert rows[:3] + rows[11:12] == [
        ("crank radius", "<i>r</i>", "crank_radius", "52.9", "mm"),
        ("connecting rod length", "<i>l</i>", "rod_length", "211.6", "mm"),
        ("crank-to-rod ratio r/l", "<i>λ</i>", "rod_ratio", "0.25", ""),
        ("rotational speed", "<i>n</i>", "rotational_speed", "2300", "rpm"),
    ]
    wanted = {key: number(displayed(key, value), "en") for key, value in results.summary.items()}
    assert {key: value for *_, key, value, _ in rows} == wanted
    figures = dict(FIGURE.findall(text))
    assert " ".join(figures) == (
        "torque kinematics brix tolle pressure indicator piston_forces rod_forces crankpin_forces crankpin_polar"
    )
    assert figures["rod_forces"] == "Force along the rod and side force"
    assert figures["torque"] == "Crank torque of one cylinder"
    tables = stored(text.encode())["tables"]
    assert [one["n"] for one in tables] == [
        "Piston motion", "First and second order", "Forces and torque", "Reduced inertia and torques"
    ]  # fmt: skip
    assert [one["k"] for one in tables] == [[*keys] for keys in results.tables.values()]


@pytest.mark.slow
def test_what_pages_store_of_other_machines_is_right_too(written_of, stored) -> None:
    """Tables of one's own, a motor, banks and articulated rods, a delay, a linkage with flywheel."""
    found = {}
    for name in ("press", "punching-machine", "v8-diesel", "radial-five", "two-stroke", "beta-stirling"):
        written, results = written_of(name, "ru"), results_of(name)
        assert len(written) < 400_000, name
        found[name] = stored_wrongly(stored(written), results)
        if name in ("radial-five", "two-stroke"):
            found[name] += turned_wrongly(stored(written)["memories"]["nodes"], results)
    assert {name: failures for name, failures in found.items() if failures} == {}


def test_functions_of_the_crank_angle_say_where_they_are_counted_from(written_of, stored) -> None:
    nodes = stored(written_of("spark-engine", "ru"))["memories"]["nodes"]
    assert turned_wrongly(nodes, results_of("spark-engine")) == []


def test_names_of_the_user_stay_text(tmp_path) -> None:
    text = (EXAMPLES / "press.toml").read_text(encoding="utf-8")
    wicked = '</script><b onload=x>&\\" {a}_{b}'
    path = tmp_path / "wicked.toml"
    path.write_text(re.sub(r"(?m)^title = .*$", f'title = "{wicked}"', text, count=1), encoding="utf-8")
    written = page(crankwork.analyse(crankwork.read(path))).decode()
    assert "<b onload" not in written
    assert "&lt;b onload=x&gt;" in written


def test_signs_of_names_mark_nothing(stored) -> None:
    text = (EXAMPLES / "press-geometry.toml").read_text("utf-8").replace('"rocker"', '"r^o{1}"')
    results = crankwork.analyse(crankwork.read_machine(re.sub(r"(?m)^rocker( *=)", r'"r^o{1}"\1', text)))
    data = stored(page(results))
    assert data["columns"]["link_angle.r^o{1}"]["s"] == "<i>θ</i><sub>r^o{1}</sub>"
    nodes = [one["s"] for one in data["memories"]["nodes"] if "r^o" in one.get("s", "")]
    assert nodes
    assert all("r^o{1}" in one.partition("<sub>")[2] for one in nodes)

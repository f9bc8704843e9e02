"""The page as a file: what is stored in it, and that it needs nothing else."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crankwork
from crankwork.note.live import packed
from crankwork.page.document import page
from crankwork.report.language import displayed_column

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = sorted(one.stem for one in EXAMPLES.glob("*.toml"))


@cache
def results_of(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))


@cache
def page_of(name: str) -> bytes:
    # the longest words
    return page(results_of(name), "ru")


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


@pytest.mark.parametrize("name", NAMES)
def test_the_page_of_an_example_asks_for_nothing_and_is_small(name) -> None:
    written = page_of(name)
    assert written == page(results_of(name), "ru")
    assert len(written) < 400_000
    outside = re.sub(r'xmlns="[^"]*"', "", written.decode())
    assert not re.search(r"https?://|src=|@import|url\(", outside.partition('id="data"')[0])


@pytest.mark.parametrize("name", NAMES)
def test_what_is_stored_is_what_the_tables_say(stored, name) -> None:
    results = results_of(name)
    data = stored(page_of(name))
    for key, column in data["columns"].items():
        wanted = displayed_column(key, results.columns[key])
        np.testing.assert_allclose(
            unpacked(column), wanted, rtol=0, atol=max(1e-4 * np.nanmax(np.abs(wanted)), 1e-9), err_msg=key
        )


@pytest.mark.parametrize("name", NAMES)
def test_every_memory_has_a_value_and_leads_to_others_of_the_page(stored, name) -> None:
    results = results_of(name)
    store = stored(page_of(name))
    data = store["memories"]
    rows = len(data["rows"])
    for node in data["nodes"]:
        assert "s" in node or node["k"] in store["columns"]
        assert node.get("s") not in ("", "?")
        assert "t" in node or "k" in node or len(node["c"]["v"].split(" ")) == rows
        assert all(0 <= row < rows for row, _ in node.get("e", ()))
        parts = [*node.get("o", ()), *(law for _, law in node.get("p", ())), *node.get("y", ())[:1]]
        assert all(0 <= one < len(data["nodes"]) for one in parts)
        assert node.get("f", 0) < max(len(data["formulas"]), 1)
    shown = {*results.summary, *(key for keys in results.tables.values() for key in keys)} & set(results.memory)
    assert shown <= set(data["keys"])


@pytest.mark.parametrize("name", NAMES)
def test_what_tables_have_is_stored_once_in_their_units(stored, name) -> None:
    store = stored(page_of(name))
    data, known = store["memories"], results_of(name).memory
    columns = [key for key in store["columns"] if key in data["keys"] and known[key].varies]
    listed = [key for key in columns if data["nodes"][data["keys"][key]].get("k") == key]
    assert len(listed) >= 0.9 * len(columns)


@pytest.mark.parametrize("name", ["radial-five", "spark-engine", "two-stroke"])
def test_functions_of_the_crank_angle_say_where_they_are_counted_from(stored, name) -> None:
    nodes = stored(page_of(name))["memories"]["nodes"]
    ends = [one for one in nodes if not one.keys() & {"o", "p", "y", "g"}]
    turned = [one for one in ends if re.match(r"(?:sin |cos )?\d?(?:<i>)?[φα]", one.get("s", "")) and "c" in one]
    assert turned
    known = results_of(name)
    for one in turned:
        # what an explanation ends with says what it is
        assert one["w"]
        counted = re.fullmatch(r"(sin|cos) (\d?)(?:<i>)?φ(?:</i>)?", one["s"])
        values = unpacked(one["c"])
        if counted and len(values) == len(known.grid.degrees):
            wanted = getattr(np, counted[1])(np.radians(float(counted[2] or 1) * known.grid.degrees))
            seen = np.isfinite(values)
            np.testing.assert_allclose(values[seen], wanted[seen], atol=1e-4)


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

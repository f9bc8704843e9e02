"""The page as a reader uses it: pointer, keys, phone, dark ground, without script, by ear."""

from __future__ import annotations

import csv
import io
import math
import re
import sys
from pathlib import Path

import pytest

import crankwork
from crankwork.report.language import displayed
from crankwork.report.tables import csv_of_sheet, sheets

EXAMPLES = Path(__file__).parents[2] / "examples"
AXE = Path(sys.prefix) / "node" / "node_modules" / "axe-core" / "axe.min.js"
EVERY = sorted(one.stem for one in EXAMPLES.glob("*.toml"))
# a row of the tables that is looked at
ROW = 3
DOTS = """one => [...one.querySelectorAll(".cursor circle:not([hidden])")].map(
  (dot) => [dot.getAttribute("cx"), dot.getAttribute("cy")])"""
CURVES = "one => [...one.querySelectorAll('path[data-curve]')].map((path) => path.dataset.curve)"
SOME = ("v8-diesel", "press", "excavator-boom", "knuckle-press", "punching-machine")


def printed(text: str) -> float:
    """Return the number of `F = −8678 N`."""
    number = re.search(r"= ([−\d.]+)", text)
    assert number is not None, text
    return float(number[1].replace("−", "-"))


def over(figure, share: float) -> None:
    """Point at the first graph of a figure, at a share of its width."""
    box = figure.bounding_box()
    graph = figure.evaluate(
        "one => { const b = one.querySelector('.cursor line'); const s = one.viewBox.baseVal;"
        "return [b.getAttribute('y1') / s.height, b.getAttribute('y2') / s.height] }"
    )
    height = box["y"] + box["height"] * (0.5 * graph[0] + 0.5 * graph[1])
    figure.page.mouse.move(box["x"] + share * box["width"], height)


def test_the_number_at_the_cursor_is_that_of_the_table(opened) -> None:
    page = opened("v8-diesel", viewport={"width": 1300, "height": 900})
    results = crankwork.analyse(crankwork.read(EXAMPLES / "v8-diesel.toml"))
    rows = list(csv.reader(io.StringIO(csv_of_sheet(sheets(results)["forces"]).decode())))
    heads = [one.partition(" [")[0] for one in rows[0]]
    page.keyboard.press("Home")
    figure = page.locator("[data-figure=piston_forces]")
    figure.scroll_into_view_if_needed()
    told = set()
    for share in (0.25, 0.4, 0.55, 0.7, 0.9):
        over(figure, share)
        angle, *values = page.locator("#figure-piston_forces .reading span").all_inner_texts()
        row = next(one for one in rows[1:] if float(one[0]) == printed(angle))
        told.add(printed(angle))
        keys = figure.locator("path[data-curve]:not([data-curve=legend])").evaluate_all(
            "all => all.map(one => one.dataset.curve)"
        )
        assert len(values) == len(set(keys)) == 3
        for key, value in zip(dict.fromkeys(keys), values, strict=True):
            assert printed(value) == pytest.approx(float(row[heads.index(key)]), abs=0.51)
    assert len(told) == 5


@pytest.mark.parametrize("name", SOME)
def test_a_dot_stands_on_its_curve_where_the_table_says(opened, pages, stored, name) -> None:
    page = opened(name)
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    page.keyboard.press("Home")
    for _ in range(ROW):
        page.keyboard.press("ArrowRight")
    figures, compared = stored(pages(name).read_bytes())["figures"], 0
    for figure in page.locator("svg.drawing:not([data-figure=machine])").all():
        dots = [tuple(map(float, one)) for one in figure.evaluate(DOTS)]
        lines = {key for key in figure.evaluate(CURVES) if key in results.columns}
        for plot in figures[figure.get_attribute("data-figure")]["plots"]:
            left, top, width, height = plot["box"]
            inside = [one for one in dots if left <= one[0] <= left + width and top <= one[1] <= top + height]
            if not plot["over"] or not inside:
                continue
            said = [plot["y"][1] - (y - top) / height * (plot["y"][1] - plot["y"][0]) for _, y in inside]
            slack = 0.06 / height * abs(plot["y"][1] - plot["y"][0])
            for key in lines:
                value = displayed(key, results.columns[key][ROW])
                # a diagram may show kN where the table has N
                compared += any(abs(one - value * unit) < slack for one in said for unit in (1.0, 1e-3))
    assert compared >= 1


def test_the_dot_of_the_indicator_diagram_stands_at_the_volume_of_its_angle(opened, pages, stored) -> None:
    """Along straight strokes the volume does not grow as the angle does."""
    page, results = opened("v8-diesel"), crankwork.analyse(crankwork.read(EXAMPLES / "v8-diesel.toml"))
    (plot, *_) = stored(pages("v8-diesel").read_bytes())["figures"]["indicator"]["plots"]
    (left, _, width, _), (low, high) = plot["box"], plot["x"]
    page.keyboard.press("Home")
    for volume in results["cylinder_volume"]:
        dots = page.locator("svg[data-figure=indicator]").evaluate(DOTS)
        said = [low + (float(x) - left) / width * (high - low) for x, _ in dots]
        assert min(abs(one - displayed("cylinder_volume", volume)) for one in said) < 0.3 / width * (high - low)
        page.keyboard.press("ArrowRight")


def test_keys_move_the_cursor_and_the_machine_runs_and_stops(opened) -> None:
    page = opened("press")
    shown = page.locator("#shown")
    page.keyboard.press("Home")
    first = shown.inner_text()
    page.keyboard.press("ArrowRight")
    second = shown.inner_text()
    assert first != second
    page.keyboard.press("ArrowLeft")
    assert shown.inner_text() == first
    page.locator("#play").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("before => document.getElementById('shown').innerText !== before", arg=first)
    page.keyboard.press("Enter")
    assert page.locator("#play").get_attribute("aria-pressed") == "false"


def test_the_machine_stands_where_the_cursor_is(opened) -> None:
    page = opened("v8-diesel", viewport={"width": 1300, "height": 900})
    results = crankwork.analyse(crankwork.read(EXAMPLES / "v8-diesel.toml"))
    page.keyboard.press("Home")
    down = "document.querySelector('[data-part=\"side.piston.1\"]').transform.baseVal[0].matrix"
    before = page.evaluate(f"(() => {{ const m = {down}; return [m.e, m.f] }})()")
    for _ in range(ROW):
        page.keyboard.press("ArrowRight")
    after = page.evaluate(f"(() => {{ const m = {down}; return [m.e, m.f] }})()")
    moved = math.dist(before, after)
    bar = page.evaluate("document.querySelector('[data-figure=machine]').viewBox.baseVal.width")
    assert 0 < moved < bar
    for _ in range(18 - ROW):
        page.keyboard.press("ArrowRight")
    lowest = page.evaluate(f"(() => {{ const m = {down}; return [m.e, m.f] }})()")
    stroke = results["stroke"]
    assert moved / math.dist(before, lowest) == pytest.approx(results["piston_displacement"][ROW] / stroke, abs=2e-3)


def test_forces_views_speed_and_paths_are_chosen_by_keys(opened) -> None:
    page = opened("v8-diesel", "ru", viewport={"width": 360, "height": 800}, reduced_motion="reduce")
    arrow = page.locator('[data-part="force.side_force.1.shaft"]')
    assert arrow.evaluate("one => getComputedStyle(one).visibility") == "hidden"
    page.locator(".controls summary").press("Enter")
    page.locator('[data-choice="force.side_force."]').press("Space")
    assert arrow.evaluate("one => getComputedStyle(one).visibility") == "visible"
    other = page.locator('[data-part="force.rod_force.1.shaft"]')
    assert other.evaluate("one => getComputedStyle(one).visibility") == "hidden"
    machine, view = page.locator("[data-figure=machine]"), page.locator("#view")
    whole = machine.get_attribute("viewBox")
    names = view.locator("option").all_inner_texts()
    assert names == ["Все виды", "Вид вдоль вала", "Сбоку: 1, 2, 3, 4", "Сбоку: 5, 6, 7, 8"]
    view.press("ArrowDown")
    view.press("ArrowDown")
    left, top, wide, tall = map(float, machine.get_attribute("viewBox").split())
    liner = machine.locator('[data-part="row.1.piston.4"]').evaluate("one => one.transform.baseVal[0].matrix.e")
    other = machine.locator('[data-part="row.5.piston.8"]').evaluate("one => one.transform.baseVal[0].matrix.f")
    assert left < liner < left + wide
    assert other > top + tall
    view.select_option(index=0)
    assert [*map(float, machine.get_attribute("viewBox").split())] == pytest.approx(
        [*map(float, whole.split())], abs=0.1
    )
    page.locator("#traces").press("Space")
    # pin and middle of the rod of every cylinder
    assert machine.locator(".traces:not([hidden]) path").count() == 16
    assert page.evaluate("document.documentElement.scrollWidth") <= 360


def test_the_speed_of_the_motion_is_that_which_was_chosen(opened) -> None:
    page = opened("spark-engine", reduced_motion="reduce")
    page.locator(".controls summary").click()
    gone = """rate => new Promise((done) => {
      const [choice, play] = ["rate", "play"].map((id) => document.getElementById(id));
      const slider = document.getElementById("slider");
      choice.value = rate;
      choice.dispatchEvent(new Event("change"));
      slider.value = 0;
      slider.dispatchEvent(new Event("input"));
      play.click();
      setTimeout(() => { play.click(); done(Number(slider.value)); }, 1000);
    })"""
    assert page.evaluate(gone, "0.1") < 0.4 * page.evaluate(gone, "1")


def test_motion_that_is_not_wanted_waits_for_the_button(opened) -> None:
    page = opened("press-geometry", reduced_motion="reduce")
    assert page.locator("#play").get_attribute("aria-pressed") == "false"
    page.locator("#play").click()
    assert page.locator("#play").get_attribute("aria-pressed") == "true"


def test_a_value_is_explained_down_to_what_the_file_gives(opened) -> None:
    page = opened("spark-engine")
    results = crankwork.analyse(crankwork.read(EXAMPLES / "spark-engine.toml"))
    page.locator('[data-key="piston_area"]').click()
    room = page.locator("#explanation")
    assert f"{results['piston_area'] * 1e4:.4g}"[:4] in room.inner_text()
    assert room.locator("math").count() >= 1
    room.locator("summary").first.click()
    page.wait_for_function("() => document.querySelector('#explanation details[open]').childElementCount > 1")
    assert "cylinder.bore" in room.inner_text()
    page.keyboard.press("Escape")
    assert room.is_hidden()
    assert page.evaluate("document.activeElement.dataset.key") == "piston_area"


def test_a_row_of_the_table_moves_the_cursor_and_explains(opened) -> None:
    page = opened("spark-engine")
    row = page.locator("#tables tbody tr").nth(7)
    cells = row.locator("td")
    angle, value = cells.nth(0).inner_text(), cells.nth(2).inner_text()
    cells.nth(2).click()
    assert "here" in (row.get_attribute("class") or "")
    assert angle in page.locator("#shown").inner_text()
    assert value.lstrip("−")[:4] in page.locator("#explanation .equation").first.inner_text()


def test_keys_go_to_every_cell_of_a_table_and_explain_its_value(opened) -> None:
    page = opened("spark-engine", reduced_motion="reduce")
    place = "[document.activeElement.cellIndex, document.activeElement.parentElement.sectionRowIndex]"
    cells = page.locator("#tables td[tabindex]")
    cells.focus()
    (column, row), before = page.evaluate(place), page.locator("#shown").inner_text()
    for key in ("ArrowDown", "ArrowDown", "ArrowRight", "ArrowRight"):
        page.keyboard.press(key)
    assert cells.count() == 1
    assert page.locator("#shown").inner_text() == before
    assert page.evaluate(place) == [column + 2, row + 2]
    value = page.evaluate("document.activeElement.textContent")
    page.keyboard.press("Enter")
    assert value.lstrip("−")[:4] in page.locator("#explanation .equation").first.inner_text()
    assert "here" in (page.locator("#tables tbody tr").nth(row + 2).get_attribute("class") or "")


def test_a_curve_is_hidden_by_its_row_of_the_legend(opened) -> None:
    page = opened("v8-diesel")
    figure = page.locator("[data-figure=piston_forces]")
    row = figure.locator("[role=button]").first
    before = figure.locator("path.off").count()
    row.press("Enter")
    assert (before, figure.locator("path.off").count()) == (0, 1)
    assert row.get_attribute("aria-pressed") == "false"
    row.press("Enter")
    assert figure.locator("path.off").count() == 0


def test_a_diagram_is_looked_at_from_near_and_back(opened) -> None:
    figure = opened("press").locator("svg.drawing").first
    home = figure.get_attribute("viewBox")
    figure.focus()
    figure.press("+")
    assert figure.get_attribute("viewBox") != home
    figure.press("0")
    assert [float(one) for one in figure.get_attribute("viewBox").split()] == [float(one) for one in home.split()]


@pytest.mark.parametrize("name", [*EVERY, "note-v8-diesel", "note-press"])
def test_a_phone_shows_the_page_without_scrolling_sideways(opened, name) -> None:
    page = opened(name, "ru", viewport={"width": 360, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 360


def test_dark_ground_is_that_of_the_reader_and_of_the_button(opened) -> None:
    page = opened("press", color_scheme="dark")
    ground = "getComputedStyle(document.body).backgroundColor"
    dark = page.evaluate(ground)
    page.locator("#look").click()
    light = page.evaluate(ground)
    assert light == "rgb(255, 255, 255)" != dark


def test_a_printed_page_has_two_diagrams_on_a_sheet_and_no_cursor(opened) -> None:
    page = opened("v8-diesel", viewport={"width": 718, "height": 1000}, reduced_motion="reduce")
    page.locator("[data-key]").first.click()
    page.emulate_media(media="print")
    assert (
        page.locator(".cursor:visible, .reading:visible, .controls:visible, .bar:visible, #explanation:visible").count()
        == 0
    )
    tall = page.locator(".figures figure").evaluate_all("all => all.map(one => one.getBoundingClientRect().height)")
    # half of what a sheet has within its margins
    assert max(tall) < 130 * 96 / 25.4
    assert page.evaluate("document.documentElement.scrollWidth") <= 718


def test_without_script_diagrams_and_values_are_there(opened) -> None:
    page = opened("v8-diesel", java_script_enabled=False)
    assert page.locator("svg.drawing").count() > 20
    assert page.locator("#values table").first.is_visible()
    assert page.locator(".without").is_visible()
    assert page.locator(".bar").is_hidden()


def test_the_web_page_of_a_note_is_read_with_the_cursor_and_without_script(opened, pages) -> None:
    assert len(pages("note-v8-diesel").read_bytes()) < 1_200_000
    page = opened("note-v8-diesel", viewport={"width": 1300, "height": 900})
    page.keyboard.press("Home")
    figure = page.locator("[data-figure=piston_forces]")
    figure.scroll_into_view_if_needed()
    over(figure, 0.55)
    angle, force, *_ = page.locator("figure:has([data-figure=piston_forces]) .reading span").all_inner_texts()
    row = page.locator(
        "div.table tbody tr", has=page.locator("td:first-child", has_text=re.compile(rf"^{printed(angle):g}$"))
    )
    assert any(force.split("=")[1].split("\u00a0")[0].strip() in one for one in row.all_inner_texts())
    assert printed(angle) % 10 == 0
    assert page.locator("[data-figure=machine]").count() == 1
    still = opened("note-v8-diesel", java_script_enabled=False)
    assert still.locator(".bar").is_hidden()
    assert still.locator("svg.drawing").count() > 20
    assert still.locator("table").count() > 10


@pytest.mark.parametrize("name", ["v8-diesel", "knuckle-press"])
def test_explanations_begin_with_the_number_that_is_explained(opened, name) -> None:
    page = opened(name, reduced_motion="reduce")
    room, first = page.locator("#explanation"), page.locator("#explanation .equation").first
    for button in page.locator("#values [data-key]").all()[::6]:
        button.evaluate("one => one.click()")
        assert first.inner_text().rsplit("=", 1)[1].strip().startswith(button.inner_text())
        page.evaluate("document.querySelectorAll('#explanation details').forEach((one) => (one.open = true))")
        assert not re.search("undefined|NaN|…", room.inner_text())
    rows = page.locator("#tables tbody tr")
    for at in range(0, rows.count(), 9):
        cell = rows.nth(at).locator("td").nth(1 + at % 4)
        cell.evaluate("one => one.click()")
        assert first.inner_text().rsplit("=", 1)[1].strip().split("\u00a0")[0].rstrip("°") == cell.inner_text()


def test_keys_reach_what_is_wider_than_a_phone(opened) -> None:
    page = opened("note-press", viewport={"width": 360, "height": 800})
    wide = "[...document.querySelectorAll('div.table, .lines')].filter((one) => one.scrollWidth > one.clientWidth)"
    assert page.evaluate(f"{wide}.length") > 0
    assert page.evaluate(f"{wide}.every((one) => one.tabIndex === 0)")


@pytest.mark.parametrize("width", [1280, 360])
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", ["spark-engine", "press", "note-spark-engine", "note-press"])
def test_the_page_keeps_the_rules_of_pages_that_everybody_can_read(opened, name, scheme, width) -> None:
    if not AXE.exists():
        pytest.skip("axe-core is not installed")
    page = opened(name, color_scheme=scheme, viewport={"width": width, "height": 800})
    for one in page.locator(".controls summary").all():
        one.click()
    if not name.startswith("note"):
        page.locator("[data-key]").first.click()
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found = page.evaluate("axe.run().then((found) => found.violations.map((one) => [one.id, one.nodes[0].html]))")
    assert found == []


def test_an_extreme_is_followed_at_its_own_angle_and_time(opened) -> None:
    page = opened("spark-engine")
    results = crankwork.analyse(crankwork.read(EXAMPLES / "spark-engine.toml"))
    page.locator('[data-key="piston_velocity_max"]').click()
    item = page.locator("#explanation summary").first
    item.click()
    text = page.locator("#explanation").inner_text()
    assert f"{results['piston_velocity_max']:.3f}" in item.inner_text()
    assert f"({math.degrees(results['piston_velocity_max_angle']):.2f}°)" in text
    page = opened("excavator-boom")
    page.locator('[data-key="link_angle_max_time.boom"]').click()
    assert "(4\u00a0s)" in page.locator("#explanation").inner_text().replace("(4 s)", "(4\u00a0s)")

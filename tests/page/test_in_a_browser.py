"""The page as a reader uses it: pointer, keys, phone, dark ground, without script, by ear."""

from __future__ import annotations

import csv
import io
import math
import re
from functools import cache

import pytest

import crankwork
from crankwork.report.display import displayed
from crankwork.report.tables import csv_of_sheet, sheets
from page.slid import EXAMPLES, rules_broken, shown

# a row of the tables that is looked at
ROW = 3
DOTS = """one => [...one.querySelectorAll(".cursor circle:not([hidden])")].map(
  (dot) => [dot.getAttribute("cx"), dot.getAttribute("cy")])"""
CURVES = "one => [...one.querySelectorAll('path[data-curve]')].map((path) => path.dataset.curve)"
PHONE = {"width": 360, "height": 800}
ACROSS = "document.documentElement.scrollWidth"


@cache
def results_of(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))


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
    page = opened("v8-diesel")
    rows = list(csv.reader(io.StringIO(csv_of_sheet(sheets(results_of("v8-diesel"))["forces"]).decode())))
    heads = [one.partition(" [")[0] for one in rows[0]]
    figure = shown(page, "piston_forces").locator("svg")
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


def test_a_dot_stands_on_its_curve_where_the_table_says(opened, written_of, stored) -> None:
    compared = {}
    for name in ("v8-diesel", "press", "excavator-boom", "knuckle-press"):
        page, columns = opened(name), results_of(name).columns
        page.keyboard.press("Home")
        for _ in range(ROW):
            page.keyboard.press("ArrowRight")
        figures, compared[name] = stored(written_of(name))["figures"], 0
        for figure in page.locator("svg.drawing:not([data-figure=machine])").all():
            dots = [tuple(map(float, one)) for one in figure.evaluate(DOTS)]
            lines = {key for key in figure.evaluate(CURVES) if key in columns}
            for plot in figures[figure.get_attribute("data-figure")]["plots"]:
                left, top, width, height = plot["box"]
                inside = [one for one in dots if left <= one[0] <= left + width and top <= one[1] <= top + height]
                if not plot["over"] or not inside:
                    continue
                said = [plot["y"][1] - (y - top) / height * (plot["y"][1] - plot["y"][0]) for _, y in inside]
                slack = 0.06 / height * abs(plot["y"][1] - plot["y"][0])
                for key in lines:
                    value = displayed(key, columns[key][ROW])
                    # a diagram may show kN where the table has N
                    compared[name] += any(abs(one - value * unit) < slack for one in said for unit in (1.0, 1e-3))
    assert compared == {"v8-diesel": 14, "press": 5, "excavator-boom": 17, "knuckle-press": 35}


def test_the_dot_of_the_indicator_diagram_stands_at_the_volume_of_its_angle(opened, written_of, stored) -> None:
    """Along straight strokes the volume does not grow as the angle does."""
    page = opened("v8-diesel")
    (plot, *_) = stored(written_of("v8-diesel"))["figures"]["indicator"]["plots"]
    (left, _, width, _), (low, high) = plot["box"], plot["x"]
    for volume in results_of("v8-diesel")["cylinder_volume"]:
        dots = page.locator("svg[data-figure=indicator]").evaluate(DOTS)
        said = [low + (float(x) - left) / width * (high - low) for x, _ in dots]
        assert min(abs(one - displayed("cylinder_volume", volume)) for one in said) < 0.3 / width * (high - low)
        page.keyboard.press("ArrowRight")


def test_keys_move_the_cursor_and_the_machine_runs_where_that_is_wanted_and_stops(opened) -> None:
    page = opened("press")
    shown, play = page.locator("#shown"), page.locator("#play")
    assert play.get_attribute("aria-pressed") == "false"
    first = shown.inner_text()
    page.keyboard.press("ArrowRight")
    assert shown.inner_text() != first
    page.keyboard.press("ArrowLeft")
    assert shown.inner_text() == first
    play.press("Enter")
    page.wait_for_function("before => document.getElementById('shown').innerText !== before", arg=first)
    assert play.get_attribute("aria-pressed") == "true"
    play.press("Enter")
    assert play.get_attribute("aria-pressed") == "false"


def test_the_machine_stands_where_the_cursor_is(opened) -> None:
    page, results = opened("v8-diesel"), results_of("v8-diesel")
    down = """(() => {
      const m = document.querySelector('[data-part="side.piston.1"]').transform.baseVal[0].matrix;
      return [m.e, m.f];
    })()"""
    before = page.evaluate(down)
    for _ in range(ROW):
        page.keyboard.press("ArrowRight")
    moved = math.dist(before, page.evaluate(down))
    assert 0 < moved < page.evaluate("document.querySelector('[data-figure=machine]').viewBox.baseVal.width")
    for _ in range(18 - ROW):
        page.keyboard.press("ArrowRight")
    share = results["piston_displacement"][ROW] / results["stroke"]
    assert moved / math.dist(before, page.evaluate(down)) == pytest.approx(share, abs=2e-3)


def test_forces_views_and_paths_are_chosen_by_keys_of_a_phone(opened) -> None:
    page = opened("v8-diesel", "ru", viewport=PHONE)
    arrow = page.locator('[data-part="force.side_force.1.shaft"]')
    assert arrow.evaluate("one => getComputedStyle(one).visibility") == "hidden"
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
    assert page.evaluate(ACROSS) <= 360


def test_the_speed_of_the_motion_is_that_which_was_chosen(opened) -> None:
    page = opened("knuckle-press", viewport=PHONE)
    page.clock.install(time=0)
    page.clock.pause_at(1000)
    # the same way in as long a time as it is slow
    places = []
    for rate in ("1", "0.1"):
        page.locator("#rate").select_option(rate)
        page.locator("#slider").evaluate("one => { one.value = 0; one.dispatchEvent(new Event('input')); }")
        page.locator("#play").press("Enter")
        page.clock.run_for(round(1000 / float(rate)))
        places.append(page.locator("#slider").input_value())
        page.locator("#play").press("Enter")
    assert places == ["9", "9"]


def test_a_value_is_explained_down_to_what_the_file_gives(opened) -> None:
    page = opened("spark-engine")
    shown(page, "values").locator('[data-key="piston_area"]').click()
    room = page.locator("#explanation")
    assert f"{results_of('spark-engine')['piston_area'] * 1e4:.4g}"[:4] in room.inner_text()
    assert room.locator("math").count() >= 1
    room.locator("summary").first.click()
    page.wait_for_function("() => document.querySelector('#explanation details[open]').childElementCount > 1")
    assert "cylinder.bore" in room.inner_text()
    page.keyboard.press("Escape")
    assert room.is_hidden()
    assert page.evaluate("document.activeElement.dataset.key") == "piston_area"


def test_a_row_of_the_table_moves_the_cursor_and_explains_by_pointer_and_by_keys(opened) -> None:
    page = opened("spark-engine")
    row = shown(page, "tables").locator("tbody tr").nth(7)
    cells, explained = row.locator("td"), page.locator("#explanation .equation").first
    angle, value = cells.nth(0).inner_text(), cells.nth(2).inner_text()
    cells.nth(2).click()
    assert "here" in (row.get_attribute("class") or "")
    assert angle in page.locator("#shown").inner_text()
    assert value.lstrip("−")[:4] in explained.inner_text()
    page.keyboard.press("Escape")
    place = "[document.activeElement.cellIndex, document.activeElement.parentElement.sectionRowIndex]"
    stop = page.locator("#tables td[tabindex]")
    assert stop.count() == 1
    stop.focus()
    (column, first), before = page.evaluate(place), page.locator("#shown").inner_text()
    for key in ("ArrowDown", "ArrowDown", "ArrowRight", "ArrowRight"):
        page.keyboard.press(key)
    assert stop.count() == 1
    assert page.locator("#shown").inner_text() == before
    assert page.evaluate(place) == [column + 2, first + 2]
    value = page.evaluate("document.activeElement.textContent")
    page.keyboard.press("Enter")
    assert value.lstrip("−")[:4] in explained.inner_text()
    assert "here" in (page.locator("#tables tbody tr").nth(first + 2).get_attribute("class") or "")


def test_a_curve_is_hidden_by_its_row_of_the_legend_and_a_diagram_looked_at_from_near(opened) -> None:
    figure = shown(opened("v8-diesel"), "piston_forces").locator("svg")
    row = figure.locator("[role=button]").first
    counts = [figure.locator("path.off").count()]
    for pressed in ("false", "true"):
        row.press("Enter")
        assert row.get_attribute("aria-pressed") == pressed
        counts.append(figure.locator("path.off").count())
    assert counts == [0, 1, 0]
    home = [float(one) for one in figure.get_attribute("viewBox").split()]
    figure.press("+")
    near = [float(one) for one in figure.get_attribute("viewBox").split()]
    assert near[2] < home[2]
    figure.press("0")
    assert [float(one) for one in figure.get_attribute("viewBox").split()] == home


def test_dark_ground_is_that_of_the_reader_and_of_the_button(opened) -> None:
    page = opened("press", color_scheme="dark")
    ground = "getComputedStyle(document.querySelector('.cards div')).backgroundColor"
    dark = page.evaluate(ground)
    page.locator("#look").click()
    assert page.evaluate(ground) == "rgb(255, 255, 255)" != dark


def test_a_printed_page_has_two_diagrams_on_a_sheet_and_no_cursor(opened) -> None:
    page = opened("v8-diesel")
    page.set_viewport_size({"width": 718, "height": 1000})
    page.locator("[data-key]").first.click()
    page.emulate_media(media="print")
    for one in (".cursor", ".reading", ".controls", ".bar", "#explanation"):
        assert page.locator(f"{one}:visible").count() == 0, one
    tall = page.locator(".figures figure").evaluate_all("all => all.map(one => one.getBoundingClientRect().height)")
    # half of what a sheet has within its margins
    assert max(tall) < 130 * 96 / 25.4
    assert page.evaluate(ACROSS) <= 718


def test_without_script_diagrams_and_values_are_there(opened) -> None:
    page = opened("v8-diesel", java_script_enabled=False)
    assert page.locator("#values table").first.is_visible()
    assert page.locator(".without").is_visible()
    still = opened("note-v8-diesel", java_script_enabled=False)
    assert still.locator("table").count() > 10
    for one in (page, still):
        assert one.locator("svg.drawing").count() > 20
        assert one.locator(".bar").is_hidden()


def test_the_web_page_of_a_note_is_read_with_the_cursor(opened, written_of) -> None:
    assert len(written_of("note-v8-diesel")) < 1_200_000
    page = opened("note-v8-diesel")
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


# what is pressed, and the number that the first equation then ends with, each beside that which was pressed
EXPLAINED = """all => all.map((one) => {
  one.click();
  document.querySelectorAll("#explanation details").forEach((each) => (each.open = true));
  const texts = ["#explanation", "#explanation .equation"].map((each) => document.querySelector(each).innerText);
  return [one.innerText, texts[1].split("=").pop().trim(), (texts[0].match(/undefined|NaN|…/) ?? [""])[0]];
})"""


@pytest.mark.parametrize("name", ["v8-diesel", "knuckle-press"])
def test_explanations_begin_with_the_number_that_is_explained(opened, name) -> None:
    page = opened(name)
    values = page.locator("#values [data-key]").evaluate_all(EXPLAINED)
    cells = page.locator("#tables tbody tr:nth-child(18n + 1) td:not(:first-child)").evaluate_all(EXPLAINED)
    assert min(len(values), len(cells)) > 10
    assert [one for one in values if not one[1].startswith(one[0]) or one[2]] == []
    assert [one for one in cells if one[1].split("\u00a0")[0].rstrip("°") != one[0] or one[2]] == []


def test_phones_show_pages_without_scrolling_sideways_and_everybody_can_read_them(opened) -> None:
    """As long words and as dark a ground as there are, and keys for what is wider."""
    found = {}
    for name in ("spark-engine", "press", "note-press", "note-spark-engine", "v8-diesel", "excavator-boom"):
        page = opened(name, "ru", viewport=PHONE)
        found[name, "width"] = page.evaluate(ACROSS)
        if name in ("v8-diesel", "excavator-boom"):
            continue
        page.emulate_media(color_scheme="dark")
        if not name.startswith("note"):
            shown(page, "values").locator("[data-key]").first.click()
        found[name, "rules"] = rules_broken(page)
        if name in ("spark-engine", "note-spark-engine"):
            page.emulate_media(color_scheme="light")
            page.set_viewport_size({"width": 1280, "height": 800})
            found[name, "wide"] = rules_broken(page)
    page = opened("note-press", "ru", viewport=PHONE)
    wide = "[...document.querySelectorAll('div.table, .lines')].filter((one) => one.scrollWidth > one.clientWidth)"
    assert page.evaluate(f"{wide}.length") > 0
    assert page.evaluate(f"{wide}.every((one) => one.tabIndex === 0)")
    assert {mark: one for mark, one in found.items() if one not in (360, [])} == {}


def test_an_extreme_is_followed_at_its_own_angle_and_time(opened) -> None:
    page, results = opened("spark-engine"), results_of("spark-engine")
    shown(page, "values").locator('[data-key="piston_velocity_max"]').click()
    item = page.locator("#explanation summary").first
    item.click()
    assert f"{results['piston_velocity_max']:.3f}" in item.inner_text()
    angle = math.degrees(results["piston_velocity_max_angle"])
    assert f"({angle:.2f}°)" in page.locator("#explanation").inner_text()
    page = opened("excavator-boom")
    shown(page, "values").locator('[data-key="link_angle_max_time.boom"]').click()
    assert "(4\u00a0s)" in page.locator("#explanation").inner_text().replace("(4 s)", "(4\u00a0s)")


def test_plans_are_those_of_the_angle_and_stand_still_in_their_place(opened) -> None:
    page, results = opened("press-geometry"), results_of("press-geometry")
    plan = page.locator("svg[data-figure=velocity_plan]")
    paper, told = plan.get_attribute("viewBox"), []
    for row, degrees in enumerate(results.grid.degrees):
        speed = float(results["point_velocity.B"][row])
        at_rest = speed < 1e-5 * float(results["point_velocity.A"][row])
        told.append(f"φ = {degrees:g}°" in plan.text_content())
        told.append(f"vB = {0 if at_rest else float(f'{speed:.4g}'):g} m/s" in plan.text_content())
        page.keyboard.press("ArrowRight")
    assert (told, plan.get_attribute("viewBox")) == ([True] * 2 * len(results.grid.degrees), paper)


SEEN = """svg => {
  const box = svg.viewBox.baseVal, room = svg.getScreenCTM();
  const seen = '[data-part]:not([data-part^="force."]:not(.on))', parts = [...svg.querySelectorAll(seen)];
  const rooms = parts.map((one) => one.getBoundingClientRect()).filter((one) => one.bottom > one.top);
  const down = rooms.flatMap((one) => [one.top, one.bottom]).map((y) => (y - room.f) / room.d);
  const across = rooms.flatMap((one) => [one.left, one.right]).map((x) => (x - room.e) / room.a);
  const [top, bottom, left, right] = [Math.min(...down), Math.max(...down), Math.min(...across), Math.max(...across)];
  const isInside = top >= box.y && bottom <= box.y + box.height && left >= box.x && right <= box.x + box.width;
  return [(bottom - top) / box.height, isInside];
}"""


def test_a_machine_fills_its_drawing_and_forces_have_room_where_they_are_seen(opened) -> None:
    page = opened("spark-engine")
    machine, boxes = page.locator("svg[data-figure=machine]"), page.locator("[data-choice]").all()
    share, inside = machine.evaluate(SEEN)
    assert share > 0.65
    assert inside
    for box in boxes:
        box.check()
    for _ in range(6):
        for _ in range(15):
            page.keyboard.press("ArrowRight")
        assert machine.evaluate(SEEN)[1]
    for box in boxes:
        box.uncheck()
    assert machine.evaluate(SEEN)[0] == pytest.approx(share, abs=0.15)

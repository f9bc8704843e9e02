"""Change points and limits of a machine as a person drags it."""

from __future__ import annotations

import itertools
import math

import pytest

from studio.hands import beside, carried, middle, settled, source, sourced, undone

FOUR_BAR = """format = 2
[fixed_points]
O = ["0 mm", "0 mm"]
C = ["{frame} mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "{crank} mm"
speed = "60 rpm"
start = "90 deg"
[links]
coupler = {{ joins = ["A", "B"], length = "{coupler} mm", points = {{ P = ["{along} mm", "{across} mm"] }} }}
rocker = {{ joins = ["C", "B"], length = "{rocker} mm" }}
"""
IN_LINE = """format = 2
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "30 mm"
speed = "60 rpm"
[links]
rod = { joins = ["A", "B"], length = "30 mm" }
[guides]
g = { through = "O" }
[sliders]
B = { guide = "g", pin = "B" }
"""


def four_bar(crank, coupler, rocker, frame, along=0.0, across=20.0):
    lengths = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame}
    return FOUR_BAR.format(**lengths, along=along, across=across)


def opened(page, text):
    """Write a machine, and wait until it stands there instead of the other one."""
    page.locator("#text-tab").click()
    before = page.locator("#results").inner_html()
    page.locator("#source").fill(text)
    page.wait_for_function(
        "before => document.getElementById('results').innerHTML !== before && !document.body.matches('.stale')",
        arg=before,
    )
    settled(page)


def turned_by(page, part, pivot, degrees, step=4.0):
    """Drag a joint about another one, the pointer ahead of it by steps."""
    (x, y), (u, v) = middle(page, part), middle(page, pivot)
    radius, start = math.hypot(x - u, y - v), math.atan2(v - y, x - u)
    turns = [start + math.copysign(math.radians(k * step), degrees) for k in range(1, round(abs(degrees) / step) + 1)]
    ways = [(u + radius * math.cos(one), v - radius * math.sin(one)) for one in turns]
    carried(page, x, y, *ways, steps=1, up=False)


def test_a_parallelogram_stays_one_through_its_change_points_and_b_makes_it_the_other(seen):
    page = seen()
    opened(page, four_bar(50, 120, 50, 120))
    turned_by(page, "A", "O", 84)
    said = beside(page)
    assert said.startswith("change point at 90.0°: coupler, rocker go straight on at B; B puts them together")
    assert page.locator("#film .limits .ghost").count() == 2
    page.mouse.up()
    turned_by(page, "A", "O", 60)
    page.mouse.up()
    (ax, ay), (bx, by) = middle(page, "A"), middle(page, "B")
    assert (ay, bx - ax) == pytest.approx((by, middle(page, "C")[0] - middle(page, "O")[0]), abs=2.0)
    text = source(page)
    page.keyboard.press("b")
    sourced(page, "B = -1")
    assert page.locator("#undo").get_attribute("title") == "B the other way"
    assert abs(middle(page, "B")[1] - middle(page, "A")[1]) > 20
    crossed = source(page)
    page.reload()
    page.wait_for_selector(".figures svg")
    settled(page)
    assert source(page) == crossed
    undone(page)
    assert source(page) == text


def test_an_in_line_slider_crank_shows_both_ways_on_where_its_pin_passes_the_shaft(seen):
    page = seen()
    opened(page, IN_LINE)
    turned_by(page, "A", "O", 84)
    assert beside(page).startswith("change point at 90.0°: rod go")
    assert page.locator("#film .limits .ghost").count() == 2
    page.mouse.up()
    page.keyboard.press("b")
    sourced(page, "B = -1")


def test_where_a_path_crosses_itself_the_machine_goes_straight_on(seen):
    page = seen()
    # the path of P is an eight
    opened(page, four_bar(30, 100, 60, 100, 50, 0))
    angles = []
    track = page.evaluate("""() => {
      const part = document.querySelector('#film [data-part="joint.P"]');
      const slider = document.getElementById('slider');
      const found = [];
      for (let k = 0; k <= 360; k += 2) {
        slider.value = String(k / 360 * Number(slider.max));
        slider.dispatchEvent(new Event('input'));
        const box = part.getBoundingClientRect();
        found.push([box.x + box.width / 2, box.y + box.height / 2]);
      }
      slider.value = '0';
      slider.dispatchEvent(new Event('input'));
      return found;
    }""")
    page.mouse.move(*track[0])
    page.mouse.down()
    for one in track:
        page.mouse.move(*one)
        angles.append(float(page.locator("#slider").input_value()))
    page.mouse.up()
    top = max(angles)
    steps = [(after - before + top / 2) % top - top / 2 for before, after in itertools.pairwise(angles)]
    assert max(map(abs, steps)) < 0.05 * top


def test_a_crank_that_swings_says_what_a_full_turn_needs_and_takes_it_by_one_click(seen):
    page = seen()
    assert page.locator("#turn").is_hidden()
    opened(page, four_bar(30, 60, 40, 90))
    text = source(page)
    assert page.locator("#turn").inner_text().endswith("a full turn needs coupler ≥ 80.1 mm. Use 80.1 mm")
    page.locator("#turn button").click()
    settled(page)
    assert source(page) == text.replace('"60 mm", points', '"80.1 mm", points')
    assert page.locator("#turn").is_hidden()
    undone(page)
    assert source(page) == text

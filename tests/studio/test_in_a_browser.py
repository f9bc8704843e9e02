"""The studio as a person uses it: with mouse and keys, in a real browser."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from page.slid import rules_broken
from studio import hands as do

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_a_typed_number_changes_text_values_and_drawing_as_one_step(seen):
    page = seen()
    before, drawn = do.number(page, "transmission_angle_min.B"), page.locator("#film").inner_html()
    do.typed(page, "links.rocker.length", "120 mm")
    assert 'length = "120 mm"' in do.source(page)
    assert do.number(page, "transmission_angle_min.B") != before
    assert page.locator("#film").inner_html() != drawn
    assert page.locator("#undo").get_attribute("title") == "links.rocker.length = 120 mm"
    page.keyboard.press("Escape")
    page.locator("#title").click()
    page.keyboard.press("Control+z")
    do.settled(page)
    assert 'length = "112.5 mm"' in do.source(page)
    assert do.number(page, "transmission_angle_min.B") == before
    assert do.value(page, "links.rocker.length") == "112.5 mm"
    page.keyboard.press("Control+Shift+z")
    do.settled(page)
    assert 'length = "120 mm"' in do.source(page)


# how long the thin lines of plans are together, and how far they reach [mm]
LINES = """one => {
  const [lines, boxes] = [[...one.querySelectorAll('path[stroke="var(--g11)"]')], []];
  for (const each of lines) boxes.push(each.getBBox());
  const ends = (start, size) => boxes.flatMap((box) => [box[start], box[start] + box[size]]);
  const reach = (...of) => Math.max(...ends(...of)) - Math.min(...ends(...of));
  return [lines.reduce((sum, each) => sum + each.getTotalLength(), 0), reach("x", "width"), reach("y", "height")];
}"""
RESULTS = "all => all.map((one) => [one.dataset.key, one.textContent])"


def test_what_follows_a_slider_is_drawn_without_asking_and_is_what_the_server_answers(seen):
    page = seen()
    plan = page.locator('[data-name="position_plans"]')
    do.with_figure(page, "position_plans")
    keys = page.locator("#results [data-key]")
    do.prepared(page, "crank.radius")
    before, stated = keys.evaluate_all(RESULTS), plan.evaluate(LINES)
    curve = page.locator('.figures path[data-curve="link_angular_velocity.coupler"]')
    joint = page.locator('#film [data-part="joint.A"]')
    drawn, stood = curve.get_attribute("d"), joint.get_attribute("transform")
    assert do.hold(page, "crank.radius", 60) == "false"
    assert curve.get_attribute("d") != drawn
    assert joint.get_attribute("transform") != stood
    plans, held = plan.evaluate(LINES), keys.evaluate_all(RESULTS)
    assert sum(one != other for one, other in zip(held, before, strict=True)) > 20
    faint = dict(page.locator("#results .filed [data-key]").evaluate_all(RESULTS))
    do.let_go(page, "crank.radius")
    assert '"60 mm"' in do.source(page)
    answered = dict(keys.evaluate_all(RESULTS))
    assert len(faint) < 10
    assert [key for key, text in held if answered[key] != text and key not in faint and "_angle" not in key] == []
    assert page.locator("html.moved").count() == 0
    assert page.locator("#undo").get_attribute("title") == "crank.radius = 60 mm"
    # its paper is another, its lines are as long
    assert plan.evaluate(LINES) == pytest.approx(plans, abs=0.3)
    assert plans != pytest.approx(stated, abs=1)
    # and a slider that leads to no machine is told why
    do.prepared(page, "links.rocker.length")
    do.hold(page, "links.rocker.length", 57)
    do.settled(page)
    assert page.locator("#refusals li, .doubt").count() > 0


def test_what_is_refused_stands_at_its_line_and_the_last_machine_stays(seen):
    page = seen()
    drawn = page.locator("#film svg").count()
    do.typed(page, "crank.radius", "-3 mm")
    assert do.field(page, "crank.radius").get_attribute("aria-invalid") == "true"
    assert do.field(page, "crank.radius").input_value() == "-3 mm"
    assert page.locator("body.stale").count() == 1
    assert page.locator("#film svg").count() == drawn
    (told,) = do.refused(page)
    assert "crank.radius" in told
    line = int(re.search(r":(\d+):", told)[1])
    assert '"-3 mm"' in do.source(page).splitlines()[line - 1]
    page.locator("#refusals button").click()
    assert page.evaluate("document.activeElement.id") == "source"
    assert page.locator("#lines .refused").inner_text().strip() == str(line)
    page.locator("#source").fill(do.source(page).replace('"-3 mm"', '"60 mm"'))
    page.wait_for_selector("body:not(.stale)")
    assert do.refused(page) == []


def test_text_is_typed_and_the_form_follows(seen):
    page = seen()
    page.locator("#text-tab").click()
    page.locator("#source").fill(do.source(page).replace('"100 rpm"', '"100 rp"'))
    page.wait_for_selector("body.stale")
    page.locator("#source").fill(do.source(page).replace('"100 rp"', '"250 rpm"'))
    page.wait_for_selector("body:not(.stale)")
    page.locator("#form-tab").click()
    assert do.value(page, "crank.speed") == "250 rpm"
    page.locator("#text-tab").click()
    page.locator("#source").press("Control+End")
    shown = page.locator("#shown").inner_text()
    page.keyboard.type("# two words")
    page.keyboard.press("ArrowLeft")
    page.keyboard.type("k")
    assert do.source(page).endswith("# two wordks")
    assert page.locator("#shown").inner_text() == shown


def test_the_machine_is_dragged_along_its_freedom_and_a_length_with_shift(seen):
    page = seen()
    text, shown = do.source(page), page.locator("#shown").inner_text()
    x, y = do.middle(page, "A")
    do.carried(page, x, y, (x, y - 30))
    assert page.locator("#shown").inner_text() != shown
    assert do.source(page) == text
    angle = page.locator("#slider").input_value()
    x, y = do.middle(page, "B")
    page.keyboard.down("Shift")
    do.carried(page, x, y, (x + 12, y - 6), up=False)
    assert "→" in do.beside(page)
    page.wait_for_function("() => globalThis.steps")
    page.mouse.move(x - 20, y + 20)
    assert "transmission angle at B" in do.beside(page)
    page.mouse.move(x + 12, y - 6)
    page.mouse.up()
    page.keyboard.up("Shift")
    do.settled(page)
    assert do.source(page) != text
    assert page.locator("#slider").input_value() == angle
    assert "length" in page.locator("#undo").get_attribute("title")
    assert page.locator("#chip").is_hidden()


def test_a_drag_past_a_dead_position_says_why_it_stays_and_the_cursor_goes_to_where_it_turns_back(seen):
    page = seen()
    do.typed(page, "crank.radius", "100 mm")
    slider, shown, joint = page.locator("#slider"), page.locator("#shown"), page.locator('#film [data-part="joint.B"]')
    slider.press("End")
    assert shown.inner_text() == "φ = 144.7°"
    assert slider.get_attribute("aria-valuetext") == "144.7°"
    bar = joint.get_attribute("transform")
    page.keyboard.press("ArrowLeft")
    assert shown.inner_text() == "φ = 140°"
    assert joint.get_attribute("transform") != bar
    page.locator("#title").click()
    page.keyboard.press("Home")
    assert shown.inner_text() == "φ = −144.7°"
    page.locator('.figures svg[data-figure="links"]').focus()
    assert "φ = −144.7°" in page.locator(".reading:visible").inner_text()
    page.keyboard.press("ArrowRight")
    assert shown.inner_text() == "φ = −140°"
    pivot = page.locator('#film [data-part="joint.O"]').bounding_box()
    # to where the crank does not come
    ways = [(pivot["x"] - 150 - one % 2, pivot["y"] + 10) for one in range(80)]
    do.carried(page, *do.middle(page, "A"), *ways, steps=1, up=False)
    said = do.beside(page)
    assert "turns back at" in said
    assert said.endswith("in line at B")
    assert "coupler, rocker" in said
    assert page.locator("#film .leash").count() == 1
    assert page.locator("#film .limits .ghost").count() == 1
    page.mouse.up()
    assert page.locator("#film .limits").count() == 0
    assert page.locator("#chip").is_hidden()


def test_diagrams_are_chosen_pinned_and_compared(seen):
    page = seen()
    shown = page.locator(".figures figure").count()
    do.with_figure(page, "velocity_plan")
    assert page.locator(".figures figure").count() == shown + 1
    page.locator('.figures [data-name="velocity_plan"] .gone').click()
    do.settled(page)
    assert page.locator(".figures figure").count() == shown
    page.locator("#pin").click()
    do.typed(page, "crank.speed", "120 rpm")
    assert page.locator(".figures path.ghost-1").count() > 0
    assert page.locator(".figures .ghost-number").first.text_content() == "1"
    page.locator("#pins .pin-1").hover()
    assert page.locator("#pins .pin-1").get_attribute("title") == "crank.speed: 100 rpm"
    assert page.locator("#results ins", has_text="+20 %").count() > 0
    page.locator("#pins button").first.click()
    do.settled(page)
    assert do.value(page, "crank.speed") == "100 rpm"
    assert page.locator("#pins button").count() == 2
    # in another language too
    do.typed(page, "crank.speed", "150 rpm")
    ghosts = page.locator(".figures path.ghost-1").count()
    do.chosen(page, "#language", "ru")
    page.wait_for_function("count => document.querySelectorAll('.figures path.ghost-1').length === count", arg=ghosts)
    assert page.locator("html").get_attribute("lang") == "ru"
    do.settled(page)
    # of another machine they say nothing
    do.begin(page, "engine")
    assert page.locator("#pins button").count() == 0


def test_the_last_diagram_taken_away_stays_away(seen):
    page = seen()
    while page.locator(".figures figure").count():
        page.locator(".figures .gone").first.click()
        do.settled(page)
    do.typed(page, "crank.speed", "120 rpm")
    assert page.title().startswith("•")
    assert page.locator(".figures figure").count() == 0


def test_one_cursor_leads_machine_diagrams_and_bar_and_is_held_by_a_click_until_the_next_one_there(seen):
    page = seen()
    figure, shown = page.locator('.figures svg[data-figure="links"]'), page.locator("#shown")
    box = figure.bounding_box()

    def at(share):
        page.mouse.move(box["x"] + box["width"] * share, box["y"] + box["height"] * 0.2)
        return shown.inner_text()

    first = at(0.6)
    assert first != "φ = 0°"
    assert page.locator(".reading:visible").count() == 1
    assert page.locator(".reading:visible").inner_text().startswith(first)
    page.mouse.down()
    page.mouse.up()
    assert at(0.4) == first
    assert page.locator(".figures .fixed").count() > 0
    page.mouse.down()
    at(0.5)
    page.mouse.up()
    second = shown.inner_text()
    assert second != first
    assert at(0.4) == second
    at(0.5)
    page.mouse.down()
    page.mouse.up()
    assert at(0.4) != second
    assert page.locator(".figures .fixed").count() == 0
    figure.focus()
    before = shown.inner_text()
    page.keyboard.press("ArrowRight")
    assert shown.inner_text() != before
    page.locator('#results [data-key="speed"]').click()
    page.wait_for_selector("#explanation:not([hidden]) math")
    assert "rotational speed" in page.locator("#explanation").inner_text()
    page.keyboard.press("Escape")
    assert page.locator("#explanation").is_hidden()


# rooms with more across than they show
WIDER = """() => [...document.querySelectorAll("html, header, #bar, main > section, #form")]
  .filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.id || one.tagName)"""


@pytest.mark.parametrize(
    ("language", "scheme", "machines"), [("en", "light", ("four-bar", "turning-moment")), ("ru", "dark", ("engine",))]
)
def test_the_studio_can_be_used_by_everybody(seen, language, scheme, machines):
    page, found = seen(language=language, color_scheme=scheme), {}
    for name in machines:
        do.begin(page, name)
        # what has no mechanism is not dragged
        assert page.locator(".hint").is_visible() is (name != "turning-moment")
        found[name] = rules_broken(page)
        for width, height in ((1440, 900), (1024, 700)):
            page.set_viewport_size({"width": width, "height": height})
            found[name, width] = page.evaluate(WIDER)
            assert page.locator("header").bounding_box()["height"] < 70
    # the longest words of all
    do.chosen(page, "#language", "vi")
    page.wait_for_selector("html[lang=vi]")
    do.settled(page)
    found["vi"] = page.evaluate(WIDER)
    assert {mark: one for mark, one in found.items() if one} == {}


def test_what_a_machine_lacks_has_no_room(filed):
    page, _ = filed((EXAMPLES / "press.toml").read_text("utf-8"))
    # neither checks nor a mechanism
    assert "0/0" not in page.locator("#results").inner_text()
    assert page.locator("#film").is_hidden()


def test_what_is_typed_while_an_answer_is_under_way_stays(seen):
    page = seen()
    do.begin(page, "whole-engine")
    do.field(page, "crank.speed").fill("5000 rpm")
    do.field(page, "crank.speed").press("Enter")
    do.field(page, "rod.ratio").fill("0.3")
    do.field(page, "rod.ratio").press("Enter")
    page.locator("#text-tab").click()
    page.locator("#source").evaluate("one => { one.value += '# more'; one.dispatchEvent(new Event('input')); }")
    page.wait_for_function(
        "all => all.every((one) => document.getElementById('source').value.includes(one))",
        arg=['"5000 rpm"', "ratio = 0.3", "# more"],
    )
    do.settled(page)
    text = do.source(page)
    assert all(one in text for one in ('"5000 rpm"', "ratio = 0.3", "# more"))


def test_numbers_are_varied_with_progress_and_a_way_to_stop(seen):
    page = seen()
    page.locator("#trial summary").click()
    trial = page.locator("#trial form")
    trial.locator("select").first.select_option("crank.radius")
    assert trial.locator("input").first.input_value() == "30..95 mm"
    trial.locator("input").first.fill("50..60 mm:4")
    trial.locator("button").click()
    page.wait_for_selector("#trial details svg")
    assert "largest" in page.locator("#trial .told").inner_text()
    trial.locator("input").first.fill("50..60 mm:200")
    trial.locator("button").click()
    page.wait_for_function("() => document.querySelector('#trial progress').value > 0")
    trial.locator("button").click()
    page.wait_for_function("() => document.querySelector('#trial .told').textContent === 'Cancelled.'")
    assert trial.locator("button").inner_text() == "Run"


# curves of variants, and of now, that are not wholly within their graph [px]
OUTSIDE = """() => [...document.querySelectorAll('.figures [data-name="links"] .ghost')].filter((one) => {
  const drawing = one.closest(".drawing");
  const { d, f } = drawing.getScreenCTM();
  const { y, height } = one.ownerSVGElement;
  const [top, bottom] = [0, 1].map((k) => f + d * (y.baseVal.value + k * height.baseVal.value));
  const own = one.getBoundingClientRect();
  const curves = [...drawing.querySelectorAll("[data-curve]:not(.ghost)")];
  const now = curves.find((other) => other.dataset.curve === one.dataset.curve).getBoundingClientRect();
  return [own, now].some((box) => box.top < top - 1 || box.bottom > bottom + 1);
}).length"""


def test_scales_hold_pinned_curves_while_a_number_is_held_and_a_zoom_stays(seen):
    page = seen()
    page.locator("#pin").click()
    do.typed(page, "crank.speed", "50 rpm")
    figure = page.locator('.figures svg[data-figure="links"]')
    ghosts = figure.locator(".ghost")
    assert ghosts.count() == 6
    assert page.evaluate(OUTSIDE) == 0
    figure.focus()
    page.keyboard.press("+")
    zoom = figure.get_attribute("viewBox")
    held = []
    for _ in range(2):
        do.prepared(page, "crank.speed")
        for speed in (190, 60):
            before = ghosts.first.get_attribute("d")
            assert do.hold(page, "crank.speed", speed) == "false"
            assert page.evaluate(OUTSIDE) == 0
            assert ghosts.first.get_attribute("d") == before
            assert figure.get_attribute("viewBox") == zoom
        held.append(figure.locator("g.frame").all_inner_texts())
        do.let_go(page, "crank.speed")
        assert page.evaluate(OUTSIDE) == 0
    assert held[0] == held[1]
    assert figure.get_attribute("viewBox") == zoom
    # the variant that is taken again is the one that was pinned
    page.locator("#pins button").first.click()
    do.settled(page)
    assert page.locator("#results ins").count() == 0
    assert page.evaluate(OUTSIDE) == 0

"""A linkage as a person draws it in the studio."""

from __future__ import annotations

import math

import pytest

from studio.hands import (
    begin_drawing,
    beside,
    canvas,
    carried,
    draw_four_bar,
    drawn_pins,
    pressed,
    refused,
    settled,
    source,
    sourced,
    typed,
    undone,
)


def without(page, word):
    page.wait_for_function("word => !document.getElementById('source').value.includes(word)", arg=word)
    settled(page)


def below(page):
    settled(page)
    return page.locator(".missing").inner_text()


def test_a_four_bar_is_drawn_in_five_actions_moves_and_is_drawn_on(seen):
    page = seen(reduced_motion="no-preference")
    draw_four_bar(page)
    assert "[positions]" in source(page)
    assert page.locator("#film [data-part]").count() > 0
    before = page.locator("#shown").inner_text()
    page.wait_for_function("before => document.getElementById('shown').textContent !== before", arg=before)
    at = canvas(page)
    assert drawn_pins(page) == 4
    carried(page, *at(100, 75), at(95, 45))
    sourced(page, "points")
    assert page.locator('#film [data-part="joint.D"]').count() == 1
    at = canvas(page)
    carried(page, *at(140, 60), at(140, 50))
    sourced(page, '"89.4 mm"')
    assert page.locator("#undo").get_attribute("title") == "Draw"


def test_what_was_drawn_goes_and_comes_with_its_entry_of_the_history_and_has_the_lengths_of_now(seen):
    page = seen()
    before = source(page)
    draw_four_bar(page)
    undone(page)
    assert source(page) == before
    canvas(page)
    # the machine of the template was not drawn
    assert drawn_pins(page) == 0
    page.locator("#redo").click()
    settled(page)
    assert "[positions]" in source(page)
    page.reload()
    page.wait_for_selector(".figures svg")
    typed(page, "links.2.length", "95 mm")
    text = source(page)
    assert '"95 mm"' in text
    at = canvas(page)
    assert drawn_pins(page) == 4
    ends = page.locator("svg.sketch line.link").evaluate_all(
        "all => all.map((one) => ['x1', 'y1', 'x2', 'y2'].map((at) => one[at].baseVal.value))"
    )
    assert [math.dist(one[:2], one[2:]) for one in ends[:2]] == pytest.approx([30, 95], abs=1e-4)
    page.mouse.move(*at(100, 75))
    assert beside(page)
    page.locator("#draw").click()
    settled(page)
    assert source(page) == text
    assert refused(page) == []


def test_what_is_missing_of_a_drawing_is_said(seen):
    page = seen()
    at = canvas(page)
    for x, y in ((60, 120), (60, 90), (120, 60), (160, 80)):
        page.mouse.click(*at(x, y))
    page.mouse.dblclick(*at(180, 120))
    page.wait_for_selector("#refusals li")
    assert "2 degrees of freedom" in refused(page)[0]
    assert drawn_pins(page) == 5


HASTY = """all => {
  const svg = document.querySelector("#film svg");
  svg.setPointerCapture = () => {};
  svg.dispatchEvent(new KeyboardEvent("keydown", { key: "5" }));
  for (const [clientX, clientY] of all) svg.dispatchEvent(new PointerEvent("pointerdown", { clientX, clientY }));
}"""


def test_digits_set_the_length_of_the_next_link(seen):
    page = seen()
    at = canvas(page)
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 95))
    page.keyboard.type("32,5")
    settled(page)
    assert "32,5 mm" in beside(page)
    # typed on and clicked twice, sooner than it is read
    page.keyboard.press("Backspace")
    page.evaluate(HASTY, [at(60, 95), at(140, 60)])
    settled(page)
    page.mouse.dblclick(*at(150, 120))
    sourced(page, "[positions]")
    assert 'radius = "32.5 mm"' in source(page)


def test_a_chain_goes_on_from_a_pin_keeps_what_was_typed_and_a_mass_comes_with_its_place(seen):
    page = seen()
    draw_four_bar(page)
    typed(page, "crank.speed", "300 rpm")
    at = canvas(page)
    page.mouse.click(*at(140, 60))
    page.mouse.click(*at(200, 60))
    page.mouse.dblclick(*at(210, 120))
    sourced(page, "\n5 = ")
    assert '"300 rpm"' in source(page)
    assert page.locator('#film [data-part^="link."]').count() == 5
    page.get_by_label("Add a field ... links.2", exact=True).select_option("links.2.mass")
    settled(page)
    assert refused(page) == []
    torques = page.locator("#add option[value=torques]"), page.locator('.figures [data-name="torques"]')
    assert sum(one.count() for one in torques) == 1


def test_a_four_bar_with_a_coupler_point_takes_six_actions_and_says_what_each_will_do(seen):
    page = seen()
    at = canvas(page)  # the first action
    page.mouse.move(*at(60, 120))
    assert beside(page) == "click: a pin on the ground, where the driving link begins"
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 90))
    assert beside(page) == "click: link O 30.0 mm ∠ 90°; double-click: its end on the ground"
    page.mouse.click(*at(60, 90))
    assert below(page) == "W = 1 · I(0,1)"
    page.mouse.click(*at(140, 60))
    assert below(page) == "W = 2 · let B slide (S), or go on to a further pin"
    page.mouse.move(*at(100, 75))
    assert beside(page) == "drag: a point of this link; click: go on from it"
    carried(page, *at(100, 75), at(95, 45))  # the fifth
    page.mouse.move(*at(60, 120))
    assert beside(page) == "click: join O; the chain ends there"
    page.mouse.dblclick(*at(150, 120))  # the sixth
    sourced(page, 'radius = "30 mm"')
    assert refused(page) == []
    assert page.locator("#film [data-part^='joint.']").count() == 5


def test_a_four_bar_with_a_coupler_point_is_drawn_by_keys_with_typed_lengths_and_directions(seen):
    page = seen()
    begin_drawing(page)
    for length, angle in (("3 cm", "90"), ("85,4", "20.5 deg")):
        page.keyboard.type(length)
        page.keyboard.press("Tab")
        page.keyboard.type(angle)
        page.keyboard.press("Enter")
        settled(page)
    pressed(page, *["ArrowLeft"] * 8, *["ArrowUp"] * 2, "p")
    page.keyboard.type("60.8")
    page.keyboard.press("Tab")
    page.keyboard.type("-80")
    assert beside(page).startswith("B: 60.8 mm ∠ -80°")
    page.keyboard.press("Control+Enter")
    sourced(page, "radius")
    lacking = ('radius = "30 mm"', 'length = "85.4 mm"', 'length = "60.8 mm"', "points")
    assert [one for one in lacking if one not in source(page)] == []
    assert refused(page) == []


def test_what_is_typed_wrongly_is_refused_beside_the_pointer_and_stays(seen):
    page = seen()
    at = canvas(page)
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 95))
    page.keyboard.type("-3")
    settled(page)
    assert beside(page) == 'O: -3 mm · "-3 mm" is out of range; write at least "0.001 mm" and at most "100000 mm"'
    page.keyboard.press("Enter")
    assert drawn_pins(page) == 1
    page.keyboard.press("Escape")
    page.keyboard.type("1,7 cm")
    page.keyboard.press("Enter")
    settled(page)
    assert drawn_pins(page) == 2
    assert page.locator("svg.sketch line.link").get_attribute("y2") == "103"


def test_a_chain_goes_on_from_the_middle_of_a_link_and_other_links_keep_their_names(seen):
    page = seen()
    draw_four_bar(page)
    at = canvas(page)
    page.mouse.click(*at(100, 75))
    page.mouse.click(*at(110, 40))
    page.mouse.dblclick(*at(180, 40))
    sourced(page, "\n5 = ")
    assert refused(page) == []
    assert "points = { D = [" in source(page)
    page.get_by_label("Add a field ... links.5", exact=True).select_option("links.5.mass")
    settled(page)
    at = canvas(page)
    page.mouse.move(*at(150, 120))
    page.keyboard.press("Delete")
    without(page, "\n3 = ")
    assert '\n5 = { joins = ["E", "F"]' in source(page)
    assert "mass" in source(page).split("\n5 = ")[1].split("\n")[0]


def test_the_driving_link_ends_in_no_slider_and_letters_are_no_length(seen):
    page = seen()
    text = source(page)
    begin_drawing(page)
    page.keyboard.type("50")
    page.keyboard.press("Enter")
    settled(page)
    assert beside(page).endswith("a slider belongs at a further pin")
    page.keyboard.press("s")
    settled(page)
    assert drawn_pins(page) == 2
    assert source(page) == text
    page.keyboard.type("abc")
    settled(page)
    assert beside(page).startswith('A: abc · "abc"')
    page.keyboard.press("Enter")
    assert drawn_pins(page) == 2
    page.keyboard.press("Escape")
    # what goes beyond the paper makes it larger
    page.keyboard.type("300")
    page.keyboard.press("Tab")
    page.keyboard.type("10")
    page.keyboard.press("Enter")
    settled(page)
    assert page.locator("svg.sketch").evaluate(
        "one => { const { x, y, width, height } = one.viewBox.baseVal;"
        " return [...one.querySelectorAll('circle')].every(({ cx, cy }) => cx.baseVal.value > x"
        " && cx.baseVal.value < x + width && cy.baseVal.value > y && cy.baseVal.value < y + height); }"
    )

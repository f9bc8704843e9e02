"""A linkage as a person draws it in the studio."""

from __future__ import annotations

import math

import pytest

from studio import hands as do


def without(page, word):
    page.wait_for_function("word => !document.getElementById('source').value.includes(word)", arg=word)
    do.settled(page)


def below(page):
    do.settled(page)
    return page.locator(".missing").inner_text()


def test_a_four_bar_is_drawn_in_five_actions_moves_and_is_drawn_on(seen):
    page = seen(reduced_motion="no-preference")
    do.draw_four_bar(page)
    assert "[positions]" in do.source(page)
    assert page.locator("#film [data-part]").count() > 0
    before = page.locator("#shown").inner_text()
    page.wait_for_function("before => document.getElementById('shown').textContent !== before", arg=before)
    at = do.canvas(page)
    assert do.drawn_pins(page) == 4
    do.carried(page, *at(100, 75), at(95, 45))
    do.sourced(page, "points")
    assert page.locator('#film [data-part="joint.D"]').count() == 1
    at = do.canvas(page)
    do.carried(page, *at(140, 60), at(140, 50))
    do.sourced(page, '"89.4 mm"')
    assert page.locator("#undo").get_attribute("title") == "Draw"


def test_what_was_drawn_goes_and_comes_with_its_entry_of_the_history_and_has_the_lengths_of_now(seen):
    page = seen()
    before = do.source(page)
    do.draw_four_bar(page)
    do.undone(page)
    assert do.source(page) == before
    do.canvas(page)
    # the machine of the template was not drawn
    assert do.drawn_pins(page) == 0
    page.locator("#redo").click()
    do.settled(page)
    assert "[positions]" in do.source(page)
    page.reload()
    page.wait_for_selector(".figures svg")
    do.typed(page, "links.2.length", "95 mm")
    text = do.source(page)
    assert '"95 mm"' in text
    at = do.canvas(page)
    assert do.drawn_pins(page) == 4
    ends = page.locator("svg.sketch line.link").evaluate_all(
        "all => all.map((one) => ['x1', 'y1', 'x2', 'y2'].map((at) => one[at].baseVal.value))"
    )
    assert [math.dist(one[:2], one[2:]) for one in ends[:2]] == pytest.approx([30, 95], abs=1e-4)
    page.mouse.move(*at(100, 75))
    assert do.beside(page)
    page.locator("#draw").click()
    do.settled(page)
    assert do.source(page) == text
    assert do.refused(page) == []


def test_what_is_missing_of_a_drawing_is_said(seen):
    page = seen()
    at = do.canvas(page)
    for x, y in ((60, 120), (60, 90), (120, 60), (160, 80)):
        page.mouse.click(*at(x, y))
    page.mouse.dblclick(*at(180, 120))
    page.wait_for_selector("#refusals li")
    assert "2 degrees of freedom" in do.refused(page)[0]
    assert do.drawn_pins(page) == 5


HASTY = """all => {
  const svg = document.querySelector("#film svg");
  svg.setPointerCapture = () => {};
  svg.dispatchEvent(new KeyboardEvent("keydown", { key: "5" }));
  for (const [clientX, clientY] of all) svg.dispatchEvent(new PointerEvent("pointerdown", { clientX, clientY }));
}"""


def test_digits_set_the_length_of_the_next_link(seen):
    page = seen()
    at = do.canvas(page)
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 95))
    page.keyboard.type("32,5")
    do.settled(page)
    assert "32,5 mm" in do.beside(page)
    # typed on and clicked twice, sooner than it is read
    page.keyboard.press("Backspace")
    page.evaluate(HASTY, [at(60, 95), at(140, 60)])
    do.settled(page)
    page.mouse.dblclick(*at(150, 120))
    do.sourced(page, "[positions]")
    assert 'radius = "32.5 mm"' in do.source(page)


def test_a_chain_goes_on_from_a_pin_keeps_what_was_typed_and_a_mass_comes_with_its_place(seen):
    page = seen()
    do.draw_four_bar(page)
    do.typed(page, "crank.speed", "300 rpm")
    at = do.canvas(page)
    page.mouse.click(*at(140, 60))
    do.settled(page)
    page.mouse.click(*at(200, 60))
    do.settled(page)
    page.mouse.dblclick(*at(210, 120))
    do.sourced(page, "\n5 = ")
    assert '"300 rpm"' in do.source(page)
    assert page.locator('#film [data-part^="link."]').count() == 5
    page.get_by_label("Add a field: Links · 2", exact=True).select_option("links.2.mass")
    do.settled(page)
    assert do.refused(page) == []
    torques = page.locator("#add option[value=torques]"), page.locator('.figures [data-name="torques"]')
    assert sum(one.count() for one in torques) == 1


def test_a_four_bar_with_a_coupler_point_takes_six_actions_and_says_what_each_will_do(seen):
    page = seen()
    at = do.canvas(page)  # the first action
    page.mouse.move(*at(60, 120))
    assert do.beside(page) == "click: a pin on the ground, where the driving link begins"
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 90))
    assert do.beside(page) == "click: link O 30.0 mm ∠ 90°; double-click: its end on the ground"
    page.mouse.click(*at(60, 90))
    assert below(page) == "W = 1 · I(0,1)"
    page.mouse.click(*at(140, 60))
    assert below(page) == "W = 2 · let B slide (S), or go on to a further pin"
    page.mouse.move(*at(100, 75))
    assert do.beside(page) == "drag: a point of this link; click: go on from it"
    do.carried(page, *at(100, 75), at(95, 45))  # the fifth
    page.mouse.move(*at(60, 120))
    assert do.beside(page) == "click: join O; the chain ends there"
    page.mouse.dblclick(*at(150, 120))  # the sixth
    do.sourced(page, 'radius = "30 mm"')
    assert do.refused(page) == []
    assert page.locator("#film [data-part^='joint.']").count() == 5


def test_a_four_bar_with_a_coupler_point_is_drawn_by_keys_with_typed_lengths_and_directions(seen):
    page = seen()
    do.begin_drawing(page)
    do.keyed(page, "3 cm", "90")
    do.keyed(page, "85,4", "20.5 deg")
    do.pressed(page, *["ArrowLeft"] * 8, *["ArrowUp"] * 2, "p")
    page.keyboard.type("60.8")
    page.keyboard.press("Tab")
    page.keyboard.type("-80")
    assert do.beside(page).startswith("B: 60.8 mm ∠ -80°")
    page.keyboard.press("Control+Enter")
    do.sourced(page, "radius")
    lacking = ('radius = "30 mm"', 'length = "85.4 mm"', 'length = "60.8 mm"', "points")
    assert [one for one in lacking if one not in do.source(page)] == []
    assert do.refused(page) == []


def test_what_is_typed_wrongly_is_refused_beside_the_pointer_and_stays(seen):
    page = seen()
    at = do.canvas(page)
    page.mouse.click(*at(60, 120))
    page.mouse.move(*at(60, 95))
    page.keyboard.type("-3")
    do.settled(page)
    assert do.beside(page) == 'O: -3 mm · "-3 mm" is out of range; write at least "0.001 mm" and at most "100000 mm"'
    page.keyboard.press("Enter")
    assert do.drawn_pins(page) == 1
    page.keyboard.press("Escape")
    do.keyed(page, "1,7 cm")
    assert do.drawn_pins(page) == 2
    assert page.locator("svg.sketch line.link").get_attribute("y2") == "103"


def test_a_chain_goes_on_from_the_middle_of_a_link_and_other_links_keep_their_names(seen):
    page = seen()
    do.draw_four_bar(page)
    at = do.canvas(page)
    page.mouse.click(*at(100, 75))
    page.mouse.click(*at(110, 40))
    page.mouse.dblclick(*at(180, 40))
    do.sourced(page, "\n5 = ")
    assert do.refused(page) == []
    assert "points = { D = [" in do.source(page)
    page.get_by_label("Add a field: Links · 5", exact=True).select_option("links.5.mass")
    do.settled(page)
    at = do.canvas(page)
    page.mouse.move(*at(150, 120))
    page.keyboard.press("Delete")
    without(page, "\n3 = ")
    assert '\n5 = { joins = ["E", "F"]' in do.source(page)
    assert "mass" in do.source(page).split("\n5 = ")[1].split("\n")[0]


def test_the_driving_link_ends_in_no_slider_and_letters_are_no_length(seen):
    page = seen()
    text = do.source(page)
    do.begin_drawing(page)
    do.keyed(page, "50")
    assert do.beside(page).endswith("a slider belongs at a further pin")
    page.keyboard.press("s")
    do.settled(page)
    assert do.drawn_pins(page) == 2
    assert do.source(page) == text
    page.keyboard.type("abc")
    do.settled(page)
    assert do.beside(page).startswith('A: abc · "abc"')
    page.keyboard.press("Enter")
    assert do.drawn_pins(page) == 2
    page.keyboard.press("Escape")
    # what goes beyond the paper makes it larger
    do.keyed(page, "300", "10")
    assert page.locator("svg.sketch").evaluate(
        "one => { const { x, y, width, height } = one.viewBox.baseVal;"
        " return [...one.querySelectorAll('circle')].every(({ cx, cy }) => cx.baseVal.value > x"
        " && cx.baseVal.value < x + width && cy.baseVal.value > y && cy.baseVal.value < y + height); }"
    )

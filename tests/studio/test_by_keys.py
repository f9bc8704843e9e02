"""The studio by keys alone: all that can be done as a list, the machine part by part, what a number reaches."""

from __future__ import annotations

import re

from tests.studio.hands import begin, draw_slider_crank, field, settled, source


def said(page):
    return page.locator("#told").inner_text()


def focused(page):
    return page.evaluate("document.activeElement.id || document.activeElement.tagName")


def to_machine(page):
    page.locator("#description [role=tab][tabindex='0']").focus()
    for _ in range(200):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.matches('#film svg')"):
            return
    raise AssertionError


def test_all_that_can_be_done_is_listed_and_done(seen):
    page = seen()
    page.keyboard.press("/")
    assert page.evaluate("document.activeElement.matches('#commands input')")
    every = page.locator("#found li").count()
    page.keyboard.type("rocker length")
    assert 0 < page.locator("#found li").count() < every
    page.keyboard.press("Enter")
    assert focused(page) == "field-links.rocker.length"
    page.keyboard.press("Escape")
    page.locator("#all").click()
    page.keyboard.type("begin with toggle")
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.getElementById('title').textContent.startsWith('Toggle')")
    settled(page)
    text = source(page)
    for words in ("undo", "redo"):
        page.locator("#title").click()
        page.keyboard.press("/")
        page.keyboard.type(words)
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowUp")
        page.keyboard.press("Enter")
        settled(page)
        assert (source(page) == text) is (words == "redo")
    page.keyboard.press("/")
    page.keyboard.type("the other way")
    page.keyboard.press("Enter")
    settled(page)
    assert "branch" in source(page)
    page.keyboard.press("/")
    page.keyboard.type("nothing is called so")
    page.keyboard.press("Enter")
    assert page.locator("#commands").is_visible()
    page.keyboard.press("Escape")
    assert page.locator("#commands").is_hidden()


def test_the_machine_is_one_stop_and_arrows_go_from_pin_to_link(seen):
    page = seen()
    to_machine(page)
    names = []
    for _ in range(9):
        page.keyboard.press("ArrowRight")
        names.append(said(page))
    assert {"A, joins crank, coupler", "B, joins coupler, rocker", "coupler, from A to B"} <= set(names)
    assert len(set(names)) == len(names) - 1, names
    assert page.locator("#film .chosen").count() == 1
    while not said(page).startswith("rocker"):
        page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    offered = page.locator("#found li").all_inner_texts()
    assert all(re.search(r"\brocker\b", one) for one in offered)
    assert any("links.rocker.length" in one for one in offered)
    assert any(one.startswith("Explain") for one in offered)
    page.keyboard.press("Escape")
    assert focused(page) == "svg"
    page.keyboard.press("m")
    assert "length" in said(page)
    page.keyboard.press("ArrowUp")
    settled(page)
    page.keyboard.press("ArrowUp")
    settled(page)
    assert field(page, "links.rocker.length").input_value() == "114.7 mm"
    assert focused(page) == "svg"
    page.keyboard.press("m")
    page.keyboard.press("Space")
    assert page.locator("#play").get_attribute("aria-pressed") == "true"
    page.keyboard.press("Space")
    page.locator("#undo").click()
    settled(page)
    assert field(page, "links.rocker.length").input_value() == "112.5 mm"


def test_a_pin_that_is_moved_by_keys_turns_the_machine(seen):
    page = seen()
    begin(page, "engine")
    to_machine(page)
    while not said(page).startswith("piston"):
        page.keyboard.press("ArrowRight")
    text, shown = source(page), page.locator("#shown").inner_text()
    page.keyboard.press("m")
    page.keyboard.press("ArrowRight")
    assert page.locator("#shown").inner_text() != shown
    assert source(page) == text
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    assert said(page) == ""
    assert page.locator("#film .chosen").count() == 0
    # what was moved of one machine is not moved of the next
    page.keyboard.press("ArrowRight")
    page.keyboard.press("m")
    begin(page, "slider-crank")
    text = source(page)
    page.locator("#film svg").focus()
    page.keyboard.press("ArrowRight")
    settled(page)
    assert source(page) == text


def test_everything_that_a_number_reaches_is_lit(seen):
    page = seen()
    field(page, "crank.speed").click(modifiers=["Alt"])
    page.wait_for_selector("body.lit")
    lit = page.locator("#results .reached [data-key]").evaluate_all("all => all.map((one) => one.dataset.key)")
    assert "speed" in lit
    assert not [one for one in lit if one.startswith(("transmission_angle", "link_swing"))]
    curves = page.locator(".figures .reached").evaluate_all("all => all.map((one) => one.dataset.curve)")
    assert {one.partition(".")[0] for one in curves} == {"link_angular_velocity", "link_angular_acceleration"} | {
        one.partition(".")[0] for one in curves if "point" in one or "reduced" in one
    }
    assert not [one for one in curves if one.startswith("link_angle")]
    assert said(page) == f"crank.speed reaches {len(lit)} values"
    page.keyboard.press("Escape")
    assert page.locator("body.lit").count() == 0
    field(page, "links.rocker.length").focus()
    page.keyboard.press("Alt+Enter")
    page.wait_for_selector("body.lit")
    lit = page.locator("#results .reached [data-key]").evaluate_all("all => all.map((one) => one.dataset.key)")
    assert "speed" not in lit
    assert [one for one in lit if one.startswith("transmission_angle")]


def test_a_pin_of_a_drawing_is_carried_by_keys(seen):
    page = seen()
    draw_slider_crank(page)
    page.locator("#draw").focus()
    page.keyboard.press("Enter")
    for key in ("ArrowUp",) * 5:
        page.keyboard.press(key)
    for key in ("m", "ArrowUp", "Escape", "m", "ArrowUp", "Enter"):
        page.keyboard.press(key)
    page.wait_for_function("() => document.getElementById('source').value.includes('radius = \"30 mm\"')")
    settled(page)
    assert page.locator("#refusals li").count() == 0

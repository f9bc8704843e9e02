"""The studio by keys alone: all that can be done as a list, the machine part by part, what a number reaches."""

from __future__ import annotations

import re

from studio import hands as do


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
    page.locator(".menu summary").click()
    page.locator("#all").click()
    do.keyed(page, "examples toggle")
    page.wait_for_function("() => document.getElementById('title').textContent.startsWith('Toggle')")
    do.settled(page)
    text = do.source(page)
    for words in ("undo", "redo"):
        page.locator("#title").click()
        page.keyboard.press("/")
        page.keyboard.type(words)
        do.pressed(page, "ArrowDown", "ArrowUp", "Enter")
        do.settled(page)
        assert (do.source(page) == text) is (words == "redo")
    page.keyboard.press("/")
    do.keyed(page, "the other way")
    assert "branch" in do.source(page)
    page.keyboard.press("/")
    do.keyed(page, "nothing is called so")
    assert page.locator("#commands").is_visible()
    page.keyboard.press("Escape")
    assert page.locator("#commands").is_hidden()


def test_the_machine_is_one_stop_and_arrows_go_from_pin_to_link(seen):
    page = seen()
    to_machine(page)
    names = []
    for _ in range(9):
        page.keyboard.press("ArrowRight")
        names.append(do.said(page))
    assert {"A, joins crank, coupler", "B, joins coupler, rocker", "coupler, from A to B"} <= set(names)
    assert len(set(names)) == len(names) - 1, names
    assert page.locator("#film .chosen").count() == 1
    while not do.said(page).startswith("rocker"):
        page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    offered = page.locator("#found li").all_inner_texts()
    assert all(re.search(r"\brocker\b", one) for one in offered)
    assert any("links.rocker.length" in one for one in offered)
    assert any(one.startswith("Explain") for one in offered)
    page.keyboard.press("Escape")
    assert focused(page) == "svg"
    page.keyboard.press("m")
    assert "length" in do.said(page)
    for _ in range(2):
        page.keyboard.press("ArrowUp")
        do.settled(page)
    assert do.value(page, "links.rocker.length") == "114.7 mm"
    assert focused(page) == "svg"
    do.pressed(page, "m", "Space")
    assert page.locator("#play").get_attribute("aria-pressed") == "true"
    page.keyboard.press("Space")
    do.undone(page)
    assert do.value(page, "links.rocker.length") == "112.5 mm"


def test_a_pin_that_is_moved_by_keys_turns_the_machine(seen):
    page = seen()
    do.begin(page, "engine")
    to_machine(page)
    while not do.said(page).startswith("piston"):
        page.keyboard.press("ArrowRight")
    text, shown = do.source(page), page.locator("#shown").inner_text()
    do.pressed(page, "m", "ArrowRight")
    assert page.locator("#shown").inner_text() != shown
    assert do.source(page) == text
    do.pressed(page, "Escape", "Escape")
    assert do.said(page) == ""
    assert page.locator("#film .chosen").count() == 0
    # what was moved of one machine is not moved of the next
    do.pressed(page, "ArrowRight", "m")
    do.begin(page, "slider-crank")
    text = do.source(page)
    page.locator("#film svg").focus()
    page.keyboard.press("ArrowRight")
    do.settled(page)
    assert do.source(page) == text


def test_everything_that_a_number_reaches_is_lit(seen):
    page = seen()

    def lit():
        page.wait_for_selector("body.lit")
        found = page.locator("#results .reached [data-key]")
        return found.evaluate_all("all => all.map((one) => one.dataset.key)")

    do.field(page, "crank.speed").click(modifiers=["Alt"])
    reached = lit()
    assert "speed" in reached
    assert not [one for one in reached if one.startswith(("transmission_angle", "link_swing"))]
    curves = page.locator(".figures .reached").evaluate_all("all => all.map((one) => one.dataset.curve)")
    assert {one.partition(".")[0] for one in curves} == {"link_angular_velocity", "link_angular_acceleration"} | {
        one.partition(".")[0] for one in curves if "point" in one or "reduced" in one
    }
    assert do.said(page) == f"crank.speed reaches {len(reached)} values"
    page.keyboard.press("Escape")
    assert page.locator("body.lit").count() == 0
    do.field(page, "links.rocker.length").focus()
    page.keyboard.press("Alt+Enter")
    reached = lit()
    assert "speed" not in reached
    assert [one for one in reached if one.startswith("transmission_angle")]


def test_sliders_and_fields_are_moved_by_keys_and_every_one_is_reached(seen):
    page = seen()
    slider = do.slider_of(page, "crank.radius")
    slider.focus()
    do.pressed(page, *["ArrowRight"] * 5)
    do.settled(page)
    # however far it goes it is one step
    value = slider.evaluate("one => one.valueAsNumber")
    assert value > 62.5
    assert f'radius = "{value:g} mm"' in do.source(page)
    assert "crank.radius" in page.locator("#undo").get_attribute("title")
    do.undone(page)
    assert 'radius = "62.5 mm"' in do.source(page)
    reached = set()
    page.locator("#title").click()
    for _ in range(150):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id || document.activeElement.dataset.of || ''"))
        if page.evaluate("document.activeElement.matches('.menu:not([open]) summary')"):
            page.keyboard.press("Enter")
    assert reached >= {
        *("template", "open", "save", "share", "pin", "export", "language", "play", "slider", "form-tab", "add"),
        *("field-crank.radius", "field-links.coupler.length"),
    }
    page.evaluate("document.activeElement.blur()")
    do.field(page, "crank.speed").focus()
    for key, other in (("ArrowUp", "crank.radius"), ("ArrowDown", "crank.speed")):
        page.keyboard.press(key)
        assert focused(page) == f"field-{other}"


def test_a_pin_of_a_drawing_is_drawn_and_carried_by_keys(seen):
    page = seen()
    do.draw_slider_crank(page)
    assert 'radius = "25 mm"' in do.source(page)
    assert do.refused(page) == []
    assert page.locator("#film [data-part]").count() > 0
    page.locator("#draw").focus()
    do.pressed(page, "Enter", *["ArrowUp"] * 5, "m", "ArrowUp", "Escape", "m", "ArrowUp", "Enter")
    do.sourced(page, 'radius = "30 mm"')
    assert do.refused(page) == []

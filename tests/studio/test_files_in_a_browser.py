"""Files of the studio in a real browser: saved, shared, opened again, changed by somebody else, kept at a reload."""

from __future__ import annotations

import re
from pathlib import Path

from tests.studio.hands import begin, field, settled, source
from tests.studio.test_pmks import FOUR_BAR

from crankwork.description.machine_file import template


def test_a_machine_is_exported_shared_and_opened_again(seen, tmp_path):
    page = seen(permissions=["clipboard-read", "clipboard-write"])
    # diagrams that are seen too
    for name, start in (("tables.xlsx", b"PK"), ("links.svg", b"<svg"), ("links.png", b"\x89PNG")):
        with page.expect_download() as download:
            page.select_option("#export", name)
        assert download.value.suggested_filename == name
        assert (
            Path(download.value.path())
            .read_bytes()
            .removeprefix(b'<?xml version="1.0" encoding="UTF-8"?>\n')
            .startswith(start)
        )
    page.locator("#share").click()
    page.wait_for_selector("#notice:not([hidden])")
    word = page.evaluate("navigator.clipboard.readText()")
    from crankwork.studio.answers import opened_share

    assert opened_share(word) == source(page)
    begin(page, "engine")
    pasted(page, word)
    page.wait_for_function("() => document.getElementById('source').value.includes('coupler')")
    settled(page)
    assert source(page) == opened_share(word)
    pasted(page, f"https://app.pmksplus.com/?{FOUR_BAR}")
    page.wait_for_function("() => document.getElementById('source').value.includes('clockwise')")
    settled(page)
    assert page.locator('#film [data-part="joint.C"]').count() == 1


def pasted(page, word):
    page.evaluate(
        "word => { const data = new DataTransfer(); data.setData('text', word);"
        " document.body.dispatchEvent(new ClipboardEvent('paste', {clipboardData: data, bubbles: true})); }",
        word,
    )


def test_what_was_typed_is_there_after_a_reload(seen):
    page = seen()
    field(page, "crank.speed").fill("333 rpm")
    field(page, "crank.speed").press("Enter")
    settled(page)
    page.reload()
    page.wait_for_selector(".figures svg")
    assert field(page, "crank.speed").input_value() == "333 rpm"


WITH = "word => document.getElementById('notice').textContent.includes(word)"


def test_a_studio_that_was_started_again_is_told_from_one_that_does_not_answer_and_nothing_typed_is_lost(
    browser, start, tmp_path
):
    context = browser.new_context(reduced_motion="reduce")
    page, left = context.new_page(), context.new_page()
    with start(tmp_path) as one:
        page.goto(f"{one.address}?token={one.token}")
        page.wait_for_selector(".figures svg")
        left.goto(one.address)
        left.wait_for_selector(".figures svg")
    page.wait_for_function(WITH, arg="does not answer")
    assert page.locator("#notice button").first.inner_text() == "Share"
    for key, value in (("crank.speed", "333 rpm"), ("crank.radius", "61 mm")):
        field(page, key).fill(value)
        field(page, key).press("Enter")
    with start(tmp_path, "--port", re.search(r":(\d+)/", one.address)[1]) as again:
        page.wait_for_function(WITH, arg="started again")
        page.goto(f"{again.address}?token={again.token}&lang=ru")
        page.wait_for_selector(".figures svg")
        page.wait_for_function("() => document.getElementById('source').value.includes('333 rpm')")
        settled(page)
        assert '"61 mm"' in source(page)
        assert page.locator("#notice").is_hidden()
        left.locator("#notice").wait_for(state="hidden")
    context.close()


def test_what_was_opened_from_elsewhere_is_not_saved_over_the_file(seen, start, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(template("four-bar"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        page = seen(one)
        field(page, "crank.speed").fill("90 rpm")
        field(page, "crank.speed").press("Enter")
        settled(page)
        page.locator("#title").click()
        page.keyboard.press("Control+s")
        page.wait_for_function("() => document.getElementById('notice').textContent.startsWith('Saved')")
        mine = path.read_text("utf-8")
        assert '"90 rpm"' in mine
        begin(page, "engine")
        with page.expect_download() as download:
            page.locator("#save").click()
        assert "[cylinder]" in Path(download.value.path()).read_text("utf-8")
        assert path.read_text("utf-8") == mine
        # undone, it is the file again
        page.locator("#undo").click()
        settled(page)
        page.locator("#save").click()
        page.wait_for_function("() => document.getElementById('notice').textContent.startsWith('Saved')")
        assert path.read_text("utf-8") == mine


def test_a_file_that_somebody_else_changes_is_told_at_once_and_may_be_taken(seen, start, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(template("four-bar"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        page = seen(one)
        field(page, "crank.speed").fill("90 rpm")
        field(page, "crank.speed").press("Enter")
        settled(page)
        theirs = template("slider-crank")
        path.write_text(theirs, encoding="utf-8")
        page.wait_for_function(WITH, arg="the file has changed on disk")
        page.locator("#title").click()
        page.keyboard.press("Control+s")
        page.wait_for_function(WITH, arg="since it was read here")
        assert path.read_text("utf-8") == theirs
        page.get_by_role("button", name="Take what is there").click()
        page.wait_for_function("() => document.getElementById('title').textContent.startsWith('Slider')")
        settled(page)
        assert source(page) == theirs
        # one entry of the history, to what stood here
        page.locator("#undo").click()
        settled(page)
        assert '"90 rpm"' in source(page)

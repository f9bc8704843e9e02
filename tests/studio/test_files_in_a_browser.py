"""Files of the studio in a real browser: saved, shared, opened again, changed by somebody else, kept at a reload."""

from __future__ import annotations

import re
from pathlib import Path

from crankwork.description.machine_file import template
from crankwork.studio.session import opened_share
from studio.hands import begin, chosen, field, refused, settled, source, sourced, told, typed, undone, value
from studio.test_pmks import FOUR_BAR

PASTED = """word => {
  const data = new DataTransfer();
  data.setData('text', word);
  document.body.dispatchEvent(new ClipboardEvent('paste', {clipboardData: data, bubbles: true}));
}"""


def test_a_machine_is_exported_shared_and_opened_again(seen):
    page = seen(permissions=["clipboard-read", "clipboard-write"])
    # diagrams that are seen too
    for name, start in (("tables.xlsx", b"PK"), ("links.svg", b"<svg"), ("links.png", b"\x89PNG")):
        with page.expect_download() as download:
            chosen(page, "#export", name)
        assert page.locator(".menu[open]").count() == 0
        assert download.value.suggested_filename == name
        data = Path(download.value.path()).read_bytes()
        assert data.removeprefix(b'<?xml version="1.0" encoding="UTF-8"?>\n').startswith(start)
    page.locator(".menu summary").click()
    page.locator("#share").click()
    page.wait_for_selector("#notice:not([hidden])")
    word = page.evaluate("navigator.clipboard.readText()")
    assert opened_share(word) == source(page)
    begin(page, "engine")
    page.evaluate(PASTED, word)
    sourced(page, "coupler")
    assert source(page) == opened_share(word)
    page.evaluate(PASTED, f"https://app.pmksplus.com/?{FOUR_BAR}")
    sourced(page, "clockwise")
    assert page.locator('#film [data-part="joint.C"]').count() == 1


def test_a_studio_that_was_started_again_is_told_from_one_that_does_not_answer_and_nothing_typed_is_lost(
    browser, start, tmp_path
):
    context = browser.new_context(reduced_motion="reduce")
    page, left = context.new_page(), context.new_page()
    with start(tmp_path) as one:
        for each, address in ((page, f"{one.address}?token={one.token}"), (left, one.address)):
            each.goto(address)
            each.wait_for_selector(".figures svg")
    told(page, "does not answer")
    assert page.locator("#notice button").first.inner_text() == "Share"
    for key, written in (("crank.speed", "333 rpm"), ("crank.radius", "61 mm")):
        field(page, key).fill(written)
        field(page, key).press("Enter")
    with start(tmp_path, "--port", re.search(r":(\d+)/", one.address)[1]) as again:
        told(page, "started again")
        page.goto(f"{again.address}?token={again.token}&lang=ru")
        page.wait_for_selector(".figures svg")
        sourced(page, "333 rpm")
        assert '"61 mm"' in source(page)
        assert page.locator("#notice").is_hidden()
        left.locator("#notice").wait_for(state="hidden")
    context.close()


def test_what_was_opened_from_elsewhere_is_not_saved_over_the_file_and_what_was_typed_stays_at_a_reload(filed):
    page, path = filed(template("four-bar"))
    typed(page, "crank.speed", "90 rpm")
    page.reload()
    page.wait_for_selector(".figures svg")
    assert value(page, "crank.speed") == "90 rpm"
    page.locator("#title").click()
    page.keyboard.press("Control+s")
    told(page, "Saved")
    mine = path.read_text("utf-8")
    assert '"90 rpm"' in mine
    begin(page, "engine")
    with page.expect_download() as download:
        page.locator("#save").click()
    assert "[cylinder]" in Path(download.value.path()).read_text("utf-8")
    assert path.read_text("utf-8") == mine
    # undone, it is the file again
    undone(page)
    page.locator("#save").click()
    told(page, "Saved")
    assert path.read_text("utf-8") == mine


def test_a_file_that_somebody_else_changes_is_told_at_once_and_may_be_taken(filed):
    page, path = filed(template("four-bar"))
    typed(page, "crank.speed", "90 rpm")
    theirs = template("slider-crank")
    path.write_text(theirs, encoding="utf-8")
    told(page, "the file has changed on disk")
    page.locator("#title").click()
    page.keyboard.press("Control+s")
    told(page, "since it was read here")
    assert path.read_text("utf-8") == theirs
    page.get_by_role("button", name="Take what is there").click()
    page.wait_for_function("() => document.getElementById('title').textContent.startsWith('Slider')")
    settled(page)
    assert source(page) == theirs
    # one entry of the history, to what stood here
    undone(page)
    assert '"90 rpm"' in source(page)


def test_a_file_that_was_opened_before_is_opened_again_and_saved(seen, start, tmp_path):
    path = tmp_path / "my press.toml"
    path.write_text(template("press"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        seen(one).close()
    with start(tmp_path) as one:
        page = seen(one, language="ru")
        assert page.locator("#title").inner_text() == "Шарнирный четырёхзвенник"
        options = page.locator("#template optgroup").first.locator("option")
        assert options.all_text_contents() == [f"my press.toml – {tmp_path}"]
        chosen(page, "#template", str(path))
        page.wait_for_function("() => document.getElementById('save').title.includes('my press.toml')")
        settled(page)
        typed(page, "crank.speed", "33 rpm")
        page.locator("#save").click()
        page.wait_for_selector("#notice:not([hidden])")
        assert '"33 rpm"' in path.read_text("utf-8")
        # undone to what stands in no file, it is handed over, and stays in the list by its title
        begin(page, "engine")
        title = page.locator("#title").inner_text()
        with page.expect_download():
            page.locator("#save").click()
        settled(page)
        assert options.all_text_contents() == [title, f"my press.toml – {tmp_path}"]
        path.unlink()
        text = source(page)
        chosen(page, "#template", str(path))
        told(page, "my press.toml")
        # it is offered no more; the notice may be that of the disk
        page.wait_for_function("() => document.querySelector('#template optgroup').childElementCount === 1")
        assert options.all_text_contents() == [title]
        assert source(page) == text
        assert page.locator("body.stale").count() == 0
        typed(page, "crank.speed", "1000 rpm")
        chosen(page, "#template", title)
        page.wait_for_function("text => document.getElementById('source').value === text", arg=text)
        page.close()


def test_a_file_that_another_page_saved_is_read_as_it_is_now(seen, start, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(template("four-bar"), encoding="utf-8")
    with start(tmp_path, str(path)) as one:
        path.write_text(template("four-bar").replace("100 rpm", "77 rpm"), encoding="utf-8")
        page = seen(one)
        assert value(page, "crank.speed") == "77 rpm"
        page.reload()
        page.wait_for_selector(".figures svg")
        typed(page, "crank.speed", "78 rpm")
        page.locator("#save").click()
        told(page, "Saved")
        assert '"78 rpm"' in path.read_text("utf-8")
        # a text that is no machine is saved and said to be none; one that is longer than any is neither
        text = page.locator("#source")
        page.locator("#text-tab").click()
        text.fill("[[[[")
        page.wait_for_selector("#refusals li")
        settled(page)
        page.locator("#save").click()
        told(page, "no machine yet")
        assert path.read_text("utf-8") == "[[[["
        text.evaluate("one => { one.value = '#'.repeat(7e6); one.dispatchEvent(new Event('input')); }")
        page.wait_for_function("() => document.querySelector('#refusals li')?.textContent.includes('longer than any')")
        assert len(refused(page)) == 1
        page.close()

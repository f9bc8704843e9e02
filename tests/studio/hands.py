"""What tests of the studio do and read in a browser."""

from __future__ import annotations


def settled(page):
    """Wait until what was asked is answered."""
    page.wait_for_function("() => document.body.dataset.waits !== 'true'")


def number(page, key):
    return page.locator(f'#results [data-key="{key}"]').inner_text()


def field(page, key):
    return page.locator(f'[data-of="{key}"]')


def source(page):
    return page.locator("#source").input_value()


def begin(page, name):
    page.select_option("#template", name)
    page.wait_for_function(
        "name => document.getElementById('source').value.includes(name)", arg="[cylinder]" if name == "engine" else "["
    )
    settled(page)


def begin_drawing(page):
    """Begin to draw by keys, with the first pin where the cross stands."""
    page.locator("#draw").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Enter")


def draw_slider_crank(page):
    """Draw a slider-crank by keys: a crank of 25 mm, a rod down to a slider."""
    begin_drawing(page)
    for keys in (["ArrowUp"] * 5, ["ArrowRight"] * 16 + ["ArrowDown"] * 5):
        for key in keys:
            page.keyboard.press(key)
        page.keyboard.press("Enter")
    page.keyboard.press("s")
    page.wait_for_function("() => document.getElementById('source').value.includes('[guides]')")
    settled(page)

"""What tests of the studio do and read in a browser."""

from __future__ import annotations

HELD = """([key, value, share]) => {
  const slider = document.querySelector(`[data-slides="${key}"]`);
  slider.value = value ?? slider.valueAsNumber * (1 + share);
  slider.dispatchEvent(new Event("input"));
  return document.body.dataset.waits;
}"""


def settled(page):
    """Wait until what was asked is answered."""
    page.wait_for_function("() => document.body.dataset.waits !== 'true'")


def number(page, key):
    return page.locator(f'#results [data-key="{key}"]').inner_text()


def field(page, key):
    return page.locator(f'[data-of="{key}"]')


def value(page, key):
    """Return the number that stands in a field, with its unit."""
    return f"{field(page, key).input_value()} {field(page, key).locator('+ span').inner_text()}".strip()


def chosen(page, which, option):
    """Choose something of a list in the menu."""
    page.locator(".menu summary").click()
    page.select_option(which, option)


def typed(page, key, value):
    """Type a number into its field, and wait for the machine that it makes."""
    field(page, key).fill(value)
    field(page, key).press("Enter")
    settled(page)


def slider_of(page, key):
    return page.locator(f'[data-slides="{key}"]')


def hold(page, key, value=None, share=None):
    """Hold a slider at a value, or a share beyond where it stands; return whether anything is asked for."""
    return page.evaluate(HELD, [key, value, share])


def let_go(page, key):
    slider_of(page, key).dispatch_event("change")
    settled(page)


def prepared(page, key):
    """Come near to a slider, and wait until what follows it is calculated in the page."""
    slider_of(page, key).hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false' && globalThis.steps")
    # its script goes when it has been taken
    page.wait_for_function("() => !document.head.querySelector('script[src^=steps]')")


def source(page):
    return page.locator("#source").input_value()


def sourced(page, word):
    """Wait until something stands in the text, and what was asked is answered."""
    page.wait_for_function("word => document.getElementById('source').value.includes(word)", arg=word)
    settled(page)


def told(page, word):
    """Wait until a notice tells something."""
    page.wait_for_function("word => document.getElementById('notice').textContent.includes(word)", arg=word)


def refused(page):
    return page.locator("#refusals li").all_inner_texts()


def undone(page):
    page.locator("#undo").click()
    settled(page)


def begin(page, name):
    chosen(page, "#template", name)
    page.wait_for_function(
        "name => document.getElementById('source').value.includes(name)", arg="[cylinder]" if name == "engine" else "["
    )
    settled(page)


def with_figure(page, name):
    """Look at a further diagram."""
    page.select_option("#add", name)
    page.wait_for_selector(f'.figures [data-name="{name}"] svg')
    settled(page)


def carried(page, x, y, *ways, steps=4, up=True):
    """Take hold of what stands at a place and carry it to others."""
    page.mouse.move(x, y)
    page.mouse.down()
    for way in ways:
        page.mouse.move(*way, steps=steps)
    if up:
        page.mouse.up()


def middle(page, part):
    """Return where a joint of the machine stands on the screen."""
    box = page.locator(f'#film [data-part="joint.{part}"]').bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def pressed(page, *keys):
    for key in keys:
        page.keyboard.press(key)


def keyed(page, *words):
    """Type words, each into the next box, and let them stand."""
    for at, word in enumerate(words):
        if at:
            page.keyboard.press("Tab")
        page.keyboard.type(word)
    page.keyboard.press("Enter")
    settled(page)


def canvas(page):
    """Begin to draw; return what tells where millimetres of the paper are on the screen."""
    page.locator("#draw").click()
    # what is missing stands below, and takes its room
    settled(page)
    matrix = "one => { const { a, e, f } = one.getScreenCTM(); return [a, e, f]; }"
    scale, left, top = page.locator("svg.sketch").evaluate(matrix)
    return lambda x, y: (left + x * scale, top + y * scale)


def drawn_pins(page):
    return page.locator("svg.sketch circle").count()


def draw_four_bar(page):
    """Draw a four-bar in five actions: a crank of 30 mm, a coupler, a rocker."""
    at = canvas(page)  # the first action
    for x, y in ((60, 120), (60, 90), (140, 60)):  # three more
        page.mouse.click(*at(x, y))
        settled(page)
    page.mouse.dblclick(*at(150, 120))  # the fifth
    sourced(page, 'radius = "30 mm"')


def begin_drawing(page):
    """Begin to draw by keys, with the first pin where the cross stands."""
    page.locator("#draw").focus()
    pressed(page, "Enter", "Enter")


def draw_slider_crank(page):
    """Draw a slider-crank by keys: a crank of 25 mm, a rod down to a slider."""
    begin_drawing(page)
    pressed(page, *["ArrowUp"] * 5, "Enter", *["ArrowRight"] * 16, *["ArrowDown"] * 5, "Enter", "s")
    sourced(page, "[guides]")


def said(page):
    return page.locator("#told").inner_text()


def beside(page):
    """Return what is said beside the pointer."""
    return page.locator("#chip").inner_text()

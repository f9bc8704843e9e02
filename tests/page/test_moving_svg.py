"""The moving drawing in a browser: it plays, stops, is turned by keys, rests where motion is unwanted, and is dark."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from crankwork import analyse
from crankwork.description.machine_file import read
from crankwork.report.drawing import moving_drawing
from crankwork.show.svg import moving_svg
from page.slid import EXAMPLES

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# where the origin of a part stands on the paper, in millimetres
_PLACE = """name => {
  const group = document.querySelector(`[data-part="${name}"]`), svg = document.documentElement;
  const inner = group.querySelector(":scope > .moves") || group;
  const on = svg.getScreenCTM().inverse().multiply(inner.getScreenCTM());
  return [on.e, on.f, Math.atan2(on.b, on.a) * 180 / Math.PI];
}"""
_MOVED = f"([name, from]) => String(({_PLACE})(name)) !== String(from)"
_STANDS = "document.getAnimations().every(one => one.playState === 'paused')"


@pytest.fixture(scope="module", name="film")
def _film():
    return moving_drawing(analyse(read(EXAMPLES / "radial-five.toml")))


@pytest.fixture(scope="module", name="folder")
def _folder(film, tmp_path_factory):
    folder = tmp_path_factory.mktemp("film")
    (folder / "machine.svg").write_bytes(moving_svg(film, "colour"))
    (folder / "img.html").write_text('<body><img src="machine.svg" width="600">', "utf-8")
    return folder


@pytest.fixture(name="shown")
def _shown(browser, folder):
    """Open the drawing, on dark ground or with reduced motion where asked."""
    contexts = []

    def shown(name="machine.svg", **look):
        contexts.append(browser.new_context(**look))
        page = contexts[-1].new_page()
        page.goto((folder / name).as_uri())
        return page

    yield shown
    for one in contexts:
        one.close()


def _wanted(film, name, frame):
    (one,) = (part for part in film.parts if part.name == name)
    x, y = one.shift[frame % film.frames if len(one.shift) > 1 else 0]
    return x, film.ground.height - y, -one.turn[frame % film.frames]


def _compared(page, film, frame):
    for name in ("side.piston.3", "side.rod.1", "side.rod.4", "side.crank.1", "row.1.piston.1"):
        x, y, turn = page.evaluate(_PLACE, name)
        wanted = _wanted(film, name, frame)
        assert np.hypot(x - wanted[0], y - wanted[1]) < 0.1, (name, frame)
        assert abs((turn - wanted[2] + 180) % 360 - 180) < 0.2, (name, frame)


def test_it_rests_where_motion_is_unwanted_and_keys_turn_it_frame_by_frame(shown, film):
    page = shown(reduced_motion="reduce")
    assert page.evaluate(_STANDS)
    _compared(page, film, film.rest)
    frame = film.rest
    for key, by in (("ArrowRight", 1), ("ArrowUp", 10), ("ArrowUp", 10), ("ArrowLeft", -1), *[("ArrowDown", -10)] * 4):
        page.keyboard.press(key)
        frame += by
        _compared(page, film, frame)
    page.keyboard.press(" ")
    page.wait_for_function(f"!({_STANDS})")


def test_it_plays_until_a_click_stops_it_and_has_a_bar_that_turns_it(shown, film):
    """A pull to a quarter of the bar shows the frame at a quarter of the cycle; the knob stands there."""
    page = shown()
    page.wait_for_function(_MOVED, arg=["side.crank.1", page.evaluate(_PLACE, "side.crank.1")])
    page.mouse.click(200, 200)
    page.wait_for_function(_STANDS)
    page.keyboard.press(" ")
    page.wait_for_function(_MOVED, arg=["side.crank.1", page.evaluate(_PLACE, "side.crank.1")])
    bar = page.locator("#slide").bounding_box()
    middle = bar["y"] + bar["height"] / 2
    page.mouse.move(bar["x"] + 0.7 * bar["width"], middle)
    page.mouse.down()
    page.mouse.move(bar["x"] + 0.25 * bar["width"], middle)
    page.mouse.up()
    assert page.evaluate(_STANDS)
    _compared(page, film, round(0.25 * film.frames))
    page.wait_for_function(
        "wanted => { const box = [...document.querySelectorAll('circle')].pop().getBoundingClientRect();"
        " return Math.abs(box.x + box.width / 2 - wanted) < 2; }",
        arg=bar["x"] + 0.25 * bar["width"],
    )
    for stands in (False, True):
        button = page.locator("#play").bounding_box()
        page.mouse.click(button["x"] + button["width"] / 2, button["y"] + button["height"] / 2)
        assert page.evaluate(_STANDS) == stands


def test_its_ground_is_dark_where_the_reader_prefers_it(shown):
    ground = "getComputedStyle(document.querySelector('rect')).fill"
    grounds = {scheme: shown(color_scheme=scheme).evaluate(ground) for scheme in ("light", "dark")}
    assert grounds == {"light": "rgb(255, 255, 255)", "dark": "rgb(20, 23, 28)"}


def _captured(page, session):
    """Return what a page looks like, once the browser has something to show."""
    from playwright.sync_api import Error

    for _ in range(100):
        try:
            return session.send("Page.captureScreenshot", {"format": "png"})["data"]
        except Error:
            page.wait_for_timeout(100)
    raise AssertionError("the browser shows nothing")


def _looks(page, count):
    """Return at which of some looks a page looked otherwise than at first, None if it never did."""
    session = page.context.new_cdp_session(page)
    first = _captured(page, session)
    return next((at for at in range(count) if _captured(page, session) != first), None)


def test_a_picture_of_it_moves_where_no_script_runs(shown):
    assert _looks(shown("img.html", java_script_enabled=False), 200) is not None


def test_a_picture_of_it_rests_where_the_system_wants_no_motion(browser, folder):
    program = next(path for name in BROWSERS if (path := shutil.which(name)))
    calm = browser.browser_type.launch(
        executable_path=program, args=["--no-sandbox", "--force-prefers-reduced-motion"]
    )  # fmt: skip
    page = calm.new_page()
    page.goto((folder / "img.html").as_uri())
    # each picture is taken later than the one before
    assert _looks(page, 8) is None
    calm.close()

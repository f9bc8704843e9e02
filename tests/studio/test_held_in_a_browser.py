"""An engine while a number is held: drawn between machines around it, as the server draws it once that is let go."""

from __future__ import annotations

import re

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from tests.studio.hands import settled
from tests.studio.test_answers import EXAMPLES

import crankwork
from crankwork.report.figures import drawings
from crankwork.studio.answers import Studio

TEXTS = {one.stem: one.read_text("utf-8") for one in EXAMPLES}
HELD = """([key, share]) => {
  const slider = document.querySelector(`[data-slides="${key}"]`);
  slider.value = slider.valueAsNumber * (1 + share);
  slider.dispatchEvent(new Event("input"));
  return document.body.dataset.waits;
}"""
PARTS = "all => Object.fromEntries(all.map((one) => [one.dataset.part, one.getAttribute('transform')]))"
# sizes of what stands still, hatchings left out, whose strokes are counted anew
STANDING = """all => all.filter((one) => one.getAttribute("d").split("M").length < 4).map((one) => {
  const { width, height } = one.getBBox();
  return [width, height];
})"""
# how far down a diagram its curves go [mm]
LEAST = """name => Math.max(...[...document.querySelectorAll(`[data-name="${name}"] path[data-curve]`)]
  .filter((one) => one.dataset.curve !== "legend").map((one) => one.getBBox()).map((box) => box.y + box.height))"""
RATIO = """() => {
  const part = (one) => document.querySelector(`#film [data-part="joint.${one}"]`);
  const [o, a, b] = ["O", "A", "B"].map((one) => part(one).transform.baseVal.consolidate().matrix);
  return Math.hypot(a.e - o.e, a.f - o.f) / Math.hypot(b.e - a.e, b.f - a.f);
}"""
MOVED = """value => {
  const slider = document.querySelector('[data-slides="crank.radius"]');
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
  return document.body.dataset.waits;
}"""
NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")


def numbers(parts):
    """Return where parts are beside the first of their view, since paper with arrows is larger."""
    found = {name: [float(one) for one in NUMBER.findall(text)] for name, text in parts.items() if "force" not in name}
    first = {}
    for name, values in found.items():
        first.setdefault(name.partition(".")[0], values[:2])
    views = {name: first[name.partition(".")[0]] for name in found}
    return {
        name: [values[0] - views[name][0], values[1] - views[name][1], *values[2:]] for name, values in found.items()
    }


@pytest.mark.parametrize(("name", "share"), [("petrol-four", -0.15), ("v8-diesel", 0.1)])
def test_the_machine_and_its_diagrams_follow_a_held_ratio_without_asking(seen, start, tmp_path, name, share):
    path = tmp_path / "my.toml"
    path.write_text(TEXTS[name], "utf-8")
    with start(tmp_path, str(path)) as own:
        page = seen(own)
        settled(page)
        held_and_let(page, share, diagram="crankpin_load" if name == "petrol-four" else "rod_forces")
    assert own.complaints.read_text() == ""


def held_and_let(page, share, diagram):
    """Hold the ratio, let it go, and compare what is seen."""
    page.select_option("#add", diagram)
    page.wait_for_selector(f'[data-name="{diagram}"]')
    settled(page)
    page.locator('[data-slides="rod.ratio"]').hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false'")
    page.wait_for_function("() => globalThis.steps")
    page.locator("#bar input[type=range]").evaluate("one => { one.value = 97; one.dispatchEvent(new Event('input')); }")
    assert page.evaluate(HELD, ["rod.ratio", share]) == "false"
    held, standing = (
        page.locator("#film [data-part]").evaluate_all(PARTS),
        page.locator("#film svg > path").evaluate_all(STANDING),
    )
    least = page.evaluate(LEAST, diagram)
    page.locator('[data-slides="rod.ratio"]').dispatch_event("change")
    settled(page)
    # a narrow dip is as deep
    assert least == pytest.approx(page.evaluate(LEAST, diagram), abs=0.6)
    let = page.locator("#film [data-part]").evaluate_all(PARTS)
    assert held.keys() == {one for one in let if "force" not in one}
    for part, values in numbers(held).items():
        # millimetres of a paper of 250
        assert values == pytest.approx(numbers(let)[part], abs=0.3), part
    ends = page.locator("#film svg > path").evaluate_all(STANDING)
    assert np.array(standing[: len(ends)]) == pytest.approx(np.array(ends[: len(standing)]), abs=0.3)


@pytest.mark.parametrize(
    ("name", "figures"),
    [("petrol-four", ["indicator", "excess_work", "crankpin_wear"]), ("v8-diesel", ["indicator", "piston_forces"])],
)
def test_curves_lie_between_those_of_machines_around(name, figures):
    asked = {"do": "ahead", "text": TEXTS[name], "key": "rod.ratio", "figures": figures}
    found = Studio("en").answer(asked)["ahead"]
    assert not set(figures) & set(found["behind"])
    values = np.array(found["values"])
    between = 0
    for at in (0.93, 1.13):
        ratio = float(values[2] * at)
        machine = crankwork.Description(TEXTS[name]).machine([f"rod.ratio={ratio!r}"])
        exact = drawings(crankwork.analyse(machine), language="en", only=set(figures))
        for figure in figures:
            for plot, drawn in zip(found["data"]["figures"][figure]["plots"], exact[figure].plots, strict=True):
                for curve, made in plot.get("curves", {}).items():
                    if "between" not in made:
                        continue
                    between += 1
                    x, y = (
                        np.array(rows * 5 if len(rows) == 1 else rows)
                        for rows in (made["between"][side] for side in "xy")
                    )
                    x, y = (
                        np.array([Polynomial.fit(values, column, 4)(ratio) for column in side.T]) for side in (x, y)
                    )
                    own = np.array(drawn.curves[curve])
                    own = own[:, np.isfinite(own).all(axis=0)]
                    size = [abs(high - low) for low, high in (drawn.x, drawn.y)]
                    is_seen = np.abs(y) < 2 * max(map(abs, drawn.y))
                    # every point lies upon the line of the exact curve, of which the scales are a sheet of 100 mm
                    apart = [
                        _apart(point, own / np.array(size)[:, None])
                        for point in np.array([x / size[0], y / size[1]])[:, is_seen].T
                    ]
                    assert max(apart) < 3e-3, (figure, curve, max(apart))
    assert between > 3


def _apart(point, line):
    """Return how far a point is from a line."""
    start, way = line[:, :-1], np.diff(line, axis=1)
    along = np.clip(((point[:, None] - start) * way).sum(axis=0) / np.maximum((way**2).sum(axis=0), 1e-30), 0, 1)
    return float(np.min(np.hypot(*(start + along * way - point[:, None]))))


def test_a_legend_follows_and_a_number_slid_beyond_the_machines_around_is_asked_for(seen):
    page = seen()
    page.select_option("#template", "engine")
    page.wait_for_selector('[data-name="kinematics"]')
    settled(page)
    page.select_option("#add", "torque")
    page.wait_for_selector('[data-name="torque"]')
    settled(page)
    page.locator('[data-slides="rod.length"]').hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false'")
    page.wait_for_function("() => globalThis.steps")
    drawn = page.locator("#film svg")
    stated = page.locator('[data-name="torque"] [data-curve=legend] + *').last.text_content()
    assert page.evaluate(HELD, ["rod.length", 0.2]) == "false"
    inside = drawn.inner_html()
    legend = page.locator('[data-name="torque"] [data-curve=legend] + *').last
    held = legend.text_content()
    assert "34.94" in stated != held
    slider = page.locator('[data-slides="rod.length"]')
    slider.dispatch_event("change")
    settled(page)
    # what is written of the mean torque is what the server writes
    assert legend.text_content() == held
    slider.hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false'")
    assert page.evaluate(HELD, ["rod.length", 0.4]) == "true"
    settled(page)
    assert drawn.inner_html() != inside
    page.locator('[data-slides="rod.length"]').dispatch_event("change")
    settled(page)


def test_a_number_held_beyond_the_last_machine_is_asked_for(seen):
    page = seen()
    page.select_option("#template", "four-bar")
    page.wait_for_selector('[data-name="links"]')
    settled(page)
    slider = page.locator('[data-slides="crank.radius"]')
    slider.hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false'")
    page.wait_for_function("() => globalThis.steps")
    assert page.evaluate(HELD, ["crank.radius", 0.2]) == "false"
    # a quarter more is the last that was analysed beforehand: half more does not turn
    assert page.evaluate(HELD, ["crank.radius", 0.06]) == "true"
    slider.dispatch_event("change")
    settled(page)


def test_a_machine_that_is_held_again_stands_upon_its_own_paper(seen):
    page = seen()
    page.locator('[data-slides="crank.radius"]').hover()
    ready = "() => document.body.dataset.prepares === 'false' && globalThis.steps"
    page.wait_for_function(ready)
    for held, waits in ((75, "false"), (50, "false"), (45, None)):
        if waits:
            page.wait_for_function(ready)
        asked = page.evaluate(MOVED, held)
        assert waits in (asked, None)
        page.wait_for_function("() => document.body.dataset.waits === 'false'")
        assert page.evaluate(RATIO) == pytest.approx(held / 175, rel=3e-3)
        page.locator('[data-slides="crank.radius"]').dispatch_event("change")
        settled(page)
        assert page.evaluate(RATIO) == pytest.approx(held / 175, rel=3e-3)


def test_a_slider_of_what_is_nothing_reaches_as_far_as_the_machine(seen):
    slider = seen().locator('[data-slides="fixed_points.C[2]"]')
    assert slider.input_value() == "0"
    assert [slider.get_attribute(one) for one in ("min", "max")] == ["-200", "200"]

"""An engine while a number is held: drawn between machines around it, as the server draws it once that is let go."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import crankwork
from crankwork.report.figures import drawings
from crankwork.studio.session import Session
from studio.hands import begin, hold, let_go, prepared, settled, slider_of, with_figure

EXAMPLES = Path(__file__).parents[2] / "examples"
TEXTS = {name: (EXAMPLES / f"{name}.toml").read_text("utf-8") for name in ("petrol-four", "v8-diesel")}
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


@pytest.mark.parametrize(
    ("name", "share", "diagram"), [("petrol-four", -0.15, "crankpin_load"), ("v8-diesel", 0.1, "rod_forces")]
)
def test_the_machine_and_its_diagrams_follow_a_held_ratio_without_asking(filed, name, share, diagram):
    page, _ = filed(TEXTS[name])
    with_figure(page, diagram)
    prepared(page, "rod.ratio")
    page.locator("#bar input[type=range]").evaluate("one => { one.value = 97; one.dispatchEvent(new Event('input')); }")
    assert hold(page, "rod.ratio", share=share) == "false"
    held, standing = (
        page.locator("#film [data-part]").evaluate_all(PARTS),
        page.locator("#film svg > path").evaluate_all(STANDING),
    )
    least = page.evaluate(LEAST, diagram)
    let_go(page, "rod.ratio")
    # a narrow dip is as deep
    assert least == pytest.approx(page.evaluate(LEAST, diagram), abs=0.6)
    let = page.locator("#film [data-part]").evaluate_all(PARTS)
    assert held.keys() == {one for one in let if "force" not in one}
    for part, values in numbers(held).items():
        # millimetres of a paper of 250
        assert values == pytest.approx(numbers(let)[part], abs=0.3), part
    ends = page.locator("#film svg > path").evaluate_all(STANDING)
    assert np.array(standing[: len(ends)]) == pytest.approx(np.array(ends[: len(standing)]), abs=0.3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "figures"),
    [("petrol-four", ["indicator", "excess_work", "crankpin_wear"]), ("v8-diesel", ["indicator", "piston_forces"])],
)
def test_curves_lie_between_those_of_machines_around(name, figures):
    text = TEXTS[name]
    found = Session("en").answer({"do": "ahead", "text": text, "key": "rod.ratio", "figures": figures})["ahead"]
    assert not set(figures) & set(found["behind"])
    values = np.array(found["values"])
    between = 0
    for at in (0.93, 1.13):
        ratio = float(values[2] * at)
        machine = crankwork.Description(text).machine([f"rod.ratio={ratio!r}"])
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
    # whose mean torque depends on the length of its rod
    page.locator("#text-tab").click()
    page.locator("#source").fill((EXAMPLES.parent / "tests/machines/points-engine.toml").read_text("utf-8"))
    page.wait_for_function("() => document.getElementById('results').innerText.includes('34.94')")
    settled(page)
    page.locator("#form-tab").click()
    with_figure(page, "torque")
    prepared(page, "rod.length")
    drawn = page.locator("#film svg")
    legend = page.locator('[data-name="torque"] [data-curve=legend] + *').last
    stated = legend.text_content()
    assert hold(page, "rod.length", share=0.2) == "false"
    inside, held = drawn.inner_html(), legend.text_content()
    assert "34.94" in stated != held
    let_go(page, "rod.length")
    # what is written of the mean torque is what the server writes
    assert legend.text_content() == held
    prepared(page, "rod.length")
    assert hold(page, "rod.length", share=-0.4) == "true"
    settled(page)
    assert drawn.inner_html() != inside


def test_a_machine_that_is_held_again_stands_upon_its_own_paper_and_beyond_the_last_is_asked_for(seen):
    page = seen()
    for held in (75, 50, 45):
        if held == 45:
            # sooner than it is prepared
            hold(page, "crank.radius", held)
            settled(page)
        else:
            prepared(page, "crank.radius")
            assert hold(page, "crank.radius", held) == "false"
        assert page.evaluate(RATIO) == pytest.approx(held / 175, rel=3e-3)
        let_go(page, "crank.radius")
        assert page.evaluate(RATIO) == pytest.approx(held / 175, rel=3e-3)
    begin(page, "four-bar")
    prepared(page, "crank.radius")
    assert hold(page, "crank.radius", share=0.2) == "false"
    # a quarter more is the last that was analysed beforehand: half more does not turn
    assert hold(page, "crank.radius", share=0.06) == "true"
    let_go(page, "crank.radius")


def test_a_slider_of_what_is_nothing_reaches_as_far_as_the_machine(seen):
    slider = slider_of(seen(), "fixed_points.C[2]")
    assert [slider.input_value(), *map(slider.get_attribute, ("min", "max"))] == ["0", "-200", "200"]

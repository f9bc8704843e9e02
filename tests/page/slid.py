"""Pages with sliders that are tested: their machines, the machines of their numbers, how a number is moved."""

from __future__ import annotations

import runpy
import sys
from functools import cache
from pathlib import Path

import pytest

import crankwork
from crankwork.page.document import page as written
from crankwork.study.sliders import moved

BULK = runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "bulk.py"))
ENGINE = BULK["ENGINE"].replace("compression_ratio = 9\n", 'compression_ratio = 9\noffset = "4 mm"\n')
EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES = {
    "engine": (ENGINE, ("crank.radius", "rod.length=150..230mm", "crank.speed=1000..6000rpm", "piston.mass")),
    "V8": (ENGINE + BULK["V8"], ("crank.speed", "rod.length=170..210mm", "piston.mass")),
    "four-bar": ("four-bar", ("crank.radius", "crank.speed", "links.coupler.length")),
    "six-bar": ("stephenson-six-bar", ("crank.radius", "crank.speed")),
    "spark-engine": ((EXAMPLES / "spark-engine.toml").read_text("utf-8"), ("crank.speed=1000..6000rpm", "rod.ratio")),
    # of which not everything follows
    "press": ((EXAMPLES / "press.toml").read_text("utf-8"), ("crank.speed",)),
    "parallelogram": ((EXAMPLES / "parallelogram.toml").read_text("utf-8"), ("crank.speed",)),
    "parallelogram's mass": ((EXAMPLES / "parallelogram.toml").read_text("utf-8"), ("links.coupler.centre[1]",)),
    # a jump that stands at a row of the tables, a diagram within another, one length, a cycle as long as its speed
    "steam": ((EXAMPLES / "double-acting-steam.toml").read_text("utf-8"), ("chambers.head.pieces[2].exponent",)),
    "loop": (
        (EXAMPLES.parent / "tests/machines/points-engine.toml").read_text("utf-8"),
        ("crank.radius", "crank.speed=1000..6000rpm"),
    ),
    "crank": ("four-bar", ("crank.radius",)),
    # of which nothing is tabulated
    "clutch": (
        (EXAMPLES.parent / "tests/machines/clutch-plates.toml").read_text("utf-8"),
        ("clutch.driving.speed=800..1200rpm",),
    ),
    "punch": ((EXAMPLES / "punching-machine.toml").read_text("utf-8"), ("crank.speed",)),
}
AXE = Path(sys.prefix) / "node" / "node_modules" / "axe-core" / "axe.min.js"
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'"
MOVE = """([at, value]) => {
  const slider = document.querySelector(`[data-field="${at}"]`);
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
}"""


@cache
def described(name):
    text = MACHINES[name][0]
    return crankwork.Description(text if "\n" in text else crankwork.template(text))


@cache
def live(name):
    description = described(name)
    return moved(description, MACHINES[name][1], (), crankwork.analyse(description.machine()))


@cache
def document(name, language):
    """Return a page with sliders, in which nothing may be made into script."""
    text = written(live(name).results[0], language, None, live(name)).decode()
    return text.replace("<head>", f'<head><meta http-equiv="Content-Security-Policy" content="{POLICY}">')


def results(name, shown):
    settings = [f"{one.key}={at!r} {one.unit}" for one, at in zip(live(name).sliders, shown, strict=True)]
    return crankwork.analyse(described(name).machine(settings))


def design(name, **shown):
    """Return what the fields of a page state, some of them, by key with `_` for `.`, something else."""
    return [shown.get(one.key.replace(".", "_"), one.shown(one.now)) for one in live(name).sliders]


def move(page, at, value):
    page.evaluate(MOVE, [at, value])


def shown(page, place):
    """Go to a diagram, or to `values` or `tables`, as a link does, and so to its tab; return where it stands."""
    place = place if place in ("values", "tables") else f"figure-{place}"
    page.evaluate("place => { location.hash = ''; location.hash = place; }", place)
    found = page.locator(f"#{place}")
    found.wait_for()
    return found


def rules_broken(page):
    """Return which rules of pages that everybody can read a page breaks, each with an element that does."""
    if not AXE.exists():
        pytest.skip("axe-core is not installed")
    page.evaluate(AXE.read_text("utf-8"))
    return page.evaluate("axe.run().then((found) => found.violations.map((one) => [one.id, one.nodes[0].html]))")

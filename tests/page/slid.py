"""Pages with sliders that are tested: their machines, the machines of their numbers, how a number is moved."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import crankwork
from crankwork.page.document import page as written
from crankwork.study.sliders import moved
from kernel.test_kernel import EIGHT, ENGINE

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES = {
    "engine": (ENGINE, ("crank.radius", "rod.length=150..230mm", "crank.speed=1000..6000rpm", "piston.mass")),
    "V8": (ENGINE + EIGHT, ("crank.speed", "rod.length=170..210mm", "piston.mass")),
    "four-bar": ("four-bar", ("crank.radius", "crank.speed", "links.coupler.length")),
    "six-bar": ("stephenson-six-bar", ("crank.radius", "crank.speed")),
    "spark-engine": ((EXAMPLES / "spark-engine.toml").read_text("utf-8"), ("crank.speed=1000..6000rpm", "rod.ratio")),
}
# of which not everything follows
PALE = {
    "press": ((EXAMPLES / "press.toml").read_text("utf-8"), ("crank.speed",)),
    "parallelogram": ((EXAMPLES / "parallelogram.toml").read_text("utf-8"), ("crank.speed",)),
    "parallelogram's mass": ((EXAMPLES / "parallelogram.toml").read_text("utf-8"), ("links.coupler.centre[1]",)),
}
# a jump that stands at a row of the tables, a diagram within another, a cycle as long as its speed makes it
OTHERS = {
    "steam": ((EXAMPLES / "double-acting-steam.toml").read_text("utf-8"), ("chambers.head.pieces[2].exponent",)),
    "loop": ("engine", ("crank.radius", "crank.speed=1000..6000rpm")),
    "punch": ((EXAMPLES / "punching-machine.toml").read_text("utf-8"), ("crank.speed",)),
}
MOVE = """([at, value]) => {
  const slider = document.querySelector(`[data-field="${at}"]`);
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
}"""


@cache
def described(name):
    text = (MACHINES | PALE | OTHERS)[name][0]
    return crankwork.Description(text if "\n" in text else crankwork.template(text))


@cache
def live(name):
    description = described(name)
    return moved(description, (MACHINES | PALE | OTHERS)[name][1], (), crankwork.analyse(description.machine()))


@cache
def document(name, language):
    one = live(name)
    return written(one.results[0], language, None, one).decode()


def results(name, shown):
    settings = [f"{one.key}={at!r} {one.unit}" for one, at in zip(live(name).sliders, shown, strict=True)]
    return crankwork.analyse(described(name).machine(settings))


def move(page, at, value):
    page.evaluate(MOVE, [at, value])

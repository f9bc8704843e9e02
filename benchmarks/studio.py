"""The studio in Chromium: from a slider to six diagrams drawn anew, a drag beside an empty page, memory, size.

Run with `python benchmarks/studio.py [NAME]` on a machine with nothing else to do; needs Playwright and Chromium.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

from crankwork.browser import script
from crankwork.description.machine_file import template
from crankwork.studio.server import styles

EXAMPLES = Path(__file__).parents[1] / "examples"
# a machine, its fields that are moved; what the six diagrams are asked to take [ms]
MOVED = {
    "four-bar": ("crank.radius", "crank.speed"),
    "slider-crank": ("crank.radius", "crank.speed"),
    "stephenson-six-bar": ("crank.radius", "links.coupler.length"),
    "engine": ("crank.speed", "rod.length"),
    "petrol-four": ("crank.speed", "piston.mass", "rod.ratio"),
    "v8-diesel": ("crank.speed", "piston.mass", "rod.ratio"),
}
# constructions, which have no curves
CONSTRUCTED = re.compile("(plans?|lever|centrodes|brix|tolle|indicator)$")
# machines that are dragged by a part of theirs, and played
DRIVEN = {"four-bar": "joint.A", "slider-crank": "joint.crank_pin", "stephenson-six-bar": "joint.A"}
MOVES, FRAMES, MANY = 60, 600, 10_000

# script and layout from an event to diagrams drawn anew, without the wait for the frame [ms]
TIMED = """async ([key, count]) => {
  const slider = document.querySelector(`[data-slides="${key}"]`);
  const rest = () => new Promise((done) => {
    if (document.body.dataset.waits !== "true") return done();
    const watch = new MutationObserver(() => {
      if (document.body.dataset.waits === "true") return;
      watch.disconnect();
      done();
    });
    watch.observe(document.body, { attributes: true, attributeFilter: ["data-waits"] });
  });
  const [from, step] = [slider.valueAsNumber, Number(slider.step)];
  const first = [], times = [];
  for (let k = 0; k < count; k += 1) {
    slider.value = from - step * (1 + k % 9);
    const start = performance.now();
    slider.dispatchEvent(new Event("input"));
    for (const one of document.querySelectorAll(".figures path, #film g")) one.getBBox();
    first.push(performance.now() - start);
    await rest();
    for (const one of document.querySelectorAll(".figures path, #film g")) one.getBBox();
    times.push(performance.now() - start);
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  }
  slider.value = from;
  slider.dispatchEvent(new Event("change"));
  await rest();
  const of = (all, share) => all.slice(10).sort((a, b) => a - b)[Math.floor(share * (count - 10))];
  return [of(first, 0.5), of(first, 0.95), of(times, 0.5), of(times, 0.95)];
}"""
# a joint dragged round a circle, one move a frame; how long frames were [ms]
DRAGGED = """async ([part, count]) => {
  const room = document.getElementById("film");
  const box = document.querySelector(`[data-part="${part}"]`).getBoundingClientRect();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const sent = (kind, dx, dy) => document.querySelector("#film svg").dispatchEvent(new PointerEvent(kind, {
    bubbles: true, cancelable: true, pointerId: 1, buttons: 1, clientX: x + dx, clientY: y + dy }));
  room.setPointerCapture = () => {};
  sent("pointerdown", 0, 0);
  const frames = [];
  let last = await new Promise(requestAnimationFrame);
  for (let k = 1; k <= count; k += 1) {
    sent("pointermove", -60 + 60 * Math.cos(k / 40), -60 * Math.sin(k / 40));
    const now = await new Promise(requestAnimationFrame);
    frames.push(now - last);
    last = now;
  }
  sent("pointerup", 0, 0);
  return frames;
}"""
CIRCLE = """<svg width="400" height="400"><circle r="9"/></svg>"""
TURNED = """async (count) => {
  const circle = document.querySelector("circle");
  const frames = [];
  let last = await new Promise(requestAnimationFrame);
  for (let k = 1; k <= count; k += 1) {
    circle.setAttribute("transform", `translate(${200 + 90 * Math.cos(k / 40)} ${200 + 90 * Math.sin(k / 40)})`);
    const now = await new Promise(requestAnimationFrame);
    frames.push(now - last);
    last = now;
  }
  return frames;
}"""
# the machine runs by itself, all diagrams with it
PLAYED = """async (count) => {
  document.getElementById("play").click();
  const frames = [];
  let last = await new Promise(requestAnimationFrame);
  for (let k = 1; k <= count; k += 1) {
    const now = await new Promise(requestAnimationFrame);
    frames.push(now - last);
    last = now;
  }
  document.getElementById("play").click();
  return frames;
}"""
MOVED_OFTEN = """async ([key, count]) => {
  const slider = document.querySelector(`[data-slides="${key}"]`);
  const [from, step] = [slider.valueAsNumber, Number(slider.step)];
  for (let k = 0; k < count; k += 1) {
    slider.value = from - step * (k % 9);
    slider.dispatchEvent(new Event("input"));
    if (k % 50 === 0) await new Promise((done) => setTimeout(done));
  }
}"""


@contextmanager
def studio(folder: Path, name: str) -> Generator[tuple[str, int]]:
    """Start the studio with a template or an example; its address with the token, its process."""
    path = EXAMPLES / f"{name}.toml"
    if not path.exists():
        path = folder / path.name
        path.write_text(template(name), encoding="utf-8")
    words = [sys.executable, "-m", "crankwork", "studio", str(path), "--no-browser"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as running:  # noqa: S603
        try:
            assert running.stdout is not None  # noqa: S101 - it is a pipe
            yield running.stdout.readline().strip(), running.pid
        finally:
            running.kill()


def opened(browser: Browser, address: str) -> Page:
    """Open the studio with six diagrams, or as many as the machine has."""
    page = browser.new_page(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
    page.goto(address)
    page.wait_for_selector(".figures svg")
    while (count := page.locator(".figures svg").count()) < 6:
        names = [one for one in page.locator("#add option").evaluate_all("all => all.map((one) => one.value)") if one]
        if not names:
            break
        page.select_option("#add", min(names, key=lambda name: bool(CONSTRUCTED.search(name))))
        page.wait_for_function("count => document.querySelectorAll('.figures svg').length > count", arg=count)
    page.wait_for_function("() => document.body.dataset.waits !== 'true'")
    return page


def prepared(page: Page, key: str) -> None:
    """Point at a slider, and wait until what it takes has come."""
    slider = page.locator(f'[data-slides="{key}"]')
    slider.scroll_into_view_if_needed()
    slider.hover()
    page.wait_for_function("() => document.body.dataset.prepares === 'false'", timeout=60_000)
    page.wait_for_timeout(300)


class Processor:
    """Processor time of pages and of a server, which other work on the machine does not lengthen. [ms]"""

    def __init__(self, browser: Browser, server: int) -> None:
        self._talk, self._server = browser.new_browser_cdp_session(), server
        self._before = self._now()

    def _now(self) -> tuple[float, float]:
        listed = self._talk.send("SystemInfo.getProcessInfo")["processInfo"]
        ticks = Path(f"/proc/{self._server}/stat").read_text("utf-8").rpartition(")")[2].split()[11:13]
        pages = sum(one["cpuTime"] for one in listed if one["type"] == "renderer")
        return 1e3 * pages, 1e3 * sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")

    def each(self, count: int) -> str:
        """Say how much each of some moves took since this was asked last."""
        before, self._before = self._before, self._now()
        page, server = ((now - was) / count for was, now in zip(before, self._before, strict=True))
        return f"processor {page:5.1f} ms in the page, {server:5.1f} ms in the server"


def latency(page: Page, name: str, keys: tuple[str, ...], processor: Processor) -> None:
    """Print how long it is from a slider to the diagrams."""
    for key in keys:
        prepared(page, key)
        processor.each(1)
        first, most, whole, at_most = page.evaluate(TIMED, [key, MOVES])
        taken = processor.each(MOVES)
        print(f"{name:18} {key:21} followed {first:5.1f}/{most:5.1f} ms, all {whole:5.1f}/{at_most:5.1f} ms; {taken}")


def frames(label: str, found: list[float], taken: str) -> None:
    """Print how long frames were."""
    listed = sorted(found[20:])
    within = sum(one < 20 for one in listed) / len(listed)
    rate = 1000 * len(listed) / sum(listed)
    print(f"{label:26} {rate:5.1f} a second, {100 * within:.1f} % under 20 ms, longest {listed[-1]:.1f} ms; {taken}")


def steadiness(page: Page, key: str) -> None:
    """Print how much memory is held after some moves, and after many."""
    talk = page.context.new_cdp_session(page)
    held = []
    prepared(page, key)
    for count in (MANY // 10, MANY):
        page.evaluate(MOVED_OFTEN, [key, count])
        page.wait_for_function("() => document.body.dataset.waits !== 'true'")
        talk.send("HeapProfiler.collectGarbage")
        held.append(talk.send("Runtime.getHeapUsage")["usedSize"] / 1e6)
    print(f"memory after {MANY // 10} moves {held[0]:.1f} MB, after {MANY} more {held[1]:.1f} MB")


def main(only: str) -> None:
    """Print every number."""
    program = next(one for one in ("chromium", "chromium-browser", "google-chrome") if shutil.which(one))
    size = len(script("studio").encode()) + len(styles().encode())
    print(f"script and style {size / 1000:.0f} kB; load of the machine {os.getloadavg()[0]:.1f}")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=shutil.which(program), args=["--no-sandbox"])
        for name, keys in MOVED.items():
            if not re.search(only, name):
                continue
            with studio(Path(folder), name) as (address, server):
                page, processor = opened(browser, address), Processor(browser, server)
                latency(page, name, keys, processor)
                if name in DRIVEN:
                    empty = browser.new_page()
                    empty.set_content(CIRCLE)
                    for _ in range(3):
                        for label, one, script_, arguments in (
                            ("empty page", empty, TURNED, FRAMES),
                            ("dragged", page, DRAGGED, [DRIVEN[name], FRAMES]),
                            ("played", page, PLAYED, FRAMES),
                        ):
                            one.bring_to_front()
                            processor.each(1)
                            found = one.evaluate(script_, arguments)
                            frames(f"{name} {label}" if one is page else label, found, processor.each(FRAMES))
                    empty.close()
                    steadiness(page, keys[0])
                page.close()
        browser.close()
    print(f"load of the machine {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")

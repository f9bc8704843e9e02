"""The moving drawing: its parts are where the motion says, and nothing leaves the picture at any angle."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork.description.machine_file import read
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.machine import Cylinder, Machine
from crankwork.mechanism.mechanism import RRP, Crank, Mechanism, slider_crank
from crankwork.quantities import LANGUAGES
from crankwork.report.drawing import moving_drawing

ROOT = Path(__file__).parents[2]
SVG = "{http://www.w3.org/2000/svg}"
FRAMES = 72
V_ENGINE = Mechanism(
    Crank(0.05, (0.02, -0.01), math.pi / 2, -1),
    (
        RRP("crank_pin", "left", "left_rod", 0.16, (0.02, -0.01), 3 * math.pi / 4),
        RRP("crank_pin", "right", "right_rod", 0.15, (0.02, -0.01), math.pi / 4),
    ),
)
MACHINES = {
    "engine": read(ROOT / "src" / "crankwork" / "description" / "templates" / "engine.toml"),
    "spark": read(ROOT / "examples" / "spark-engine.toml"),
    "offset": Machine(slider_crank(0.05, 0.13, 0.04), 100.0),
    "long": Machine(slider_crank(0.02, 0.4), 100.0, cylinder=Cylinder(0.01)),
    "short": Machine(slider_crank(0.05, 0.052), 100.0, cylinder=Cylinder(0.4, compression_ratio=1.5)),
    "lying": Machine(Mechanism(Crank(0.3), (RRP("crank_pin", "cross", "rod", 1.0),)), 10.0),
    "two rods": Machine(V_ENGINE, 100.0),
}


@pytest.fixture(params=MACHINES, name="machine")
def _machine(request):
    return MACHINES[request.param]


def _tree(machine, **options):
    return ET.fromstring(moving_drawing(machine, **options))  # noqa: S314 - our own text


def _track(element, name):
    """Return all values that an attribute takes, frame by frame."""
    for one in element.findall(f"{SVG}animate"):
        if one.get("attributeName") == name:
            return np.array([float(value) for value in one.get("values").split(";")])
    return np.full(FRAMES + 1, float(element.get(name)))


def _xy(element, x, y):
    return np.column_stack([_track(element, x), _track(element, y)])


def _scale(tree, machine):
    crank = next(one for one in tree.iter(f"{SVG}line") if one.get("class") == f"link {machine.mechanism.crank.link}")
    return float(np.hypot(*(_xy(crank, "x2", "y2") - _xy(crank, "x1", "y1")).T).mean() / machine.mechanism.crank.radius)


def test_links_lie_between_their_points_at_every_frame(machine):
    tree, crank = _tree(machine), machine.mechanism.crank
    moving = linkage_motion(machine.mechanism, CrankGrid.from_degrees(np.arange(FRAMES + 1) * 360 / FRAMES))
    scale = _scale(tree, machine)
    place = {name: scale * np.column_stack([one.x.position, -one.y.position]) for name, one in moving.points.items()}
    place["pivot"] = np.tile(scale * np.array([crank.pivot[0], -crank.pivot[1]]), (FRAMES + 1, 1))
    lines = {one.get("class").removeprefix("link "): one for one in tree.iter(f"{SVG}line")}
    ends = {crank.link: ("pivot", crank.pin)} | {one.link: (one.joint, one.slider) for one in machine.mechanism.dyads}
    assert lines.keys() == ends.keys()
    for name, (start, end) in ends.items():
        np.testing.assert_allclose(_xy(lines[name], "x1", "y1"), place[start], atol=0.1)
        np.testing.assert_allclose(_xy(lines[name], "x2", "y2"), place[end], atol=0.1)
    blocks = [one for one in tree.iter(f"{SVG}g") if (one.get("class") or "").startswith("block")]
    assert len(blocks) == len(machine.mechanism.dyads)
    for block in blocks:
        values = block.find(f"{SVG}animateTransform").get("values")
        track = np.array([[float(one) for one in pair.split()] for pair in values.split(";")])
        np.testing.assert_allclose(track, place[block.get("class").removeprefix("block ")], atol=0.1)


def test_nothing_leaves_the_picture(machine):
    tree = _tree(machine)
    left, top, width, height = map(float, tree.get("viewBox").split())
    reach = [_xy(one, "x1", "y1") for one in tree.iter(f"{SVG}line")]
    reach += [_xy(one, "x2", "y2") for one in tree.iter(f"{SVG}line")]
    reach += [_xy(one, "cx", "cy") + side * 6 for one in tree.iter(f"{SVG}circle") for side in (-1, 1)]
    reach += [_xy(one, "x", "y") + shift for one in tree.iter(f"{SVG}text") for shift in ((-8, -12), (8, 4))]
    reach += [_path(one) for one in tree.iter(f"{SVG}path")]
    for block in (one for one in tree.iter(f"{SVG}g") if (one.get("class") or "").startswith("block")):
        rect = block.find(f"{SVG}rect")
        x, y, w, h = (float(rect.get(name)) for name in ("x", "y", "width", "height"))
        turn = math.radians(float(rect.get("transform").removeprefix("rotate(").removesuffix(")")))
        corners = np.array([[x, y], [x + w, y], [x, y + h], [x + w, y + h]])
        corners @= np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
        values = block.find(f"{SVG}animateTransform").get("values").split(";")
        track = np.array([[float(one) for one in pair.split()] for pair in values])
        reach.append((track[:, None] + corners).reshape(-1, 2))
    places = np.vstack(reach)
    assert np.all(places >= [left, top])
    assert np.all(places <= [left + width, top + height])


def _path(element):
    """Return the absolute places of a path."""
    return np.array(re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", element.get("d")), dtype=float)


def test_one_revolution_closes_and_takes_the_time_asked_for(machine):
    tree = _tree(machine, seconds=2.5)
    moves = [*tree.iter(f"{SVG}animate"), *tree.iter(f"{SVG}animateTransform")]
    assert {one.get("dur") for one in moves} == {"2.5s"}
    for one in moves:
        values = one.get("values").split(";")
        assert one.get("calcMode") == "discrete" or (len(values) == FRAMES + 1 and values[0] == values[-1])


def test_the_readout_shows_one_angle_at_a_time():
    tree = _tree(MACHINES["engine"])
    (group,) = (one for one in tree.iter(f"{SVG}g") if one.get("class") == "angle")
    texts = group.findall(f"{SVG}text")
    assert ["".join(one.itertext()) for one in texts] == [f"φ = {angle}°" for angle in range(0, 360, 15)]
    assert [one.get("visibility") for one in texts].count("visible") == 1
    for share in (0.001, 0.3, 0.9999):
        assert sum(_visible(one.find(f"{SVG}animate"), share) for one in texts) == 1


def _visible(animation, share):
    times = [float(one) for one in animation.get("keyTimes").split(";")]
    assert times[0] == 0
    return animation.get("values").split(";")[np.searchsorted(times, share, side="right") - 1] == "visible"


def test_the_scale_bar_is_as_long_as_it_says():
    machine = MACHINES["engine"]
    tree = _tree(machine, language="ru")
    (bar,) = (one for one in tree.iter(f"{SVG}path") if one.get("class") == "scale")
    pixels = float(bar.get("d").split("h")[1].split("m")[0])
    (text,) = (one.text for one in tree.iter(f"{SVG}text") if (one.text or "").endswith(" мм"))
    assert float(text.removesuffix(" мм")) / 1e3 * _scale(tree, machine) == pytest.approx(pixels, abs=0.02)


@pytest.mark.parametrize("language", LANGUAGES)
def test_titles_are_kept_whatever_they_hold(language):
    machine = replace(MACHINES["engine"], title='A & B <c> "d" \U0001f600\x00\x0b\ud800')
    title = _tree(machine, language=language).findtext(f"{SVG}title")
    assert title.startswith('A & B <c> "d" \U0001f600: ')


def test_title_and_description_are_in_the_language():
    machine = replace(MACHINES["engine"], title="")
    trees = [_tree(machine, language=language) for language in LANGUAGES]
    assert len({tree.findtext(f"{SVG}title") for tree in trees}) == 3
    assert "радиус кривошипа 45 мм" in trees[1].findtext(f"{SVG}desc")


def test_there_is_no_script_and_nothing_is_fetched(machine):
    text = moving_drawing(machine)
    assert "script" not in text
    assert "href" not in text
    assert text.count("http") == 1
    assert len(text) < 40_000


@pytest.mark.parametrize(("seconds", "frames"), [(0.0, 72), (math.nan, 72), (4.0, 3)])
def test_nonsense_is_refused(seconds, frames):
    with pytest.raises(CrankworkError):
        moving_drawing(MACHINES["offset"], seconds=seconds, frames=frames)

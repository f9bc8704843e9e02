"""The moving drawing: its parts are where the motion says at every frame, on paper, in SVG and as data."""

from __future__ import annotations

import io
import json
import math
import re
import shutil
import sys
from dataclasses import replace
from functools import partial
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from crankwork import analyse
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.description.machine_file import read
from crankwork.errors import CrankworkError
from crankwork.machine import Cylinder, Machine
from crankwork.mechanism.mechanism import RRP, Crank, Mechanism, slider_crank
from crankwork.quantities import LANGUAGES
from crankwork.report.drawing import moving_drawing
from crankwork.show.animation import data
from crankwork.show.formats import FORMATS, gif, mp4
from crankwork.show.inline import inline_film
from crankwork.show.scene import ChartBox, Circle, Drawing, Polyline, extent, rectangle
from crankwork.show.svg import moving_svg, svg
from each import for_each
from shown import FILES, film_of_file, in_parts, machine_of, results_of

SVG = "{http://www.w3.org/2000/svg}"

V_ENGINE = Mechanism(
    Crank(0.05, (0.02, -0.01), math.pi / 2, -1),
    (
        RRP("crank_pin", "left", "left_rod", 0.16, (0.02, -0.01), 3 * math.pi / 4),
        RRP("crank_pin", "right", "right_rod", 0.15, (0.02, -0.01), math.pi / 4),
    ),
)

MACHINES = {
    "engine": machine_of("template engine"),
    "offset": Machine(slider_crank(0.05, 0.13, 0.04), 100.0),
    "long": Machine(slider_crank(0.02, 0.4), 100.0, cylinder=Cylinder(0.01)),
    "short": Machine(slider_crank(0.05, 0.052), 100.0, cylinder=Cylinder(0.4, compression_ratio=1.5)),
    "leaning": Machine(slider_crank(0.05, 0.13, 0.02), 100.0, cylinder=Cylinder(0.08, inclination=0.7)),
    "lying": Machine(Mechanism(Crank(0.3), (RRP("crank_pin", "cross", "rod", 1.0),)), 10.0),
    "two rods": Machine(V_ENGINE, 100.0),
}

# one cylinder, several in a row, and master with articulated rods; and one more of each
FEW, REST = ("spark-engine", "petrol-four", "radial-five"), ("v8-diesel", "narrow-v6", "two-stroke")
ENGINES = (*FEW, *REST)


def _engine(name):
    """Return results of an engine and its film."""
    return results_of(name, "exact"), film_of_file(name, "exact")


def _part(film, name):
    (found,) = (one for one in film.parts if one.name == name)
    return found


def _places(results):
    engine = results.machine.engine
    return engine.layout.places if engine else (None,)


def _column(results, key, degrees):
    """Return a column of every cylinder, from the formulas of one cylinder at its own crank angle."""
    if results.machine.engine is None:
        return results.columns_at(degrees, [key])[key][None]
    return multi_cylinder_engine(results.solved).each(key, degrees)


def _scale(film):
    """Return the millimetres of the paper in a metre, by the scale bar and what stands on it."""
    *_, bar, left, right, text = film.ground.items
    unit = {"mm": 1e-3}[text.text.split()[-1]]
    assert bar.points[1, 0] - bar.points[0, 0] == right.points[0, 0] - left.points[0, 0]
    return float(bar.points[1, 0] - bar.points[0, 0]) / (float(text.text.split()[0]) * unit)


@in_parts("name", FEW, REST)
def test_pistons_are_where_the_formulas_of_their_cylinder_say(name):
    results, film = _engine(name)
    degrees = np.mod(film.angles, results.machine.cycle)
    moved, scale = _column(results, "piston_displacement", degrees), _scale(film)
    shaft = next(one for one in film.parts if one.name.startswith("side.crank.")).shift[0]
    for at, place in enumerate(_places(results)):
        piston = _part(film, f"side.piston.{at + 1}")
        axis = math.radians(place.axis) if place else 0.0
        along = (piston.shift - shaft) @ np.array([math.sin(axis), math.cos(axis)]) / scale
        across = (piston.shift - shaft) @ np.array([math.cos(axis), -math.sin(axis)]) / scale
        offsets = results.machine.engine.offsets if place else ()
        np.testing.assert_allclose(across, offsets[at] if offsets else results.machine.lengths.offset, atol=1e-9)
        np.testing.assert_allclose(along[0] - along, moved[at] - moved[at, 0], atol=1e-7)
        assert piston.turn[0] == pytest.approx(90 - math.degrees(axis))
        outline = piston.items[0].points
        assert 0.97 * results.machine.cylinder.bore < np.ptp(outline[:, 1]) / scale < results.machine.cylinder.bore


@in_parts("name", FEW, REST)
def test_rods_reach_from_their_crankpin_to_their_piston_pin(name):
    results, film = _engine(name)
    scale, whole = _scale(film), results.machine.engine
    for at, place in enumerate(_places(results)):
        rod, piston = _part(film, f"side.rod.{at + 1}"), _part(film, f"side.piston.{at + 1}")
        articulated_rod = whole.articulated_rods[at] if whole and whole.articulated_rods else None
        length = articulated_rod.length if articulated_rod else results.machine.lengths.rod_length
        np.testing.assert_allclose(np.hypot(*(piston.shift - rod.shift).T), scale * length, rtol=1e-9)
        crank = _part(film, f"side.crank.{place.crankpin + 1 if place else 1}")
        for frame in (0, 13, 31, 55):
            eyes = [one.centre for one in rod.at(frame) if isinstance(one, Circle)]
            assert np.hypot(*(np.array(eyes) - piston.shift[frame]).T).min() < 1e-6
            carrier = _part(film, f"side.rod.{place.master}") if articulated_rod else crank
            pins = np.array([one.centre for one in carrier.at(frame) if isinstance(one, Circle)])
            assert np.hypot(*(pins - rod.shift[frame]).T).min() < 1e-6


@in_parts("name", FEW, REST)
def test_gas_fills_the_cylinder_as_high_as_its_volume(name):
    results, film = _engine(name)
    degrees, scale = np.mod(film.angles, results.machine.cycle), _scale(film)
    area, pressure = math.pi / 4 * results.machine.cylinder.bore**2, _column(results, "gas_pressure", degrees)
    volume = _column(results, "cylinder_volume", degrees)
    seen = [one for one in film.parts if ".gas." in one.name]
    assert {int(one.name.rpartition(".")[2]) for one in seen} >= {1, len(_places(results))}
    for one in seen:
        at = int(one.name.rpartition(".")[2]) - 1
        if not (results.machine.engine and results.machine.engine.articulated_rods):
            np.testing.assert_allclose(one.stretch, scale * volume[at] / area, rtol=2e-3)
        assert one.stretch.min() > 0
        # a row of equal pressures has no order
        assert np.all(np.diff(one.tint[np.argsort(pressure[at])]) > -1e-9)


@in_parts("name", FEW, REST)
def test_flashes_follow_the_firing_order_from_ignition_or_the_top_dead_centre(name):
    results, film = _engine(name)
    machine = results.machine
    timing = getattr(getattr(machine.gas, "calculated", None), "timing", None)
    advance = timing.ignition_advance if timing else 0.0
    begins = {}
    for one in film.parts:
        if ".flash." in one.name:
            starts = np.flatnonzero((one.tint[1:] > 0) & (one.tint[:-1] == 0)) + 1
            begins[int(one.name.rpartition(".")[2])] = starts[0] % film.frames
            piston = _column(results, "piston_displacement", np.mod(film.angles, machine.cycle))
            lowest = piston[int(one.name.rpartition(".")[2]) - 1][starts[0]]
            # the way of a piston without rod, as far before the dead centre
            assert lowest < 0.02 * piston.max() + 0.7 * (1 - np.cos(np.radians(advance))) * piston.max()
    order = sorted(begins, key=lambda number: (begins[number] - begins[1]) % film.frames)
    assert tuple(order) == (machine.engine.layout.firing_order if machine.engine else (1,))
    pressure = _column(results, "gas_pressure", np.mod(film.angles, machine.cycle))
    for number, start in begins.items():
        after = (np.argmax(pressure[number - 1]) - start) % film.frames
        assert advance - machine.cycle / film.frames < after * machine.cycle / film.frames < 30 + advance


@in_parts("name", FEW[1:2], ["v8-diesel", "narrow-v6", "two-stroke"])
def test_the_view_from_the_side_shows_every_cylinder_at_its_pitch(name):
    results, film = _engine(name)
    whole, scale = results.machine.engine, _scale(film)
    seen = {int(one.name.rpartition(".")[2]): one for one in film.parts if re.match(r"row\.\d+\.piston\.", one.name)}
    assert sorted(seen) == [one.number for one in whole.layout.places]
    first = whole.layout.places[0]
    for place in whole.layout.places:
        across = seen[place.number].shift[0, 0] - seen[first.number].shift[0, 0]
        assert across == pytest.approx(scale * (place.position - first.position), abs=1e-6)
        axis = math.radians(place.axis)
        side = _part(film, f"side.piston.{place.number}").shift @ np.array([math.sin(axis), math.cos(axis)])
        up = seen[place.number].shift[:, 1]
        np.testing.assert_allclose(up - up[0], side - side[0], atol=1e-9)


@in_parts("film", [*(partial(moving_drawing, one) for one in MACHINES.values()), partial(film_of_file, "petrol-four")],
          [partial(film_of_file, name) for name in ENGINES])  # fmt: skip
def test_nothing_leaves_the_picture(film):
    film = film()
    for frame in range(0, film.frames, 9):
        for one in map(extent, film.still(frame).items):
            assert min(one.left, one.bottom) >= 0
            assert one.right <= film.ground.width
            assert one.top <= film.ground.height


def _matrix(text):
    """Return what a transform in SVG or CSS does to points, as a matrix of shape (3, 3)."""
    found = np.eye(3)
    for name, inside in re.findall(r"(\w+)\(([^)]*)\)", text):
        values = [float(one) for one in re.findall(r"-?[\d.]+", inside)]
        one = np.eye(3)
        if name == "translate":
            one[:2, 2] = [values[0], values[1] if len(values) > 1 else 0.0]
        elif name == "rotate":
            turn = math.radians(values[0])
            one[:2, :2] = [[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]]
        else:
            one[0, 0] = values[0]
        found = found @ one
    return found


def _played(text, share):
    """Return the matrix of every part when a share of the time has passed, as a browser plays it."""
    tree, style = ET.fromstring(text), re.search(r"<style>(.*?)</style>", text.decode(), re.DOTALL)[1]  # noqa: S314
    time, delay = re.search(r"\.moves\{animation:([\d.]+)s linear (-?[\d.]+)s", style).groups()
    found = {}
    for group in tree.iter(f"{SVG}g"):
        if name := group.get("data-part"):
            inner = next(iter(group), None)
            moved = re.search(r"m\d+", inner.get("class") or "") if inner.tag == f"{SVG}g" else None
            own = re.search(r"-[\d.]+", inner.get("style") or delay)[0]
            at = (share + (float(delay) - float(own)) / float(time)) % 1
            shown = _step_at(style, moved[0], at) if moved else inner.get("transform") or ""
            found[name] = _matrix(group.get("transform")) @ _matrix(shown)
    return found


def _step_at(style, name, share):
    """Return the transform of a movement when a share of its time has passed."""
    body = re.search(rf"@keyframes {name}\{{(.*?)\}}\}}", style)[1]
    steps = [(float(at), how) for at, how in re.findall(r"([\d.]+)%\{(?:transform:)?([^;}]*)", f"{body}}}")]
    times = np.array([at for at, _ in steps]) / 100
    numbers = [[float(one) for one in re.findall(r"-?[\d.]+", how)] for _, how in steps]
    values = iter([np.interp(share, times, column) for column in np.transpose(numbers)])
    return re.sub(r"-?[\d.]+", lambda _: f"{next(values):.4f}", steps[0][1])


PLAYED = [(name, share) for name in ("spark-engine", "petrol-four", "radial-five") for share in (0.131, 0.5, 0.8765)]


@in_parts(("name", "share"), PLAYED[:1], [("spark-engine", 0.0), *PLAYED[1:]])
def test_a_browser_plays_what_the_frames_say(name, share):
    _, film = _engine(name)
    shown, at = _played(moving_svg(film), share), share * film.frames
    assert shown.keys() == {one.name for one in film.parts}
    for one in film.parts:
        if ".flash." in one.name:
            continue
        track = np.array([np.interp(at, np.arange(len(one.track)), column) for column in one.track.T])
        x, y, turn, stretch, _ = track
        turned = math.radians(turn)
        wanted = np.array([x, film.ground.height - y])
        # a tenth of a millimetre, also at the far end of what is stretched
        np.testing.assert_allclose(shown[one.name][:2, 2], wanted, atol=0.13, err_msg=one.name)
        end = wanted + stretch * np.array([math.cos(turned), -math.sin(turned)])
        np.testing.assert_allclose((shown[one.name] @ (1.0, 0.0, 1.0))[:2], end, atol=0.2, err_msg=one.name)


@for_each("name", ("engine", "two rods"))
def test_a_picture_moves_without_a_script_and_rests_where_motion_is_unwanted(name):
    film = moving_drawing(MACHINES[name], seconds=2.5, frames=40)
    text = moving_svg(film, "colour").decode()
    ET.fromstring(text)  # noqa: S314 - our own text
    assert "@keyframes m1{" in text
    assert "infinite" in text
    assert "@media (prefers-reduced-motion: reduce){.moves{animation-play-state:paused}}" in text
    assert "@media (prefers-color-scheme: dark){svg{fill:#e8e8e8}" in text
    assert '[fill="#ffffff"]{fill:#14171c}' in text
    assert "prefers-color-scheme" not in moving_svg(film, "dark").decode()
    assert film.seconds == pytest.approx(2.5 * film.angles[-1] / 360)
    assert film.frames == 40
    assert f".moves{{animation:{film.seconds:g}s linear" in text
    assert text.encode() == moving_svg(moving_drawing(MACHINES[name], seconds=2.5, frames=40), "colour")


def test_what_a_page_moves_by_itself_has_neither_style_nor_script():
    film = moving_drawing(MACHINES["engine"])
    text, told = inline_film(film, "machine"), json.loads(json.dumps(data(film)))
    assert "<style" not in text
    assert "<script" not in text
    assert "moves" not in text
    assert told["frames"] == 120 == len(told["readouts"]) == len(told["angles"]) - 1
    assert told["readouts"][1] == "φ = 6°"
    names = re.findall(r'data-part="?([^" ]+)"?', text)
    assert sorted(names) == sorted(told["parts"])
    piston = told["parts"]["side.piston.1"]
    assert piston.keys() == {"x", "y", "turn"}
    assert len(piston["y"]) == 121
    place = _part(film, "side.piston.1").shift[7, 1]
    assert piston["y"][7] == pytest.approx(film.ground.height - place, abs=0.01)
    assert told["parts"]["side.crank.1"]["turn"][-1] == pytest.approx(720 - 90)


@for_each("ending", FORMATS)
def test_every_format_takes_a_still(ending):
    assert len(FORMATS[ending](moving_drawing(MACHINES["engine"]).still(20), "print")) > 1000


@for_each("language", LANGUAGES)
def test_titles_are_kept_whatever_they_hold(language):
    machine = replace(MACHINES["engine"], title='A & B <c> "d" \U0001f600\x00\x0b\ud800')
    tree = ET.fromstring(moving_svg(moving_drawing(machine, language=language)))  # noqa: S314 - our own text
    assert tree.findtext(f"{SVG}title").startswith('A & B <c> "d" \U0001f600: ')


def test_names_of_parts_are_kept_whatever_they_hold():
    mechanism = Mechanism(Crank(0.3, link='<a "b">&'), (RRP("crank_pin", "c'<", "r>", 1.0),))
    tree = ET.fromstring(moving_svg(moving_drawing(mechanism)))  # noqa: S314 - our own text
    assert 'link.<a "b">&.1' in {one.get("data-part") for one in tree.iter(f"{SVG}g")}


def test_title_and_description_are_in_the_language():
    machine = replace(MACHINES["engine"], title="")
    tree = ET.fromstring(moving_svg(moving_drawing(machine, language="vi")))  # noqa: S314 - our own text
    assert tree.findtext(f"{SVG}title") == "Sơ đồ chuyển động của cơ cấu"
    assert "một vòng quay trong 4 s" in tree.findtext(f"{SVG}desc")


@for_each(("seconds", "frames"), [(0.0, 72), (math.nan, 72), (4.0, 3)])
def test_nonsense_is_refused(seconds, frames):
    with pytest.raises(CrankworkError):
        moving_drawing(MACHINES["offset"], seconds=seconds, frames=frames)


def _tip(film, name):
    """Return a force as it is drawn, from its foot to its tip, shape (n, 2). [mm]"""
    shaft, head = (_part(film, f"force.{name}.{of}") for of in ("shaft", "head"))
    return np.broadcast_to(head.shift, (len(film.angles), 2)) - shaft.shift


@for_each("name", ["double-acting-steam", "atkinson"])
def test_arrows_of_joint_forces_are_as_long_as_they_are_large(name):
    results = results_of(name)
    film = moving_drawing(results, forces=True, frames=48)
    forces = results.columns_at(film.angles % 360, ["joint_force.A"])["joint_force.A"]
    length = np.hypot(*_tip(film, "A").T)
    np.testing.assert_allclose(length / length.max(), forces / forces.max(), atol=1e-9)


@in_parts("name", ["spark-engine", "radial-five"], ["petrol-four"])
def test_arrows_of_forces_balance_at_the_piston_pin_and_at_the_crank(name):
    film = moving_drawing(results_of(name, "exact"), forces=True, frames=48)
    piston, wall, rod, across = (
        _tip(film, f"{key}.1") for key in ("piston_force", "side_force", "rod_force", "tangential_force")
    )
    size = np.hypot(*rod.T).max()
    assert 5 < size < 50
    # the wall pushes the piston back, and what is left goes through the rod
    np.testing.assert_allclose(piston - wall, rod, atol=1e-6 * size)
    crank = _part(film, "side.crank.1").shift[0]
    arm = _part(film, "side.rod.1").shift - crank
    with_rotation = np.column_stack([arm[:, 1], -arm[:, 0]]) / np.hypot(*arm.T)[:, None]
    pushed = np.sum(rod * with_rotation, axis=1)[:, None] * with_rotation
    np.testing.assert_allclose(across, pushed, atol=1e-6 * size)
    # a bar tells the scale of the arrows: on a screen a millimetre is none
    bar, *_, text = _part(film, "force.scale").items[:4]
    drawn_size, unit = float(np.ptp(bar.points[:, 0])), text.text.split()[-1]
    force = float(text.text.split()[0]) * {"N": 1.0, "kN": 1e3}[unit]
    largest = np.abs(_column(results_of(name, "exact"), "rod_force", film.angles)[0]).max()
    assert drawn_size / force == pytest.approx(size / largest, rel=0.02)
    told = [
        _part(film, f"force.{key}.1.text") for key in ("piston_force", "side_force", "rod_force", "tangential_force")
    ]
    assert [one.items[0].text for one in told] == ["/{F}_{P}", "/{F}_{N}", "/{F}_{Q}", "/{F}_{T}"]
    # a name stands beyond its arrow, and is not seen where there is none
    beyond = np.hypot(*(told[2].shift - _part(film, "force.rod_force.1.shaft").shift).T) - np.hypot(*rod.T)
    assert np.all(beyond[told[2].tint > 0] > 3)


@pytest.mark.slow
def test_a_gif_is_small_and_takes_the_time_of_the_film():
    film = film_of_file("atkinson")
    data = gif(film)
    assert len(data) < 3e6
    with Image.open(io.BytesIO(data)) as picture:
        assert picture.n_frames == film.frames
        assert picture.info["loop"] == 0
        times = []
        for at in range(film.frames):
            picture.seek(at)
            times.append(picture.info["duration"])
    assert sum(times) == pytest.approx(1000 * film.seconds, abs=10)


def test_a_film_goes_through_ffmpeg_frame_by_frame_where_there_is_one(tmp_path, monkeypatch):
    film = moving_drawing(MACHINES["offset"], frames=10)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CrankworkError, match="install it, or write GIF"):
        mp4(film)
    program = tmp_path / "ffmpeg"
    program.write_text(f"#!{sys.executable}\nimport sys\nsys.stdout.buffer.write(sys.stdin.buffer.read())\n", "utf-8")
    program.chmod(0o755)
    assert mp4(film).count(b"\x89PNG") == 10
    program.write_text(f"#!{sys.executable}\nimport sys\nsys.stderr.write('no codec')\nsys.exit(3)\n", "utf-8")
    with pytest.raises(CrankworkError, match="no codec; write GIF"):
        mp4(film)


def test_where_nothing_burns_nothing_flashes():
    results = analyse(read(FILES["petrol-four"], ["engine.misfire=[2]"]))
    flashes = {one.name for one in moving_drawing(results, frames=24).parts if ".flash." in one.name}
    assert flashes == {"side.flash.1", "row.1.flash.1", "row.1.flash.3", "row.1.flash.4"}
    names = {one.name for one in film_of_file("template compressor").parts}
    assert "side.gas.1" in names
    assert not any("flash" in one for one in names)


def test_what_is_filled_hides_outlines_beneath_it():
    boxes = [rectangle(ChartBox(at, 0.0, 4.0, 4.0), "medium", 1.0) for at in (0.0, 2.0)]
    text = svg(Drawing("t", "en", 10.0, 10.0, tuple(boxes))).decode()
    assert text.count("<path") == 2


def _walls_beside(film, along, middle, half):
    """Return from where to where the walls beside a piston go along its axis, from its middle. [mm]"""
    across, ends = np.array([-along[1], along[0]]), []
    for one in film.ground.items:
        if isinstance(one, Polyline) and len(one.points) == 2:
            seen, off = (one.points - middle) @ along, (one.points - middle) @ across
            if abs(np.ptp(off)) < 1e-6 and abs(abs(off[0]) - half) < 1.0 and np.ptp(seen) > half:
                ends.append(seen)
    assert len(ends) >= 2
    return min(min(one) for one in ends), max(max(one) for one in ends)


@in_parts("name", ["petrol-four", "double-acting-steam"], [*FEW, *REST, "opposed-pistons", "beta-stirling", "atkinson"])
def test_pistons_stay_in_their_bores(name):
    """At every angle, and their rods go through crossheads where gas is on both sides."""
    results, film = results_of(name), film_of_file(name)
    walled = {int(one.name.rpartition(".")[2]) for one in film.parts if one.name.startswith("side.gas.")}
    sliders = {face.slider for one in results.machine.chambers.values() for face in one.faces}
    names = [f"side.piston.{one}" for one in walled] or [f"block.{one}" for one in sliders]
    assert names
    for one in names:
        piston = _part(film, one)
        count = len(film.angles)
        tracks = [np.broadcast_to(track, (count, *track.shape[1:])) for track in (piston.shift, piston.turn)]
        outline, turn = piston.items[0].points, math.radians(float(tracks[1][0]))
        along = np.array([math.cos(turn), math.sin(turn)])
        low, high = _walls_beside(film, along, tracks[0][0], np.ptp(outline[:, 1]) / 2)
        moved = (tracks[0] - tracks[0][0]) @ along
        assert moved.min() + outline[:, 0].min() >= low - 0.5, one
        assert moved.max() + outline[:, 0].max() <= high + 0.5, one


@pytest.mark.slow
def test_a_gif_tells_how_much_of_it_is_done():
    told = []
    gif(moving_drawing(MACHINES["lying"], frames=24), progress=told.append)
    assert told == pytest.approx([10 / 24, 20 / 24, 1.0])


@pytest.mark.programs
def test_a_film_tells_how_much_of_it_is_done():
    if shutil.which("ffmpeg") is None:
        pytest.skip("there is no ffmpeg")
    told = []
    mp4(moving_drawing(MACHINES["lying"], frames=24), progress=told.append)
    assert told == pytest.approx([10 / 24, 20 / 24, 1.0])

"""The moving drawing of a linkage, link by link: joints, blocks, numbers, gas between pistons."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from crankwork.analysis.skeleton import skeleton
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import slider_crank
from crankwork.mechanism.structure import structure
from crankwork.mechanism.table_reader import linkage_from
from crankwork.report.drawing import moving_drawing
from crankwork.show.scene import Polyline, extent
from crankwork.show.svg import moving_svg
from each import for_each
from linkages import LINKAGES, SHAPER
from shown import film_of_file, in_parts, results_of

FRAMES = 24


# a slot carried by a link, a group of class III, and a slider that a slider carries
FEW = ("described shaper", "class III", "carried yoke")


@functools.cache
def _film_of(name):
    return moving_drawing(LINKAGES[name], frames=FRAMES)


def _parts(film, kind):
    """Return the parts of a kind by the rest of their names."""
    return {one.name.partition(".")[2]: one for one in film.parts if one.name.startswith(f"{kind}.")}


def _corners(part, frame):
    (outline,) = part.at(frame if len(part.shift) > 1 else 0)
    return outline.points


@in_parts("name", FEW, [name for name in LINKAGES if name not in FEW])
def test_joints_links_and_blocks_are_where_the_motion_says(name):
    linkage, film = LINKAGES[name], _film_of(name)
    shape = skeleton(linkage)
    moving = linkage_motion(linkage, CrankGrid.from_degrees(np.arange(FRAMES + 1) * 360 / FRAMES))
    joints = {name: np.broadcast_to(one.shift, (FRAMES + 1, 2)) for name, one in _parts(film, "joint").items()}
    pivot = next(name for name, at in shape.pivots.items() if at == linkage.crank.pivot)
    centre, pin = joints[pivot], joints[linkage.crank.pin]
    scale = np.hypot(*(pin - centre).T).mean() / linkage.crank.radius
    expected = {name: at for name, at in moving.points.items() if name in shape.letters and name not in shape.pivots}
    assert joints.keys() == {*expected, *shape.pivots}
    for joint, point in expected.items():
        place = np.column_stack([point.x.position, point.y.position]) - linkage.crank.pivot
        np.testing.assert_allclose(joints[joint] - centre, scale * place, atol=1e-6)
    _check_links(film, shape, joints)
    slots = {name.rpartition(".")[0]: one for name, one in _parts(film, "slot").items()}
    for member, block in _parts(film, "block").items():
        guide = shape.member(member).guide
        if guide.link:
            slot = slots[guide.link]
            turn = np.radians(slot.turn)
            along = np.sum((block.shift - slot.shift) * np.column_stack([np.cos(turn), np.sin(turn)]), axis=1)
            assert np.all(np.abs(along) < 0.96 * slot.items[0].points[:, 0].max())


def _check_links(film, shape, joints):
    """Check that links keep their length and end in their joints."""
    for name, link in _parts(film, "link").items():
        member = shape.member(name.rpartition(".")[0])
        for frame in (0, 5, 11, 20):
            nodes = _corners(link, frame)
            ends = [one for one in member.points if np.hypot(*(nodes - joints[one][frame]).T).min() < 1e-6]
            assert len(ends) >= min(1, len(member.points)), name
            first = _corners(link, 0)
            assert np.hypot(*(nodes[1] - nodes[0])) == pytest.approx(np.hypot(*(first[1] - first[0])))


@in_parts("name", FEW, [name for name in LINKAGES if name not in FEW])
def test_every_link_is_drawn_and_numbered_and_nothing_leaves_the_small_picture(name):
    film, shape = _film_of(name), skeleton(LINKAGES[name])
    names = [one.name.split(".") for one in film.parts]
    assert {one.name for one in shape.members} <= {one[1] for one in names if one[0] in {"link", "slot", "block"}}
    written = [one.items[0].text for one in _parts(film, "text").values()]
    assert sorted(int(one) for one in written if one.isdecimal()) == list(range(len(shape.members) + 1))
    for frame in range(0, FRAMES, 5):
        drawn = film.still(frame)
        for one in map(extent, drawn.items):
            assert min(one.left, one.bottom) >= 0
            assert one.right <= drawn.width
            assert one.top <= drawn.height
    text = moving_svg(film)
    assert text == moving_svg(moving_drawing(LINKAGES[name], frames=FRAMES))
    assert len(text) < 70_000


def test_numbers_follow_the_formula_of_structure():
    found, _ = structure(linkage_from(SHAPER)[0])
    members = skeleton(LINKAGES["described shaper"], found.links).members
    assert {one.name: one.number for one in members} == {"crank": 1, "lever": 2, "link": 3, "block": 4, "ram": 5}
    machine = Machine(LINKAGES["described shaper"], 10.0, linkage=linkage_from(SHAPER)[0])
    assert "4 – block" in moving_drawing(machine, frames=FRAMES).about


def test_points_keep_the_names_of_the_owner_and_catalog_points_get_letters():
    assert skeleton(LINKAGES["class III"]).letters == {name: name for name in "OABCDEF"}
    letters = skeleton(LINKAGES["slotted press"]).letters
    assert list(letters.values()) == ["O", "A", "B", "C", "D", "S2", "S3"]
    assert set(skeleton(slider_crank(0.05, 0.2)).letters.values()) == {"O", "A", "B"}


@for_each("name", ["opposed-pistons", "beta-stirling", "double-acting-steam"])
def test_gas_of_a_linkage_ends_at_its_pistons_and_heads(name):
    """The pistons move as their linkage says, the gas between them is as long as its volume says."""
    results, film = results_of(name), film_of_file(name)
    assert "block" in {one.name.partition(".")[0] for one in film.parts}
    pistons, gases = _parts(film, "block"), _parts(film, "gas")
    assert gases.keys() == results.machine.chambers.keys()
    for chamber, one in gases.items():
        faces = results.machine.chambers[chamber].faces
        turn = math.radians(one.turn[0])
        along = np.array([math.cos(turn), math.sin(turn)])
        ends = [one.shift @ along, one.shift @ along + one.stretch]
        sides = []
        for face in faces:
            body = pistons[face.slider]
            length = np.ptp(body.items[0].points[:, 0]) / 2
            sides += [body.shift @ along - length, body.shift @ along + length]
            assert np.ptp(body.items[0].points[:, 1]) == pytest.approx(np.ptp(one.items[0].points[:, 1]))
        for end in ends:
            touches = min(np.abs(end - side).max() for side in sides)
            # within a thousandth of a millimetre at every frame, or a head that stands
            assert touches < 1e-3 or (len(faces) == 1 and np.ptp(end) < 1e-3)
        pressure = results.columns_at(film.angles % 360, [f"gas_pressure.{chamber}"])[f"gas_pressure.{chamber}"]
        assert np.all(np.diff(one.tint[np.argsort(pressure)]) > -1e-9)


@in_parts("name", ["double-acting-steam", "atkinson"], ["opposed-pistons", "beta-stirling"])
def test_gas_of_a_linkage_is_darker_the_higher_its_pressure_in_all_its_chambers(name):
    """Of every still: what is filled between pistons, by the pressure that its chamber has at that angle."""
    results, film = results_of(name), film_of_file(name)
    keys = [f"gas_pressure.{one}" for one in results.machine.chambers]
    columns = results.columns_at(np.mod(film.angles[:-1], results.machine.cycle), keys)
    seen = []
    for frame in range(0, film.frames, 3):
        fills = [
            one.fill for one in film.still(frame).items[len(film.ground.items) :]
            if isinstance(one, Polyline) and one.name == "gas"
        ]  # fmt: skip
        seen += zip((columns[key][frame] for key in keys), fills, strict=True)
    fill = np.array(sorted(seen))[:, 1]
    assert np.all(np.diff(fill) < 1e-9)
    assert np.ptp(fill) > 0.5
    assert not any("flash" in one.name for one in film.parts)


def test_a_piston_with_gas_on_both_sides_has_a_rod_and_a_crosshead():
    film = film_of_file("double-acting-steam")
    parts = {one.name: one for one in film.parts}
    piston, head, rod, joint = (
        parts[name] for name in ("block.piston", "crosshead.piston", "link.piston.1", "joint.B")
    )
    np.testing.assert_allclose(head.shift, joint.shift, atol=1e-9)
    apart = np.hypot(*(piston.shift - joint.shift).T)
    assert np.ptp(apart) < 1e-9
    # no farther than the rod reaches, and the crosshead clear of the cylinder
    assert np.ptp(rod.items[0].points[:, 0]) == pytest.approx(apart[0] - np.ptp(piston.items[0].points[:, 0]) / 2)
    cover = max(
        one.points[:, 0].max() for one in film.ground.items if isinstance(one, Polyline) and one.kind == "thick"
    )
    assert head.shift[:, 0].min() + head.items[0].points[:, 0].min() > cover

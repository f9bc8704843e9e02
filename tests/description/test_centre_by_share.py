"""Centres of mass as sheets state them: a share of the length from the first joint."""

import pytest

import crankwork
from crankwork.errors import InputError
from each import for_each

# a shaking conveyor as sheets of Russian courses set it
CONVEYOR = """
[fixed_points]
O = ["0 mm", "0 mm"]
C = ["320 mm", "-160 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "80 mm"
speed = "75 rpm"
mass = "5 kg"
centre = CRANK
[links]
AB = { joins = ["A", "B"], length = "350 mm", mass = "7 kg", centre = ROD, inertia = "m l^2 / 12" }
CBD = { joins = ["C", "B", "D"], length = "220 mm", points.D = ["300 mm", "0 mm"], mass = "10 kg", centre = ROCKER }
DE = { joins = ["D", "E"], length = "700 mm", mass = "14 kg", centre = "E" }
[guides]
bed = { through = ["0 mm", "200 mm"] }
[sliders]
trough = { pin = "E", guide = "bed", mass = "450 kg" }
"""
SHARES = CONVEYOR.replace("CRANK", "0.25").replace("ROD", '"1/3"').replace("ROCKER", "0.6")
PLACES = (
    CONVEYOR.replace("CRANK", '["20 mm", "0 mm"]')
    .replace("ROD", f'["{350 / 3!r} mm", "0 mm"]')
    .replace("ROCKER", '["132 mm", "0 mm"]')
)


@for_each("changed", [{}, {"crank.radius": "90 mm", "links.AB.length": "360 mm", "links.AB.centre": 0.4}])
def test_a_share_is_that_of_the_length(changed: dict[str, object]) -> None:
    shares, places = crankwork.Description(SHARES), crankwork.Description(PLACES)
    shares.replace(changed)
    if changed:
        places.replace({
            "crank.radius": "90 mm", "links.AB.length": "360 mm", "links.AB.centre": ["144 mm", "0 mm"],
            "crank.centre": ["22.5 mm", "0 mm"],
        })  # fmt: skip
    one, other = (crankwork.analyse(stated.machine()).summary for stated in (shares, places))
    assert one == {key: pytest.approx(value, rel=1e-12, abs=1e-12) for key, value in other.items()}


def test_designs_of_a_share_are_those_of_places() -> None:
    swept = crankwork.sweep(crankwork.Description(SHARES), {"links.AB.centre": [0.2, 0.7]}, ["balancing_torque_max"])
    single = [
        crankwork.analyse(crankwork.read_machine(PLACES.replace(repr(350 / 3), place)))["balancing_torque_max"]
        for place in ("70", "245")
    ]
    assert swept.reason == ""
    assert swept.values["balancing_torque_max"] == pytest.approx(single, rel=1e-12)


def test_it_is_explained_and_the_length_of_a_link_with_three_joints_is_named() -> None:
    results = crankwork.analyse(crankwork.read_machine(SHARES))
    explained = results.explain("point_x.CBD.centre", 30).replace("\xa0", " ")
    assert "u_S,CBD = k_S,CBD·l_CBD = 0.6·0.22 = 0.132 m" in explained
    assert [(item.keys, item.names) for item in results.assumptions if item.code == "first_joints"] == [
        (("links.CBD.centre",), ("CB",))
    ]


MISTAKES = {
    "2e3": "links.AB.centre: 2000.0 is out of range; write a number from -10 to 10",
    '"middle"': "links.AB.centre: middle is not a point of AB; write a share of the length, as 0.5, one of A, B",
    "true": "links.AB.centre: ",
}


@for_each("written", list(MISTAKES))
def test_what_is_no_centre_is_rejected(written: str) -> None:
    text = CONVEYOR.replace("CRANK", "0.25").replace("ROD", written).replace("ROCKER", "0.6")
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(text)
    assert MISTAKES[written] in str(caught.value)


def test_a_missing_centre_is_asked_for_as_a_share_or_a_place() -> None:
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(SHARES.replace("centre = 0.6", 'inertia = "m l^2 / 12"'))
    assert "links.CBD.centre: is missing; give a share of the length, as 0.5 for the middle" in str(caught.value)

from crankwork.mechanism.catalog import crank_shaper, four_bar, scotch_yoke, watt_six_bar
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.joints import Pin, SlidingJoint, group_links, joints, links_of_points
from crankwork.mechanism.mechanism import Mechanism, slider_crank
from linkages import slotted_press


def shown(mechanism: Mechanism) -> list[str]:
    return [
        f"{one.name}: {one.link} on {one.other}" + (f" at {one.point}" if isinstance(one, Pin) and one.point else "")
        for one in joints(mechanism)
    ]


def test_a_four_bar():
    assert shown(four_bar(1, 3, 3, 3)) == [
        "crank_pivot: crank on ground",
        "crank_pin: coupler on crank at crank_pin",
        "coupler_pin: rocker on coupler at coupler_pin",
        "rocker_pivot: rocker on ground at rocker_pivot",
    ]


def test_every_mechanism_has_two_forces_per_joint_and_a_torque_for_three_equations_per_link():
    six_bar = watt_six_bar(four_bar(1, 3, 3, 3), (2, 1), 3, 3, (6, 0))
    for mechanism in (six_bar, crank_shaper(1, 3, 6, 2, 3), scotch_yoke(1), slotted_press(), slider_crank(1, 4)):
        links = 1 + sum(len(group_links(group)) for group in mechanism.dyads)
        assert 2 * len(joints(mechanism)) + 1 == 3 * links


def test_sliding_joints_know_their_carrier():
    assert shown(crank_shaper(1, 3, 6, 2, 3))[1:4] == [
        "crank_pin: block on crank at crank_pin",
        "block: block on lever",
        "lever_pivot: lever on ground at lever_pivot",
    ]
    assert SlidingJoint("ram", "ram", "ground") in joints(crank_shaper(1, 3, 6, 2, 3))


def test_two_links_on_one_pin_have_names_of_their_own():
    engine = slider_crank(1, 4)
    twin = RRP("crank_pin", "second_pin", "second_rod", 4.0)
    both = Mechanism(engine.crank, (*engine.dyads, twin))
    names = [one.name for one in joints(both)]
    assert names[1:3] == ["crank_pin_rod", "piston_pin"]
    assert "crank_pin_second_rod" in names


def test_a_shared_point_belongs_to_what_is_placed_first():
    bearer = links_of_points(watt_six_bar(four_bar(1, 3, 3, 3), (2, 1), 3, 3, (6, 0)))
    assert bearer["crank_pin"] == "crank"
    assert bearer["rocker_pivot"] == "ground"
    assert bearer["coupler_pin"] == "coupler"
    assert bearer["second_pin"] == "rocker"

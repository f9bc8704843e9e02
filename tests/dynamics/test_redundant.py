"""A link too many with a stated share: coupled wheels with three cranks against the equilibrium of every link."""

import math
import re

import numpy as np
import pytest

import crankwork
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES, in_language
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.web import web
from crankwork.report.summary import summary_text
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

WHEELS = """
fixed_points = { O = ["0 mm", "0 mm"], P = ["1000 mm", "0 mm"], Q = ["2200 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "300 mm", speed = "60 rpm" }
links.rod.joins = ["A", "B"]
links.rod.length = "1000 mm"
links.rod.points = { C = ["2200 mm", "0 mm"] }
links.rod.mass = "80 kg"
links.rod.inertia = "12 kg*m2"
links.rod.centre = ["900 mm", "40 mm"]
links.second = { joins = ["P", "B"], length = "300 mm", mass = "20 kg", inertia = "0.5 kg*m2", \
    centre = ["100 mm", "30 mm"] }
links.third = { joins = ["Q", "C"], length = "300 mm", share = SHARE, of = "second" }
loads = [
    { kind = "torque", link = "second", torque = ["-300 N*m"] },
    { kind = "force", point = "B", link = "rod", x = "500 N", y = "-900 N" },
]
method.weights = true
"""
UNSHARED = WHEELS.replace(', share = SHARE, of = "second"', "")


def with_fourth(text, share=""):
    """Return the text with a fourth wheel."""
    text = text.replace('Q = ["2200 mm", "0 mm"]', 'Q = ["2200 mm", "0 mm"], R = ["3000 mm", "0 mm"]')
    text = text.replace('C = ["2200 mm", "0 mm"]', 'C = ["2200 mm", "0 mm"], D = ["3000 mm", "0 mm"]')
    return text + f'links.fourth = {{ joins = ["R", "D"], length = "300 mm"{share} }}\n'


def by_equilibrium(angle, share):
    """Forces of the pins A, B on the rod, of the third crank on it along itself, and the torque of the crank.

    Twelve equations of four links and the share, thirteen unknowns: the reactions at O, A, B, P, C, Q, and the torque.
    """
    w, g = 2 * math.pi, 9.80665
    e = np.array([math.cos(angle), math.sin(angle)])
    pin, along_x = 0.3 * e, np.array([1.0, 0.0])
    names = ["O", "A", "B", "P", "C", "Q"]
    column = {name: 2 * k for k, name in enumerate(names)}
    places = {"O": 0 * e, "A": pin, "B": pin + along_x, "P": np.array([1.0, 0]), "C": pin + 2.2 * along_x,
              "Q": np.array([2.2, 0])}  # fmt: skip
    # each reaction acts on the first link, and against the second
    on = {"O": ("crank", None), "A": ("rod", "crank"), "B": ("rod", "second"), "P": ("second", None),
          "C": ("rod", "third"), "Q": ("third", None)}  # fmt: skip
    links = ["crank", "rod", "second", "third"]
    matrix, right = np.zeros((13, 13)), np.zeros(13)
    for name, (one, other) in on.items():
        x, y = places[name]
        for link, sign in ((one, 1), (other, -1)):
            if link:
                row = 3 * links.index(link)
                for axis in (0, 1):
                    matrix[row + axis, column[name] + axis] = sign
                matrix[row + 2, column[name]], matrix[row + 2, column[name] + 1] = -sign * y, sign * x
    matrix[2, 12] = 1.0

    def act(link, force, at=(0.0, 0.0), couple=0.0):
        row = 3 * links.index(link)
        right[row : row + 2] -= force
        right[row + 2] -= at[0] * force[1] - at[1] * force[0] + couple

    centre = pin + np.array([0.9, 0.04])
    act("rod", 80 * (w**2 * pin) + [0, -80 * g], centre)
    turned = 0.1 * e + 0.03 * np.array([-e[1], e[0]])
    act("second", 20 * w**2 * turned + [0, -20 * g], np.array([1.0, 0]) + turned)
    act("second", np.zeros(2), couple=-300.0)
    act("rod", np.array([500.0, -900.0]), places["B"])
    # along a crank towards its pin: what presses the rod away; the third has its share of the second
    matrix[12, column["C"] : column["C"] + 2] = e
    matrix[12, column["B"] : column["B"] + 2] = -share * e
    return np.linalg.solve(matrix, right)


@for_each("share", [0.5, 1.0, -0.2])
def test_every_joint_of_coupled_wheels_with_three_cranks(share):
    results = analysed(WHEELS.replace("SHARE", str(share)))
    for degrees in (12.0, 30.0, 77.0, 90.0, 144.0, 201.0, 300.0, 359.0):
        o_x, o_y, a_x, a_y, b_x, b_y, p_x, p_y, c_x, c_y, _, _, torque = by_equilibrium(math.radians(degrees), share)
        size = max(map(abs, (a_x, a_y, b_x, b_y, c_x, c_y)))
        found = {key: results.value(key, at=degrees) for key in
                 ("joint_force.O", "joint_force.A", "joint_force.B", "joint_force.P", "axial_force.third",
                  "balancing_torque")}  # fmt: skip
        wanted = {
            "joint_force.O": math.hypot(o_x, o_y), "joint_force.A": math.hypot(a_x, a_y),
            "joint_force.B": math.hypot(b_x, b_y), "joint_force.P": math.hypot(p_x, p_y),
            "axial_force.third": c_x * math.cos(math.radians(degrees)) + c_y * math.sin(math.radians(degrees)),
            "balancing_torque": torque,
        }  # fmt: skip
        assert found == pytest.approx(wanted, abs=1e-12 * size), degrees
        ratio = found["axial_force.third"] / results.value("axial_force.second", at=degrees)
        assert ratio == pytest.approx(share, rel=1e-10)
    assert not results.unmet
    assert results.value("mobility") == 0.0
    assert [one.values["name"] for one in results.notices if one.code == "redundant"] == ["third"]


def test_four_coupled_wheels_share_at_once():
    """Two links too many, each with its share; the rod with all four is in balance about A."""
    results = analysed(with_fourth(WHEELS.replace("SHARE", "0.5"), ', share = 0.25, of = "second"'))
    assert results.value("mobility") == -1.0
    for degrees in (20.0, 77.0, 250.0):
        along = [results.value(f"axial_force.{name}", at=degrees) for name in ("second", "third", "fourth")]
        assert along[1:] == pytest.approx([0.5 * along[0], 0.25 * along[0]], rel=1e-10)
        # moment about A of what bears on the rod: its own weight and inertia, the force at B, and the pins
        angle, w = math.radians(degrees), 2 * math.pi
        e = np.array([math.cos(angle), math.sin(angle)])
        own = 80 * w**2 * 0.3 * e + [0, -80 * 9.80665]
        b = [results.value(f"joint_force_{axis}.B", at=degrees) for axis in "xy"]
        # the joint force at B holds the second crank
        moment = 0.9 * own[1] - 0.04 * own[0] - 900.0 - b[1] + e[1] * (2.2 * along[1] + 3.0 * along[2])
        assert moment == pytest.approx(0.0, abs=1e-9 * abs(b[1]))


@for_each("language", LANGUAGES)
def test_it_is_told_and_explained(language):
    results = analysed(WHEELS.replace("SHARE", "0.5"))
    assert "third" in summary_text(results, language=language)
    explained = results.explain("axial_force.third", at=40, language=language)
    assert re.search("second", explained)
    assert not re.search(r"[{}]|None|nan", explained)
    assert "third" in web(note_of(results, NoteOptions(full=True, language=language, figures=False))).decode()


def test_without_a_share_everything_but_joint_forces_is_known():
    """The link does no work: torques are those with any share, and the motion."""
    shared = analysed(WHEELS.replace("SHARE", "0.5"))
    results = analysed(UNSHARED)
    assert [one.values["name"] for one in results.notices if one.code == "redundant_unshared"] == ["third"]
    assert results.value("mobility") == 0.0
    assert not results.unmet
    # and what bearings bear
    forces = ("joint_force", "axial_force", "normal_force", "crankpin_", "main_journal_load")
    assert not [key for key in results.columns if key.startswith(forces)]
    assert set(results.columns) == {key for key in shared.columns if not key.startswith(forces)}
    for key, column in results.columns.items():
        # rounding has no relative error
        size = max(1e-3, float(np.max(np.abs(shared[key]))))
        assert column == pytest.approx(shared[key], abs=1e-9 * size), key
    for language in LANGUAGES:
        assert "third" in web(note_of(results, NoteOptions(full=True, language=language, figures=False))).decode()


def test_two_links_too_many_without_shares():
    results = analysed(with_fourth(UNSHARED))
    assert {one.values["name"] for one in results.notices if one.code == "redundant_unshared"} == {"third", "fourth"}


MISTAKES = {
    "no other": (', of = "second"', "", "links.third.of", 'like of = "rod"'),
    "no share": (", share = SHARE", "", "links.third.share", "like share = 0.5"),
    "a mass": ('of = "second"', 'of = "second", mass = "2 kg", centre = "C"', "links.third.mass", "taken without mass"),
    "nobody": ('of = "second"', 'of = "sec"', "links.third.of", "there is rod, second"),
    "a link of three joints": ('of = "second"', 'of = "rod"', "links.third.of", "rod has not two joints"),
    "too long": ('joins = ["Q", "C"], length = "300 mm"', 'joins = ["Q", "C"], length = "310 mm"', "links.third",
                 "and does not fit"),
    "not one too many": ('links.rod.points = { C = ["2200 mm", "0 mm"] }\n', "", "links.third.share",
                         "third has not two joints"),
    "shares of all": ("SHARE", "1e4", "links.third.share", "1000"),
}  # fmt: skip


@for_each(("old", "new", "key", "advice"), MISTAKES.values(), ids=MISTAKES)
def test_what_cannot_be_shared_is_told(old, new, key, advice):
    with pytest.raises(CrankworkError) as caught:
        crankwork.read_machine(WHEELS.replace(old, new, 1).replace("SHARE", "0.5"))
    problem = next(one for one in caught.value.problems if one.key == key)
    assert advice in problem.message
    assert all(in_language(problem.message, language) for language in LANGUAGES)


def test_a_link_that_is_needed_has_no_share():
    text = WHEELS.replace("SHARE", "0.5")
    text = re.sub(r"links\.third = .*\n", "", text)
    text = text.replace('joins = ["P", "B"]', 'share = 1.0, of = "rod", joins = ["P", "B"]')
    with pytest.raises(CrankworkError, match=r"links\.second\.share: second is not one link too many"):
        crankwork.read_machine(text)

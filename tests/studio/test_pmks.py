"""What PMKS+ 2.0.3 shares of its own templates, told by hand from its text: 0 before a number means minus, base 64."""

from __future__ import annotations

import math
import string

import pytest

import crankwork
from crankwork.errors import CrankworkError
from crankwork.studio.session import is_share, opened_share
from crankwork.studio.sketch import from_pmks

DIGITS = string.digits + string.ascii_uppercase + string.ascii_lowercase + "_-"
FOUR_BAR = (
    "0P.TY.K,0.101.MA,A,0mv,0VU,0.GB,B,0e_,E6,0.GC,C,l1,WW,0.KD,D,qD,0Pk,0..YRAB,AB,Fe,Fe,0ix,08i,c5cae9,A,B,,."
    "YRBC,BC,Fe,Fe,32,NJ,303e9f,B,C,,.YRCD,CD,Fe,Fe,nd,3P,0d125a,C,D,,...JBq"
)
WATT = (
    "0P.TY.K,0.101.MA,A,0Qh,0Kn,0.GB,B,0e1,9i,0.GC,C,bT,LF,0.GD,D,0G5,tZ,0.GE,E,V5,1_z,0.GF,F,1mM,1Gv,0."
    "KG,G,1rt,0ey,0..YRAB,AB,Fe,Fe,0XM,05Z,c5cae9,A,B,,.YRBCD,BCD,Fe,Fe,06D,Sr,303e9f,B,C,D,,."
    "YRDE,DE,Fe,Fe,7W,1RG,0d125a,D,E,,.YREF,EF,Fe,Fe,17j,1dx,B2DFDB,E,F,,."
    "YRFCG,FCG,Fe,Fe,1PE,KQ,26A69A,F,C,G,,...JAp"
)
STEPHENSON = (
    "0P.TY.K,0.101.MA,A,0YP,0ce,0.GB,B,0cQ,0FI,0.GC,C,lC,1-,0.KD,D,ow,0U1,0.GE,E,033,D-,0.GF,F,Dc,nj,0."
    "KG,G,1M0,GJ,0..YRAB,AB,Fe,Fe,0aP,0Qz,c5cae9,A,B,,.YRBCE,BCE,Fe,Fe,1w,E,303e9f,B,C,E,,."
    "YRCD,CD,Fe,Fe,n3,0E1,0d125a,C,D,,.YREF,EF,Fe,Fe,5H,Vs,B2DFDB,E,F,,.YRFG,FG,Fe,Fe,np,X0,26A69A,F,G,,...JBe"
)
WATT_II = (
    "0P.TY.K,0.101.MA,A,0Vf,0Vd,0.GB,B,0mZ,08A,0.GC,C,06Y,LC,0.GD,D,1MR,J2,0.KE,E,rw,0j2,0.GF,F,2ic,ID,0."
    "KG,G,2lk,0Zt,0..YRAB,AB,Fe,Fe,0e6,0Ju,c5cae9,A,B,,.YRBC,BC,Fe,Fe,0RY,6X,303e9f,B,C,,."
    "YRCDE,CDE,Fe,Fe,ic,01d,0d125a,C,D,E,,.YRDF,DF,Fe,Fe,21X,Id,B2DFDB,D,F,,.YRFG,FG,Fe,Fe,2kA,08r,26A69A,F,G,,...JBm"
)
# the driving link has three joints
STEPHENSON_I = (
    "0P.cc.K,0.101.Ma,a,r,0,0.Gb,b,96,1X0,0.Gc,c,1co,R0,0.Gd,d,2N7,2l1,0.Ge,e,4Yl,1T9,0.Gf,f,2zK,xY,0."
    "Kg,g,3tC,0Pw,0..YRabc,abc,Fe,Fe,ba,fM,c5cae9,a,b,c,,.YRbd,bd,Fe,Fe,1G6,280,303e9f,b,d,,."
    "YRde,de,Fe,Fe,3Sx,265,c5cae9,d,e,,.YRefg,efg,Fe,Fe,3oQ,gG,303e9f,e,f,g,,.YRfc,fc,Fe,Fe,2I3,hH,0d125a,f,c,,..j"
)
SLIDER_CRANK = (
    "0P.TY.K,0.101.MA,A,0mA,0c,0.GB,B,0Yt,bK,0.GC,C,il,H-,0.LD,D,il,H-,0..YRAB,AB,Fe,Fe,0fW,IN,c5cae9,A,B,,."
    "YRBC,BC,Fe,Fe,4y,Rf,303e9f,B,C,,.YPCD,CD,Fe,0,0,0,,C,D,,...JAe"
)
FORCE = (
    "0v.cc.K,0.101.Ma,a,0,0,0.Gb,b,fk,1Jz,0.Gc,c,2o7,1sD,0.Kd,d,3Qm,0,0..YRab,Crank,Fe,Fe,Kt,f-,c5cae9,a,b,,."
    "YRbc,Coupler,Fe,Fe,1jw,1b5,303e9f,b,c,,.YRcd,Follower,Fe,Fe,36S,x7,c5cae9,c,d,,.."
    "2F1,bc,F1,1AR,1SH,1AR,JF,Fe.R"
)


def analysed(word):
    return crankwork.analyse(crankwork.Description(from_pmks(word, "en")).machine())


@pytest.mark.parametrize(
    ("word", "points"),
    [
        (FOUR_BAR, {"B": (-2.622, 0.902), "C": (3.009, 2.080)}),
        (WATT, {"B": (-2.561, 0.620), "C": (2.397, 1.359), "D": (-1.029, 3.555), "E": (1.989, 8.125),
                "F": (7.190, 5.177)}),
        (STEPHENSON, {"B": (-2.458, -0.978), "C": (3.020, 0.127), "E": (-0.195, 0.895), "F": (0.870, 3.181)}),
        (WATT_II, {"B": (-3.107, -0.522), "C": (-0.418, 1.356), "D": (5.531, 1.218), "F": (11.046, 1.165)}),
        (STEPHENSON_I, {"b": (0.582, 6.208), "c": (6.578, 1.728), "d": (9.671, 11.201), "e": (18.607, 5.961),
                        "f": (12.116, 3.810)}),
        (SLIDER_CRANK, {"B": (-2.231, 2.388), "C": (2.863, 1.151)}),
    ],
)  # fmt: skip
def test_unit_speed_and_branch_are_those_of_the_template(word, points):
    # not every crank turns fully
    found = crankwork.analyse(crankwork.Description(from_pmks(word, "en")).machine(), [0.0])
    for name, at in points.items():
        # as PMKS+ writes them: thousandths of a centimetre
        assert [found[f"point_{axis}.{name}"][0] for axis in "xy"] == pytest.approx(
            [0.01 * one for one in at], abs=2e-6
        )
    assert found.summary["rotational_speed"] == pytest.approx(20 * math.tau / 60)


def test_it_turns_clockwise_as_its_velocities_say():
    # v_B = omega x AB with AB = (0.851, 2.426) cm; along BC = (5.094, -1.237) cm both ends are as fast
    found = analysed(SLIDER_CRANK)
    assert found["point_velocity_x.B"][0] == pytest.approx(0.050810, rel=1e-4)
    assert found["point_velocity_y.B"][0] == pytest.approx(-0.017823, rel=1e-4)
    assert found["point_velocity_x.C"][0] == pytest.approx(0.055138, rel=1e-4)


def test_a_force_is_read_with_its_link():
    text = from_pmks(FORCE, "en")
    # 1 N downward, at 4.699, 5.585 cm
    assert 'point = "F1"\nx = "0 N"\ny = "-1 N"' in text
    assert "mass" not in text


@pytest.mark.parametrize("changed", [FOUR_BAR[:-9], FOUR_BAR.replace("0mv", "0m!"), FOUR_BAR.replace("MA,A", "KA,A")])
def test_what_is_damaged_or_has_no_input_is_refused(changed):
    with pytest.raises(CrankworkError, match="PMKS"):
        from_pmks(changed, "en")


def test_links_files_and_words_are_told_from_names_of_files():
    assert all(map(is_share, (FOUR_BAR, f"https://app.pmksplus.com/?{FOUR_BAR}", "crankwork:abc")))
    files = ("machine.toml", "../a.b/c.d.e.toml", "my.long.name.of.a.toml", "[crank]\nradius = 1")
    assert not any(map(is_share, files))
    assert "clockwise" in opened_share(f"https://app.pmksplus.com/?{FOUR_BAR}")


def word(number):
    """Return a number of thousandths as PMKS+ writes it."""
    digits, left = "", round(1000 * abs(number))
    while left or not digits:
        left, one = divmod(left, 64)
        digits = DIGITS[one] + digits
    return "0" * (number < 0) + digits


def shared(joints, links, forces=()):
    """Return what PMKS+ shares of joints (flags, name, x, y, angle), of links and of forces as it writes them."""
    told = [DIGITS[flags] + ",".join([name, name, *map(word, numbers)]) for flags, name, *numbers in joints]
    text = ".".join(["0P", "TY", "K,0", "101", *told, "", *links, "", *forces, "", "N_"])
    return text + DIGITS[len(text) % 62]


def link(name, mass, inertia, x, y, subset=""):
    """Return a link that joins the joints of its name."""
    return f"YR{name},{name},{','.join(map(word, (mass, inertia, x, y)))},303e9f,{','.join(name)},,{subset}"


# flags: 1 slides, 2 drives, 4 ground, 8 welded
BENT = [(6, "A", 0, 0, 0), (0, "B", 0, 2, 0), (8, "F", 3, 4, 0), (0, "C", 6, 2, 0), (4, "D", 6, -3, 0)]
CRANK, ROCKER = link("AB", 1, 1, 0, 1), link("CD", 1, 1, 6, 0)


def test_what_is_welded_in_a_joint_is_one_rigid_link():
    whole = link("BFC", 5, 10.8, 3.3, 3, "BF,FC")
    pieces = [link("BF", 2, 0, 1.5, 3), link("FC", 3, 0, 4.5, 3)]
    # as it is shared, pieces beside the whole; and pieces that a joint only says are welded
    beside = [one.replace("YR", "NR") for one in pieces]
    texts = [from_pmks(shared(BENT, [CRANK, *links, ROCKER]), "en") for links in ([whole, *beside], pieces)]
    for text, name in zip(texts, ("BFC", "BF"), strict=True):
        found = crankwork.Description(text).values["links"]
        assert found.keys() == {name, "CD"}
        # 5 kg at 3.3, 1 cm; 2 * 1.8^2 + 3 * 1.2^2 about it
        assert found[name] == {
            "joins": ["B", "C"], "length": "6 cm", "points": {"F": ["3 cm", "2 cm"]},
            "mass": "5 kg", "inertia": "10.8 kg*cm2", "centre": ["3.3 cm", "1 cm"],
        }  # fmt: skip
        assert crankwork.analyse(crankwork.Description(text).machine()).checks


def test_links_without_mass_are_welded_too():
    pieces = [link("BF", 0, 0, 1.5, 3), link("FC", 0, 0, 4.5, 3)]
    found = crankwork.Description(from_pmks(shared(BENT, [CRANK, *pieces, ROCKER]), "en")).values["links"]["BF"]
    assert (found["mass"], found["centre"]) == ("0 kg", ["3 cm", "1 cm"])


def test_a_slider_that_is_welded_and_a_second_input_are_refused_by_name():
    joints = [(6, "A", 0, 0, 0), (0, "B", 0, 2, 0), (8, "C", 6, 1, 0), (5, "D", 6, 1, 0.524)]
    piston = link("CD", 1, 0, 0, 0).replace("YR", "YP")
    with pytest.raises(CrankworkError, match="joint C of PMKS"):
        from_pmks(shared(joints, [CRANK, link("BC", 1, 1, 3, 1), piston]), "en")
    joints[2:3] = [(0, "C", 6, 1, 0)]
    text = from_pmks(shared(joints, [CRANK, link("BC", 1, 1, 3, 1), piston]), "en")
    # 524 thousandths of a radian
    assert crankwork.Description(text).values["guides"]["g1"]["angle"] == "30 deg"
    two = [(6, *BENT[0][1:]), *BENT[1:4], (6, *BENT[4][1:])]
    with pytest.raises(CrankworkError, match="joints A, D of PMKS"):
        from_pmks(shared(two, [CRANK, link("BFC", 1, 1, 3, 2), ROCKER]), "en")


@pytest.mark.parametrize("local", [0, 1])
def test_a_force_on_a_piece_acts_on_the_link_that_it_is_welded_into(local):
    pieces = [link("BF", 1, 1, 1.5, 3), link("FC", 1, 1, 4.5, 3)]
    force = ",".join([f"{local}F1", "FC", "F1", *map(word, (4.5, 3, 4.5, 2, 7))])
    text = from_pmks(shared(BENT, [CRANK, *pieces, ROCKER], [force]), "en")
    found = crankwork.Description(text).values
    assert found["links"]["BF"]["points"]["F1"] == ["4.5 cm", "1 cm"]
    assert found["loads"] == [{"kind": "force", "point": "F1", "x": "0 N", "y": "-7 N"}]
    assert text.startswith("# forces that turn with their links") == bool(local)

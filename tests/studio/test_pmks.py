"""What PMKS+ 2.0.3 shares of its own templates, told by hand from its text: 0 before a number means minus, base 64."""

from __future__ import annotations

import math

import pytest

import crankwork
from crankwork.errors import CrankworkError
from crankwork.studio.answers import is_share, opened_share
from crankwork.studio.pmks import from_pmks

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
        (SLIDER_CRANK, {"B": (-2.231, 2.388), "C": (2.863, 1.151)}),
    ],
)  # fmt: skip
def test_unit_speed_and_branch_are_those_of_the_template(word, points):
    found = analysed(word)
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

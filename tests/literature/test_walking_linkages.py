"""Walking linkages from machine files, from stated positions on the stated branch.

Jansen's leg with his lengths (strandbeest.com/explains; University of Texas, wiki page 51061060): all joints at twelve
crank angles and the extent of the foot, from intersections of circles at 40 digits. Chebyshev's lambda linkage with the
proportions 1, 2, 2.5, 2.5 and its tracer at 5. Klann's six-bar with the coordinates of the example leg of US patent
6,260,862: joints from intersections of circles, and stride and step height that he prints for it, 1.000 and 52.3 %
(mechanicalspider.com/concept.html). Wagle's Strider with the bars of his plans, 4, 14, 5, 6, 1, 13, 10 and a frame of
11 by 8 (diywalkers.com/strider-linkage-plans.html): joints from intersections of circles.
"""

import math

import numpy as np
import pytest

import crankwork
from crankwork import read_machine
from crankwork.kinematics.circuits import circuit_through
from crankwork.kinematics.configuration_curve import driver_coordinate
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.catalog import four_bar
from each import for_each
from linkages import At

JOINTS = ("C", "K", "D", "F", "foot")
# crank angle, then both coordinates of each joint [mm]
ROWS = (
    (0, -24.01353509713, 31.27209745484, -26.95210703157, -45.51517017008, -74.79436538094, 8.143170205896,
     -59.23151496142, -28.05293023075, -43.1601105241, -91.75693292612),
    (30, -30.05801099709, 32.93296957843, -21.88156752979, -43.64251853181, -76.77593445744, 2.419437702352,
     -56.4570933855, -31.33711273594, -30.80634954707, -91.82289073818),
    (60, -38.00946855288, 33.69999891984, -19.73349556207, -42.59690813304, -78.01557322983, -5.19925028342,
     -56.14050494921, -37.96876946998, -18.15029468117, -91.57132466831),
    (90, -46.73565230244, 32.77016611811, -20.99530064271, -43.2306392797, -77.66779126317, -13.67165532888,
     -57.44759936753, -47.48738894067, -7.689066230642, -90.3893513674),
    (120, -54.40004523074, 30.32202141059, -27.36791827383, -45.63449270399, -75.78925351703, -21.2157489029,
     -61.89202032566, -58.083443564, -3.668421915931, -88.52194859008),
    (150, -58.4544608426, 28.30907132063, -42.6678384094, -46.82180524506, -74.10331089232, -25.25167449309,
     -74.74858297603, -64.64639017854, -12.39706673083, -85.35335571976),
    (180, -54.93393498528, 30.08788521301, -65.31506892334, -36.05556599527, -75.59707117851, -21.74525864939,
     -96.76012629755, -54.97905316684, -33.72972953817, -73.51709740982),
    (210, -41.53840431142, 33.54887779528, -70.96147710993, -29.20165943873, -78.09178982164, -8.611411669346,
     -107.1680320982, -35.19960707772, -55.41158970049, -75.6688629435),
    (240, -28.19594287167, 32.52530798177, -64.70828331554, -36.62980406345, -76.26575750292, 4.189236953529,
     -100.1597698262, -27.13864479891, -69.73798086639, -85.37097908567),
    (270, -21.34897154416, 30.21306685027, -55.11470893246, -43.17763047686, -73.60565991011, 10.64578494848,
     -87.63658723792, -26.17123663559, -70.67056317652, -89.64283680092),
    (300, -19.27581844255, 29.23586133741, -44.50835882025, -46.55733821442, -72.53304454374, 12.58329793091,
     -75.38096249465, -26.71364041477, -64.15292573011, -91.44710309378),
    (330, -20.35134989292, 29.76028686522, -34.70049819492, -46.96124727123, -73.10634295059, 11.57923333456,
     -65.55569397894, -27.09049255155, -54.38441028073, -91.83377344257),
)  # fmt: skip
PLACES = {angle: dict(zip(JOINTS, zip(row[::2], row[1::2], strict=True), strict=True)) for angle, *row in ROWS}
LENGTHS = {"b": 41.5, "c": 39.3, "d": 40.1, "e": 55.8, "f": 39.4, "g": 36.7, "h": 65.7, "i": 49.0, "j": 50.0, "k": 61.9}
EXTREMES = (-71.52155224005665, -3.613130548548408, -91.83388674233223, -69.37671315801602)


def _along(point, axis):
    return lambda there: point.on(there)[axis]


def _third(one, other, far):
    """The place of a third point of a triangle on its left, along and across its first side."""
    along = (one**2 + other**2 - far**2) / (2 * one)
    return along, math.sqrt(other**2 - along**2)


def _described(tables):
    """Return the mechanism of a machine file with lengths in millimetres."""

    def shown(value):
        if isinstance(value, dict):
            return "{ " + ", ".join(f"{name} = {shown(one)}" for name, one in value.items()) + " }"
        if isinstance(value, (list, tuple)):
            return f"[{', '.join(map(shown, value))}]"
        return f'"{value}"' if isinstance(value, str) else f'"{value!r} mm"'

    lines = ['crank.speed = "60 rpm"']
    for table, values in tables.items():
        lines += [f"{table}.{name} = {shown(one)}" for name, one in values.items()]
    return read_machine("\n".join(lines)).mechanism


def _jansen(positions):
    b, c, d, e, f, g, h, i, j, k = LENGTHS.values()
    # seen from B the triangle b, d, e turns left to D; seen from F the foot lies on the left of K
    return _described({
        "fixed_points": {"O": (0.0, 0.0), "B": (-38.0, -7.8)},
        "crank": {"pivot": "O", "pin": "A", "radius": 15.0},
        "positions": positions,
        "links": {
            "upper": {"joins": ["A", "C"], "length": j},
            "lower": {"joins": ["A", "K"], "length": k},
            "knee": {"joins": ["B", "C"], "length": b, "points": {"D": _third(b, d, e)}},
            "hip": {"joins": ["B", "K"], "length": c},
            "hanger": {"joins": ["D", "F"], "length": f},
            "leg": {"joins": ["F", "K"], "length": g, "points": {"foot": _foot(g, h, i)}},
        },
    })  # fmt: skip


def _foot(g, h, i):
    along, across = _third(g, h, i)
    return along, -across


@pytest.fixture(scope="module")
def jansen():
    rough = {name: (round(x / 5) * 5.0, round(y / 5) * 5.0) for name, (x, y) in PLACES[0].items() if name in "CKF"}
    return _jansen({**rough, "D": PLACES[0]["D"]})


def test_every_joint_of_jansens_leg(jansen):
    points = linkage_motion(jansen, CrankGrid.from_degrees(list(PLACES))).points
    for name in JOINTS:
        found = np.column_stack([points[name].x.position, points[name].y.position])
        wanted = 1e-3 * np.array([place[name] for place in PLACES.values()])
        assert found == pytest.approx(wanted, abs=1e-13), name


def test_stride_and_lift_of_jansens_leg(jansen):
    circuit = circuit_through(jansen)
    foot = next(one for one in jansen.points if one.name == "foot")
    ends = [circuit.extent(_along(At("leg", foot.along, foot.across), axis)) for axis in (0, 1)]
    found = [value for end in ends for value in (end.least, end.greatest)]
    assert found == pytest.approx([1e-3 * one for one in EXTREMES], abs=1e-13)
    at = np.degrees(circuit.values(driver_coordinate(jansen), np.array([ends[1].least_at]))) % 360
    assert at == pytest.approx([329.3341944780148], abs=1e-6)


def test_the_tracer_of_the_lambda_linkage():
    circuit = circuit_through(four_bar(1.0, 2.5, 2.5, 2.0))
    tracer = At("coupler", 5.0)
    ends = [circuit.extent(_along(tracer, axis)) for axis in (0, 1)]
    found = [value for end in ends for value in (end.least, end.greatest)]
    assert found == pytest.approx([-0.3518070749468599, 4.35180707494686, 4.0, 4.898979485566356], abs=1e-11)
    at = circuit.values(driver_coordinate(circuit.mechanism), np.array([ends[0].greatest_at]))
    assert np.degrees(at) == pytest.approx([55.99494215380475], abs=1e-8)


def _met(centre, radius, other, far, near):
    """The crossing of two circles that lies nearer to a point."""
    gap = abs(other - centre)
    along = (radius**2 - far**2 + gap**2) / (2 * gap)
    across = math.sqrt(radius**2 - along**2)
    both = [centre + (other - centre) / gap * complex(along, sign * across) for sign in (1, -1)]
    return min(both, key=lambda one: abs(one - near))


def _pair(z):
    return float(z.real), float(z.imag)


def _rough(z, grain=0.1):
    return _pair(complex(round(z.real / grain) * grain, round(z.imag / grain) * grain))


def _as_walked(tables, places, start, names):
    """Follow the places round a turn in small steps and compare joints with the linkage of the tables."""
    mechanism = _described(tables)
    circuit = circuit_through(mechanism)
    assert circuit.turns("crank") == 1
    points = linkage_motion(mechanism, CrankGrid.from_degrees(np.arange(361.0))).points
    last = start
    for degrees in range(361):
        last = places(degrees, last)
        found = [complex(points[name].x.position[degrees], points[name].y.position[degrees]) for name in names]
        assert 1e3 * np.array(found) == pytest.approx(np.array(last), abs=1e-10)
    assert last == pytest.approx(start, abs=1e-12)
    return circuit


KLANN = {"hinge": 1.366 + 1.366j, "pivot": 1.009 + 0.574j, "shaft": 1.599 + 0.75j}


@for_each("hip", [1, -1])
def test_klanns_leg_stays_on_the_stated_branch(hip):
    """The same leg with its hip to one side of the line from knee to hinge walks, to the other it waves."""
    crank, rod, lower, far, knee, thigh, leg, upper = 0.268, 0.59, 0.3206, 1.1051, 0.5221, 0.8966, 1.732, 0.5177
    pivot, hinge, shaft = KLANN["pivot"], KLANN["hinge"], KLANN["shaft"]

    def places(degrees, last):
        pin = shaft + crank * np.exp(1j * np.radians(degrees))
        elbow = _met(pin, rod, pivot, lower, last[0])
        bend = _met(pin, far, elbow, knee, last[2])
        top = _met(bend, thigh, hinge, upper, last[1])
        foot = _met(bend, thigh, top, leg, last[3])
        return elbow, top, bend, foot

    # crank to the right: elbow beside the shaft, knee further left, the foot below
    top, foot = (complex(1.0, 1.7), complex(1.0, 0.0)) if hip == 1 else (complex(1.7, 0.9), complex(0.0, 0.35))
    first = (complex(1.3, 0.75), top, complex(0.8, 0.9), foot)
    start = places(0, places(0, first))
    angle = np.angle(start[0] - (shaft + crank))
    own = (start[2] - (shaft + crank)) * np.exp(-1j * angle)
    along = (start[3] - start[2]) * np.exp(-1j * np.angle(start[1] - start[2]))
    tables = {
        "fixed_points": {"O": _pair(shaft), "P": _pair(pivot), "Q": _pair(hinge)},
        "crank": {"pivot": "O", "pin": "A", "radius": crank},
        "positions": {"E": _rough(start[0]), "H": _rough(start[1]), "K": _rough(start[2])},
        "links": {
            "rod": {"joins": ["A", "E"], "length": rod, "points": {"K": _pair(own)}},
            "lower": {"joins": ["P", "E"], "length": lower},
            "leg": {"joins": ["K", "H"], "length": thigh, "points": {"foot": _pair(along)}},
            "upper": {"joins": ["Q", "H"], "length": upper},
        },
    }
    circuit = _as_walked(tables, places, start, ("E", "H", "K", "foot"))
    if hip == 1:
        # the foot stands on one line with the crank to the right and to the left; that is the stride
        assert abs(start[3] - 1.0) < 6e-4
        half = linkage_motion(circuit.mechanism, CrankGrid.from_degrees([0.0, 180.0])).points["foot"]
        assert 1e3 * abs(half.x.position[1] - half.x.position[0]) == pytest.approx(1.000, abs=5e-4)
        height = circuit.extent(_along(At("leg", *(1e-3 * one for one in _pair(along))), 1))
        # his four digits give 0.527
        assert 1e3 * height.travel == pytest.approx(0.523, abs=5e-3)


def test_the_strider_stays_on_the_stated_branch():
    left, right = complex(-11, 8), complex(11, 8)

    def places(degrees, last):
        pin = 4 * np.exp(1j * np.radians(degrees))
        behind, ahead = _met(pin, 14, left, 5, last[0]), _met(pin, 14, right, 5, last[1])
        # each bar goes on behind the crankpin, and there carries a short arm upwards
        tail = pin - (6 - 1j) * (ahead - pin) / 14
        return behind, ahead, tail, _met(behind, 13, tail, 10, last[3])

    start = places(0, (complex(-9, 4), complex(14, 4), 0, complex(-10, -9)))
    start = places(0, start)
    tables = {
        "fixed_points": {"O": (0.0, 0.0), "P": _pair(left), "Q": _pair(right)},
        "crank": {"pivot": "O", "pin": "A", "radius": 4.0},
        "positions": {name: _rough(place, 1.0) for name, place in zip("DEGH", start, strict=True)},
        "links": {
            "one": {"joins": ["A", "D"], "length": 14.0},
            "rocker": {"joins": ["P", "D"], "length": 5.0},
            "two": {"joins": ["A", "E"], "length": 14.0, "points": {"G": (-6.0, 1.0)}},
            "other": {"joins": ["Q", "E"], "length": 5.0},
            "shank": {"joins": ["D", "H"], "length": 13.0},
            "thigh": {"joins": ["G", "H"], "length": 10.0},
        },
    }
    _as_walked(tables, places, start, ("D", "E", "G", "H"))


@pytest.mark.elsewhere
def test_jansens_leg_as_a_template():
    results = crankwork.analyse(crankwork.Description(crankwork.template("jansen")))
    moved = results.columns_at(list(PLACES), [f"point_{axis}.{name}" for name in JOINTS for axis in "xy"])
    for name in JOINTS:
        for index, axis in enumerate("xy"):
            wanted = [1e-3 * place[name][index] for place in PLACES.values()]
            assert moved[f"point_{axis}.{name}"] == pytest.approx(wanted, abs=2e-11), name
    ends = [results[f"point_{axis}_{end}.foot"] for axis in "xy" for end in ("min", "max")]
    assert ends == pytest.approx([1e-3 * one for one in EXTREMES], abs=2e-11)
    assert results["path_width.foot"] == pytest.approx(0.06790842169150824, abs=2e-11)
    assert results["path_height.foot"] == pytest.approx(0.02245717358431621, abs=2e-11)


@pytest.mark.elsewhere
def test_the_lambda_linkage_as_a_template():
    """Proportions 1, 2, 2.5, 2.5 and 5 with a crank of 40 mm; straight to 0.009 of it over half a turn."""
    results = crankwork.analyse(crankwork.Description(crankwork.template("hoecken")))
    assert results["path_width.P"] == pytest.approx(0.04 * 4.70361414989372, abs=1e-13)
    assert results["path_height.P"] == pytest.approx(0.04 * 0.8989794855663562, abs=1e-13)
    assert results["point_x_max_angle.P"] == pytest.approx(math.radians(55.99494215380475), abs=1e-8)
    heights = [results.value("point_y.P", angle) for angle in (90, 120, 180, 270)]
    assert heights == pytest.approx([0.16, 0.04 * 4.008918628686366, 0.16, 0.16], abs=1e-14)


@pytest.mark.elsewhere
def test_chebyshevs_crossed_linkage_runs_straight():
    """Proportions 4, 5, 2, 5: at the middle and above both pivots the tracer is as high as the triangle 3, 4, 5."""
    results = crankwork.analyse(crankwork.Description(crankwork.template("chebyshev")))
    assert results["point_y_min.P"] == pytest.approx(0.16, abs=1e-12)
    assert results.value("point_x.P", 0) == pytest.approx(0.08, abs=1e-3)


@pytest.mark.elsewhere
def test_watts_lever_passes_through_its_middle():
    """With both levers level the coupler stands upright, its middle at half height."""
    results = crankwork.analyse(crankwork.Description(crankwork.template("watt-straight-line")))
    assert (results.value("point_x.P", 0), results.value("point_y.P", 0)) == pytest.approx((0.1, 0.04), abs=1e-12)
    # over 40 degrees of the lever it leaves the straight line by a hundredth of the way
    assert results["path_width.P"] < 0.01 * results["path_height.P"]


@pytest.mark.elsewhere
def test_stroke_of_a_pumpjack():
    """By intersections of circles over the turn: the end of the beam opposite to its bearing of the pitman."""
    results = crankwork.analyse(crankwork.Description(crankwork.template("pumpjack")))
    shaft, crank = complex(2.8, 3.1), 0.9 * np.exp(1j * np.linspace(0, 2 * np.pi, 200001))
    bearing = np.array([_met(pin, 3.0, shaft, 2.4, complex(0.4, 3.0)) for pin in crank[::2000]])
    head = shaft - 3.0 * (bearing - shaft) / 2.4
    # the largest of 101 places lies below the extreme by less than the square of half a step
    assert results["path_height.H"] == pytest.approx(float(np.ptp(head.imag)), rel=1e-3)
    assert results["path_height.H"] >= np.ptp(head.imag)

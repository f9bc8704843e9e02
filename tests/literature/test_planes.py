"""Masses in planes of a shaft and locomotives, each from its machine file.

R. S. Khurmi, J. K. Gupta: Theory of Machines. S. Chand, New Delhi 2005. Chapters 21 and 22; where the book draws to
scale, its values are those of the drawing. B. K. Sarkar: Theory of Machines, ch. 12, and
T. Bevan: The Theory of Machines, ch. 14, as recalculated in github.com/FOSSEE/Python-Textbook-Companions. The
counterweight of a V6 is that of the program github.com/StasF1/crankshaft.
"""

import cmath
import math
from typing import NamedTuple

import numpy as np
import pytest

from crankwork.errors import InputError
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere
DEGREE = math.pi / 180
POUND, INCH = 0.45359237, 0.0254


class Case(NamedTuple):
    """A machine file and what is printed or worked of it: value and tolerance by key, in SI."""

    text: str
    printed: dict[str, tuple[float, float]]


def _mass(name: str, **values: str) -> str:
    return f'{{ name = "{name}", ' + ", ".join(f'{key} = "{value}"' for key, value in values.items()) + " }"


def _rotor(*masses: str, more: str = "", speed: str = "") -> str:
    head = f'crank.speed = "{speed}"\n' if speed else ""
    return f"format = 2\n{head}[rotor]\n{more}\nmasses = [{', '.join(masses)}]\n"


def _locomotive(share: float, m: str, rec: str, apart: float, speed: str, more: str) -> str:
    """Return the file of two cylinders at right angles between wheels 1.5 m apart, whose weights stand at `more`."""
    weight, train = more.split("|")
    crank = {"mass": m, "reciprocating": rec, "radius": "0.3 m"}
    return _rotor(
        _mass("left", radius=weight, position="-0.75 m"),
        _mass("one", **crank, angle="0 deg", position=f"{-apart / 2} m"),
        _mass("two", **crank, angle="90 deg", position=f"{apart / 2} m"),
        _mass("right", radius=weight, position="0.75 m"),
        more=f"reciprocating_share = {share!r}\nlocomotive = {{ {train} }}",
        speed=speed,
    )


CASES = {
    # four masses in one plane, printed 116 kg at 201.48 degrees, of components cut to 8.5 and 21.6
    "khurmi 21.1": Case(
        _rotor(
            _mass("1", mass="200 kg", radius="0.2 m", angle="0 deg"),
            _mass("2", mass="300 kg", radius="0.15 m", angle="45 deg"),
            _mass("3", mass="240 kg", radius="0.25 m", angle="120 deg"),
            _mass("4", mass="260 kg", radius="0.3 m", angle="255 deg"),
            _mass("B", radius="0.2 m"),
        ),
        {"plane_mass.B": (116, 0.5), "plane_angle.B": (201.48 * DEGREE, 0.2 * DEGREE)},
    ),
    # two weights in given planes, drawn: 355 kg at 145 degrees and 182.5 kg at 12 degrees, both clockwise
    "khurmi 21.2": Case(
        _rotor(
            _mass("A", mass="200 kg", radius="80 mm", angle="0 deg", position="0 mm"),
            _mass("X", radius="100 mm", position="100 mm"),
            _mass("B", mass="300 kg", radius="70 mm", angle="45 deg", position="300 mm"),
            _mass("C", mass="400 kg", radius="60 mm", angle="115 deg", position="400 mm"),
            _mass("Y", radius="100 mm", position="500 mm"),
            _mass("D", mass="200 kg", radius="80 mm", angle="235 deg", position="700 mm"),
        ),
        {
            "plane_mass.X": (355, 2.5), "plane_angle.X": (215 * DEGREE, 2 * DEGREE),
            "plane_mass.Y": (182.5, 2.0), "plane_angle.Y": (348 * DEGREE, 1 * DEGREE),
        },
    ),
    # three masses of known size and unknown direction, drawn: 240, 100, 155 degrees and 7 kg, of 0.7 kg m
    "khurmi 21.3": Case(
        _rotor(
            _mass("A", radius="100 mm", position="0 mm"),
            _mass("B", mass="10 kg", radius="125 mm", angle="0 deg", position="600 mm"),
            _mass("C", mass="5 kg", radius="200 mm", position="1200 mm"),
            _mass("D", mass="4 kg", radius="150 mm", position="1800 mm"),
        ),
        {
            "plane_mass.A": (7, 0.5), "plane_angle.A": (155 * DEGREE, 2 * DEGREE),
            "plane_angle.C": (240 * DEGREE, 3 * DEGREE), "plane_angle.D": (100 * DEGREE, 1 * DEGREE),
        },
    ),
    # 105 kg drawn for 105.34, which the hammer blow follows
    "khurmi 22.4": Case(
        _locomotive(2 / 3, "150 kg", "180 kg", 0.7, "300 rpm", "0.6 m|"),
        {
            "plane_mass.left": (105.342299196, 5e-9), "plane_angle.left": (199.983106522 * DEGREE, 1e-10),
            "plane_angle.right": (250.016893478 * DEGREE, 1e-10), "hammer_blow.left": (27724.9818605, 5e-7),
            "tractive_effort_variation": (25123.9111187, 5e-7), "swaying_couple": (8793.36889154, 5e-8),
        },
    ),
    "locomotive at 80 km/h": Case(
        _locomotive(
            2 / 3, "250 kg", "300 kg", 0.6, "",
            '0.8 m|speed = "80 km/h", wheel_diameter = "2 m", wheel_load = "40 kN"',
        ),
        {
            "plane_mass.left": (128.516171161, 5e-9), "reciprocating_moment.left": (57.118298294 * 0.8, 5e-9),
            "hammer_blow.right": (22565.253647, 5e-6), "tractive_effort_variation": (20951.3120352, 5e-7),
            "swaying_couple": (6285.39361055, 5e-8), "lifting_speed.left": (106.512326982 / 3.6, 5e-9),
            "rail_load_min.left": (40e3 - 22565.253647, 5e-6), "rail_load_max.left": (40e3 + 22565.253647, 5e-6),
        },
    ),
    "sarkar 12.3": Case(
        _locomotive(0.67, "130 kg", "210 kg", 0.7, "300 rpm", "0.64 m|"),
        {"tractive_effort_variation": (29018.1173421, 5e-7), "swaying_couple": (10156.3410697, 5e-7)},
    ),
    "sarkar 12.1": Case(
        _rotor(
            _mass("crank", mass="70 kg", reciprocating="120 kg", radius="0.09 m", angle="0 deg"),
            _mass("B", radius="0.15 m"),
            more=f"reciprocating_share = {2 / 3!r}",
            speed="250 rpm",
        ),
        {"plane_mass.B": (90.0, 1e-12), "plane_angle.B": (math.pi, 1e-12), "unbalanced_force@30": (3264.065, 5e-4)},
    ),
    # half of the reciprocating weight: what is left is as large at any angle, printed 1436 lbf with g = 32.2 ft/s2
    "bevan 14.5": Case(
        _rotor(
            _mass("crank", mass="180 lb", reciprocating="150 lb", radius="7.5 in", angle="0 deg"),
            _mass("B", radius="6 in"),
            more="reciprocating_share = 0.5",
            speed="300 rpm",
        ),
        {
            "plane_mass.B": (318.75 * POUND, 1e-10),
            **{f"unbalanced_force@{angle}": (1436.76306305 * 32.2 * 12 * POUND * INCH, 5e-6) for angle in (0, 40, 90)},
        },
    ),
    # crank and rods of one throw of a V6 at 46.5 mm, against two sectors
    "stasf1": Case(
        _rotor(
            _mass("crank", mass="3.285 kg", radius="15.984 mm", angle="0 deg"),
            _mass("rods", mass=f"{200 * 0.00528101725068 * 4 / 3!r} kg", radius="46.5 mm", angle="0 deg"),
            '{ name = "webs", sector = { inner_radius = "35.85 mm", outer_radius = "87 mm", width = "19.09 mm", '
            'density = "7860 kg/m3", count = 2 } }',
        ),
        {"sector_angle.webs": (148.734937081 * DEGREE, 1e-10), "plane_moment.webs": (0.117992053908, 1e-11)},
    ),
}  # fmt: skip


@for_each("name", CASES)
def test_as_books_have_it(name: str) -> None:
    case = CASES[name]
    results = analysed(case.text)
    for key, (value, tolerance) in case.printed.items():
        kind, _, angle = key.partition("@")
        assert results.value(kind, float(angle) if angle else None) == pytest.approx(value, abs=tolerance), key
    assert not results.unmet


def test_the_other_arrangement_is_the_mirror_image() -> None:
    """Angles without a sense can be drawn on either side of the one that is given."""
    text = CASES["khurmi 21.3"].text
    first, second = (analysed(f"{text}arrangement = {number}\n") for number in (1, 2))
    assert [notice.code for notice in first.notices] == ["rotor_ways"]
    for name in "ACD":
        assert first[f"plane_angle.{name}"] + second[f"plane_angle.{name}"] == pytest.approx(math.tau, abs=1e-10)


def test_a_position_is_found_besides_masses_and_an_angle() -> None:
    """Khurmi 21.4: eccentricities 80, 60, 60, 80 mm, A at 190, B at 0 and C at 100 degrees; drawn: 10 kg and 8 kg."""
    results = analysed(
        _rotor(
            _mass("A", radius="80 mm", angle="190 deg", position="0 mm"),
            _mass("B", mass="18 kg", radius="60 mm", angle="0 deg", position="100 mm"),
            _mass("C", mass="12.5 kg", radius="60 mm", angle="100 deg", position="300 mm"),
            _mass("D", radius="80 mm"),
        )
    )
    b, c = 18 * 0.06, 12.5 * 0.06 * cmath.exp(100j * DEGREE)
    couple = b * 0.1 + c * 0.3
    # D turns opposite to the couples about A, and A takes what is left across it
    across, a = couple / abs(couple), cmath.exp(190j * DEGREE)
    mass_a = -((b + c) / across).imag / (a / across).imag
    moment_d = abs(b + c + mass_a * a)
    assert results["plane_mass.A"] == pytest.approx(mass_a / 0.08, rel=1e-12)
    assert results["plane_mass.D"] == pytest.approx(moment_d / 0.08, rel=1e-12)
    assert results["plane_position.D"] == pytest.approx(abs(couple) / moment_d, rel=1e-12)
    assert (round(results["plane_mass.A"]), round(results["plane_mass.D"])) == (10, 8)


def test_a_marine_engine_of_four_cranks() -> None:
    """Khurmi 22.5: outer cranks at 120 degrees with 400 kg each, 450, 750 and 600 mm apart, 240 rpm, rod 1.2 m."""
    results = analysed(
        _rotor(
            _mass("1", mass="400 kg", radius="300 mm", angle="0 deg", position="0 mm"),
            _mass("2", radius="300 mm", position="450 mm"),
            _mass("3", radius="300 mm", position="1200 mm"),
            _mass("4", mass="400 kg", radius="300 mm", angle="120 deg", position="1800 mm"),
            more='kind = "reciprocating"\nrod_length = "1.2 m"',
            speed="240 rpm",
        )
    )
    places, turned = (0.0, 0.45, 1.2, 1.8), cmath.exp(120j * DEGREE)
    second, third = np.linalg.solve(
        np.array([[1, 1], places[1:3]], dtype=complex), [-400 * (1 + turned), -400 * places[3] * turned]
    )
    for name, vector in (("2", second), ("3", third)):
        assert results[f"plane_mass.{name}"] == pytest.approx(abs(vector), rel=1e-12)
        assert results[f"plane_angle.{name}"] == pytest.approx(cmath.phase(vector) % math.tau, rel=1e-12)
    unit, cranks = 0.3**2 / 1.2 * (8 * math.pi) ** 2, (400, second, third, 400 * turned)
    doubled = [abs(m) * cmath.exp(2j * cmath.phase(m)) for m in cranks]
    assert results["free_force.2"] == pytest.approx(unit * abs(sum(doubled)), rel=1e-12)
    couple = sum((place - 0.9) * m for place, m in zip(places, doubled, strict=True))
    assert results["free_moment.2"] == pytest.approx(unit * abs(couple), rel=1e-12)


def test_cranks_at_quarter_turns() -> None:
    """Khurmi 22.7: 1800 rpm, crank 60 mm, rod 240 mm, 150 mm apart, 1.5 kg, order 1-4-2-3: a primary couple alone,
    and a secondary one about the middle."""
    masses = [
        _mass(str(1 + k), mass="1.5 kg", radius="60 mm", angle=f"{angle} deg", position=f"{150 * k} mm")
        for k, angle in enumerate((0, 180, 270, 90))
    ]
    results = analysed(_rotor(*masses, more='kind = "reciprocating"\nrod_length = "240 mm"', speed="1800 rpm"))
    one = 1.5 * 0.06 * (60 * math.pi) ** 2
    assert results["free_force.1"] == pytest.approx(0, abs=1e-9)
    assert results["free_force.2"] == pytest.approx(0, abs=1e-9)
    assert results["free_moment.1"] == pytest.approx(math.sqrt(2) * 0.15 * one, rel=1e-12)
    assert results["free_moment.2"] == pytest.approx(4 * 0.15 * one / 4, rel=1e-12)


def test_what_is_not_balanced_loads_two_bearings() -> None:
    """Three masses at 600 rpm, the bearings by moments about one another."""
    masses = ((0.4, 0, 0.0), (0.4, 90, 0.3), (0.36, 210, 0.7))
    results = analysed(
        _rotor(
            *(
                _mass(f"m{k}", moment=f"{q} kg*m", angle=f"{a} deg", position=f"{z} m")
                for k, (q, a, z) in enumerate(masses)
            ),
            more='bearings = ["-0.4 m", "0.9 m"]',
            speed="600 rpm",
        )
    )
    vectors = [(q * cmath.exp(1j * a * DEGREE), z) for q, a, z in masses]
    w = 20 * math.pi
    far = w**2 * abs(sum(v * (z + 0.4) for v, z in vectors)) / 1.3
    near = w**2 * abs(sum(v * (0.9 - z) for v, z in vectors)) / 1.3
    assert (results["bearing_load.1"], results["bearing_load.2"]) == pytest.approx((near, far), rel=1e-12)
    assert results["free_force.1"] == pytest.approx(w**2 * abs(sum(v for v, _ in vectors)), rel=1e-12)


def test_coupled_axles_share_the_reciprocating_part() -> None:
    """Of two axles each has half of the balanced share, so half of the hammer blow; the tractive effort stays."""
    text = CASES["khurmi 22.4"].text
    alone, coupled = analysed(text), analysed(text.replace("locomotive = {  }", "locomotive.coupled = 2"))
    assert coupled["hammer_blow.left"] == pytest.approx(alone["hammer_blow.left"] / 2, rel=1e-12)
    assert coupled["tractive_effort_variation"] == pytest.approx(alone["tractive_effort_variation"], rel=1e-12)


def test_forces_along_and_across_the_rails() -> None:
    """Of cranks at right angles: what is not balanced of the pistons along, what is balanced of them across."""
    results = analysed(_locomotive(0.6, "160 kg", "180 kg", 0.7, "300 rpm", "0.6 m|"))
    degrees = np.array([0.0, 25.0, 110.0, 200.0, 305.0])
    one, (sin, cos) = 180 * 0.3 * (10 * math.pi) ** 2, (np.sin(np.radians(degrees)), np.cos(np.radians(degrees)))
    columns = results.columns_at(degrees, ["unbalanced_force_along", "unbalanced_force_across"])
    assert columns["unbalanced_force_along"] == pytest.approx(0.4 * one * (cos - sin), rel=1e-12, abs=1e-9 * one)
    assert columns["unbalanced_force_across"] == pytest.approx(-0.6 * one * (sin + cos), rel=1e-12, abs=1e-9 * one)


def test_a_sector_has_the_moment_of_its_strips() -> None:
    """Of 110 degrees between 40 and 90 mm, two of 30 mm, summed strip by strip."""
    sector = 'sector = { inner_radius = "40 mm", outer_radius = "90 mm", width = "30 mm", angle = "110 deg", '
    masses = f'{{ name = "webs", {sector} density = "7800 kg/m3", count = 2 }}, angle = "180 deg" }}'
    results = analysed(_rotor(masses, _mass("B", radius="50 mm")))
    radius = 0.04 + 0.05 * (np.arange(20_000) + 0.5) / 20_000
    strips = 2 * 7800 * 0.03 * np.sum(radius**2) * 0.05 / 20_000 * 2 * math.sin(55 * DEGREE)
    assert results["plane_moment.B"] == pytest.approx(strips, rel=1e-8)
    assert results["plane_mass.B"] == pytest.approx(strips / 0.05, rel=1e-8)


def test_three_cranks_leave_a_swaying_couple_alone() -> None:
    """Three cylinders at 120 degrees leave no force along the rails."""
    crank = {"mass": "100 kg", "reciprocating": "200 kg", "radius": "0.3 m"}
    results = analysed(
        _rotor(
            _mass("left", radius="0.6 m", position="-0.75 m"),
            *(_mass(f"c{k}", **crank, angle=f"{120 * k} deg", position=f"{0.7 * (k - 1)} m") for k in range(3)),
            _mass("right", radius="0.6 m", position="0.75 m"),
            more="reciprocating_share = 0.4\nlocomotive = {}",
            speed="240 rpm",
        )
    )
    one = 0.6 * 200 * 0.3 * (8 * math.pi) ** 2
    assert results["tractive_effort_variation"] == pytest.approx(0, abs=1e-9 * one)
    assert results["swaying_couple"] == pytest.approx(math.sqrt(3) * 0.7 * one, rel=1e-12)
    # the forces along the rails times their arms, one by one
    degrees = np.array([0.0, 37.0, 101.0, 250.0])
    couple = sum(one * np.cos(np.radians(degrees + 120 * k)) * 0.7 * (k - 1) for k in range(3))
    column = results.columns_at(degrees, ["unbalanced_couple"])["unbalanced_couple"]
    assert column == pytest.approx(couple, rel=1e-12, abs=1e-9 * one)


def test_what_cannot_balance_is_refused() -> None:
    known = _mass("A", mass="1 kg", radius="1 m", angle="0 deg", position="0 m")
    cases = {
        "1 values": _rotor(known, _mass("B", mass="1 kg", radius="1 m", position="1 m")),
        "cannot balance": _rotor(
            _mass("A", mass="5 kg", radius="1 m", angle="0 deg"),
            _mass("B", mass="1 kg", radius="1 m"),
            _mass("C", mass="1 kg", radius="1 m"),
        ),
        "any of many": _rotor(known, *(_mass(name, radius="1 m", position="0 m") for name in "BC")),
        "another mass": _rotor(known, known),
        "at most 2": CASES["khurmi 21.3"].text + "arrangement = 3",
        "is too small": CASES["stasf1"].text.replace('"19.09 mm"', '"9 mm"'),
        "nothing to share": _rotor(known, more="reciprocating_share = 0.5"),
    }
    for words, text in cases.items():
        with pytest.raises(InputError, match=words):
            analysed(text)


def test_throws_and_counterweights_of_an_engine_are_masses_in_planes() -> None:
    """Three throws at 120 degrees: sqrt(3) a w^2 times the moment of each, less that of its counterweight."""
    engine = """
        crank = { radius = "50 mm", speed = "3000 rpm", mass = "2 kg" }
        rod = { length = "180 mm", mass = "1 kg", small_end_share = 0 }
        engine = { layout = "inline", cylinders = 3, spacing = "100 mm" }
        bearings.counterweight = "30 kg*mm"
    """
    masses = [
        _mass(f"{name}{k}", mass=mass, radius=radius, angle=f"{240 * k + turn} deg", position=f"{100 * k} mm")
        for k in range(3)
        for name, mass, radius, turn in (("throw", "3 kg", "50 mm", 0), ("weight", "0.5 kg", "60 mm", 180))
    ]
    couple = math.sqrt(3) * 0.1 * (100 * math.pi) ** 2 * (0.15 - 0.03)
    assert analysed(engine)["free_moment.residual.1"] == pytest.approx(couple, rel=1e-12)
    assert analysed(_rotor(*masses, speed="3000 rpm"))["free_moment.1"] == pytest.approx(couple, rel=1e-12)
    with pytest.raises(InputError, match=r"rotor: .*\[\[rotor.masses\]\].*counterweight") as refused:
        analysed(f"{engine}\nrotor.masses = [{masses[0]}]")
    assert len(refused.value.problems) == 1

"""Spreads against closed forms and a hundred thousand draws of formulas that are written here."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import pytest

import crankwork
from crankwork import cli
from crankwork.study.spread import spread_text

pytestmark = [pytest.mark.elsewhere, pytest.mark.usefixtures("by_arrays")]

COUNT = 100_000


def draws(*pairs: tuple[float, float]) -> list[np.ndarray]:
    generator = np.random.default_rng(20261122)
    return [mean + size * generator.standard_normal(COUNT) for mean, size in pairs]


def slider_crank(**changes: str) -> crankwork.Description:
    description = crankwork.Description(crankwork.template("slider-crank"))
    description.replace({key.replace("__", "."): value for key, value in changes.items()})
    return description


def test_one_per_cent_of_four_numbers_against_draws() -> None:
    description = slider_crank(
        crank__radius="50 mm sd 1 %",
        rod__length="200 sd 2 mm",
        crank__speed="1500 σ 15 rpm",
        piston__mass="0.8 kg sd 1 %",
    )
    found = crankwork.spread(description)
    r, rod, w, _ = draws((0.05, 0.0005), (0.2, 0.002), (50 * math.pi, 0.5 * math.pi), (0.8, 0.008))
    phi = np.radians(np.linspace(68, 84, 161))[:, None]
    shift = (r / rod) * np.sin(phi)
    velocity = (r * w * (np.sin(phi) + shift * np.cos(phi) / np.sqrt(1 - shift**2))).max(axis=0)
    expected = {
        "stroke": 2 * r,
        "rod_ratio": r / rod,
        "piston_velocity_max": velocity,
        "piston_acceleration_max": r * w**2 * (1 + r / rod),
    }
    for key, drawn in expected.items():
        assert found[key].deviation == pytest.approx(float(drawn.std()), rel=0.01), key
        assert sum(cause.share for cause in found[key].causes) == pytest.approx(1)
        assert not found[key].is_sampled
    # by three deviations of each, where the value grows or falls with each
    assert found["stroke"].worst == pytest.approx((0.097, 0.103))
    w, ends = 50 * math.pi, found["piston_acceleration_max"].worst
    assert ends[1] == pytest.approx(0.0515 * (1.03 * w) ** 2 * (1 + 0.0515 / 0.194))
    assert ends[0] == pytest.approx(0.0485 * (0.97 * w) ** 2 * (1 + 0.0485 / 0.206))
    # of r w^2 (1 + r/l) the speed brings (2 %)^2 of the variance, the crank (1.2 %)^2, the rod (0.2 %)^2
    shares = {cause.key: cause.share for cause in found["piston_acceleration_max"].causes}
    assert shares["crank.speed"] == pytest.approx(4 / (4 + 1.44 + 0.04), rel=1e-3)
    assert next(iter(shares)) == "crank.speed"


def test_a_value_at_its_least_spreads_by_its_curvature() -> None:
    """The stroke of a centric slider-crank is the least over its offset."""
    found = crankwork.spread(slider_crank(cylinder__offset="0 sd 8 mm"), ["stroke"])
    (e,) = draws((0.0, 0.008))
    stroke = np.sqrt(0.25**2 - e**2) - np.sqrt(0.15**2 - e**2)
    assert found["stroke"].deviation == pytest.approx(float(stroke.std()), rel=0.02)
    off = math.sqrt(0.25**2 - 0.024**2) - math.sqrt(0.15**2 - 0.024**2)
    assert found["stroke"].worst == pytest.approx((0.1, off))


def test_a_tolerance_is_its_limits_and_its_third_a_deviation() -> None:
    """The stroke is 2 r; r w^2 (1 + r/l) has by its partial derivatives a deviation to first order."""
    description = slider_crank(
        crank__radius="50 ± 0.3 mm", rod__length="200 mm ± 0.6 mm", crank__speed="1500 rpm +- 0.6 %"
    )
    keys = ["stroke", "piston_acceleration_max"]
    found = {within: crankwork.spread(description, keys, within=within) for within in (1.0, 3.0, 7.0)}
    r, rod, w = 0.05, 0.2, 50 * math.pi
    for spreads in found.values():
        assert spreads["stroke"].worst == pytest.approx((2 * 0.0497, 2 * 0.0503), rel=1e-12)
        assert spreads["stroke"].deviation == pytest.approx(2 * 0.0001, rel=1e-6)
        by_crank, by_rod = w**2 * (1 + 2 * r / rod) * 0.0001, r**2 * w**2 / rod**2 * 0.0002
        by_speed = 2 * r * w * (1 + r / rod) * 0.002 * w
        expected = math.hypot(by_crank, by_rod, by_speed)
        assert spreads["piston_acceleration_max"].deviation == pytest.approx(expected, rel=1e-4)
        ends = [
            (r + sign * 0.0003) * ((1 + sign * 0.006) * w) ** 2 * (1 + (r + sign * 0.0003) / (rod - sign * 0.0006))
            for sign in (-1, 1)
        ]
        assert spreads["piston_acceleration_max"].worst == pytest.approx(ends, rel=1e-9)


def test_tolerances_and_deviations_of_one_file_have_ends_of_their_own() -> None:
    """The ratio r / l grows with r and falls with l."""
    description = slider_crank(crank__radius="50 ± 0.3 mm", rod__length="200 sd 1 mm")
    found = crankwork.spread(description, ["rod_ratio"], within=2)
    assert found["rod_ratio"].worst == pytest.approx((49.7 / 202, 50.3 / 198), rel=1e-12)
    assert found["rod_ratio"].deviation == pytest.approx(0.25 * math.hypot(0.1 / 50, 1 / 200), rel=1e-4)
    machine = found.results.machine
    assert machine.deviations == pytest.approx({"crank.radius": 1e-4, "rod.length": 1e-3})
    assert machine.tolerances == pytest.approx({"crank.radius": 3e-4})
    told = [row for row in found.results.assumptions if row.code == "deviation"]
    assert [row.keys for row in told] == [("crank.radius",)]


def test_corners_of_values_with_two_peaks_are_the_limits() -> None:
    """The largest pressure angle of a centric slider-crank is asin((r + |e|) / l)."""
    text = OFFSET.replace("sd 2 mm", "± 6 mm")
    found = crankwork.spread(crankwork.Description(text), ["pressure_angle_max.B"], samples=200, within=2)
    assert found["pressure_angle_max.B"].is_sampled
    assert found["pressure_angle_max.B"].worst == pytest.approx((math.asin(0.05 / 0.2), math.asin(0.056 / 0.2)))


OFFSET = """
    fixed_points.O = ["0 mm", "0 mm"]
    crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
    links.rod = { joins = ["A", "B"], length = "200 mm" }
    guides.bed.through = ["0 mm", "0 sd 2 mm"]
    sliders.ram = { guide = "bed", pin = "B" }
"""


def test_where_the_largest_of_two_peaks_changes_draws_are_taken_and_told() -> None:
    """The largest pressure angle of a centric slider-crank is asin((r + |e|) / l)."""
    description = crankwork.Description(OFFSET)
    found = crankwork.spread(description, ["pressure_angle_max.B"], samples=1500)
    (e,) = draws((0.0, 0.002))
    expected = float(np.arcsin((0.05 + np.abs(e)) / 0.2).std())
    one = found["pressure_angle_max.B"]
    assert one.is_sampled
    assert found.samples == 1500
    # of 1500 draws a deviation is known to 1.8 %
    assert one.deviation == pytest.approx(expected, rel=0.06)
    assert "1500" in spread_text(found)
    assert one.worst == pytest.approx((math.asin(0.05 / 0.2), math.asin(0.056 / 0.2)))


@pytest.mark.parametrize("way", ["arrays", pytest.param("compiled", marks=pytest.mark.compiled)])
def test_draws_calculated_at_once_are_those_analysed_one_by_one(monkeypatch, way) -> None:
    """With a rod so short the least acceleration leaves the bottom dead centre, and for some draws does not."""
    description = slider_crank(crank__radius="50 sd 0.5 mm", rod__length="192 sd 2 mm", crank__speed="1500 rpm sd 1 %")
    keys = ["piston_acceleration_min", "piston_acceleration_min_angle"]
    monkeypatch.setattr("crankwork.kernel.compiled.compiles", lambda: way == "compiled")
    at_once = crankwork.spread(description, keys, samples=150)
    assert at_once[keys[1]].is_sampled
    monkeypatch.setattr("crankwork.study.spread._Neighbours.compile", lambda *_: None)
    alone = crankwork.spread(description, keys, samples=150)
    for key in keys:
        assert at_once[key].deviation == pytest.approx(alone[key].deviation, rel=1e-9)
        assert at_once[key].worst == pytest.approx(alone[key].worst, rel=1e-9)
        assert dict(at_once[key].causes) == pytest.approx(dict(alone[key].causes), rel=1e-6)


def test_the_least_acceleration_against_draws() -> None:
    found = crankwork.spread(
        slider_crank(crank__radius="50 sd 1 mm", rod__length="200 sd 4 mm"), ["piston_acceleration_min"], samples=20_000
    )["piston_acceleration_min"]
    r, rod = draws((0.05, 0.001), (0.2, 0.004))
    phi = np.radians(np.linspace(130, 180, 251))[:, None]
    of_angle = np.cos(phi) + (r / rod) * np.cos(2 * phi) / (1 - (r / rod * np.sin(phi)) ** 2) ** 0.5
    of_angle = of_angle + (r / rod) ** 3 * np.sin(2 * phi) ** 2 / 4 / (1 - (r / rod * np.sin(phi)) ** 2) ** 1.5
    expected = (r * (50 * math.pi) ** 2 * of_angle).min(axis=0)
    assert found.deviation == pytest.approx(float(expected.std()), rel=0.02)


@pytest.fixture
def commanded(tmp_path, capsys, monkeypatch):
    """Return what calls the command for a file with a deviation: its status, what it prints and what it complains."""
    (tmp_path / "my.toml").write_text(slider_crank(crank__radius="50 sd 0.1 mm").dump(), encoding="utf-8")

    def run(*words: str) -> tuple[object, str, str]:
        monkeypatch.setattr("sys.argv", ["crankwork", "spread", str(tmp_path / "my.toml"), *words])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        return ended.value.code, *capsys.readouterr()

    return run


def test_the_command_tells_values_deviations_and_causes(commanded) -> None:
    for language, words in (("en", "Standard deviations"), ("ru", "отклонения"), ("vi", "Độ lệch chuẩn")):
        code, out, _ = commanded("--lang", language)
        assert not code
        assert words in out
        assert "crank.radius 100 %" in out
    data = json.loads(commanded("stroke", "--units", "imperial", "--json")[1])["spreads"]
    assert list(data) == ["stroke"]
    assert data["stroke"]["deviation"] == pytest.approx(0.2 / 25.4)
    assert data["stroke"]["unit"] == "in"


def test_what_cannot_be_spread_is_refused() -> None:
    for radius, key, message in (
        (None, "", "no number of the file has a tolerance or a standard deviation"),
        ("50 sd 0.1 mm", "strok", "stroke"),
        ("50 sd 0.1 mm", "piston_velocity", "crank_torque@90deg|single value"),
        ("50 sd -1 mm", "", "crank.radius"),
        ("50 sd mm", "", "crank.radius"),
        ("50 sd 1 kg", "", "crank.radius"),
        ("50 sd 80 mm", "", "crank.radius"),
        ("50 ± 240 mm", "", "crank.radius"),
        ("50 ± -1 mm", "", "crank.radius"),
    ):
        with pytest.raises(crankwork.CrankworkError, match=message):
            crankwork.spread(slider_crank(**({"crank__radius": radius} if radius else {})), [key] if key else [])


def test_a_file_with_deviations_is_the_machine_of_its_values() -> None:
    plain = crankwork.analyse(slider_crank())
    spread = crankwork.analyse(slider_crank(crank__radius="50 sd 0.1 mm", rod__length="200 mm sd 1%"))
    assert dict(plain.summary) == dict(spread.summary)
    assert spread.machine.deviations == {"crank.radius": pytest.approx(1e-4), "rod.length": pytest.approx(2e-3)}


def test_a_deviation_may_have_a_unit_of_its_own():
    sizes = {"2 kg sd 0.5 g": 0.0005, "2000 g σ 0.1 kg": 0.1, "2 SD 0.1 kg": 0.1, "2 kg sd 1 lb": 0.45359237,
             "2 kg ± 1.5 g": 0.0005, "2000 +/- 300 g": 0.1}  # fmt: skip
    engine = crankwork.template("engine")
    found = [crankwork.read_machine(engine.replace('"0.55 kg"', f'"{stated}"')).deviations for stated in sizes]
    assert [one["piston.mass"] for one in found] == pytest.approx(list(sizes.values()))


def test_a_deviation_of_another_quantity_is_refused():
    with pytest.raises(crankwork.InputError, match=r"piston\.mass: unit \"mm\" measures length; mass is wanted"):
        crankwork.read_machine(crankwork.template("engine").replace('"0.55 kg"', '"0.55 kg sd 1 mm"'))


def test_an_angle_that_goes_through_zero_spreads_by_a_little():
    """Of an offset e the acceleration is largest where sin phi is about -2 e / l / (...), on either side of zero."""
    text = """
        format = 2
        crank = { radius = "50 mm", speed = "1000 rpm" }
        rod.length = "200 mm"
        cylinder = { bore = "80 mm", offset = "0 sd 2 mm" }
    """
    found = crankwork.spread(crankwork.Description(text), ["piston_acceleration_max_angle"])
    offset = np.random.default_rng(5).normal(0.0, 0.002, 400)
    phi = np.linspace(-0.1, 0.1, 20001)
    s, c = 0.05 * np.sin(phi), 0.05 * np.cos(phi)

    def at(e: float) -> float:
        # second derivative of r cos + sqrt(l^2 - (r sin - e)^2), its largest downward value
        y, root = s - e, np.sqrt(0.2**2 - (s - e) ** 2)
        return float(phi[np.argmax(c + (c**2 - y * s) / root + (y * c) ** 2 / root**3)])

    expected = float(np.std([at(one) for one in offset]))
    assert found["piston_acceleration_max_angle"].deviation == pytest.approx(expected, rel=0.1)


def test_equal_causes_have_equal_shares_where_draws_are_taken():
    """The greatest of three equal peaks: each by itself does a third of it."""
    at = ", ".join(f'"{one} deg"' for one in range(0, 361, 60))
    torque = ", ".join(['"0 N*m"', '"1000 sd 10 N*m"'] * 3 + ['"0 N*m"'])
    text = f'crank.speed = "30 rad/s"\ntorque = {{ period = "360 deg", at = [{at}], torque = [{torque}] }}\n'
    found = crankwork.spread(crankwork.Description(text), samples=2000)
    largest = found["turning_moment_max"]
    assert largest.is_sampled
    # of three normal draws the greatest is 3 / (2 sqrt(pi)) deviations above their mean
    assert largest.mean == pytest.approx(1000 + 10 * 1.5 / math.sqrt(math.pi), rel=1e-3)
    assert largest.deviation == pytest.approx(10 * math.sqrt(0.5594672), rel=0.06)
    assert re.search(r"mean of the draws 100[89]; ", spread_text(found))
    assert [one.share for one in largest.causes] == pytest.approx([1 / 3] * 3, abs=0.06)


def test_a_worst_case_that_is_none_is_refused(commanded) -> None:
    for within in ("0", "-1", "11", "nan", "three"):
        code, _, told = commanded(f"--within={within}")
        assert (code, "--within 3" in told) == (2, True), within


def test_draws_that_give_no_machine_are_counted_by_reason():
    description = slider_crank(crank__radius="50 sd 12 mm", rod__length="100 sd 13 mm")
    found = crankwork.spread(description, ["piston_acceleration_max"], samples=1500, seed=3)
    r, rod = np.random.default_rng(3).standard_normal((1500, 2)).T * [[12], [13]] + [[50], [100]]
    assert list(found.refused.values()) == [np.sum(r >= rod)]
    assert "draws gave no machine: the rod" in spread_text(found)

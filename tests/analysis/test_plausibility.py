"""Values far outside normal design are told, those of real engines are not."""

import cmath
import math

import pytest

from crankwork import Description, analyse, template
from crankwork.description.machine_file import read_machine
from crankwork.description.shorthand import expanded
from crankwork.report.notices import notice_text
from expansions import ROOT, machine_files
from machine_texts import POINTS_ENGINE

CODES = ("implausible", "implausible_own", "firing_order", "fast_work")
# which limits no book has
OWN = {"en": "(limits of this program)", "ru": "(границы этой программы)", "vi": "(giới hạn của chương trình này)"}


def told(results):
    return {item.values.get("quantity", item.code) for item in results.notices if item.code in CODES}


@pytest.mark.parametrize(
    ("key", "value", "quantity"),
    [
        ("piston.mass", "1050 g/cm2", "mass_per_area.of_piston"),
        ("rod.mass", "0.2 g/cm2", "mass_per_area.of_rod"),
        ("crank.speed", "23000 rpm", "mean_piston_speed"),
        ("rod.ratio", 0.6, "rod_ratio"),
        ("cylinder.bore", "900 mm", "stroke_bore_ratio"),
        ("cycle.peak_pressure", "80 MPa", "gas_pressure_max"),
        ("gas.points.z.pressure", "80 MPa", "gas_pressure_max"),
        ("gas.points.a.pressure", "0.115 kPa", "gas_pressure"),
        ("cycle.intake_pressure", "0.115 kPa", "gas_pressure"),
        ("rod.small_end_share", 0.9, "small_end_share"),
        ("flywheel.percent", 50, "speed_fluctuation"),
    ],
)
def test_a_value_beyond_what_is_built_is_told_with_its_range(key, value, quantity):
    description = Description(POINTS_ENGINE if key.startswith("gas.") else template("engine"))
    assert told(analyse(description)) == set()
    description[key] = value
    results = analyse(description)
    assert quantity in told(results)
    notice = next(item for item in results.notices if item.values.get("quantity") == quantity)
    assert key.startswith(notice.values["path"])
    for language in ("en", "ru", "vi"):
        source = f"({notice.values['source']})" if notice.values["source"] else OWN[language]
        assert source in notice_text(notice.code, notice.values, language)
        assert "{" not in notice_text(notice.code, notice.values, language)


def test_a_notice_on_an_expanded_file_is_that_of_the_engine_with_its_own_keys(tmp_path):
    (tmp_path / "engine.toml").write_text(template("engine"), "utf-8")
    settings = ["rod.ratio=0.6", "piston.mass=1050 g/cm2", "cylinder.bore=900 mm", "cycle.intake_pressure=0.115 kPa"]
    written = Description(expanded(tmp_path / "engine.toml", settings))
    notices = [item.values for item in analyse(written).notices if item.code in CODES]
    engine = analyse(read_machine(template("engine"), overrides=settings))
    assert {values["quantity"] for values in notices} == told(engine)
    assert {values["path"] for values in notices} <= set(written)


def test_a_firing_order_with_avoidable_moments_is_told_with_a_better_one():
    description = Description(template("whole-engine"))
    description["engine.firing_order"] = [1, 2, 3, 4]
    notice = next(item for item in analyse(description).notices if item.code == "firing_order")
    better = [int(number) for number in notice.values["better"].split("-")]

    def couple(order):
        # throws as they fire, 180 degrees apart, at equal distances along the shaft
        return abs(sum(along * cmath.exp(-1j * math.pi * order.index(along)) for along in (1, 2, 3, 4)))

    assert couple(better) == pytest.approx(0.0, abs=1e-12)
    assert couple([1, 2, 3, 4]) == pytest.approx(2.0)


@pytest.mark.parametrize(("stroke", "is_told"), [("growing", True), ("falling", False)])
def test_work_on_the_faster_stroke_is_told(stroke, is_told):
    description = Description(template("crank-shaper"))
    [slider] = [key.split(".")[1] for key in description if key.startswith("sliders.") and key.endswith(".mass")][-1:]
    plain = analyse(description)
    high, low = (plain.summary[f"slider_displacement_{end}_angle.{slider}"] for end in ("max", "min"))
    grows = math.degrees(high - low) % 360
    description["loads"] = [{"kind": "process", "slider": slider, "stroke": stroke, "force": "1 kN"}]
    notices = [item for item in analyse(description).notices if item.code == "fast_work"]
    assert bool(notices) == is_told == ((grows < 180) == (stroke == "growing"))
    if notices:
        # the time ratio from the angles of the two dead positions
        assert notices[0].values["ratio"] == pytest.approx(max(grows, 360 - grows) / min(grows, 360 - grows))


def test_files_of_real_machines_are_plausible():
    # those with friction take long and are no engines
    for name, text in machine_files("examples").items():
        if "[friction" not in text:
            assert told(analyse(read_machine(text, folder=ROOT / "examples"))) == set(), name


def test_a_gas_as_cold_as_no_gas_is_told():
    description = Description((ROOT / "examples" / "beta-stirling.toml").read_text("utf-8"))
    key = next(key for key in description if key.startswith("chambers.") and key.endswith(".temperature"))
    description[key] = "20 K"
    notice = next(item for item in analyse(description).notices if item.code == "implausible_own")
    assert (notice.values["path"], notice.values["value"]) == (key, 20.0)

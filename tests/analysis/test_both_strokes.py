"""What has a sign is told with its least and its greatest value: a shaper whose ram comes back faster than it went."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.report.summary import summary_text
from each import for_each

# lengths of a shaper that was made up [mm], [rpm]
CRANK, BASE, LEVER, LINK, SPEED = 95.464406235492845, 217.525383016890908, 437.98729887315682, 357.67353639089129, 284.4
RAM = 226.995  # of the bed over the crankshaft
SHAPER = crankwork.read_machine(f"""
fixed_points = {{ O = ["0 mm", "0 mm"], B = ["0 mm", "{-BASE} mm"] }}
crank = {{ pivot = "O", pin = "A", radius = "{CRANK} mm", speed = "{SPEED} rpm", direction = "clockwise" }}
links.lever = {{ joins = ["B", "C"], length = "{LEVER} mm" }}
links.link = {{ joins = ["C", "D"], length = "{LINK} mm" }}
guides.slot = {{ link = "lever" }}
guides.bed = {{ through = ["0 mm", "{RAM} mm"] }}
sliders.block = {{ pin = "A", guide = "slot" }}
sliders.ram = {{ pin = "D", guide = "bed" }}
positions = {{ C = ["100 mm", "200 mm"], D = ["450 mm", "{RAM} mm"] }}
""")
RATE = SPEED * math.pi / 30


@pytest.fixture(scope="module")
def summary():
    return crankwork.analyse(SHAPER).summary


def ram(turned):
    """Where the ram is, its lever towards the crank pin; of complex angles too. [mm]"""
    x, y = CRANK * np.cos(turned), BASE - CRANK * np.sin(turned)
    reach = LEVER / np.sqrt(x * x + y * y)
    x, y = x * reach, y * reach - BASE
    return x + np.sqrt(LINK**2 - (RAM - y) ** 2)


@pytest.mark.elsewhere
def test_the_lever_is_fastest_where_its_slot_is_shortest(summary):
    """The crank pin goes across the lever there; in between the lever is in line with what turns it."""
    assert summary["link_angular_velocity_max.lever"] == pytest.approx(RATE * CRANK / (BASE - CRANK), rel=1e-12)
    assert summary["link_angular_velocity_min.lever"] == pytest.approx(-RATE * CRANK / (BASE + CRANK), rel=1e-12)
    assert summary["link_angular_acceleration_max.lever"] == pytest.approx(
        -summary["link_angular_acceleration_min.lever"], rel=1e-9
    )


@pytest.mark.elsewhere
def test_the_block_goes_as_fast_as_the_crank_pin_where_that_goes_along_the_slot(summary):
    assert summary["slider_velocity_max.block"] == pytest.approx(RATE * CRANK / 1e3, rel=1e-12)
    assert summary["slider_velocity_min.block"] == pytest.approx(-RATE * CRANK / 1e3, rel=1e-12)
    # s^2 = d^2 + r^2 + 2 d r cos has these second derivatives at its ends
    inner, outer = (RATE**2 * BASE * CRANK / (BASE + sign * CRANK) / 1e3 for sign in (-1, 1))
    assert summary["slider_acceleration_max.block"] == pytest.approx(inner, rel=1e-12)
    assert summary["slider_acceleration_min.block"] == pytest.approx(-outer, rel=1e-12)


@pytest.mark.elsewhere
def test_both_strokes_of_the_ram_are_those_of_its_place_differentiated(summary):
    """By a complex step at 20,000 crank angles, which miss a maximum by less than 1e-7 of it."""
    turned = np.linspace(0.0, math.tau, 20001)
    velocity = ram(turned + 1e-30j).imag / 1e-30 * RATE / 1e3
    assert summary["slider_velocity_max.ram"] == pytest.approx(velocity.max(), rel=1e-6)
    assert summary["slider_velocity_min.ram"] == pytest.approx(velocity.min(), rel=1e-6)
    assert -summary["slider_velocity_min.ram"] > 2 * summary["slider_velocity_max.ram"]
    at = turned[velocity.argmin()]
    assert math.remainder(summary["slider_velocity_min_angle.ram"] - at, math.tau) == pytest.approx(0.0, abs=1e-3)
    acceleration = np.gradient(velocity, turned) * RATE
    assert summary["slider_acceleration_max.ram"] == pytest.approx(acceleration.max(), rel=1e-5)
    assert summary["slider_acceleration_min.ram"] == pytest.approx(acceleration.min(), rel=1e-5)


@for_each("language", ["en", "ru", "vi"])
def test_both_are_told_in_every_language(language):
    told = {
        "en": ("largest velocity of slider ram", "smallest velocity of slider ram"),
        "ru": ("скорость ползуна ram: наибольшее значение", "скорость ползуна ram: наименьшее значение"),
        "vi": ("vận tốc con trượt ram: giá trị lớn nhất", "vận tốc con trượt ram: giá trị nhỏ nhất"),
    }
    text = summary_text(crankwork.analyse(SHAPER), language=language)
    assert all(one in text for one in told[language])

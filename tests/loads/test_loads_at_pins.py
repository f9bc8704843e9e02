"""A load at a pin bears on the link that is named, and it is told which one where none is."""

from __future__ import annotations

import numpy as np
import pytest

import crankwork
from crankwork.errors import InputError
from crankwork.report.notices import notice_text
from each import for_each
from machine_texts import analysed

# the guide goes through the crankshaft, and the load along it
SLIDER_CRANK = """
fixed_points = { O = ["0 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "100 mm", speed = "300 rpm" }
[links.rod]
joins = ["A", "B"]
length = "400 mm"
mass = "2 kg"
inertia = "0.03 kg*m2"
centre = ["150 mm", "0 mm"]
[guides.bed]
[sliders.piston]
pin = "B"
guide = "bed"
mass = "5 kg"
[positions]
B = ["500 mm", "0 mm"]
"""
LOADS = {
    "spring": 'kind = "spring", between = ["O", "B"], stiffness = "3000 N/m", free_length = "350 mm", preload = "20 N"',
    "damper": 'kind = "damper", between = ["O", "B"], damping = "400 N*s/m"',
    "force": 'kind = "force", point = "B", x = "-250 N", y = "120 N"',
}


def with_load(kind: str, more: str = "") -> str:
    return f"loads = [{{ {LOADS[kind]}{more} }}]{SLIDER_CRANK}"


def pushed(kind: str) -> np.ndarray:
    """What the load puts on B along the guide, from the closed form of a slider-crank. [N]"""
    turned, speed = np.radians(np.arange(0.0, 361.0, 10.0)), 10 * np.pi
    sin, cos = np.sin(turned), np.cos(turned)
    root = np.sqrt(16.0 - sin**2)
    place, velocity = 0.1 * (cos + root), -0.1 * speed * (sin + sin * cos / root)
    return {"spring": -3000 * (place - 0.35) - 20, "damper": -400 * velocity, "force": -250 + 0 * turned}[kind]


def acceleration() -> np.ndarray:
    """That of B in closed form. [m/s2]"""
    turned, speed = np.radians(np.arange(0.0, 361.0, 10.0)), 10 * np.pi
    sin, cos = np.sin(turned), np.cos(turned)
    root = np.sqrt(16.0 - sin**2)
    return -0.1 * speed**2 * (cos + (cos**2 - sin**2) / root + (sin * cos) ** 2 / root**3)


@pytest.mark.elsewhere
@for_each("kind", list(LOADS))
def test_the_pin_carries_what_bears_on_the_rod(kind: str) -> None:
    """On the piston the load balances in it: Newton for 5 kg, the pin and the load, on a guide without friction."""
    key = {"force": "link"}.get(kind, "links")
    rod, piston = ('"rod"', '"piston"') if kind == "force" else ('["ground", "rod"]', '["ground", "piston"]')
    on_rod, on_piston, on_none = (
        analysed(with_load(kind, more)) for more in (f", {key} = {rod}", f", {key} = {piston}", "")
    )
    inertia = 5.0 * acceleration()
    assert on_rod.columns["joint_force_x.B"] == pytest.approx(inertia, abs=1e-9)
    assert on_piston.columns["joint_force_x.B"] == pytest.approx(inertia - pushed(kind), abs=1e-9)
    assert on_none.columns["joint_force_x.B"] == pytest.approx(on_piston.columns["joint_force_x.B"], abs=1e-9)
    assert on_rod.columns["balancing_torque"] == pytest.approx(on_piston.columns["balancing_torque"], abs=1e-9)
    for results in (on_rod, on_piston):
        assert max(results.checks.values()) < 1e-12
        assert not results.notices
    (told,) = on_none.notices
    assert told.code == "load_on_pin"
    assert (told.values["link"], told.values["owners"], told.values["field"]) == ("piston", "rod, piston", key)
    for language in ("en", "ru", "vi"):
        text = notice_text(told.code, told.values, language)
        assert all(one in text for one in ("loads[1]", "piston", "rod", key)), text


@for_each("more", [', links = ["ground", "crank"]', ', links = ["rod", "piston"]'], ids=["crank", "swapped"])
def test_a_link_that_is_not_at_the_pin_is_refused(more: str) -> None:
    with pytest.raises(InputError, match=r"is no point of (crank|rod); it is one of") as told:
        crankwork.read_machine(with_load("damper", more))
    assert "loads[1].links" in str(told.value)


def test_one_link_for_two_ends_is_refused() -> None:
    with pytest.raises(InputError, match=r"loads\[1\].links"):
        crankwork.read_machine(with_load("spring", ', links = ["rod"]'))


def test_a_damper_along_a_guide_names_no_links() -> None:
    load = 'kind = "damper", slider = "piston", damping = "1 N*s/m", links = ["ground", "piston"]'
    with pytest.raises(InputError, match=r"loads\[1\].links"):
        crankwork.read_machine(f"loads = [{{ {load} }}]{SLIDER_CRANK}")

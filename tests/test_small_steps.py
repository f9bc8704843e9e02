"""Small steps that only their own numbers show: ends of ranges, a bar, a place in a link, a key, a factor."""

from __future__ import annotations

import io
import math
import tomllib

import pytest

import crankwork
from crankwork import progress, units
from crankwork.cli.asked import count_of
from crankwork.description.expand import expanded
from crankwork.description.machine_file import template
from crankwork.mechanism.description import linkage_from


def test_a_count_has_at_most_nine_digits() -> None:
    assert [count_of(text) for text in ("0", "123456789", "1234567890", "²", "-1", "")] == [0, 123456789, 0, 0, 0, 0]


def test_a_value_in_a_small_unit_is_multiplied_by_a_whole_number() -> None:
    assert [units.from_si(value, "mm") for value in (0.0009, 0.0018, 0.0579)] == [0.9, 1.8, 57.9]


def test_a_key_that_cannot_be_printed_is_told_in_letters() -> None:
    results = crankwork.analyse(crankwork.read_machine(template("slider-crank")))
    with pytest.raises(crankwork.UnknownKeyError, match=r"no result a\\x07b; list"):
        results.value("a\x07b")


def test_a_bar_is_shown_once_a_second_has_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    # a clock that has run for a long while, and a terminal
    now, screen = [5000.0], io.StringIO()
    screen.isatty = lambda: True  # type: ignore[method-assign]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(progress.sys, "stderr", screen)
    with progress.bar() as told:
        now[0] += 0.9
        told(0.2)
        assert screen.getvalue() == ""
        now[0] += 0.2
        told(0.5)
        assert "50%" in screen.getvalue()
        told(0.75)
        assert "75%" in screen.getvalue()


def test_a_joint_that_is_drawn_has_its_place_along_and_across_its_link() -> None:
    tables = {
        "fixed_points": {"O": [0.0, 0.0], "E": [0.6, 0.1], "F": [0.3, 0.9]},
        "crank": {"pivot": "O", "pin": "A", "radius": math.hypot(0.1, 0.2), "start": math.atan2(0.2, 0.1)},
        # from A to B 0.5 long, in the direction (0.6, 0.8); C lies 0.2 along and 0.1 across
        "positions": {"B": [0.4, 0.6], "C": [0.14, 0.42]},
        "links": {
            "plate": {"joins": ["A", "B", "C"]},
            "arm": {"joins": ["B", "E"], "length": 0.6},
            "leg": {"joins": ["C", "F"], "length": 0.6},
        },
    }
    linkage, problems = linkage_from(tables)
    assert problems == []
    assert linkage.member("plate").points["C"] == pytest.approx((0.2, 0.1), abs=1e-12)


def test_a_method_is_written_out_with_its_gravity(tmp_path) -> None:
    """An engine is written out as a linkage, and what its method states goes with it."""
    path = tmp_path / "my.toml"
    path.write_text(template("engine"), "utf-8")
    method = tomllib.loads(expanded(path, ["method.gravity=9.7 m/s2", "method.weights=true"]))["method"]
    assert (method["gravity"], method["weights"]) == ("9.7 m/s2", True)


@pytest.mark.elsewhere
def test_mechanical_losses_of_a_file_are_in_megapascals() -> None:
    """Kolchin and Demidov: p_M = 0.034 + 0.0113 v_p, at 14.56 m/s by hand 0.198528 MPa."""
    text = template("whole-engine")
    assert text.count("[cycle]") == 1
    machine = crankwork.read_machine(text.replace("[cycle]", "[cycle]\nmechanical_loss = [0.034, 0.0113]"))
    summary = crankwork.analyse(machine).summary
    by_hand = 0.034e6 + 0.0113e6 * summary["mean_piston_speed"]
    assert summary["mechanical_loss_pressure"] == pytest.approx(by_hand, rel=1e-12)


@pytest.mark.elsewhere
def test_gas_left_in_the_clearance_expands_to_the_volume_of_its_polytrope() -> None:
    """V_c (p_2 / p_1)^(1/n), and what is induced is the swept and the clearance volume without it."""
    results = crankwork.analyse(crankwork.read_machine(template("compressor")))
    summary = results.summary
    left = summary["clearance_volume"] * (5.0 / 0.95) ** (1 / 1.25)
    assert summary["expanded_volume"] == pytest.approx(left, rel=1e-9)
    swept = summary["swept_volume"] + summary["clearance_volume"]
    assert summary["induced_volume"] == pytest.approx(swept - left, rel=1e-9)


@pytest.mark.compiled
def test_kernels_that_begin_alike_are_different_kernels(tmp_path, monkeypatch) -> None:
    from crankwork.kernel.compiled import compiled

    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    same = "".join(f"x{number} = {number}\n" for number in range(100))
    assert [compiled(f"{same}y = {number}\n").y for number in (1, 2)] == [1, 2]

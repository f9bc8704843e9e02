"""A small part of the campaign that compares engines with their linkages, and that it notices each kind of fault."""

from __future__ import annotations

import numpy as np
import pytest

from campaigns import forms
from campaigns.bodies import Bodies
from expansions import written

pytestmark = pytest.mark.elsewhere

# a compressor that accelerates and a boxer of four, and more
FEW, MORE = (1, 3), tuple(range(4, 14))


@pytest.mark.parametrize("numbers", [FEW, pytest.param(MORE, marks=pytest.mark.slow)], ids=len)
def test_engines_agree_with_their_linkages_and_with_newton_and_euler(numbers, capsys):
    for number in numbers:
        status, told = forms.main(["--only", "chance", "--first", str(number), "--count", "1"]), capsys.readouterr().out
        assert status == 0, told
        assert "1 machines compared" in told


def test_files_agree_with_their_expansions(capsys):
    """A table of transfer functions, a calculated cycle, an approximate method, valves, a shaft with given torques."""
    names = ["table-forward", "two-stroke-ports", "slider-crank", "compressor", "turning-strokes"]
    status, told = forms.main(["--only", "files", "--files", *names]), capsys.readouterr().out
    assert status == 0, told
    assert "5 files compared" in told


def test_the_bodies_are_those_of_a_crank_mechanism_by_hand():
    """r = 50 mm, l = 200 mm at 100 rad/s: 1.5 kg at the pin and 2 kg of a rod, without gas."""
    values = {
        "crank": {"radius": "50 mm", "speed": "100 rad/s"}, "rod": {"length": "200 mm", "mass": "2 kg",
        "small_end_share": 0.25}, "piston": {"mass": "1.5 kg"}, "table": {"step": "90 deg"},
    }  # fmt: skip
    bodies = Bodies(forms.linkage_of(written(values)))
    angles = np.radians([0.0, 90.0, 180.0])
    found, torque = bodies.forces(angles, np.zeros((3, bodies.count)))
    first, second, _ = bodies.motion(angles)
    piston = 3 * (bodies.sliders["piston"][0] - 1) + 1
    # downwards from the top: r w^2 (1 + r / l) and -r w^2 (1 - r / l), and -r^2 w^2 / sqrt(l^2 - r^2) amid
    assert second[:, piston] == pytest.approx([-0.0625, 0.05**2 / np.sqrt(0.2**2 - 0.05**2), 0.0375])
    assert first[1, piston] == pytest.approx(-0.05)
    assert found["joint_force_y.B"][[0, 2]] * np.sign(found["joint_force_y.B"][0]) == pytest.approx([937.5, -562.5])
    assert torque[[0, 2]] == pytest.approx([0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("key", ["joint_force_x.B", "total_torque", "reduced_inertia", "excess_work", "crank_speed"])
def test_a_fault_of_a_millionth_is_noticed(monkeypatch, key):
    analyse = forms.analyse
    values = {
        "crank": {"radius": "54 mm", "speed": "690 rpm"}, "rod": {"length": "366 mm", "mass": "4 kg",
        "small_end_share": 0.3}, "piston": {"mass": "7 kg"}, "cylinder": {"bore": "132 mm", "compression_ratio": 13},
        "gas": {"cycle": "360 deg", "pressures": "absolute", "valves": {"suction": "0.95 bar", "discharge": "2.5 bar",
        "compression_exponent": 1.35, "expansion_exponent": 1.25}}, "table": {"step": "10 deg"},
        "flywheel": {"fluctuation": 0.02, "inertia": "0.1 kg*m2"},
    }  # fmt: skip

    def spoilt(machine):
        results = analyse(machine)
        for each in (results, results.other):
            for table in (each.columns, each.summary):
                if key in table:
                    table[key] = table[key] * (1 + 1e-6)
        return results

    monkeypatch.setattr(forms, "analyse", spoilt)
    found, _ = forms.apart(written(values), 0)
    assert any(key in line for line in found)

"""`crankwork draw`: a machine as it moves or stands, in the format that the name of the file asks for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from crankwork.quantities import LANGUAGES

EXAMPLES = Path(__file__).parents[2] / "examples"


def _example(name):
    return str(EXAMPLES / f"{name}.toml")


def test_the_ending_says_how_a_machine_is_drawn(crankwork, tmp_path):
    for ending, head in {"svg": b"<svg", "gif": b"GIF89a", "png": b"\x89PNG", "pdf": b"%PDF"}.items():
        out = tmp_path / f"four.{ending}"
        run = crankwork("draw", _example("slider-crank"), "-o", str(out))
        assert run.code == 0, run.err
        assert out.read_bytes().startswith(head)


def test_a_still_stands_at_the_angle_that_is_asked_for(crankwork, tmp_path):
    out = tmp_path / "still.svg"
    assert crankwork("draw", _example("spark-engine"), "--at", "391.25", "--forces", "-o", str(out)).code == 0
    text = out.read_text("utf-8")
    assert "= 391.3°" in text or "= 391.2°" in text
    assert "<style" not in text
    assert 'class="force"' in text


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    "asked",
    [
        ("press", "out.svg"),
        ("spark-engine", "out.doc"),
        ("spark-engine", "out.gif", "--at", "30"),
        ("spark-engine", "out.png", "--at", "721"),
        ("excavator-boom", "out.png", "--at", "9"),
        ("slider-crank", "out.svg", "--forces"),
    ],
)
def test_what_cannot_be_drawn_is_refused(crankwork, tmp_path, language, asked):
    name, out, *options = asked
    run = crankwork("draw", _example(name), "-o", out, *options, "--lang", language)
    assert run.code == 2
    assert ";" in run.err
    assert not (tmp_path / out).exists()


def test_a_drawing_that_is_there_is_kept(crankwork, tmp_path):
    out = tmp_path / "four.svg"
    out.write_text("mine", "utf-8")
    assert crankwork("draw", _example("slider-crank"), "-o", str(out)).code == 2
    assert out.read_text("utf-8") == "mine"


def test_a_still_says_which_link_acts_on_which_in_a_joint(crankwork, tmp_path):
    """The boom (3) is held by the frame and by the rod (2) of the cylinder, whose barrel (1) is held by the frame."""
    out = tmp_path / "forces.svg"
    assert crankwork("draw", _example("excavator-boom"), "--at", "2", "--forces", "-o", str(out)).code == 0
    said = re.sub(r"<[^>]*>", "", out.read_text("utf-8"))
    assert re.findall(r"R([A-Z]) (\d) → (\d)", said)[:3] == [("O", "0", "3"), ("B", "3", "2"), ("A", "0", "1")]

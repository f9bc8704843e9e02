"""`crankwork draw`: a machine as it moves or stands, in the format that the name of the file asks for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
REFUSED = [
    ("press", "out.svg"),
    ("spark-engine", "out.doc"),
    ("spark-engine", "out.gif", "--at", "30"),
    ("excavator-boom", "out.png", "--at", "9"),
    ("slider-crank", "out.svg", "--forces"),
    ("slider-crank", "mine.svg"),
]


def _drawn(crankwork, name, out, *options):
    answer = crankwork("draw", str(EXAMPLES / f"{name}.toml"), "-o", out, *options)
    assert (answer.code, answer.err) == (0, "")
    return Path(out).read_bytes()


@pytest.mark.parametrize(
    "ending", ["svg", *(pytest.param(one, marks=pytest.mark.slow) for one in ("gif", "png", "pdf"))]
)
def test_the_ending_says_how_a_machine_is_drawn(crankwork, ending):
    head = {"svg": b"<svg", "gif": b"GIF89a", "png": b"\x89PNG", "pdf": b"%PDF"}[ending]
    assert _drawn(crankwork, "slider-crank", f"drawn.{ending}").startswith(head)


def test_a_still_stands_at_the_angle_that_is_asked_for(crankwork):
    text = _drawn(crankwork, "spark-engine", "still.svg", "--at", "391.25", "--forces").decode()
    assert ("= 391.2°" in text or "= 391.3°" in text, "<style" in text, 'class="force"' in text) == (True, False, True)


def test_a_linkage_stands_whole_turns_later_as_before(crankwork):
    stills = [_drawn(crankwork, "press-geometry", f"{at}.svg", "--at", at) for at in ("30", "390", "-330")]
    assert stills == stills[:1] * 3


def test_what_cannot_be_drawn_is_refused_in_the_language_and_what_is_there_is_kept(check_refusals):
    Path("mine.svg").write_text("mine", "utf-8")
    check_refusals(
        (("draw", str(EXAMPLES / f"{name}.toml"), "-o", out, *options, "--lang", language), "; ")
        for name, out, *options in REFUSED
        for language in ("en", "ru", "vi")
    )


def test_a_still_says_which_link_acts_on_which_in_a_joint(crankwork):
    """The boom (3) is held by the frame and by the rod (2) of the cylinder, whose barrel (1) is held by the frame."""
    text = _drawn(crankwork, "excavator-boom", "forces.svg", "--at", "2", "--forces").decode()
    said = re.findall(r"R([A-Z]) (\d) → (\d)", re.sub(r"<[^>]*>", "", text))
    assert said[:3] == [("O", "0", "3"), ("B", "3", "2"), ("A", "0", "1")]

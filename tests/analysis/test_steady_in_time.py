"""A motion that is followed until it is steady, and one that will not be."""

from pathlib import Path

import pytest

import crankwork

PRESS = (Path(__file__).parents[2] / "examples" / "press-start.toml").read_text(encoding="utf-8")


def let_go(text: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read_machine(text))


def told(results: crankwork.Results) -> list[str]:
    return [notice.code for notice in results.notices if notice.code.startswith("transient")]


def without_motor(more: str = "") -> str:
    """Return the press of the example driven by a constant torque, for 60 s."""
    before, _, after = PRESS.partition("[motor]")
    rest = after[after.index("[method]") :].replace('"12 s"', '"60 s"\ntorque = "1500 N*m"')
    return f"{before}{more}\n{rest}"


def damped(damping: float) -> str:
    return without_motor(f'[[loads]]\nkind = "damper"\nslider = "ram"\ndamping = "{damping} N*s/m"')


@pytest.mark.parametrize(
    ("text", "word"),
    [
        (without_motor(), "transient_never_steady"),
        # its speed is far from its limit after the 10,000 steps of 20 s
        (damped(2e3), "transient_slowly_steady"),
        (damped(2e5), "transient_steady"),
    ],
)
def test_a_motion_that_will_not_be_steady_in_time_ends_early(text: str, word: str) -> None:
    results = let_go(text)
    assert told(results)[-1] == word
    assert results["transient_time"] < 10.0


def test_more_time_does_not_help_a_machine_that_came_to_rest() -> None:
    rubbing = without_motor('[friction.sliders]\nram = { force = "400 N" }')
    results = let_go(rubbing.replace('torque = "1500 N*m"', 'speed = "40 rpm"'))
    assert told(results)[-1] == "transient_comes_to_rest"
    assert results["transient_time"] < 10.0

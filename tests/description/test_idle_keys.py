"""Keys that can never have an effect: an error from format 2 on, read and without effect before."""

from __future__ import annotations

from typing import Any

import pytest

from crankwork import Description, InputError, analyse, template
from crankwork.description.shorthand import expanded
from each import for_each
from expansions import ROOT

TORQUES = template("turning-moment")
PRESS = (ROOT / "tests" / "machines" / "turning-shears.toml").read_text("utf-8")
TRANSFER = (ROOT / "examples" / "press.toml").read_text("utf-8")
CRANK = template("slider-crank")
NO_MECHANISM = "has no mechanism"
OF_METHOD = (
    ("method.kinematics", "exact"), ("method.rod", "two-mass"), ("method.gravity", "5 m/s2"), ("method.weights", True),
    ("method.inertia_rod_ratio", 0.2),
)  # fmt: skip
CASES = [
    *((text, key, value, NO_MECHANISM) for text in (TORQUES, PRESS, TRANSFER) for key, value in OF_METHOD),
    (CRANK, "cylinder.compression_ratio", 9.0, r"add \[gas\] or \[cycle\]"),
    (CRANK, "cylinder.clearance_volume", "60 cm3", r"add \[gas\] or \[cycle\]"),
    (CRANK, "rod.ratio_definition", "l/r", r"add ratio = 0\.25"),
]


@for_each(("text", "key", "value", "reason"), CASES)
def test_a_key_without_effect_is_refused_with_the_reason(text: str, key: str, value: Any, reason: str) -> None:
    description = Description(text)
    if key.startswith("cylinder."):
        description["cylinder.bore"] = "80 mm"
    description["format"] = 1
    plain = dict(analyse(description).summary)
    description[key] = value
    assert dict(analyse(description).summary) == pytest.approx(plain, nan_ok=True)
    description["format"] = 2
    with pytest.raises(InputError, match=rf"text:\d+: {key}: .*{reason}"):
        description.machine()
    del description[key]
    description.machine()


@for_each("text", [TORQUES, PRESS, TRANSFER])
def test_pi_counts_and_what_is_written_out_is_read(text: str, tmp_path) -> None:
    description = Description(text)
    description.replace({"format": 2, "method.pi": 3.14})
    path = tmp_path / "machine.toml"
    path.write_text(description.dump(), "utf-8")
    out = expanded(path)
    assert "pi = 3.14" in out
    assert "gravity" not in out
    path.write_text(out, "utf-8")
    assert expanded(path) == out

"""Loops of pressure over volume are one curve if they are the same, not if only their sizes are."""

from __future__ import annotations

import numpy as np

from crankwork.report.gas import _indicators
from crankwork.report.look import drawn_of
from crankwork.show.scene import Text
from shown import results_of

ANGLES = np.linspace(0.0, 2 * np.pi, 721)


def loop(lean: float, *, turned: bool = False) -> tuple[np.ndarray, np.ndarray, None]:
    across = np.cos(ANGLES + lean * np.sin(ANGLES))
    return 1e-4 * (2 - across if turned else 2 + across), 1e6 * (2 + np.sin(ANGLES)), None


def legend(**curves: tuple[np.ndarray, np.ndarray, None]) -> set[str]:
    drawing = _indicators(drawn_of(results_of("triplex-pump"), "en"), curves, "indicator")
    return {item.text for item in drawing.items if isinstance(item, Text)} & {"a", "b", "a, b"}


def test_the_mirror_image_of_a_loop_is_another_loop():
    assert legend(a=loop(0.5), b=loop(0.5)) == {"a, b"}
    assert legend(a=loop(0.5), b=loop(0.5, turned=True)) == {"a", "b"}

"""A machine let go as figures: its crank, its energies and its torque over the time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from crankwork.analysis.results import Results
from crankwork.locale import say
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_look import Style
from crankwork.show.scene import Drawing

_PANELS = (("crank_angle",), ("crank_speed",), ("kinetic_energy", "potential_energy"), ("driving_torque",))


def transient_figures(results: Results, style: Style) -> dict[str, Callable[[], Drawing]]:
    """Return crank angle, speed, energies and torque since a machine was let go; none where it was not."""
    if "transient" not in results.listings:
        return {}
    columns = results.listings["transient"].columns
    time = columns["time"]
    panels = [tuple(key for key in panel if key in columns and np.any(columns[key])) for panel in _PANELS]
    in_time = style._replace(period=float(time[-1]))
    shown = [panel for panel in panels if panel]
    title = say("tables.transient", style.language)
    return {"transient": partial(curves, 360.0 * time / time[-1], columns, shown, title, in_time)}

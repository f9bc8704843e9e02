"""Figures of results as SVG: of one cylinder, of a whole engine, or of a linkage."""

from __future__ import annotations

import importlib

from crankwork.analysis import Results
from crankwork.errors import MissingExtraError
from crankwork.machine import Machine
from crankwork.quantities import Language
from crankwork.report.engine_figure_list import engine_figures
from crankwork.report.figure_data import drawn_from
from crankwork.report.linkage_figures import linkage_figures


def figures(results: Results, *, language: Language = "en", per_area: bool = False) -> dict[str, bytes]:
    """Return the figures of a machine as SVG by name; those for which nothing is known are left out.

    Parameters
    ----------
    results : Results
        The results; curves are computed afresh, finer than their table.
    language : str
        Language of names, units and numbers.
    per_area : bool
        Divide forces by the piston area.

    Returns
    -------
    dict of str to bytes
        Of one cylinder `kinematics`, `brix` and `tolle`, and as far as known `pressure`, `indicator`, `piston_forces`,
        `rod_forces`, `crankpin_forces`, `torque` and `crankpin_polar`; of an engine also the loads of its bearings,
        their wear, the torque of all cylinders, its harmonics, the speed and the balance.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    try:
        importlib.import_module("matplotlib")
    except ImportError:
        # an optional part, whose fonts all figures use
        raise MissingExtraError("drawing figures", "figures") from None
    if not isinstance(results.machine, Machine):
        return linkage_figures(results, language=language)
    return dict(engine_figures(drawn_from(results, language, per_area=per_area)))

"""Figures of results as SVG: motion, gas pressure, forces, torque and the polar load diagram of the crankpin."""

from __future__ import annotations

from crankwork.analysis import Results
from crankwork.errors import MissingExtraError
from crankwork.machine import Machine
from crankwork.quantities import Language
from crankwork.report.engine_figure_list import engine_figures
from crankwork.report.figure_data import drawn_from
from crankwork.report.figure_forces import crankpin_forces, piston_forces, rod_forces, torque
from crankwork.report.figure_gas import indicator, pressure
from crankwork.report.figure_look import LOOK
from crankwork.report.figure_motion import kinematics
from crankwork.report.figure_polar import crankpin_polar
from crankwork.report.linkage_figures import linkage_figures

# name: what draws it, the column it needs
_FIGURES = {
    "kinematics": (kinematics, "piston_displacement"),
    "pressure": (pressure, "gas_pressure"),
    "indicator": (indicator, "gas_pressure"),
    "piston_forces": (piston_forces, "piston_force"),
    "rod_forces": (rod_forces, "rod_force"),
    "crankpin_forces": (crankpin_forces, "tangential_force"),
    "torque": (torque, "crank_torque"),
    "crankpin_polar": (crankpin_polar, "tangential_force"),
}


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
        `kinematics`, and as far as known `pressure`, `indicator`, `piston_forces`, `rod_forces`,
        `crankpin_forces`, `torque` and `crankpin_polar`.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    try:
        import matplotlib as mpl  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError("drawing figures", "figures") from None
    if not isinstance(results.machine, Machine):
        return linkage_figures(results, language=language)
    drawn = drawn_from(results, language, per_area=per_area)
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(LOOK)
        single = {name: draw(drawn) for name, (draw, key) in _FIGURES.items() if key in drawn.columns}
    return single | dict(engine_figures(drawn))

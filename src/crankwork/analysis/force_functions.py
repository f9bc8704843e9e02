"""What notes tabulate beside the forces: each force of the rod per force on the piston pin."""

from __future__ import annotations

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.rod_functions import radial_factor, rod_factor, side_factor, tangential_factor
from crankwork.kinematics.slider_crank import rod_swing


def force_functions(results: Results) -> dict[str, Array]:
    """Return tan beta, 1 / cos beta, cos(phi + beta) / cos beta and sin(phi + beta) / cos beta.

    Parameters
    ----------
    results : Results
        Of an engine.

    Returns
    -------
    dict of str to array, shape (n,)
        `side_factor`, `rod_factor`, `radial_factor`, `tangential_factor` at the crank angles of the columns. [-]

    Raises
    ------
    MethodError
        If the machine is no slider-crank of its own.

    References
    ----------
    kolchin_demidov_2008, ch. 7.
    """
    solved = results.solved
    if not isinstance(solved, Solved):
        raise MethodError("functions of the rod angle exist for an engine only; give the results of one")
    swing = rod_swing(solved.lengths, results.grid)
    found = {
        "side_factor": side_factor(swing.sin, swing.cos),
        "rod_factor": rod_factor(swing.cos),
        "radial_factor": radial_factor(swing.cos_sum, swing.cos),
        "tangential_factor": tangential_factor(swing.sin_sum, swing.cos),
    }
    return {key: np.asarray(values, dtype=float) for key, values in found.items()}

"""What notes tabulate beside the forces: each force of the rod per force on the piston pin."""

from __future__ import annotations

from crankwork.analysis.forces import columns
from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array

FACTORS = ("side_factor", "rod_factor", "radial_factor", "tangential_factor")


def force_functions(results: Results) -> dict[str, Array]:
    """Return tan beta, 1 / cos beta, cos(phi + beta) / cos beta and sin(phi + beta) / cos beta. [-]

    `side_factor`, `rod_factor`, `radial_factor`, `tangential_factor` at the crank angles of the columns. Source:
    kolchin_demidov_2008, ch. 7.
    """
    solved = results.solved
    if not isinstance(solved, Solved):
        raise MethodError("functions of the rod angle exist for an engine only; give the results of one")
    return columns(solved, results.grid, FACTORS)

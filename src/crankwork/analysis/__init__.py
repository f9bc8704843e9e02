"""The analysis of a machine: columns over the crank angle, summary, checks."""

from crankwork.analysis.analyse import analyse, columns_only, value_only, with_method
from crankwork.analysis.forces import columns
from crankwork.analysis.results import Results
from crankwork.analysis.solved import Notice, Solved, WorkingSpace, solve
from crankwork.kinematics.crank_grid import Array

__all__ = [
    "Array",
    "Notice",
    "Results",
    "Solved",
    "WorkingSpace",
    "analyse",
    "columns",
    "columns_only",
    "solve",
    "value_only",
    "with_method",
]

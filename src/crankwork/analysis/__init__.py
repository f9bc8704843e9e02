"""The analysis of a machine: columns over the crank angle, summary, checks."""

from crankwork.analysis.analyse import analyse, columns_only, value_only, with_method
from crankwork.analysis.cylinder_forces import columns
from crankwork.analysis.prepared import Notice, PreparedMachine, WorkingSpace, prepare
from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array

__all__ = [
    "Array",
    "Notice",
    "PreparedMachine",
    "Results",
    "WorkingSpace",
    "analyse",
    "columns",
    "columns_only",
    "prepare",
    "value_only",
    "with_method",
]

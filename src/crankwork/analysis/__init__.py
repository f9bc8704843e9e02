"""The analysis of a machine: columns over the crank angle, summary, checks."""

from crankwork.analysis.analyse import analyse, columns_only, value_only, with_method
from crankwork.analysis.cylinder_forces import columns, traced_cylinder
from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array

__all__ = [
    "Array",
    "Results",
    "analyse",
    "columns",
    "columns_only",
    "traced_cylinder",
    "value_only",
    "with_method",
]

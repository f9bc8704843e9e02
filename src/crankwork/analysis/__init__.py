"""The analysis of a machine: columns over the crank angle, summary, checks."""

from crankwork.analysis.analyse import analyse, with_method
from crankwork.analysis.results import Results
from crankwork.analysis.solved import Notice, Solved, WorkingSpace, solve
from crankwork.analysis.state import columns, harmonic_columns

__all__ = [
    "Notice",
    "Results",
    "Solved",
    "WorkingSpace",
    "analyse",
    "columns",
    "harmonic_columns",
    "solve",
    "with_method",
]

"""Kinematics and dynamics of crank-driven machines.

>>> import crankwork
>>> machine = crankwork.read_machine(crankwork.template("engine"))
>>> results = crankwork.analyse(machine)
>>> round(results["mean_torque"], 2)
34.94
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from crankwork.analysis import Results, analyse, with_method
    from crankwork.description.machine_file import json_schema, read, read_machine, template, template_names
    from crankwork.kinematics.crank_grid import CrankGrid
    from crankwork.machine import Machine
    from crankwork.report.figures import figures
    from crankwork.report.summary import summary_text

__version__ = "0.1.0"

# Where each name lives; it is imported when first used, so that the command line starts fast.
_HOMES = {
    "CrankGrid": "kinematics.crank_grid",
    "Machine": "machine",
    "Results": "analysis",
    "analyse": "analysis",
    "figures": "report.figures",
    "json_schema": "description.machine_file",
    "read": "description.machine_file",
    "read_machine": "description.machine_file",
    "summary_text": "report.summary",
    "template": "description.machine_file",
    "template_names": "description.machine_file",
    "with_method": "analysis",
}

__all__ = [
    "CrankGrid",
    "Machine",
    "Results",
    "analyse",
    "figures",
    "json_schema",
    "read",
    "read_machine",
    "summary_text",
    "template",
    "template_names",
    "with_method",
]


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module 'crankwork' has no attribute '{name}'")
    return getattr(importlib.import_module(f"crankwork.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])

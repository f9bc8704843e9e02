"""Kinematics and dynamics of crank-driven machines.

>>> import crankwork
>>> machine = crankwork.read_machine(crankwork.template("engine"))
>>> results = crankwork.analyse(machine)
>>> round(results["mean_torque"], 2)
31.45
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from crankwork.registered import RegisteredMethod
from crankwork.version import __version__ as __version__

if TYPE_CHECKING:
    from crankwork.analysis.analyse import analyse, with_method
    from crankwork.analysis.compare import Comparison, compare
    from crankwork.analysis.results import Results
    from crankwork.description.document import Description, load
    from crankwork.description.machine_file import json_schema, read, read_machine, template, template_names
    from crankwork.errors import (
        CrankworkError,
        DoubtfulError,
        GeometryError,
        InputError,
        MethodError,
        MissingExtraError,
        RenamedKeyWarning,
        UnknownKeyError,
    )
    from crankwork.kinematics.crank_grid import CrankGrid
    from crankwork.kinematics.motion import Motion
    from crankwork.loads.applied_loads import AppliedLoads, force_at
    from crankwork.loads.load import LoadLaw
    from crankwork.machine import Machine
    from crankwork.mechanism.catalog import (
        crank_shaper,
        four_bar,
        scotch_yoke,
        slotted_press,
        stephenson_six_bar,
        toggle_press,
        watt_six_bar,
        whitworth,
    )
    from crankwork.mechanism.driver import Law, MotionLaw, Segment
    from crankwork.mechanism.mechanism import Mechanism
    from crankwork.method import Method
    from crankwork.note.options import NoteOptions
    from crankwork.note.sections import note_of, written_note
    from crankwork.quantities import QUANTITIES
    from crankwork.report.figures import figures
    from crankwork.report.notebook import Picture
    from crankwork.report.summary import summary_text
    from crankwork.study.optimise import Optimum, optimise
    from crankwork.study.solve import SeveralSolutions, Solution, solve, solve_several
    from crankwork.study.spread import Spreads, spread
    from crankwork.study.variants import Swept, sweep


# Where each name lives; it is imported when first used, so that the command line starts fast.
_HOMES = {
    "AppliedLoads": "loads.applied_loads",
    "Comparison": "analysis.compare",
    "CrankGrid": "kinematics.crank_grid",
    "CrankworkError": "errors",
    "Description": "description.document",
    "DoubtfulError": "errors",
    "GeometryError": "errors",
    "InputError": "errors",
    "Law": "mechanism.driver",
    "LoadLaw": "loads.load",
    "Machine": "machine",
    "Mechanism": "mechanism.mechanism",
    "Method": "method",
    "MethodError": "errors",
    "MissingExtraError": "errors",
    "Motion": "kinematics.motion",
    "MotionLaw": "mechanism.driver",
    "NoteOptions": "note.options",
    "Optimum": "study.optimise",
    "Picture": "report.notebook",
    "QUANTITIES": "quantities",
    "RenamedKeyWarning": "errors",
    "Results": "analysis",
    "Segment": "mechanism.driver",
    "SeveralSolutions": "study.solve",
    "Solution": "study.solve",
    "Spreads": "study.spread",
    "Swept": "study.variants",
    "UnknownKeyError": "errors",
    "analyse": "analysis",
    "compare": "analysis.compare",
    "crank_shaper": "mechanism.catalog",
    "figures": "report.figures",
    "force_at": "loads.applied_loads",
    "four_bar": "mechanism.catalog",
    "json_schema": "description.machine_file",
    "load": "description.document",
    "note_of": "note.sections",
    "optimise": "study.optimise",
    "read": "description.machine_file",
    "read_machine": "description.machine_file",
    "scotch_yoke": "mechanism.catalog",
    "slotted_press": "mechanism.catalog",
    "solve": "study.solve",
    "solve_several": "study.solve",
    "spread": "study.spread",
    "stephenson_six_bar": "mechanism.catalog",
    "summary_text": "report.summary",
    "sweep": "study.variants",
    "template": "description.machine_file",
    "template_names": "description.machine_file",
    "toggle_press": "mechanism.catalog",
    "watt_six_bar": "mechanism.catalog",
    "whitworth": "mechanism.catalog",
    "with_method": "analysis",
    "written_note": "note.sections",
}

__all__ = [
    "AppliedLoads",
    "Comparison",
    "CrankGrid",
    "CrankworkError",
    "Description",
    "DoubtfulError",
    "GeometryError",
    "InputError",
    "Law",
    "LoadLaw",
    "Machine",
    "Mechanism",
    "Method",
    "MethodError",
    "MissingExtraError",
    "Motion",
    "MotionLaw",
    "NoteOptions",
    "Optimum",
    "Picture",
    "QUANTITIES",
    "RenamedKeyWarning",
    "Results",
    "Segment",
    "SeveralSolutions",
    "Solution",
    "Spreads",
    "Swept",
    "UnknownKeyError",
    "analyse",
    "compare",
    "crank_shaper",
    "figures",
    "force_at",
    "four_bar",
    "json_schema",
    "load",
    "note_of",
    "optimise",
    "read",
    "read_machine",
    "scotch_yoke",
    "slotted_press",
    "solve",
    "solve_several",
    "spread",
    "stephenson_six_bar",
    "summary_text",
    "sweep",
    "template",
    "template_names",
    "toggle_press",
    "watt_six_bar",
    "whitworth",
    "with_method",
    "written_note",
]


# Where the methods of results live that show, write or explain them.
_METHODS = {
    "__repr__": ("report.notebook", "short_text"),
    "_repr_html_": ("report.notebook", "page"),
    "explain": ("note.explain", "explanation"),
    "figure": ("report.notebook", "picture"),
    "to_dataframe": ("report.dataset", "frame"),
    "to_xarray": ("report.dataset", "dataset"),
    "write": ("report.dataset", "write"),
}


def _imported(home: str, name: str) -> Any:  # noqa: ANN401 - of any kind
    return getattr(importlib.import_module(f"crankwork.{home}"), name)


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module 'crankwork' has no attribute '{name}'")
    return _imported(_HOMES[name], name)


RegisteredMethod.find = lambda name: _imported(*_METHODS[name])


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])

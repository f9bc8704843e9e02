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


# The names of each module, which is imported when one of them is first used, so that the command line starts fast.
_MODULES = {
    "analysis": "Results analyse with_method",
    "analysis.compare": "Comparison compare",
    "description.document": "Description load",
    "description.machine_file": "json_schema read read_machine template template_names",
    "errors": """CrankworkError GeometryError InputError MethodError MissingExtraError RenamedKeyWarning
                 UnknownKeyError""",
    "kinematics.crank_grid": "CrankGrid",
    "kinematics.motion": "Motion",
    "loads.applied_loads": "AppliedLoads force_at",
    "loads.load": "LoadLaw",
    "machine": "Machine",
    "mechanism.catalog": """crank_shaper four_bar scotch_yoke stephenson_six_bar toggle_press
                            watt_six_bar whitworth""",
    "mechanism.driver": "Law MotionLaw Segment",
    "mechanism.mechanism": "Mechanism",
    "method": "Method",
    "note.options": "NoteOptions",
    "note.sections": "note_of written_note",
    "quantities": "QUANTITIES",
    "report.figures": "figures",
    "report.notebook": "Picture",
    "report.summary": "summary_text",
    "study.optimise": "Optimum optimise",
    "study.solve": "SeveralSolutions Solution solve solve_several",
    "study.spread": "Spreads spread",
    "study.variants": "Swept sweep",
}
_HOMES = {name: home for home, names in _MODULES.items() for name in names.split()}

__all__ = [
    "AppliedLoads",
    "Comparison",
    "CrankGrid",
    "CrankworkError",
    "Description",
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

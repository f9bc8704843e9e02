"""The page of the names that `import crankwork` gives, from their docstrings, by subject."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

import crankwork

SUBJECTS = {
    "Files and machines": (
        "load", "read", "read_machine", "template", "template_names", "json_schema", "Description", "Machine", "Method",
    ),
    "Results": ("analyse", "with_method", "Results", "compare", "Comparison", "summary_text", "figures", "Picture",
                "QUANTITIES"),
    "Notes": ("note_of", "written_note", "NoteOptions"),
    "Many designs": ("solve", "Solution", "solve_several", "SeveralSolutions", "spread", "Spreads", "sweep", "Swept",
                     "optimise", "Optimum"),
    "Mechanisms": ("Mechanism", "Motion", "CrankGrid", "MotionLaw", "Segment", "Law", "four_bar", "crank_shaper",
                   "scotch_yoke", "stephenson_six_bar", "toggle_press", "watt_six_bar", "whitworth"),
    "Loads of one's own": ("AppliedLoads", "LoadLaw", "force_at"),
    "Errors": ("CrankworkError", "GeometryError", "InputError", "MethodError", "MissingExtraError",
               "RenamedKeyWarning", "UnknownKeyError"),
}  # fmt: skip

# what is no class and no function has no docstring
_DATA = {
    "QUANTITIES": (
        "Every quantity by its key, with `label`, `symbol`, `unit`, `si_unit` and `definition`: "
        "those of the reference of results."
    )
}


def examples() -> dict[str, str]:
    """Return the examples of names whose docstrings have none, by name."""
    written = (Path(__file__).parent / "name_examples.md").read_text(encoding="utf-8")
    parts = re.findall(r"^## (.+?)\n\n(.+?)(?=^## |\Z)", written, re.MULTILINE | re.DOTALL)
    return {name: shown.strip() for names, shown in parts for name in names.split()}


def without_example() -> list[str]:
    """Return the public names that have no example."""
    shown = examples()
    return [name for name in crankwork.__all__
            if name not in shown and ">>>" not in (inspect.getdoc(getattr(crankwork, name)) or "")]  # fmt: skip


def _entry(name: str) -> list[str]:
    value = getattr(crankwork, name)
    if inspect.isclass(value):
        members = [] if issubclass(value, Exception) else ["   :members:"]
        return [f".. autoclass:: crankwork.{name}", *members]
    if callable(value):
        return [f".. autofunction:: crankwork.{name}"]
    return [f".. py:data:: crankwork.{name}", "", f"   {_DATA[name]}"]


def _shown(name: str) -> list[str]:
    return ["", *(f"   {line}".rstrip() for line in examples()[name].splitlines())] if name in examples() else []


def page() -> str:
    """Return the page."""
    said = "What `import crankwork` gives. Values are in SI units unless it is said. The examples are run as tests."
    parts = [f"# Names of the package\n\n{said}\n"]
    for title, names in SUBJECTS.items():
        entries = ["\n".join([*_entry(name), *_shown(name)]) for name in names]
        parts.append(f"## {title}\n\n```{{eval-rst}}\n" + "\n\n".join(entries) + "\n```\n")
    return "\n".join(parts)


def left_out() -> list[str]:
    """Return the public names that stand on no page, or say nothing."""
    named = [name for names in SUBJECTS.values() for name in names]
    silent = [
        name for name in named
        if callable(getattr(crankwork, name)) and len((inspect.getdoc(getattr(crankwork, name)) or "").split()) < 3
    ]  # fmt: skip
    return sorted(set(crankwork.__all__) ^ set(named)) + silent

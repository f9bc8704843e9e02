"""What readers should know as sentences: notices about results, and which figures are left out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from crankwork.analysis import Results
from crankwork.formula.expression import symbol
from crankwork.locale import decimal, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.driver import Cylinder, LinkMotor
from crankwork.notation import argument_unit
from crankwork.quantities import QUANTITIES, Language
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit, label
from crankwork.report.tables import any_nonzero

# numbers of a notice that are in the unit of its quantity
_IN_UNIT = ("value", "low", "high", "before", "after")
_DRAWN = ("reduced_inertia", "static_torque", "dynamic_torque", "driving_torque", "joint_force")


def notice_text(code: str, values: Mapping[str, float | str], language: Language) -> str:
    """Return the sentence of a notice with its numbers printed."""
    shown = {}
    for key, value in values.items():
        if key == "quantities":
            shown[key] = ", ".join(label(name, language) for name in str(value).split(", "))
        elif key == "quantity":
            shown[key] = label(str(value), language)
        elif key == "argument":
            shown[key] = symbol(str(value), language)
        elif key == "angles":
            shown[key] = decimal(str(value), language).replace("-", "−")
        elif key in ("shift", "write"):
            # to be written in the machine file
            shown[key] = f"{value:g}"
        elif isinstance(value, str):
            shown[key] = in_language(value, language)
        else:
            # pressure steps are the only values with a unit of their own, MPa
            shown[key] = number(value / 1e6 if key == "step" else value, language, digits=5)
    if code in ("implausible", "implausible_own", "impossible", "law_jump"):
        key = str(values["quantity"])
        numbers = {name: displayed(key, float(values[name])) for name in _IN_UNIT if name in values}
        shown |= {name: number(value, language) for name, value in numbers.items()}
        shown["unit"] = f" {unit_name(key_unit(key), language)}".rstrip()
    if "argument" in values:
        unit = unit_name(argument_unit(str(values["argument"])), language)
        shown |= {key: f"{shown[key]} {unit}".rstrip() for key in ("value", "high")}
    return translate(f"notices.{code}", language, **shown)


def skipped_figure_notes(results: Results, language: Language, *, zeros: bool = True) -> Iterator[str]:
    """Yield sentences about figures that are left out; `zeros`: also those of what is zero throughout."""
    names = list(dict.fromkeys(label(kind, language) for kind in _zero(results))) if zeros else []
    if names:
        yield translate("report.not_drawn_zero", language, names=", ".join(names))
    if results.machine.linkage is not None and _has_no_groups(results):
        yield translate("report.no_force_plans", language)


def _zero(results: Results) -> Iterator[str]:
    """Yield the quantities that figures are of and that are zero throughout."""
    for kind in _DRAWN:
        keys: Iterable[str] = [key for key in results.columns if key_of(key).quantity == kind and kind in QUANTITIES]
        if keys and not any_nonzero(keys, results.columns):
            yield kind


def _has_no_groups(results: Results) -> bool:
    """Return whether there are joint forces, but a driver within a group, so that none is apart from it."""
    has_forces = any(key.startswith("joint_force.") for key in results.columns)
    return has_forces and isinstance(results.machine.mechanism.driver, Cylinder | LinkMotor)

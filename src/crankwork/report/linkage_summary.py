"""What to say of a linkage, or of a table of transfer functions, in a summary."""

from __future__ import annotations

from crankwork.analysis.linkage import four_bar_type
from crankwork.linkage_machine import LinkageMachine, TabulatedMachine
from crankwork.locale import say
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.language import method_name


def method_words(machine: LinkageMachine | TabulatedMachine, language: Language) -> str:
    """Return how the results of a linkage are made, in words."""
    if isinstance(machine, TabulatedMachine):
        return say("report.tabulated", language)
    return method_name("exact", 0, "", language)


def headline(machine: LinkageMachine | TabulatedMachine, language: Language) -> list[str]:
    """Return mobility, groups and formula of structure of a linkage, or the size of a table."""
    if isinstance(machine, TabulatedMachine):
        return [say("check.table", language, bodies=len(machine.bodies), positions=len(machine.angles))]
    found, _ = structure(machine.linkage)
    if found is None:
        return [say("check.linkage", language)]
    numbered = ", ".join(f"{number} {name}" for number, name in enumerate(found.links, start=1))
    count, number = len(found.links), "I" * found.number if found.number < 4 else found.number
    return [
        say("check.links", language, count=count, names=numbered),
        say("check.mobility", language, links=count, joints=found.joints, mobility=found.mobility),
        say("check.structure", language, formula=found.formula, number=number),
        *_grashof_lines(machine, language),
    ]


def _grashof_lines(machine: LinkageMachine, language: Language) -> list[str]:
    """Return the type of a four-bar linkage by Grashof."""
    kind = four_bar_type(machine)
    if not kind:
        return []
    shown = kind if language == "en" else say(f"kinds.{kind.replace(' ', '_')}", language)
    return [say("check.grashof", language, kind=shown)]

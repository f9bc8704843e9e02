"""What to say of a linkage, or of a table of transfer functions, in a summary."""

from __future__ import annotations

from crankwork.linkage_machine import LinkageMachine, TabulatedMachine
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.language import method_name, word


def method_words(machine: LinkageMachine | TabulatedMachine, language: Language) -> str:
    """Return how the results of a linkage are made, in words."""
    if isinstance(machine, TabulatedMachine):
        return word("tabulated", language)
    return method_name("exact", 0, "", language)


def headline(machine: LinkageMachine | TabulatedMachine) -> list[str]:
    """Return mobility, groups and formula of structure of a linkage, or the size of a table."""
    if isinstance(machine, TabulatedMachine):
        return [f"transfer functions of {len(machine.bodies)} bodies at {len(machine.angles)} positions"]
    found, _ = structure(machine.linkage)
    if found is None:
        return ["linkage"]
    numbered = ", ".join(f"{number} {name}" for number, name in enumerate(found.links, start=1))
    return [
        f"linkage of {len(found.links)} moving links: {numbered}",
        f"mobility W = 3·{len(found.links)} − 2·{found.joints} = {found.mobility} (Chebyshev)",
        f"structure {found.formula}, mechanism of class {'I' * found.number if found.number < 4 else found.number}",
    ]

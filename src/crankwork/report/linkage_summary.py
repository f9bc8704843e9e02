"""What to say of a linkage, or of a table of transfer functions, in a summary."""

from __future__ import annotations

import math

from crankwork.kinematics.quality import grashof
from crankwork.linkage_machine import LinkageMachine, TabulatedMachine
from crankwork.mechanism.dyads import RRR
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
    four_bar = _grashof_lines(machine)
    numbered = ", ".join(f"{number} {name}" for number, name in enumerate(found.links, start=1))
    return [
        f"linkage of {len(found.links)} moving links: {numbered}",
        f"mobility W = 3·{len(found.links)} − 2·{found.joints} = {found.mobility} (Chebyshev)",
        f"structure {found.formula}, mechanism of class {'I' * found.number if found.number < 4 else found.number}",
        *four_bar,
    ]


def _grashof_lines(machine: LinkageMachine) -> list[str]:
    """Return the type of a four-bar linkage by Grashof."""
    match machine.mechanism.dyads:
        case (RRR() as dyad,) if {dyad.joint_a, dyad.joint_b} & set(machine.mechanism.ground):
            fixed = next(one for one in (dyad.joint_a, dyad.joint_b) if one in machine.mechanism.ground)
            crank = machine.mechanism.crank
            coupler, rocker = dyad.length_a, dyad.length_b
            if fixed == dyad.joint_a:
                coupler, rocker = rocker, coupler
            ground = math.dist(machine.mechanism.ground[fixed], crank.pivot)
            return [f"four-bar linkage by Grashof: {grashof(crank.radius, coupler, rocker, ground).type}"]
    return []

"""Equations of moments and forces of groups of links in a note, the lengths of the force plans and what they give."""

from __future__ import annotations

import cmath
import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import partial

from crankwork.analysis.force_plans import (
    MomentEquation,
    PolygonForce,
    constructed_forces,
    force_plans,
    loads_on_links,
    moment_equations,
)
from crankwork.analysis.vector_polygons import worked_position
from crankwork.formula.calculation_lines import ValueLine
from crankwork.locale import capital, translate
from crankwork.note.document import Block, Cell, Equation, Math, Paragraph, Reference, Run, Runs
from crankwork.note.equations import value_box
from crankwork.note.layout import DOT, EQUALS, PRODUCT, Box, Digits, Fence, Fraction, PrintedEquation, Row, Sign, row
from crankwork.note.material import Material
from crankwork.note.symbols import number_box, subscript, symbol_box
from crankwork.note.vector_equations import READING, vector_box
from crankwork.note.wording import Words
from crankwork.report.display import key_unit, link_label, link_numbers, symbol
from crankwork.report.forces import arm_symbol, force_symbol, torque_symbol
from crankwork.report.plans import vector_mark
from crankwork.units import to_si

_DIGITS, _MOMENTS, _NOISE = 4, "ΣM_", 1e-9


def has_polygons(material: Material) -> bool:
    """Return whether each group of a linkage has its own equilibrium."""
    return bool(force_plans(material.results, worked_position(material.results)))


def _numbers(material: Material) -> dict[str, int]:
    return {name: int(number) for name, number in link_numbers(material.results).items() if number.isdecimal()}


def _name(force: PolygonForce, numbers: dict[str, int], words: Words) -> str:
    return force_symbol(force, numbers, words.language).strip("$").replace(" ", ",")


def inertia_of_links(material: Material) -> Iterator[Block]:
    """Yield inertia forces and torques of all links, and their weights, at the position that is worked."""
    words, results, numbers = material.words, material.results, _numbers(material)
    forces, torques = loads_on_links(results, worked_position(results))
    of_kind = {kind: {load.link: load.force for load in forces if load.kind == kind} for kind in ("inertia", "weight")}
    speed = results.solved.speed or 1.0
    turning = {load.link: load.torque for load in torques if load.kind == "inertia"}
    titles: list[str | Runs] = ["link", *map(words.titled, ("centre_acceleration", "link_inertia_force")), "angle"]
    titles += map(words.titled, ("link_angular_acceleration", "link_inertia_torque"))
    titles += [(Math(words.mark("weight")), f", {words.unit('joint_force')}")] if of_kind["weight"] else []
    rows, bodies = list[tuple[Cell, ...]](), results.machine.mechanism.bodies
    for link in dict.fromkeys(body.link for body in bodies):
        mass, inertia = (
            sum(getattr(body, name) for body in bodies if body.link == link) for name in ("mass", "inertia")
        )
        pull, torque = complex(*of_kind["inertia"].get(link, (0.0, 0.0))), turning.get(link, 0.0)
        # what is left of rounding is none
        torque = torque if abs(torque) > _NOISE * inertia * speed**2 else 0.0
        values = {"centre_acceleration": (abs(pull), mass), "link_inertia_force": (abs(pull), 1.0), "": (0.0, 0.0),
                  "link_angular_acceleration": (-torque, inertia), "link_inertia_torque": (torque, 1.0)}  # fmt: skip
        values |= (
            {"joint_force": (abs(complex(*of_kind["weight"].get(link, (0.0, 0.0)))), 1.0)} if of_kind["weight"] else {}
        )
        cells = [words.shown(key, size / over, digits=_DIGITS) if size and over else "–"
                 for key, (size, over) in values.items()]  # fmt: skip
        cells[2] = words.fixed(math.degrees(cmath.phase(pull)) % 360.0, 1) if pull else "–"
        rows.append((f"{numbers[link]} ({link_label(link, words.language)})", *cells))
    yield words.paragraph("inertia_listed", table=Reference("t:inertia_loads"))
    yield words.table("inertia_loads", titles, rows, "l" + "r" * (len(titles) - 1), "t:inertia_loads")


def equilibrium(material: Material) -> Iterator[Block]:
    """Yield the equations of moments of each group and that of its plan of forces, from the last one to the crank."""
    words, numbers, degrees = material.words, _numbers(material), worked_position(material.results)
    moments, solved = moment_equations(material.results, degrees), set[str]()
    plans = force_plans(material.results, degrees)
    if plans:
        yield words.paragraph("equilibrium", **words.at_place(degrees))
    for plan in plans:
        key = "drawing.links" if len(plan.links) > 1 else "drawing.link"
        links = ", ".join(str(numbers[link]) for link in plan.links)
        yield Paragraph((f"{capital(translate(key, words.language, links=links))}:",))
        lines, texts, known = list[Row](), list[str](), set(solved)
        for equation in (equation for equation in moments if equation.link in plan.links):
            left, text = _moments(equation, numbers, words)
            lines += left
            texts.append(text)
            if equation.kind == "guide":
                # on a block its guide is known then, and the force of its pin follows
                on_block = [force for force in plan.forces if force.is_load and force.name == equation.unknown]
                on_block.append(PolygonForce("guide", equation.unknown, 0.0, 0.0))
                on_block += [force for force in plan.forces
                             if force.kind == "pin" and force.name not in {*solved, equation.point}]  # fmt: skip
                block = _vector_sum(on_block, {equation.unknown}, (), numbers, words)
                lines.append(block[0])
                known |= {force.name for force in on_block}
        forces, text = _vector_sum(plan.forces, known, solved, numbers, words)
        lines.append(forces)
        texts.append(text)
        solved |= {force.name for force in plan.forces}
        yield Equation(ValueLine("", 0.0), printed=PrintedEquation(tuple(lines), "; ".join(texts)))


def _vector_sum(
    forces: Iterable[PolygonForce],
    known: Collection[str],
    solved: Collection[str],
    numbers: dict[str, int],
    words: Words,
) -> tuple[Row, str]:
    """Return the equation of a plan of forces, and it as text; what the group before gave acts the other way."""
    parts, written = list[Box](), list[str]()
    for force in forces:
        name, sign = _name(force, numbers, words), "−" if force.name in solved else "+"
        for part, lines in _parts(force, name, words, is_known=force.is_load or force.name in known):
            parts += [*([Sign(sign)] if parts or sign == "−" else []), vector_box(part, lines, words)]
        written.append(f"{sign} {name}")
    return row(*parts, EQUALS, Digits("0")), f"{' '.join(written).removeprefix('+ ')} = 0"


def _parts(force: PolygonForce, name: str, words: Words, *, is_known: bool) -> Iterator[tuple[str, int]]:
    """Yield the vectors of a force and how much of each is known: a part across its link wholly, that along it not."""
    if is_known or force.across is None:
        # of a guide and of a slider that drives the line of action is known
        yield name, 2 if is_known else 1 if force.kind in ("guide", "driver") else 0
        return
    if any(force.across):
        yield f"{name}{vector_mark('tangential', words.language)}", 2
    yield f"{name}{vector_mark('normal', words.language)}", 1


def _moments(equation: MomentEquation, numbers: dict[str, int], words: Words) -> tuple[list[Row], str]:
    """Return the equation of moments of a link, what is unknown in it worked out below it, and it as text."""
    language, sense = words.language, equation.sense
    number = partial(number_box, language=language, digits=_DIGITS)
    if equation.kind == "driver":
        name, length, unit = symbol("balancing_torque", language), "", "N*m"
    else:
        force = PolygonForce(equation.kind, equation.unknown, 0.0, 0.0)
        name, unit = _name(force, numbers, words), "N"
        length = f"l_{subscript(equation.point + equation.end)}" if equation.kind == "pin" else arm_symbol(name)
        name += vector_mark("tangential", language) if equation.kind == "pin" else ""
    terms = list[tuple[float, Row, Row]]()
    for acting, arm in equation.terms:
        shown = _name(acting, numbers, words)
        letters = row(symbol_box(shown), PRODUCT, symbol_box(arm_symbol(shown)))
        terms.append((sense * arm, letters, row(number(acting.size)[0], DOT, number(abs(arm))[0])))
    for load in equation.torques:
        shown, (value, _) = torque_symbol(load.kind, numbers.get(load.link, load.link), language), number(load.torque)
        terms.append((sense, row(symbol_box(shown)), row(Fence(value) if load.torque < 0 else value)))
    unknown = row(symbol_box(name), PRODUCT, symbol_box(length)) if length else row(symbol_box(name))
    total = row(symbol_box(f"{_MOMENTS}{subscript(equation.point)}"), EQUALS)
    known = [box for sign, letters, _ in terms for box in (Sign("−" if sign < 0 else "+"), letters)]
    first, text = row(total, unknown, *known, EQUALS, Digits("0")), f"{name} {length}".strip()
    result = value_box(equation.value if terms else 0.0, unit, language, _DIGITS)
    if not terms:
        return [row(first, Sign(",", "comma"), symbol_box(name), EQUALS, Digits("0"))], f"{text} = 0"
    sums = [
        _sum([(-sign, letters) for sign, letters, _ in terms]),
        _sum([(-sign, worked) for sign, _, worked in terms]),
    ]
    if length:
        sums = [Fraction(sums[0], symbol_box(length)), Fraction(sums[1], number(equation.arm)[0])]
    return [first, row(symbol_box(name), EQUALS, sums[0], EQUALS, sums[1], EQUALS, result)], f"{text} + … = 0"


def _sum(terms: list[tuple[float, Row]]) -> Box:
    """Return terms with their signs, none before the first unless it is a minus."""
    boxes = list[Box]()
    for sign, term in terms:
        boxes += [Sign("−", "binary" if boxes else "prefix")] if sign < 0 else [Sign("+")] if boxes else []
        boxes.append(term)
    return row(*boxes)


def compared_forces(material: Material) -> Iterator[Block]:
    """Yield the lengths of all forces on the plans, and those that are read on them beside the calculated ones."""
    results, words, degrees = material.results, material.words, worked_position(material.results)
    drawing = material.drawn.get("force_plans") if material.full or material.order != "en" else None
    plots, numbers = iter(drawing.plots if drawing is not None else ()), _numbers(material)
    unit, solved, rows, scales = words.unit("joint_force"), set[str](), list[tuple[Cell, ...]](), list[Run]()
    for plan in force_plans(results, degrees):
        plot = next(plots, None) if len(plan.forces) > 2 else None
        shown = (plot.x[1] - plot.x[0]) / plot.box.width if plot is not None else 0.0
        scale = float(to_si(shown, key_unit("joint_force")))
        lengths: Mapping[PolygonForce, float] = (
            constructed_forces(results, plan, solved, scale, READING) if shown else {}
        )
        links = ", ".join(str(numbers[link]) for link in plan.links)
        for index, (force, length) in enumerate(lengths.items()):
            size, off = words.shown("joint_force", force.size, digits=4), 100.0 * (length * scale / force.size - 1.0)
            read = words.number(shown * length, digits=4), size, unit, words.fixed(off, 2)
            known = force.is_load or force.name in solved
            given = ("–", size, unit, "–") if known else read
            rows.append(
                (links if not index else "", Math(_name(force, numbers, words)), words.fixed(length, 1), *given)
            )
        if lengths:
            mark = f" = {words.number(shown, digits=4)} {unit}/{words.unit('point_x')} ({links})"
            scales += [*(["; "] if scales else []), Math("μ_F"), mark]
        solved |= {force.name for force in plan.forces}
    if rows:
        titles = "members", "vector", "on_plan", "by_plan", "analytic", "unit", "deviation"
        table = words.table("compared_forces", titles, rows, "lcrrrcr", "t:compared_forces")
        values: dict[str, Run | Runs] = {"reading": words.number(READING), "scales": tuple(scales)}
        yield words.paragraph("forces_compared", table=Reference(table.label), **values)
        yield table

"""Plans of velocities, accelerations and forces in a note: vector equations by groups, what is read on the plans."""

from __future__ import annotations

import cmath
import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from crankwork.analysis.drawn_plans import (
    ConstructedPlan,
    PlanScales,
    PlanVector,
    VectorEquation,
    constructed_plans,
    is_constructed,
)
from crankwork.analysis.force_plans import (
    MomentEquation,
    PolygonForce,
    constructed_forces,
    force_plans,
    loads_on_links,
    moment_equations,
)
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.skeleton import skeleton
from crankwork.analysis.vector_polygons import POSITION_STEP, driver_rates, velocities, worked_position
from crankwork.formula.calculation_lines import ValueLine
from crankwork.locale import capital, translate
from crankwork.locale.numbers import unit_name
from crankwork.mechanism.mechanism import Crank
from crankwork.note.document import Block, Cell, Equation, Figure, Math, Paragraph, Reference, Run, Runs, Table
from crankwork.note.equations import value_box
from crankwork.note.layout import (
    DOT,
    EQUALS,
    PRODUCT,
    Box,
    Digits,
    Fence,
    Fraction,
    Marked,
    PrintedEquation,
    Row,
    Script,
    Sign,
    Upright,
    row,
)
from crankwork.note.material import Material
from crankwork.note.readings import LEGIBLE
from crankwork.note.sheets.packing import in_grid
from crankwork.note.sheets.plans import Scales
from crankwork.note.symbols import number_box, subscript, symbol_box
from crankwork.note.wording import Words
from crankwork.report.display import key_unit, link_label, link_numbers, symbol
from crankwork.report.forces import arm_symbol, force_symbol, torque_symbol
from crankwork.report.look import Style, position_sign, position_text
from crankwork.report.plans import acceleration_plan, vector_mark, velocity_plan
from crankwork.show.canvas import current_layout, marked, use_layout
from crankwork.show.scene import Drawing
from crankwork.units import to_si

# to which points and lengths are laid off and read on paper, and what is too short to be compared [mm]
READING, _SHORTEST = 0.5, 2.0
_SIGNS, _UNITS, _ROTARY = ("v", "a"), ("m/s", "m/s2"), ("rad/s", "rad/s2")
_TURNING, _KINDS = ("speed", "angular_acceleration"), ("velocities", "accelerations")
# shares of the largest value that are rounding
_NOISE, _DIGITS, _TALL = 1e-9, 4, 1.3
_MARKS: dict[str, Box] = {"=": EQUALS, "·": DOT, "": PRODUCT, "/": Sign("/", "slash")}
_COMMA = row(Sign(",", "comma"), Upright("\u2009"))
_FORCE_DIGITS, _MOMENTS, _FORCE_NOISE = 4, "ΣM_", 1e-9


def has_vector_equations(material: Material) -> bool:
    """Return whether the groups of a linkage have vector equations."""
    return is_constructed(material.machine.mechanism)


def vector_plans(material: Material) -> Iterator[Block]:
    """Yield the equations of all groups, both plans, and the values read on them beside the exact ones."""
    results, words, mechanism = material.results, material.words, material.machine.mechanism
    degrees, links = worked_position(results), material.structure.links if material.structure is not None else ()
    figure, scales = _figure(material, degrees, links)
    exact, drawn = (constructed_plans(results, degrees, scales, precision, links) for precision in (0.0, READING))
    if exact is None or drawn is None:
        yield from material.presented((), ("velocity_plan", "acceleration_plan"))
        return
    yield words.paragraph("vector_equations", **words.at_place(degrees))
    coincident = velocities(mechanism, sample_motion(mechanism, [degrees]), 0, 1.0, links).coincident
    points = [
        words.phrase("beneath", point=point, link=str(link), other=over) for point, (link, over) in coincident.items()
    ]
    if points:
        yield words.paragraph("coincident", points="; ".join(points))
    shape = skeleton(mechanism, links)
    ends, driver = "".join(shape.letters[name] for name in shape.members[0].points[:2]), mechanism.driver
    arm = PlanVector(ends, "normal", 0j, link=1, arm=driver.radius if isinstance(driver, Crank) else 0.0)
    for order, plan in enumerate(exact):
        writer = _Writer(order, scales[1 + order], exact[0].turning, words)
        yield words.paragraph(f"equations_of_{_KINDS[order]}")
        turning = [each.turning.get(1, 0.0) for each in exact]
        given = driver_rates(results, results.columns_at(np.array([degrees])))[order][0]
        yield writer.block((), [writer.crank(arm, *turning) if arm.arm else writer.slider(ends[0], float(given))])
        for group in plan.groups:
            yield writer.block(
                group, [line for equation in group for part in equation.right for line in writer.worked(part)]
            )
    if material.options.figures:
        yield words.paragraph(
            "see_constructions", constructions=words.sentence("figure_named", figures=Reference("f:velocity_plan"))
        )
        yield Figure(
            figure,
            figure.title,
            translate("seen.velocity_plan", words.language),
            label="f:velocity_plan",
            to_scale=True,
        )
        material.leave_out("velocity_plan", "acceleration_plan")
    compared = material.full or material.order != "en"
    compared_plans = [_table(exact[k], drawn[k] if compared else None, k, scales[1 + k], words) for k in range(2)]
    tables = [table for table, _ in compared_plans]
    material.plan_difference = max(difference for _, difference in compared_plans) if compared else None
    values: dict[str, Run | Runs] = {kind: Reference(table.label) for kind, table in zip(_KINDS, tables, strict=True)}
    mm = unit_name("mm", words.language)
    scale = f"\u00a0=\u00a0{words.number(1e3 * scales.length)}\u00a0{mm}/{mm}"
    values |= {"length": (Math("μ_l"), scale), "reading": words.number(READING), "shortest": words.number(_SHORTEST)}
    yield words.paragraph("read_on_plans" if compared else "plan_vectors", **values)
    yield from tables


def _figure(material: Material, degrees: float, links: tuple[str, ...]) -> tuple[Drawing, PlanScales]:
    """Return both plans beside each other, and the scales at which the note draws plans."""
    results, language, scales = material.results, material.words.language, Scales()
    mechanism, style = results.machine.mechanism, Style(language, links, results.period)
    moved, rates = sample_motion(mechanism, [degrees]), driver_rates(results, results.columns_at(np.array([degrees])))
    given, number = (float(rates.first[0]), float(rates.second[0])), round(degrees / POSITION_STEP)
    drawn = (
        lambda: scales.kept("v", 0, velocity_plan(mechanism, moved, 0, given[0], style, number)),
        lambda: scales.kept("a", 0, acceleration_plan(mechanism, moved, 0, *given, style, number)),
    )
    where = marked(f"{position_sign(style)} = {position_text(degrees, style)}")
    with use_layout(current_layout()._replace(tall=_TALL)):
        plans = in_grid(drawn, 2, translate("headings.polygons", language), language, lambda: where)
    (plot,) = material.position_plan.plots
    return plans, PlanScales(1.0 / plot.metre, scales.of("v", 0), scales.of("a", 0))


class _Writer:
    """Writes the equations of velocities, order 0, or accelerations, 1; `rates`: how fast links turn [rad/s]."""

    def __init__(self, order: int, scale: float, rates: dict[int, float], words: Words) -> None:
        self._order, self._scale, self._rates, self._words = order, scale, rates, words

    def block(self, equations: Sequence[VectorEquation], further: list[Row]) -> Equation:
        """Return the equations of a group with lines below them, under one number."""
        lines = [row(*self._parts(equation)) for equation in equations] + further
        sums = [" + ".join(map(self._name, equation.right)) for equation in equations]
        lefts = [self._name(equation.left) for equation in equations]
        text = "; ".join(f"{left} = {total}" if total else left for left, total in zip(lefts, sums, strict=True))
        return Equation(ValueLine("", 0.0), printed=PrintedEquation(tuple(lines), text or _SIGNS[self._order]))

    def _name(self, vector: PlanVector) -> str:
        return name_of(vector, self._order, self._words)

    def _parts(self, equation: VectorEquation) -> Iterator[Box]:
        """Yield a vector equation, and along what line each vector lies."""
        yield vector_box(self._name(equation.left), equation.left.known, self._words)
        for index, vector in enumerate(equation.right):
            yield from (Sign("+") if index else EQUALS, vector_box(self._name(vector), vector.known, self._words))
        for vector in (equation.left, *equation.right):
            where = vector.line[1:] or "0"
            shown = self._words.phrase("along_guide", link=where) if vector.line and where.isdecimal() else where
            if vector.line or not vector.drawn:
                yield from (_COMMA, symbol_box(self._name(vector))) if equation.right else ()
                yield from (Sign(vector.line[0], "relation") if vector.line else EQUALS, Upright(shown))

    def _worked(self, unit: str, *parts: str | float | Script | Fence) -> Row:
        """Return symbols and numbers side by side, the last with its unit."""
        boxes: list[Box] = []
        for part in parts:
            box = self._number(part) if isinstance(part, float) else part
            boxes.append(_MARKS.get(box) or symbol_box(box) if isinstance(box, str) else box)
        value = float(parts[-1]) if isinstance(parts[-1], float) else 0.0
        return row(*boxes[:-1], value_box(value, unit, self._words.language, _DIGITS))

    def _number(self, value: float) -> Box:
        return number_box(value, self._words.language, _DIGITS)[0]

    def _turn(self, order: int, link: int) -> str:
        return f"{symbol(_TURNING[order], self._words.language)}_{link}"

    def crank(self, arm: PlanVector, rate: float, second: float) -> Row:
        """Return the velocity of the crank pin, or its normal acceleration and the tangential one if there is one."""
        name, length, turn = arm.name[1:], f"l_{arm.name}", self._turn(0, 1)
        if not self._order:
            return self._worked(
                "m/s", f"v_{name}", "=", turn, "", length, "=", abs(rate), "·", arm.arm, "=", abs(rate) * arm.arm
            )
        normal = self._normal(f"a_{name}^n" if second else f"a_{name}", arm, rate)
        if not second:
            return normal
        mark, turn = vector_mark("tangential", self._words.language), self._turn(1, 1)
        product = (turn, "", length, "=", abs(second), "·", arm.arm, "=", abs(second) * arm.arm)
        return row(normal, _COMMA, self._worked("m/s2", f"a_{name}{mark}", "=", *product))

    def slider(self, letter: str, rate: float) -> Row:
        """Return the velocity or acceleration of a slider that drives, which its law gives."""
        name = symbol_box(f"{_SIGNS[self._order]}_{letter}")
        size = self._worked(_UNITS[self._order], Fence(name, "||"), "=", abs(rate))
        where = Upright(self._words.phrase("along_guide", link="1"))
        return row(size, _COMMA, name, Sign("∥", "relation"), where)

    def _normal(self, name: str, arm: PlanVector, rate: float) -> Row:
        squared = Script(self._number(abs(rate)), None, Upright("2"))
        product = f"{self._turn(0, arm.link)}²", "", f"l_{arm.name}", "=", squared, "·", arm.arm
        return self._worked("m/s2", name, "=", *product, "=", rate**2 * arm.arm)

    def worked(self, part: PlanVector) -> Iterator[Row]:
        """Yield what goes with a part of a relative velocity or acceleration: its size, or the rate of its link."""
        length, rate, name = abs(part.drawn), abs(self._rates.get(part.link, 0.0)), self._name(part)
        size = length * self._scale if length > _NOISE else 0.0
        match part.kind:
            case "normal":
                yield self._normal(name, part, rate)
            case "relative" | "tangential":
                quotient = name, "/", f"l_{part.name}", "=", size, "/", part.arm, "=", size / part.arm
                turn = Fence(symbol_box(self._turn(self._order, part.link)), "||")
                yield self._worked(_ROTARY[self._order], turn, "=", *quotient)
            case "coriolis" if rate:
                relative = size / 2 / rate
                product = 2.0, "", self._turn(0, part.link), "", f"v_{part.name}", "=", 2.0, "·", rate, "·", relative
                yield self._worked("m/s2", name, "=", *product, "=", size)


def vector_box(name: str, known: int, words: Words) -> Box:
    """Return a vector, underlined once where its line is known and twice where its magnitude is known too."""
    box = symbol_box(name)
    script = box if isinstance(box, Script) else Script(box)
    marked: Box = Script(Marked(script.base, words.mark("vector")), script.below, script.above)
    for _ in range(known):
        marked = Marked(marked, "line")
    return marked


def name_of(vector: PlanVector, order: int, words: Words) -> str:
    """Return the symbol of a vector: `v_BA`, `a_BA^n`."""
    return f"{_SIGNS[order]}_{vector.name}{vector_mark(vector.kind, words.language) if order else ''}"


def plan_vectors(plan: ConstructedPlan) -> dict[tuple[str, str], PlanVector]:
    """Return the vectors of a plan by name and kind, each once."""
    parts = [part for group in plan.groups for equation in group for part in (*equation.right, equation.left)]
    return {(part.name, part.kind): part for part in (*parts, *plan.similar)}


def _table(
    plan: ConstructedPlan, drawn: ConstructedPlan | None, order: int, scale: float, words: Words
) -> tuple[Table, float]:
    """Return the vectors of a plan and the rates of the links: exact, and beside them as they are read if drawn.

    The number is the largest difference of long vectors, as a share of each.
    """
    vectors, rows, difference = plan_vectors(plan), list[tuple[Cell, ...]](), 0.0
    read = (
        {key: round(abs(part.drawn) / READING) * READING for key, part in plan_vectors(drawn).items()} if drawn else {}
    )
    most = max(abs(part.drawn) for part in vectors.values())

    def cells(exact: float, shown: float, unit: str, *, legible: bool = True) -> tuple[str, ...]:
        name = unit_name(unit, words.language)
        if drawn is None:
            return words.number(exact, digits=_DIGITS), name
        off = words.fixed(100.0 * (shown - exact) / exact, 2) if legible else "–"
        if not legible:
            return "–", words.number(exact, digits=_DIGITS), name, off
        decimals = max(0, _DIGITS - 1 - math.floor(math.log10(abs(exact))))
        return words.fixed(shown, decimals), words.fixed(exact, decimals), name, off

    for key, part in vectors.items():
        length = abs(part.drawn)
        if length > _NOISE * most:
            angle, shown = math.degrees(cmath.phase(part.drawn)) % 360.0, read.get(key, length)
            values = cells(scale * length, scale * shown, _UNITS[order], legible=length >= _SHORTEST)
            difference = max(difference, abs(shown / length - 1.0)) if length > LEGIBLE else difference
            rows.append((Math(name_of(part, order, words)), words.fixed(angle, 1), words.fixed(shown, 1), *values))
    for link, rate in plan.turning.items():
        if link != 1 and abs(rate) > _NOISE * most * scale:
            name = Math(f"{symbol(_TURNING[order], words.language)}_{link}")
            rows.append((name, "–", "–", *cells(rate, drawn.turning[link] if drawn else rate, _ROTARY[order])))
    titles = ("by_plan", "analytic", "unit", "deviation") if drawn else ("value", "unit")
    caption, align = ("compared_", "crrrrcr") if drawn else ("plan_", "crrrc")
    caption += _KINDS[order]
    return words.table(caption, ("vector", "angle", "on_plan", *titles), rows, align, f"t:{caption}"), difference


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
        torque = torque if abs(torque) > _FORCE_NOISE * inertia * speed**2 else 0.0
        values = {"centre_acceleration": (abs(pull), mass), "link_inertia_force": (abs(pull), 1.0), "": (0.0, 0.0),
                  "link_angular_acceleration": (-torque, inertia), "link_inertia_torque": (torque, 1.0)}  # fmt: skip
        values |= (
            {"joint_force": (abs(complex(*of_kind["weight"].get(link, (0.0, 0.0)))), 1.0)} if of_kind["weight"] else {}
        )
        cells = [words.shown(key, size / over, digits=_FORCE_DIGITS) if size and over else "–"
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
    number = partial(number_box, language=language, digits=_FORCE_DIGITS)
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
    result = value_box(equation.value if terms else 0.0, unit, language, _FORCE_DIGITS)
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

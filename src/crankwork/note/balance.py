"""The balance of the moving masses in a note: free forces by order, shaking force, counterweights."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from crankwork.formula.calculation_lines import ValueLine
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, in_order
from crankwork.mechanism.mechanism import Crank
from crankwork.note.document import Block, Citation, Equation, Reference, Runs
from crankwork.note.equations import value_box
from crankwork.note.layout import (
    DOT,
    EQUALS,
    PRODUCT,
    Box,
    Digits,
    Fence,
    Fraction,
    PrintedEquation,
    Root,
    Script,
    Sign,
    Upright,
    row,
)
from crankwork.note.material import Material
from crankwork.note.parts import At, Head, Lines, Places, Rows, Section, Shown, Text, When, every, full, has, turning
from crankwork.note.symbols import number_box, symbol_box
from crankwork.note.wording import in_display_unit, named
from crankwork.quantities.key import key_of

_BALANCE = "den_hartog_1956, ch. 5"
_SHAKING = ("shaking_force_x", "shaking_force_y", "shaking_force", "shaking_moment")
_OF_ORDERS = (
    "acceleration_coefficient", "order_inertia_force", "force_factor", "free_force", "moment_factor", "free_moment",
    "rotating_mass", "counterweight_moment", "best_balanced_share", "best_counterweight_moment", "shaft_unbalance",
    "unbalance_force",
)  # fmt: skip


def _orders(material: Material) -> Iterator[Block]:
    """Yield the table of the free forces of each order."""
    words, summary = material.words, material.results.summary
    orders = named(summary, "free_force")
    yield words.paragraph("free_forces", table=Reference("t:orders"))
    kinds = [kind for kind in ("free_force", "shaking_moment_amplitude") if named(summary, kind)]
    sizes = [
        words.column_texts(
            in_display_unit(kind, [summary[key] for key in named(summary, kind)]), digits=material.digits
        )
        for kind in kinds
    ]
    rows = list(zip((key_of(key).owner for key in orders), *sizes, strict=True))
    titles: list[str | Runs] = ["order_of_turn", *(words.titled(kind) for kind in kinds)]
    yield words.table("linkage_orders", titles, rows, "c" + "r" * len(kinds), "t:orders")


def _counterweight(material: Material) -> Iterator[Block]:
    """Yield the best counterweight from the first harmonic of the shaking force, and where it stands."""
    words, results = material.words, material.results
    key, driver = "counterweight_moment", material.machine.mechanism.driver
    node, angle = results.trace[key].node, results.summary.get("counterweight_angle")
    if angle is None or not isinstance(node, ProcedureValue) or node.by is None or not isinstance(driver, Crank):
        return
    yield words.paragraph("counterweight", value=words.amount(angle, "deg", digits=material.digits))
    speed, value = results.solved.speed, results.summary[key]
    parts = {
        f"{wave.node.operands[0].key},{wave.node.part[0]}": wave.value
        for wave in in_order([node.by])
        if isinstance(wave.node, HarmonicCoefficient)
    }

    signs = ("+", "−") if driver.direction > 0 else ("−", "+")
    sums = ("x,c", signs[0], "y,s"), ("y,c", signs[1], "x,s")
    # as many digits as give the value again
    lost = max(map(abs, parts.values())) / (2 * value * speed**2)
    digits = material.digits + max(0, math.ceil(math.log10(lost)))

    def written(shown: Callable[[str], Box], times: Box, rate: Box) -> Box:
        squares = [_squared(Fence(row(shown(first), Sign(sign), shown(second)))) for first, sign, second in sums]
        return Fraction(Root(row(squares[0], Sign("+"), squares[1])), row(Digits("2"), times, _squared(rate)))

    def letter(name: str) -> Box:
        return symbol_box(f"{words.symbol('shaking_force')},{name}")

    def number(name: str) -> Box:
        wave = parts[f"shaking_force_{name}"]
        box = number_box(wave, words.language, digits)[0]
        return Fence(box) if wave < 0 else box

    letters = written(letter, PRODUCT, symbol_box(words.symbol("speed")))
    numbers = written(number, DOT, number_box(speed, words.language, digits)[0])
    result = value_box(value, "kg*m", words.language, material.digits)
    lines = row(symbol_box(words.symbol(key)), EQUALS, letters), row(EQUALS, numbers, EQUALS, result)
    text = f"{words.symbol(key)} = {words.amount(value, 'kg*m', digits=material.digits)}"
    yield Equation(ValueLine(key, value), printed=PrintedEquation(lines, text))


def _squared(box: Box) -> Box:
    return Script(box, None, Upright("2"))


SECTIONS = (
    Section("balance", (
        Head("balance", sinks=True), Text("balance"), Lines("balance", _OF_ORDERS),
        Shown(("balance_orders", "balance_ellipses"), (Rows("balance", "balance"),)),
    ), has("piston_displacement", "balance")),
    Section("balance", (
        Head("linkage_balance"), Text("shaking", {"source": Citation(_BALANCE)}), At("shaking"), Lines("shaking"),
        When(full, (Places("shaking", _SHAKING, "shaking", filled=True),)),
        When(lambda material: bool(named(material.results.summary, "free_force")), (
            _orders, _counterweight,
        )),
    ), every(turning, has("shaking_force"))),
)  # fmt: skip

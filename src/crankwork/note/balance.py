"""The balance of the moving masses in a note: free forces by order, shaking force, counterweights."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.formula.calculation_lines import ValueLine
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, in_order
from crankwork.mechanism.mechanism import Crank
from crankwork.note import layout
from crankwork.note.document import Block, Citation, Equation, Reference, Runs, Table
from crankwork.note.equations import value_box
from crankwork.note.material import Material
from crankwork.note.parts import (
    At,
    Head,
    Lines,
    Places,
    Rows,
    Section,
    Shown,
    Text,
    When,
    every,
    full,
    has,
    machine_has,
    turning,
    works,
)
from crankwork.note.symbols import number_box, symbol_box
from crankwork.note.tables import listing_table
from crankwork.note.wording import in_display_unit, named
from crankwork.quantities.key import key_of

_BALANCE = "den_hartog_1956, ch. 5"
# share of the largest force below which one is not seen beside it
_SEEN = 0.05
# what the orders of a turn are of, and what of them is rounding
_OF_TURN, _NOISE = {"free_force": "shaking_force", "shaking_moment_amplitude": "shaking_moment"}, 1e-9
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
    limits = {
        kind: _NOISE * float(np.max(np.abs(material.columns.get(column, 0.0)))) for kind, column in _OF_TURN.items()
    }
    kinds = [kind for kind in ("free_force", "shaking_moment_amplitude") if named(summary, kind)]
    sizes = [
        words.column_texts(
            in_display_unit(kind, [summary[key] * (summary[key] > limits[kind]) for key in named(summary, kind)]),
            digits=material.digits,
        )
        for kind in kinds
    ]
    yield words.paragraph("free_forces", table=Reference("t:orders"))
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
    waves = {
        f"{wave.node.operands[0].key[-1]},{wave.node.part[0]}": wave.value
        for wave in in_order([node.by])
        if isinstance(wave.node, HarmonicCoefficient)
    }
    letters, numbers = list[layout.Box](), list[layout.Box]()
    for first, second, sign in (("x,c", "y,s", driver.direction), ("y,c", "x,s", -driver.direction)):
        names = [symbol_box(f"{words.symbol('shaking_force')},{name}") for name in (first, second)]
        letters.append(layout.Fence(layout.row(names[0], layout.Sign("+" if sign > 0 else "−"), names[1])))
        numbers.append(number_box(abs(waves[first] + sign * waves[second]), words.language, material.digits + 1)[0])
    name, value, rate = symbol_box(words.symbol(key)), results.summary[key], symbol_box(words.symbol("speed"))
    speed = number_box(results.solved.speed, words.language, material.digits + 1)[0]
    shown = value_box(value, "kg*m", words.language, material.digits)
    formula = layout.row(name, layout.EQUALS, _of_harmonic(letters, layout.PRODUCT, rate))
    worked = layout.row(layout.EQUALS, _of_harmonic(numbers, layout.DOT, speed), layout.EQUALS, shown)
    text = f"{words.symbol(key)} = {words.amount(value, 'kg*m', digits=material.digits)}"
    yield Equation(ValueLine(key, value), printed=layout.PrintedEquation((formula, worked), text))


def _of_harmonic(parts: list[layout.Box], times: layout.Box, rate: layout.Box) -> layout.Box:
    """Return half the magnitude of two parts over the square of a speed."""
    first, second, below = (layout.Script(box, None, layout.Upright("2")) for box in (*parts, rate))
    top = layout.Root(layout.row(first, layout.Sign("+"), second))
    return layout.Fraction(top, layout.row(layout.Digits("2"), times, below))


def _worked(material: Material) -> list[Block]:
    """Return the equations of the orders; in a short one neither moments that vanish nor the mass that rotates."""
    left = () if material.full else ("rotating_mass", *(() if material.has_free_moments else ("free_moment",)))
    return material.equations("balance", *(kind for kind in _OF_ORDERS if kind not in left))


def _by_order(material: Material) -> Table | None:
    """Return the free forces of each order, and the moments where there are any."""
    return listing_table(material, "balance", "balance" if material.has_free_moments else "balance_forces")


def _drawn_orders(material: Material) -> Iterator[Block]:
    """Yield the free forces, drawn where those of several orders are seen."""
    sizes = [np.abs(np.nan_to_num(values)) for key, values in material.results.listings["balance"].columns.items()
             if key in ("free_force", "free_moment")]  # fmt: skip
    # what counterweights leave may be all of it
    seen = sum(len(np.unique(np.round(size[size > _SEEN * size.max()] / size.max(), 3))) for size in sizes)
    figures = ("balance_orders", "balance_ellipses") if material.full or seen > 1 else ()
    return material.presented([_by_order(material)], figures)


SECTIONS = (
    Section("planes", (
        Head("planes"), Text("planes", {"source": Citation("khurmi_gupta_2005, ch. 21")}), Lines("planes"),
        Shown(("balance_polygons",), (Rows("planes", "planes"),)),
        When(works("rotor_forces"), (
            Head("rotor_forces", 2), Text("rotor_forces"), At("rotor_columns"), Lines("rotor_columns"),
            Lines("rotor_forces"), Shown(("unbalanced",)),
        )),
    ), machine_has("rotor")),
    Section("balance", (
        Head("balance"), Text("balance"), _worked,
        _drawn_orders,
    ), has("piston_displacement", "balance")),
    Section("balance", (
        Head("linkage_balance"), Text("shaking", {"source": Citation(_BALANCE)}), At("shaking"), Lines("shaking"),
        When(full, (Places("shaking", _SHAKING, "shaking", filled=True),)),
        When(lambda material: bool(named(material.results.summary, "free_force")), (_orders, _counterweight)),
    ), every(turning, has("shaking_force"))),
)  # fmt: skip

"""The balance of the moving masses in a note: free forces by order, shaking force, counterweights."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.note.document import Block, Citation, Reference, Runs, Table
from crankwork.note.material import Material
from crankwork.note.parts import At, Head, Lines, Places, Section, Shown, Text, When, every, full, has, turning
from crankwork.note.tables import listing_table
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
        words.column_texts(in_display_unit(kind, [summary[key] for key in named(summary, kind)]), digits=6)
        for kind in kinds
    ]
    rows = list(zip((key_of(key).owner for key in orders), *sizes, strict=True))
    titles: list[str | Runs] = ["order_of_turn", *(words.titled(kind) for kind in kinds)]
    yield words.table("linkage_orders", titles, rows, "c" + "r" * len(kinds), "t:orders")


def _worked(material: Material) -> list[Block]:
    """Return the equations of the orders; in a short one neither moments that vanish nor the mass that rotates."""
    left = () if material.full else ("rotating_mass", *(() if material.has_free_moments else ("free_moment",)))
    return material.equations("balance", *(kind for kind in _OF_ORDERS if kind not in left))


def _by_order(material: Material) -> Table | None:
    """Return the free forces of each order, and the moments where there are any."""
    return listing_table(material, "balance", "balance" if material.has_free_moments else "balance_forces")


SECTIONS = (
    Section("balance", (
        Head("balance", sinks=True), Text("balance"), _worked,
        Shown(("balance_orders", "balance_ellipses"), (_by_order,)),
    ), has("piston_displacement", "balance")),
    Section("balance", (
        Head("linkage_balance"), Text("shaking", {"source": Citation(_BALANCE)}), At("shaking"), Lines("shaking"),
        When(full, (Places("shaking", _SHAKING, "shaking", filled=True),)),
        When(lambda material: bool(named(material.results.summary, "free_force")), (
            _orders, Text("counterweight"), Lines("counterweight"),
        )),
    ), every(turning, has("shaking_force"))),
)  # fmt: skip

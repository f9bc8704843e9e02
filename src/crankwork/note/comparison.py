"""The section that puts the values of a machine beside those by other methods, or of another machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from crankwork.analysis import Results
from crankwork.locale import say
from crankwork.note.document import Block, Heading, ItemList, Math, Reference, Runs, Table
from crankwork.note.printed_units import printed_unit
from crankwork.note.table_width import SIZES, fits
from crankwork.note.words import NoteWords
from crankwork.report.comparison import comparison_rows, shown_names
from crankwork.report.language import display_key, displayed, key_unit, label

_LABEL = "compared"
_DIGITS = 3


def comparison_blocks(
    results: Results, words: NoteWords, heading: Heading, caption: str, *, per_area: bool = False
) -> Iterator[Block]:
    """Yield the heading and the single values by each name; nothing without a comparison."""
    compared = results.compared
    if compared is None:
        return
    yield heading
    own, *other_names = shown_names(compared, words.language)
    key = "compared_methods" if compared.is_of_methods else "compared_machines"
    yield words.paragraph(key, table=Reference(_LABEL), own=own)
    titles: list[Runs] = [(words.column("quantity"),), (words.column("unit"),), (own,)]
    for other in other_names:
        titles += [(other,), ("Δ",)]
    rows = [
        (
            label(display_key(key, results) if key in results.memory else key, words.language),
            printed_unit(key_unit(key, per_area=per_area), words.language) or "–",
            words.number(values[0]),
            # after the own value come another and how far it is above it
            *(words.number(value, digits=_DIGITS if index % 2 else 6) for index, value in enumerate(values[1:])),
        )
        for key, values in comparison_rows(results, per_area=per_area).items()
        if not key.partition(".")[0].endswith(("_max_angle", "_min_angle", "_max_time", "_min_time"))
    ]
    align = "lc" + "r" * (len(titles) - 2)
    yield Table(caption, tuple(titles), rows, wide=not fits(titles, rows, SIZES[-1]), align=align, label=_LABEL)


# in their order; of what links, joints and cylinders have the largest is told
_KEYS = (
    "effective_power", "indicated_power", "motor_power", "shaft_power",
    "mean_torque", "total_torque_max", "total_torque_min", "driving_torque_max",
    "driving_torque_min", "driver_force_max", "driver_force_min", "piston_force_max", "piston_force_min",
    "slider_stroke", "joint_force_max", "crankpin_load_max", "excess_work", "flywheel_inertia",
    "flywheel_inertia.exact", "speed_fluctuation", "piston_velocity_max", "piston_acceleration_max",
    "piston_acceleration_min",
)  # fmt: skip
_SAME = {"shaft_power": ("motor_power",)}
_MOST = 12


def main_numbers(results: Results, words: NoteWords) -> Iterator[Block]:
    """Yield the numbers that matter, one in a line."""
    summary = results.summary
    keys = [
        key for kind in _KEYS if not any(same in summary for same in _SAME.get(kind, ())) for key in _of(kind, summary)
    ]
    items = [_item(key, results, words) for key in keys[:_MOST]]
    if items:
        yield words.paragraph("numbers")
        yield ItemList(tuple(items))


def _of(kind: str, summary: Mapping[str, float]) -> list[str]:
    """Return the key of a quantity, or of the largest of those that links, joints and cylinders have."""
    if kind in summary or "." in kind:
        return [kind] if kind in summary else []
    parts = [key for key in summary if key.startswith(f"{kind}.")] if kind.endswith(("_max", "_stroke")) else []
    return [max(parts, key=lambda key: abs(summary[key]))] if parts else []


def _item(key: str, results: Results, words: NoteWords) -> Runs:
    unit = printed_unit(key_unit(key), words.language)
    name = say("report.exact", words.language) if key.endswith(".exact") else ""
    own = display_key(key, results).removesuffix(".exact")
    title = label(own, words.language) + (f", {name}" if name else "")
    value = words.number(displayed(key, results.summary[key]), digits=5)
    return (f"{title}, ", Math(words.symbol(own)), f" = {value}\u00a0{unit}".rstrip("\u00a0"))

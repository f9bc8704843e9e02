"""Spreads of single values as text and as plain data."""

from __future__ import annotations

from typing import Any

from crankwork.locale import Language, say, told
from crankwork.locale.numbers import number, unit_name
from crankwork.report.language import displayed, displayed_size, key_unit, label, rounded
from crankwork.study.spread import Spreads
from crankwork.units import use_units

# causes that bring less of the variance are not told
_LEAST = 0.005


def spread_text(found: Spreads, language: Language = "en") -> str:
    """Return every value that spreads with its deviation, and where that comes from."""
    with use_units(found.results.machine.units):
        return _text(found, language)


def _text(found: Spreads, language: Language) -> str:
    title = found.results.machine.title
    lines = [title] if title else []
    within = number(found.within, language)
    lines += [say("study.normal", language), say("study.worst", language, within=within), ""]
    rows = []
    for key, one in found.items():
        causes = ", ".join(
            f"{cause.key} {number(100 * cause.share, language, digits=3)} %"
            for cause in one.causes
            if cause.share > _LEAST
        )
        sign = say("study.sampled", language) if one.is_sampled else ""
        if one.mean is not None:
            mean = number(displayed(key, one.mean), language, digits=4)
            causes = f"{say('study.mean', language, value=mean)}; {causes}"
        # draws tell no more digits
        size = number(displayed_size(key, one.deviation), language, digits=3 if one.is_sampled else 6)
        shown = [number(displayed(key, one.value), language), size]
        worst = " … ".join(number(displayed(key, end), language) for end in one.worst)
        rows.append((label(key, language), " ± ".join(shown), worst, unit_name(key_unit(key), language), causes, sign))
    wide = [max((len(row[at]) for row in rows), default=0) for at in range(5)]
    lines += ["  ".join(cell.ljust(size) for cell, size in zip(row, [*wide, 0], strict=True)).rstrip() for row in rows]
    if found.samples:
        lines += ["", say("study.samples", language, count=str(found.samples), sign=say("study.sampled", language))]
    for reason, count in found.refused.items():
        lines += ["", say("study.draws_refused", language, count=str(count), reason=told(reason, language))]
    return "\n".join(lines)


def spread_data(found: Spreads) -> dict[str, Any]:
    """Return the spreads as plain data, in the units of the tables."""
    with use_units(found.results.machine.units):
        return {
            "title": found.results.machine.title,
            "samples": found.samples,
            "within": found.within,
            "refused": [{"count": count, "reason": str(reason)} for reason, count in found.refused.items()],
            "spreads": {
                key: {
                    "value": rounded(displayed(key, one.value)),
                    "deviation": rounded(displayed_size(key, one.deviation)),
                    "unit": key_unit(key),
                    "least": rounded(displayed(key, one.worst[0])),
                    "largest": rounded(displayed(key, one.worst[1])),
                    "is_sampled": one.is_sampled,
                    "mean": None if one.mean is None else rounded(displayed(key, one.mean)),
                    "causes": {cause.key: rounded(cause.share) for cause in one.causes},
                }
                for key, one in found.items()
            },
        }

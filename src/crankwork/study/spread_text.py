"""Spreads of single values as text and as plain data."""

from __future__ import annotations

from typing import Any

from crankwork.locale import Language, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.report.display import displayed, displayed_size, key_unit, label, rounded
from crankwork.study.spread import Spreads
from crankwork.units import use_units

# least share of the variance that is printed
_MIN_SHARE = 0.005


def spread_text(spreads: Spreads, language: Language = "en") -> str:
    """Return every uncertain value with its deviation and contributions, as text."""
    with use_units(spreads.results.machine.units):
        return _text(spreads, language)


def _text(spreads: Spreads, language: Language) -> str:
    title = spreads.results.machine.title
    lines = [title] if title else []
    within = number(spreads.within, language)
    lines += [translate("study.normal", language), translate("study.worst", language, within=within), ""]
    rows = []
    for key, spread in spreads.items():
        causes = ", ".join(
            f"{cause.key} {number(100 * cause.share, language, digits=3)} %"
            for cause in spread.causes
            if cause.share > _MIN_SHARE
        )
        sign = translate("study.sampled", language) if spread.is_sampled else ""
        if spread.mean is not None:
            mean = number(displayed(key, spread.mean), language, digits=4)
            causes = f"{translate('study.mean', language, value=mean)}; {causes}"
        # significant digits of sampled deviations
        size = number(displayed_size(key, spread.deviation), language, digits=3 if spread.is_sampled else 6)
        shown = [number(displayed(key, spread.value), language), size]
        worst = " … ".join(number(displayed(key, end), language) for end in spread.worst)
        rows.append((label(key, language), " σ ".join(shown), worst, unit_name(key_unit(key), language), causes, sign))
    wide = [max((len(row[column]) for row in rows), default=0) for column in range(5)]
    lines += ["  ".join(cell.ljust(size) for cell, size in zip(row, [*wide, 0], strict=True)).rstrip() for row in rows]
    if spreads.samples:
        lines += [
            "",
            translate("study.samples", language, count=str(spreads.samples), sign=translate("study.sampled", language)),
        ]
    for reason, count in spreads.refused.items():
        lines += [
            "",
            translate("study.draws_refused", language, count=str(count), reason=in_language(reason, language)),
        ]
    return "\n".join(lines)


def spread_data(spreads: Spreads) -> dict[str, Any]:
    """Return the spreads as plain data, in the units of the tables."""
    with use_units(spreads.results.machine.units):
        return {
            "title": spreads.results.machine.title,
            "samples": spreads.samples,
            "within": spreads.within,
            "refused": [{"count": count, "reason": str(reason)} for reason, count in spreads.refused.items()],
            "spreads": {
                key: {
                    "value": rounded(displayed(key, spread.value)),
                    "deviation": rounded(displayed_size(key, spread.deviation)),
                    "unit": key_unit(key),
                    "least": rounded(displayed(key, spread.worst[0])),
                    "largest": rounded(displayed(key, spread.worst[1])),
                    "is_sampled": spread.is_sampled,
                    "mean": None if spread.mean is None else rounded(displayed(key, spread.mean)),
                    "causes": {cause.key: rounded(cause.share) for cause in spread.causes},
                }
                for key, spread in spreads.items()
            },
        }

"""What is found of a study as text, as plain data and as tables, in the units of files and tables."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, say, told
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.report.language import displayed, displayed_column, displayed_size, key_unit, label, plain
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.study.chunks import NUMBER, Reduced, ranks, within
from crankwork.study.ranking import Index, Moments
from crankwork.study.study_file import Study
from crankwork.study.varied import Varied
from crankwork.units import from_si, use_units

_DIGITS = 6
# designs that a terminal shows of the best
_SHOWN = 3
# a share below this is not told
_LEAST = 0.005


def found_files(study: Study, found: Reduced) -> dict[str, bytes]:
    """Return what goes into the folder of a study beside its parts."""
    data = json.dumps(found_data(study, found), ensure_ascii=False, indent=1)
    with use_units(study.units):
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in _sheets(study, found).items()}
    return {"summary.json": f"{data}\n".encode(), **tables}


def found_text(study: Study, found: Reduced, language: Language = "en") -> str:
    """Return what is found in words."""
    with use_units(study.units):
        return "\n".join(_lines(study, found, language))


def _lines(study: Study, found: Reduced, language: Language) -> Iterator[str]:
    if study.title:
        yield study.title
    name = "study.designs_within" if study.limits else "study.designs"
    yield say(name, language, count=_count(found.designs), within=_count(found.within))
    for count, reason in found.refused.values():
        yield say("study.refused", language, count=_count(count), reason=told(reason, language))
    if found.alone is None:
        yield say("study.compiled", language, count=_count(found.one_by_one))
    else:
        yield say("study.alone", language, reason=_because(found.alone, language))
    yield from ("", say("study.values", language))
    yield from aligned([_moments(key, one, language) for key, one in found.moments.items()])
    best, pareto = ranked(study, found)
    for key, rows in best.items():
        word = "study.ascending" if study.objectives[key] > 0 else "study.descending"
        yield from ("", f"{capital(label(key, language))}, {say(word, language)}")
        yield from aligned([_design(study, found, at, key, language) for at in rows[:_SHOWN]])
    if len(study.objectives) > 1:
        name = "study.pareto_thinned" if found.is_thinned else "study.pareto"
        yield from ("", say(name, language, count=_count(len(pareto))))
    if any(one.indices() for one in found.shares.values()):
        yield from ("", say("study.indices", language))
        yield from aligned(list(_causes(study, found, language)))


def _because(alone: tuple[str, str], language: Language) -> str:
    reason, key = alone
    return say(f"study.because_{reason}", language, name=key)


def _count(count: int) -> str:
    return f"{count:,}".replace(",", " ")


def _moments(key: str, one: Moments, language: Language) -> tuple[str, ...]:
    def shown(value: float) -> str:
        return number(displayed(key, value), language, digits=_DIGITS) if math.isfinite(value) else "-"

    size = number(displayed_size(key, one.deviation), language, digits=4) if one.count > 1 else "-"
    ends = f"{shown(one.low)} … {shown(one.high)}" if one.count else "-"
    return label(key, language), f"{shown(one.mean)} ± {size}", ends, unit_name(key_unit(key), language)


def _design(study: Study, found: Reduced, at: int, key: str, language: Language) -> tuple[str, ...]:
    value = number(displayed(key, found.values[study.keys.index(key), at]), language, digits=_DIGITS)
    stated = (
        f"{one.key} = {_stated(one, of[at], language)}" for one, of in zip(study.varied, found.fields, strict=True)
    )
    return f"{value} {unit_name(key_unit(key), language)}".rstrip(), *stated


def _stated(one: Varied, value: float, language: Language) -> str:
    if one.number is None:
        return str(one.values[int(value)])
    shown = number(float(from_si(value, one.number.unit)), language, digits=_DIGITS)
    return f"{shown} {unit_name(one.number.unit, language)}".rstrip()


def _causes(study: Study, found: Reduced, language: Language) -> Iterator[tuple[str, ...]]:
    for key, one in found.shares.items():
        indices = one.indices()
        if indices is None:
            continue
        first, _, total, _ = indices
        rows = sorted(zip(total, first, study.varied, strict=True), key=lambda row: -row[0])
        for whole, alone, field in rows:
            if whole > _LEAST:
                shown = (f"{number(100 * max(share, 0.0), language, digits=3)} %" for share in (alone, whole))
                yield label(key, language), field.key, *shown


def ranked(study: Study, found: Reduced) -> tuple[dict[str, Index], Index]:
    """Return which of the designs that are kept are the best of each objective, and which are the Pareto set."""
    rows = np.flatnonzero(within(study, found.values))
    best, pareto, _ = ranks(study, found.values[:, rows])
    return {key: rows[at] for key, at in best.items()}, rows[pareto]


def _sheets(study: Study, found: Reduced) -> dict[str, Sheet]:
    """Return the tables of what is found."""
    best, pareto = ranked(study, found)
    tables = {f"best.{key}": _rows(study, found, rows) for key, rows in best.items()}
    if len(study.objectives) > 1:
        tables["pareto"] = _rows(study, found, pareto)
    for key, one in found.histograms.items():
        ends = displayed_column(key, one.edges) if one.counts else np.zeros(1)
        columns = {"from": ends[:-1], "to": ends[1:], "count": np.array(one.counts, dtype=float)}
        tables[f"histogram.{key}"] = Sheet((), columns, {"from": key_unit(key), "to": key_unit(key), "count": ""})
    if found.shares:
        columns = {}
        for key, shares in found.shares.items():
            indices = shares.indices() or (np.full(len(study.varied), np.nan),) * 4
            columns |= {f"{key} {name}": of for name, of in zip(_INDICES, indices, strict=True)}
        tables["sensitivity"] = Sheet(tuple(one.key for one in study.varied), columns, dict.fromkeys(columns, ""))
    return tables


_INDICES = ("first", "first_error", "total", "total_error")


def _rows(study: Study, found: Reduced, rows: Index) -> Sheet:
    """Return designs as a table, words by what they are."""
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for one, of in zip(study.varied, found.fields, strict=True):
        if one.number is None:
            columns[one.key] = np.array([str(one.values[int(at)]) for at in of[rows]], dtype=object)
        else:
            columns[one.key] = np.asarray(from_si(of[rows], one.number.unit))
        units[one.key] = one.unit
    for key, of in zip(study.keys, found.values, strict=True):
        columns[key], units[key] = displayed_column(key, of[rows]), key_unit(key)
    return Sheet(tuple(str(one) for one in found.numbers[rows]), columns, units)


def found_data(study: Study, found: Reduced) -> dict[str, Any]:
    """Return what is found as plain data."""
    with use_units(study.units):
        return _data(study, found)


def _data(study: Study, found: Reduced) -> dict[str, Any]:
    best, pareto = ranked(study, found)

    def designs(rows: Index) -> list[dict[str, Any]]:
        sheet = _rows(study, found, rows)
        columns = [[plain(one) for one in of.tolist()] for of in sheet.columns.values()]
        return [
            {NUMBER: int(name), **dict(zip(sheet.columns, row, strict=True))}
            for name, row in zip(sheet.names, zip(*columns, strict=True), strict=True)
        ]

    return {
        "title": study.title,
        "study": study.digest,
        "seed": study.seed,
        "designs": found.designs,
        "within_limits": found.within,
        "one_by_one": found.one_by_one,
        "not_compiled": None if found.alone is None else _because(found.alone, "en"),
        "refused": [{"count": count, "reason": str(reason)} for count, reason in found.refused.values()],
        "units": {
            **{one.key: one.number.unit for one in study.varied if one.number},
            **{key: key_unit(key) for key in study.keys},
        },
        "values": {
            key: {
                "count": one.count,
                "mean": plain(displayed(key, one.mean)),
                "deviation": plain(displayed_size(key, one.deviation)),
                "least": plain(displayed(key, one.low)),
                "largest": plain(displayed(key, one.high)),
            }
            for key, one in found.moments.items()
        },
        "best": {key: designs(rows) for key, rows in best.items()},
        "pareto": designs(pareto),
        "pareto_thinned": found.is_thinned,
        "sensitivity": {
            key: {
                one.key: dict(zip(_INDICES, map(plain, row), strict=True))
                for one, row in zip(study.varied, np.array(indices).T.tolist(), strict=True)
            }
            for key, shares in found.shares.items()
            if (indices := shares.indices()) is not None
        },
    }

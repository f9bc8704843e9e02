"""Results of a study as text, plain data and tables, in the units of files and tables."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, in_language, translate
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.report.display import displayed, displayed_column, displayed_size, key_unit, label, plain
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.report.workbook import workbook_of
from crankwork.show.canvas import plain as plain_text
from crankwork.study.chunks import NUMBER, StudyAggregate, feasible_designs, ranks
from crankwork.study.ranking import Index, Moments
from crankwork.study.study_file import Study
from crankwork.study.varied_field import VariedField
from crankwork.units import from_si, use_units

_DIGITS = 6
# best designs printed in a terminal
_SHOWN = 3
# least share of the variance that is printed
_MIN_SHARE = 0.005


def found_files(study: Study, aggregate: StudyAggregate, language: Language = "en") -> dict[str, bytes]:
    """Return the files of a study's folder besides its parts."""
    data = json.dumps(found_data(study, aggregate), ensure_ascii=False, indent=1)
    with use_units(study.units):
        sheets = _sheets(study, aggregate)
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in sheets.items()}
        book = workbook_of(sheets, {"title": study.title[:255]}, language)
    return {"summary.json": f"{data}\n".encode(), **tables, "study.xlsx": book}


def found_text(study: Study, aggregate: StudyAggregate, language: Language = "en") -> str:
    """Return the results of a study as text."""
    with use_units(study.units):
        return "\n".join(_lines(study, aggregate, language))


def _lines(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[str]:
    if study.title:
        yield study.title
    name = "study.designs_within" if study.limits else "study.designs"
    yield translate(name, language, count=_count(aggregate.designs), within=_count(aggregate.within))
    for count, reason in aggregate.refused.values():
        yield translate("study.refused", language, count=_count(count), reason=in_language(reason, language))
    if aggregate.alone is None:
        yield translate("study.compiled", language, count=_count(aggregate.one_by_one))
    else:
        yield translate("study.alone", language, reason=_because(aggregate.alone, language))
    yield from ("", translate("study.values", language))
    yield from aligned([_moments(key, moments, language) for key, moments in aggregate.moments.items()])
    best, pareto = ranked(study, aggregate)
    for key, rows in best.items():
        word = "study.ascending" if study.objectives[key] > 0 else "study.descending"
        yield from ("", f"{capital(label(key, language))}, {translate(word, language)}")
        yield from aligned([_design(study, aggregate, row, key, language) for row in rows[:_SHOWN]])
    if len(study.objectives) > 1:
        name = "study.pareto_thinned" if aggregate.is_thinned else "study.pareto"
        yield from ("", translate(name, language, count=_count(len(pareto))))
    if any(shares.indices() for shares in aggregate.shares.values()):
        yield from ("", translate("study.indices", language))
        yield from aligned(list(_causes(study, aggregate, language)))


def with_unit(value: float, unit: str, language: Language, digits: int = _DIGITS) -> str:
    """Return a number with its unit as text."""
    return f"{number(value, language, digits=digits)} {unit_name(unit, language)}".rstrip()


def value_text(key: str, value: float, language: Language, digits: int = _DIGITS) -> str:
    """Return a value of results with its display unit as text."""
    return with_unit(displayed(key, value), key_unit(key), language, digits)


def axis_title(key: str, language: Language) -> str:
    """Return the name of a value with its display unit, for an axis."""
    unit = unit_name(key_unit(key), language)
    return plain_text(f"{label(key, language)}, {unit}" if unit else label(key, language))


def _because(alone: tuple[str, str], language: Language) -> str:
    reason, key = alone
    return translate(f"study.because_{reason}", language, name=key)


def _count(count: int) -> str:
    return f"{count:,}".replace(",", " ")


def _moments(key: str, moments: Moments, language: Language) -> tuple[str, ...]:
    def shown(value: float) -> str:
        return number(displayed(key, value), language, digits=_DIGITS) if math.isfinite(value) else "-"

    size = number(displayed_size(key, moments.deviation), language, digits=4) if moments.count > 1 else "-"
    ends = f"{shown(moments.low)} … {shown(moments.high)}" if moments.count else "-"
    return label(key, language), f"{shown(moments.mean)} σ {size}", ends, unit_name(key_unit(key), language)


def _design(study: Study, aggregate: StudyAggregate, design: int, key: str, language: Language) -> tuple[str, ...]:
    fields = zip(study.varied, aggregate.fields[:, design], strict=True)
    stated = (f"{field.key} = {_stated(field, value, language)}" for field, value in fields)
    return value_text(key, aggregate.values[study.keys.index(key), design], language), *stated


def _stated(field: VariedField, value: float, language: Language) -> str:
    if field.number is None:
        return str(field.values[int(value)])
    return with_unit(float(from_si(value, field.number.unit)), field.number.unit, language)


def _causes(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, ...]]:
    for key, shares in aggregate.shares.items():
        indices = shares.indices()
        if indices is None:
            continue
        first, _, total, _ = indices
        rows = sorted(zip(total, first, study.varied, strict=True), key=lambda row: -row[0])
        for total_share, alone, field in rows:
            if total_share > _MIN_SHARE:
                shown = (f"{number(100 * max(share, 0.0), language, digits=3)} %" for share in (alone, total_share))
                yield label(key, language), field.key, *shown


def ranked(study: Study, aggregate: StudyAggregate) -> tuple[dict[str, Index], Index]:
    """Return the rows of the best designs of each objective and of the Pareto set."""
    rows = np.flatnonzero(feasible_designs(study, aggregate.values))
    best, pareto, _ = ranks(study, aggregate.values[:, rows])
    return {key: rows[places] for key, places in best.items()}, rows[pareto]


def _sheets(study: Study, aggregate: StudyAggregate) -> dict[str, Sheet]:
    """Return the tables of a study."""
    best, pareto = ranked(study, aggregate)
    tables = {f"best.{key}": _rows(study, aggregate, rows) for key, rows in best.items()}
    if len(study.objectives) > 1:
        tables["pareto"] = _rows(study, aggregate, pareto)
    for key, histogram in aggregate.histograms.items():
        ends = displayed_column(key, histogram.edges) if histogram.counts else np.zeros(1)
        columns = {"from": ends[:-1], "to": ends[1:], "count": np.array(histogram.counts, dtype=float)}
        tables[f"histogram.{key}"] = Sheet((), columns, {"from": key_unit(key), "to": key_unit(key), "count": ""})
    if aggregate.shares:
        columns = {}
        for key, shares in aggregate.shares.items():
            indices = shares.indices() or (np.full(len(study.varied), np.nan),) * 4
            columns |= {f"{key} {name}": column for name, column in zip(_INDICES, indices, strict=True)}
        tables["sensitivity"] = Sheet(tuple(field.key for field in study.varied), columns, dict.fromkeys(columns, ""))
    return tables


_INDICES = ("first", "first_error", "total", "total_error")


def _rows(study: Study, aggregate: StudyAggregate, rows: Index) -> Sheet:
    """Return designs as a table, with the texts of fields that are not numbers."""
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for field, column in zip(study.varied, aggregate.fields, strict=True):
        if field.number is None:
            columns[field.key] = np.array([str(field.values[int(index)]) for index in column[rows]], dtype=object)
        else:
            columns[field.key] = np.asarray(from_si(column[rows], field.number.unit))
        units[field.key] = field.unit
    for key, column in zip(study.keys, aggregate.values, strict=True):
        columns[key], units[key] = displayed_column(key, column[rows]), key_unit(key)
    return Sheet(tuple(str(design) for design in aggregate.numbers[rows]), columns, units)


def found_data(study: Study, aggregate: StudyAggregate) -> dict[str, Any]:
    """Return the results of a study as plain data."""
    with use_units(study.units):
        return _data(study, aggregate)


def _data(study: Study, aggregate: StudyAggregate) -> dict[str, Any]:
    best, pareto = ranked(study, aggregate)

    def designs(rows: Index) -> list[dict[str, Any]]:
        sheet = _rows(study, aggregate, rows)
        columns = [[plain(value) for value in column.tolist()] for column in sheet.columns.values()]
        return [
            {NUMBER: int(name), **dict(zip(sheet.columns, row, strict=True))}
            for name, row in zip(sheet.names, zip(*columns, strict=True), strict=True)
        ]

    return {
        "title": study.title,
        "study": study.digest,
        "seed": study.seed,
        "designs": aggregate.designs,
        "within_limits": aggregate.within,
        "one_by_one": aggregate.one_by_one,
        "not_compiled": None if aggregate.alone is None else _because(aggregate.alone, "en"),
        "refused": [{"count": count, "reason": str(reason)} for count, reason in aggregate.refused.values()],
        "units": {
            **{field.key: field.number.unit for field in study.varied if field.number},
            **{key: key_unit(key) for key in study.keys},
        },
        "values": {
            key: {
                "count": moments.count,
                "mean": plain(displayed(key, moments.mean)),
                "deviation": plain(displayed_size(key, moments.deviation)),
                "least": plain(displayed(key, moments.low)),
                "largest": plain(displayed(key, moments.high)),
            }
            for key, moments in aggregate.moments.items()
        },
        "best": {key: designs(rows) for key, rows in best.items()},
        "pareto": designs(pareto),
        "pareto_thinned": aggregate.is_thinned,
        "sensitivity": {
            key: {
                field.key: dict(zip(_INDICES, map(plain, row), strict=True))
                for field, row in zip(study.varied, np.array(indices).T.tolist(), strict=True)
            }
            for key, shares in aggregate.shares.items()
            if (indices := shares.indices()) is not None
        },
    }

"""Results of a study, and of a search for the best design, as text, plain data, tables and a machine file."""

from __future__ import annotations

import contextlib
import json
import math
import os
from collections.abc import Iterator
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from crankwork.description.document import Description
from crankwork.description.machine_file import Setting, apply_settings
from crankwork.errors import MissingExtraError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, in_language, translate
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.report.display import displayed, displayed_column, displayed_size, key_unit, label, plain, rounded
from crankwork.report.results_folder import workbook_of
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.show.canvas import plain as plain_text
from crankwork.study.chunks import NUMBER, Index, Moments, StudyAggregate, feasible_designs, ranks
from crankwork.study.study_file import Study
from crankwork.study.varied_field import VariedField
from crankwork.units import from_si, use_units

if TYPE_CHECKING:
    from crankwork.study.optimise import ActiveConstraint, Optimum

_DIGITS = 6
# best designs printed in a terminal
_SHOWN = 3
# least share of the variance that is printed
_MIN_SHARE = 0.005
_LONG = 8
# digits of numbers in the machine file of the best design
_WRITTEN = 10
# share of a gradient that active constraints may leave
_EXPLAINED = 1e-3


def found_files(study: Study, aggregate: StudyAggregate, language: Language = "en") -> dict[str, bytes]:
    """Return the files of a study's folder besides its parts."""
    data = json.dumps(found_data(study, aggregate), ensure_ascii=False, indent=1)
    with use_units(study.units):
        sheets = _sheets(study, aggregate)
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in sheets.items()}
        # the same tables are there as CSV
        with contextlib.suppress(MissingExtraError):
            tables["study.xlsx"] = workbook_of(sheets, {"title": study.title[:255]}, language)
    return {"summary.json": f"{data}\n".encode(), **tables}


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


def _stated(field: VariedField, value: float, language: Language, digits: int = _DIGITS) -> str:
    if field.number is None:
        return str(field.values[int(value)])
    return with_unit(_of_field(field, value), field.unit, language, digits)


def _causes(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, ...]]:
    for key, shares in aggregate.shares.items():
        indices = shares.indices()
        if indices is None:
            continue
        rows = sorted(zip(*indices, study.varied, strict=True), key=lambda row: -row[2])
        for alone, alone_error, total, total_error, field in rows:
            if total > _MIN_SHARE:
                shares_of_field = ((alone, alone_error), (total, total_error))
                shown = ([number(100 * value, language, digits=3) for value in pair] for pair in shares_of_field)
                yield label(key, language), field.key, *(f"{share} ± {error} %" for share, error in shown)


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
    keys = [*(field.key for field in study.varied), *study.keys]
    columns = dict(zip(keys, [*aggregate.fields[:, rows], *aggregate.values[:, rows]], strict=True))
    return _table(study, columns, tuple(str(design) for design in aggregate.numbers[rows]))


def _table(study: Study, columns: dict[str, Array], names: tuple[str, ...] = ()) -> Sheet:
    """Return fields and values of results as a table, in units of the file and of the tables."""
    fields, shown = {field.key: field for field in study.varied}, dict[str, Array]()
    for key, column in columns.items():
        if key not in fields:
            shown[key] = displayed_column(key, column)
        elif fields[key].number is None:
            shown[key] = np.array([str(fields[key].values[int(index)]) for index in column], dtype=object)
        else:
            shown[key] = np.asarray(from_si(column, fields[key].unit))
    return Sheet(names, shown, {key: fields[key].unit if key in fields else key_unit(key) for key in columns})


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


def optimum_files(study: Study, optimum: Optimum, folder: str | PurePath) -> dict[str, bytes]:
    """Return the files of a search's folder: machine file of the best design, history and summary."""
    data = json.dumps(optimum_data(study, optimum), ensure_ascii=False, indent=1)
    with use_units(study.units):
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in _optimum_sheets(study, optimum).items()}
    machine = _best_machine(study, optimum, folder).dump()
    return {"machine.toml": machine.encode(), "summary.json": f"{data}\n".encode(), **tables}


def _best_machine(study: Study, optimum: Optimum, folder: str | PurePath) -> Description:
    """Return the machine file of the best design, with paths to its tables relative to a folder."""
    own = study.machine
    best = Description(own.dump(), own.name, folder=own.folder)
    written = [Setting(key, key, value) for key, value in _written(study, optimum).items()]
    settings = {setting.key: setting.value for setting in apply_settings(own.values, [*study.overrides, *written])}
    tables = {
        key: Path(os.path.relpath((own.folder or Path()) / own[key], folder)).as_posix()
        for key in own
        if key.rpartition(".")[2] == "file" and isinstance(own[key], str)
    }
    for key, value in (settings | tables).items():
        best[key] = value
    return best


def _written(study: Study, optimum: Optimum) -> dict[str, str | float]:
    """Return the numbers of the best design as its machine file states them."""
    return {
        field.key: f"{_of_field(field, value):.{_WRITTEN}g} {field.unit}" if field.unit else rounded(value, _WRITTEN)
        for field, value in zip(study.varied, optimum.fields.values(), strict=True)
    }


def _of_field(field: VariedField, value: float) -> float:
    return float(from_si(value, field.unit))


def _optimum_sheets(study: Study, optimum: Optimum) -> dict[str, Sheet]:
    """Return tables of every design evaluated and of the optimum from each start."""
    places = {key: np.array([place[key] for place in optimum.places]) for key in optimum.places[0]}
    return {
        "course": _table(study, {**optimum.history.fields, **optimum.history.values}),
        "starts": _table(study, places),
    }


def optimum_text(study: Study, optimum: Optimum, language: Language = "en") -> str:
    """Return the best design as text: fields, values and active constraints."""
    with use_units(study.units):
        return "\n".join(_optimum_lines(study, optimum, language))


def _optimum_lines(study: Study, optimum: Optimum, language: Language) -> Iterator[str]:
    if study.title:
        yield study.title
    name = label(optimum.objective, language)
    value = value_text(optimum.objective, optimum.value, language, _LONG)
    before = value_text(optimum.objective, study.stated[optimum.objective], language, _LONG)
    yield translate(f"study.best_{optimum.sense}", language, name=capital(name), value=value, stated=before)
    yield from ("", translate("study.best_design", language))
    rows = []
    for field, best in zip(study.varied, optimum.fields.values(), strict=True):
        rows.append((field.key, _stated(field, best, language, _LONG), _stated_number(field, language)))
    yield from aligned(rows)
    if len(optimum.values) > 1:
        values = [(label(key, language), value_text(key, x, language, _LONG)) for key, x in optimum.values.items()]
        yield from ("", translate("study.best_values", language), *aligned(values[1:]))
    yield ""
    yield translate("study.held_by" if optimum.holding else "study.held_by_nothing", language, name=name)
    yield from aligned([_held(study, optimum, constraint, language) for constraint in optimum.holding])
    if optimum.rest > _EXPLAINED:
        yield translate("study.unexplained", language, share=number(100 * optimum.rest, language, digits=2))


def _stated_number(field: VariedField, language: Language) -> str:
    now = None if field.number is None else field.number.now
    return "" if now is None else f"({_stated(field, now, language, _LONG)})"


def _held(study: Study, optimum: Optimum, constraint: ActiveConstraint, language: Language) -> tuple[str, str, str]:
    """Return an active constraint and the change of the objective with it, as text."""
    key, sense, level, _ = constraint
    field = next((field for field in study.varied if field.key == key), None)
    shown = _stated(field, level, language, _LONG) if field else value_text(key, level, language, _LONG)
    price = number(_price(study, optimum, constraint), language, digits=4)
    units = (key_unit(optimum.objective), field.unit if field else key_unit(key))
    unit = "/".join(unit_name(unit, language) or "1" for unit in units)
    return key if field else label(key, language), f"{sense} {shown}", f"{price} {unit}"


def _price(study: Study, optimum: Optimum, constraint: ActiveConstraint) -> float:
    """Return the change of the objective with a level, in units of tables and of the file."""
    fields = {field.key: field for field in study.varied}
    size = _in_file(fields[constraint.key], 1.0) if constraint.key in fields else displayed_size(constraint.key, 1.0)
    return displayed_size(optimum.objective, constraint.price) / size


def _in_file(field: VariedField, size: float) -> float:
    return _of_field(field, size) - _of_field(field, 0.0)


def optimum_data(study: Study, optimum: Optimum) -> dict[str, Any]:
    """Return the best design as plain data, in the units of the file and the tables."""
    with use_units(study.units):
        return _optimum_data(study, optimum)


def _optimum_data(study: Study, optimum: Optimum) -> dict[str, Any]:
    fields = {field.key: field for field in study.varied}
    stated = {key: field.number.now if field.number else None for key, field in fields.items()}
    size = displayed_size(optimum.objective, 1.0)

    def shown(key: str, value: float) -> object:
        return plain(_of_field(fields[key], value) if key in fields else displayed(key, value))

    return {
        "title": study.title,
        "objective": optimum.objective,
        "sense": optimum.sense,
        "units": {key: fields[key].unit if key in fields else key_unit(key) for key in (*fields, *optimum.values)},
        "fields": {key: shown(key, value) for key, value in optimum.fields.items()},
        "written": _written(study, optimum),
        "stated": {key: None if now is None else shown(key, now) for key, now in stated.items()},
        "values": {key: shown(key, value) for key, value in optimum.values.items()},
        "gradient": {key: plain(size * slope / _in_file(fields[key], 1.0)) for key, slope in optimum.gradient.items()},
        "holding": [
            {"key": constraint.key, "sense": constraint.sense, "level": shown(constraint.key, constraint.level),
             "price": plain(_price(study, optimum, constraint))}
            for constraint in optimum.holding
        ],
        "rest": plain(optimum.rest),
        "places": [{key: shown(key, value) for key, value in place.items()} for place in optimum.places],
        "designs": len(optimum.history),
        "way": optimum.way,
        "seed": optimum.seed,
        "not_compiled": optimum.reason,
    }  # fmt: skip

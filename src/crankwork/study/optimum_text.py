"""Results of a search for the best design: its machine file, text, plain data and tables."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path, PurePath
from typing import Any

import numpy as np

from crankwork.description.document import Description
from crankwork.description.machine_file import Setting, apply_settings
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, translate
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.report.display import displayed, displayed_column, displayed_size, key_unit, label, plain, rounded
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.study.optimise import ActiveConstraint, Optimum
from crankwork.study.study_file import Study
from crankwork.study.study_text import value_text, with_unit
from crankwork.study.varied_field import VariedField
from crankwork.units import from_si, use_units

_DIGITS = 8
# digits of numbers in the machine file of the best design
_WRITTEN = 10
# share of a gradient that active constraints may leave
_EXPLAINED = 1e-3


def optimum_files(study: Study, optimum: Optimum, folder: str | PurePath) -> dict[str, bytes]:
    """Return the files of a search's folder: machine file of the best design, history and summary."""
    data = json.dumps(optimum_data(study, optimum), ensure_ascii=False, indent=1)
    with use_units(study.units):
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in _sheets(study, optimum).items()}
    machine = _machine(study, optimum, folder).dump()
    return {"machine.toml": machine.encode(), "summary.json": f"{data}\n".encode(), **tables}


def _machine(study: Study, optimum: Optimum, folder: str | PurePath) -> Description:
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


def _sheets(study: Study, optimum: Optimum) -> dict[str, Sheet]:
    """Return tables of every design evaluated and of the optimum from each start."""
    places = {key: np.array([place[key] for place in optimum.places]) for key in optimum.places[0]}
    return {
        "course": _sheet(study, {**optimum.history.fields, **optimum.history.values}),
        "starts": _sheet(study, places),
    }


def _sheet(study: Study, columns: dict[str, Array]) -> Sheet:
    units = {field.key: field.unit for field in study.varied}
    shown = {
        key: np.asarray(from_si(column, units[key])) if key in units else displayed_column(key, column)
        for key, column in columns.items()
    }
    return Sheet((), shown, {key: units[key] if key in units else key_unit(key) for key in columns})


def optimum_text(study: Study, optimum: Optimum, language: Language = "en") -> str:
    """Return the best design as text: fields, values and active constraints."""
    with use_units(study.units):
        return "\n".join(_lines(study, optimum, language))


def _lines(study: Study, optimum: Optimum, language: Language) -> Iterator[str]:
    if study.title:
        yield study.title
    name = label(optimum.objective, language)
    value = value_text(optimum.objective, optimum.value, language, _DIGITS)
    before = value_text(optimum.objective, study.stated[optimum.objective], language, _DIGITS)
    yield translate(f"study.best_{optimum.sense}", language, name=capital(name), value=value, stated=before)
    yield from ("", translate("study.best_design", language))
    fields = zip(study.varied, optimum.fields.values(), strict=True)
    yield from aligned(
        [(field.key, _field(field, value, language), _stated(field, language)) for field, value in fields]
    )
    if len(optimum.values) > 1:
        values = [(label(key, language), value_text(key, x, language, _DIGITS)) for key, x in optimum.values.items()]
        yield from ("", translate("study.best_values", language), *aligned(values[1:]))
    yield ""
    yield translate("study.held_by" if optimum.holding else "study.held_by_nothing", language, name=name)
    yield from aligned([_held(study, optimum, constraint, language) for constraint in optimum.holding])
    if optimum.rest > _EXPLAINED:
        yield translate("study.unexplained", language, share=number(100 * optimum.rest, language, digits=2))


def _field(field: VariedField, value: float, language: Language) -> str:
    return with_unit(_of_field(field, value), field.unit, language, _DIGITS)


def _stated(field: VariedField, language: Language) -> str:
    now = None if field.number is None else field.number.now
    return "" if now is None else f"({_field(field, now, language)})"


def _held(study: Study, optimum: Optimum, constraint: ActiveConstraint, language: Language) -> tuple[str, str, str]:
    """Return an active constraint and the change of the objective with it, as text."""
    key, sense, level, _ = constraint
    field = next((field for field in study.varied if field.key == key), None)
    shown = _field(field, level, language) if field else value_text(key, level, language, _DIGITS)
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
        return _data(study, optimum)


def _data(study: Study, optimum: Optimum) -> dict[str, Any]:
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

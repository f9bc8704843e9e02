"""Units of measurement as text, at the doors only; inside, everything is SI.

A table and a strict grammar: a number, a space if you like, a unit of the table. Nothing is evaluated,
so neither `9**9**9 mm` nor `1 mm + 1 m` means anything, and a comma is never dropped.
"""

from __future__ import annotations

import math
import re
import unicodedata
from typing import Any, NamedTuple

from crankwork.locale import Refusal


class Unit(NamedTuple):
    """A unit: the dimension it measures, its size in SI and, for a temperature scale, where its zero lies."""

    dimension: str
    factor: float
    zero: float = 0.0


KGF = 9.80665
_RPM = math.pi / 30

# dimension: {SI size: every spelling}. The first spelling is the one that is suggested.
_SPELLINGS: dict[str, list[tuple[float, str]]] = {
    "angle": [(math.pi / 180, "deg ° градус град độ"), (1.0, "rad рад")],
    "length": [
        (1e-3, "mm мм"),
        (1e-2, "cm см"),
        (1.0, "m м"),
        (1e-6, "um µm μm мкм"),
        (0.0254, "in inch"),
        (0.3048, "ft"),
    ],
    "area": [(1e-4, "cm2 cm² см2 см²"), (1e-6, "mm2 mm² мм2 мм²"), (1.0, "m2 m² м2 м²")],
    "volume": [
        (1e-6, "cm3 cm³ cc см3 см³"),
        (1e-3, "l L dm3 dm³ л дм3 дм³"),
        (1e-9, "mm3 mm³ мм3 мм³"),
        (1.0, "m3 m³ м3 м³"),
        (0.0254**3, "in3 in³"),
    ],
    "mass": [(1.0, "kg кг"), (1e-3, "g г"), (1e3, "t т"), (0.45359237, "lb lbm")],
    "mass_per_area": [
        (10.0, "g/cm2 g/cm² г/см2 г/см²"),
        (1.0, "kg/m2 kg/m² кг/м2 кг/м²"),
        (1e4, "kg/cm2 kg/cm² кг/см2 кг/см²"),
    ],
    "inertia": [
        (1.0, "kg*m2 kg·m² kg.m2 kgm2 кг·м² кг*м2 кг.м2"),
        (1e-4, "kg*cm2 kg·cm² кг·см² кг*см2"),
        (1e-6, "kg*mm2 kg·mm² кг·мм² кг*мм2"),
        (1e-7, "g*cm2 g·cm² г·см²"),
    ],
    "speed": [
        (_RPM, "rpm r/min rev/min 1/min min-1 min⁻¹ об/мин vg/ph vòng/phút v/ph v/p"),
        (1.0, "rad/s рад/с rad/giây"),
        (2 * math.pi, "rev/s 1/s Hz s-1 об/с vg/s"),
    ],
    "angular_acceleration": [(1.0, "rad/s2 rad/s² рад/с2 рад/с²")],
    "velocity": [(1.0, "m/s м/с"), (1e-3, "mm/s мм/с")],
    "acceleration": [(1.0, "m/s2 m/s² м/с2 м/с²"), (1e-3, "mm/s2 mm/s² мм/с2 мм/с²")],
    "pressure": [
        (1e6, "MPa МПа MN/m2 MN/m² МН/м2 МН/м² N/mm2 N/mm² Н/мм2 Н/мм²"),
        (1e3, "kPa кПа kN/m2 kN/m²"),
        (1.0, "Pa Па N/m2 N/m²"),
        (1e5, "bar бар"),
        (KGF * 1e4, "kgf/cm2 kgf/cm² кгс/см2 кгс/см² kG/cm2 kG/cm² at ат"),
        (101325.0, "atm атм"),
        (6894.757293168361, "psi lbf/in2"),
    ],
    "time": [(1.0, "s с"), (1e-3, "ms мс"), (60.0, "min мин")],
    "stiffness": [(1.0, "N/m Н/м"), (1e3, "N/mm kN/m Н/мм кН/м")],
    "damping": [(1.0, "N*s/m N·s/m Н·с/м Н*с/м"), (1e3, "kN*s/m N*s/mm кН·с/м кН*с/м")],
    "angular_damping": [(1.0, "N*m*s/rad N·m·s/rad N*m*s N·m·s Н·м·с/рад Н*м*с/рад Н·м·с Н*м*с")],
    "force": [(1.0, "N Н"), (1e3, "kN кН"), (1e6, "MN МН"), (KGF, "kgf кгс kG"), (4.4482216152605, "lbf")],
    "torque": [
        (1.0, "N*m N·m Nm N.m Н·м Н*м Нм Н.м"),
        (1e3, "kN*m kN·m kNm кН·м кН*м"),
        (KGF, "kgf*m kgf·m кгс·м кгс*м"),
    ],
    "energy": [(1.0, "J Дж"), (1e3, "kJ кДж")],
    "temperature": [(1.0, "K К")],
    "specific_energy": [(1e6, "MJ/kg МДж/кг"), (1e3, "kJ/kg кДж/кг"), (1.0, "J/kg Дж/кг")],
    "mass_moment": [(1.0, "kg*m kg·m кг·м кг*м"), (1e-3, "kg*mm kg·mm кг·мм кг*мм"), (1e-5, "g*cm g·cm г·см г*см")],
    "pressure_rise": [
        (1e6 * 180 / math.pi, "MPa/deg MPa/° МПа/град"),
        (1e5 * 180 / math.pi, "bar/deg бар/град"),
        (1.0, "Pa/rad Па/рад"),
    ],
    "pressure_by_velocity": [(1e6, "MPa*s/m МПа*с/м"), (1.0, "Pa*s/m Па*с/м")],
    "heat_transfer": [(1.0, "W/(m2*K) W/m2K Вт/(м2*К)"), (1e3, "kW/(m2*K) кВт/(м2*К)")],
    "specific_heat": [(1.0, "J/(kg*K) Дж/(кг*К)"), (1e3, "kJ/(kg*K) кДж/(кг*К)")],
    "density": [(1.0, "kg/m3 kg/m³ кг/м3 кг/м³")],
    "specific_amount": [(1.0, "kmol/kg кмоль/кг")],
    "molar_mass": [(1.0, "kg/kmol кг/кмоль")],
    "molar_energy": [(1.0, "kJ/kmol кДж/кмоль")],
    "molar_heat": [(1.0, "kJ/(kmol*K) кДж/(кмоль*К)")],
    "fuel_consumption": [(1 / 3.6e9, "g/(kW*h) g/kWh г/(кВт*ч)"), (1.0, "kg/J кг/Дж")],
    "mass_rate": [(1 / 3600, "kg/h кг/ч"), (1.0, "kg/s кг/с")],
    "power_density": [(1e6, "kW/l кВт/л"), (1.0, "W/m3 W/m³ Вт/м3 Вт/м³")],
    "per_temperature": [(1.0, "1/K 1/К")],
    "volume_per_temperature": [(1e-6, "cm3/K cm³/K см3/К см³/К"), (1.0, "m3/K m³/K м3/К м³/К")],
    "speed_per_temperature": [(1.0, "m/(s*K) м/(с*К)")],
    "power": [(1e3, "kW кВт"), (1.0, "W Вт"), (735.49875, "PS л.с. лс mã_lực")],
}

UNITS: dict[str, Unit] = {
    name: Unit(dimension, factor)
    for dimension, rows in _SPELLINGS.items()
    for factor, names in rows
    for name in names.split()
} | {name: Unit("temperature", 1.0, 273.15) for name in ("degC", "°C", "°С")}

# "ratio" has no unit; the display of a share in per cent stays a choice of the report.
EXAMPLES = {
    dimension: {"speed": "2300 rpm", "temperature": "293 K"}.get(dimension, f"30 {rows[0][1].split()[0]}")
    for dimension, rows in _SPELLINGS.items()
}

_MAX_LENGTH = 100
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?"
# a unit that starts with a digit, 1/min, needs a space before it
_UNIT = r"\s*(?P<unit>[^\s\d.,+-].*?|(?<=\s)1/\w+)?\s*\Z"
_QUANTITY = re.compile(rf"\s*(?P<number>{_NUMBER}){_UNIT}")
_WITH_COMMA = re.compile(rf"\s*(?P<number>[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{{1,3}})?){_UNIT}")
_BARE = re.compile(rf"{_NUMBER}|[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{{1,3}})?")
_OPERATOR = re.compile(r"\s*([/*·])\s*")


def spellings(dimension: str) -> list[str]:
    """Return the first spelling of every unit of a dimension."""
    return [names.split()[0] for _, names in _SPELLINGS[dimension]]


def parse(text: str, dimensions: tuple[str, ...], *, decimal_comma: bool = False) -> tuple[float, str]:
    """Return the SI value and the dimension of a quantity written as text.

    `dimensions`: the dimensions that make sense here; the first is used in the advice; `decimal_comma`: read `1,1 kg`
    as 1.1 kg. Otherwise a comma is an error, because it also separates thousands.

    Examples
    --------
    >>> parse("75 mm", ("length",))
    (0.075, 'length')
    """
    example = EXAMPLES[dimensions[0]]
    text = unicodedata.normalize("NFC", text) if len(text) <= _MAX_LENGTH else text
    match = (_WITH_COMMA.match(text) or _QUANTITY.match(text)) if len(text) <= _MAX_LENGTH else None
    if match is None:
        raise ValueError(Refusal("no_quantity", text=_short(text), example=example))
    number, name = match["number"].replace(",", "."), match["unit"]
    spelling = _spelling(name or "")
    if spelling.lower() == "hp":
        raise ValueError(Refusal("horsepower", unit=_short(name)))
    unit = UNITS.get(spelling)
    fits = unit is not None and unit.dimension in dimensions
    wanted = tuple(_dimension(one) for one in dimensions)
    known = ", ".join(one for dimension in dimensions for one in spellings(dimension))
    if "," in match["number"] and not decimal_comma:
        point = f"{number} {name if fits else example.split()[1]}"
        if fits or name is None:
            raise ValueError(Refusal("decimal_comma", text=_short(text), point=point))
        raise ValueError(Refusal("decimal_comma_unit", text=_short(text), wanted=wanted, point=point, known=known))
    if name is None:
        raise ValueError(Refusal("unit_missing", text=_short(text), example=example))
    if unit is None:
        raise ValueError(Refusal("unit_unknown", unit=_short(name), wanted=wanted, known=known))
    if not fits:
        measured = _dimension(unit.dimension)
        raise ValueError(Refusal("unit_other", unit=_short(name), measured=measured, wanted=wanted, known=known))
    value = to_si(float(number), spelling)
    if not math.isfinite(value):
        raise ValueError(Refusal("too_large", text=_short(text), example=example))
    return value, unit.dimension


def parse_in(text: str, unit: str) -> float:
    """Return the SI value of a quantity written by hand: a bare number is in a unit, and a comma is a decimal mark.

    Examples
    --------
    >>> parse_in("1,5", "mm"), parse_in("2 cm", "mm")
    (0.0015, 0.02)
    """
    text = text.strip()
    text = f"{text} {unit}" if _BARE.fullmatch(text) else text
    return parse(text, (UNITS[unit].dimension,), decimal_comma=True)[0]


def _spelling(name: str) -> str:
    """Return a unit as the table spells it: blanks around an operator mean nothing, others an operator or a word."""
    name = _OPERATOR.sub(r"\1", name)
    return next((one for one in (name, name.replace(" ", "*"), name.replace(" ", "_")) if one in UNITS), name)


def to_si(value: Any, unit: str) -> Any:  # noqa: ANN401 - a float or an array, as given
    """Return a value (or array) given in `unit` as SI.

    Small units divide by their whole reciprocal, so that 120 cm3 is the double nearest to 0.00012.
    """
    _, factor, zero = UNITS[unit]
    if zero:
        return value * factor + zero
    inverse = round(1 / factor)
    return value / inverse if inverse > 1 and abs(inverse * factor - 1) < 1e-12 else value * factor


def from_si(value: Any, unit: str) -> Any:  # noqa: ANN401 - a float or an array, as given
    """Return an SI value (or array) expressed in `unit`; `""` leaves it alone."""
    if not unit:
        return value
    _, factor, zero = UNITS[unit]
    if zero:
        return (value - zero) / factor
    inverse = round(1 / factor)
    return value * inverse if inverse > 1 and abs(inverse * factor - 1) < 1e-12 else value / factor


def coherent_unit(unit: str) -> str:
    """Return the SI unit of what a unit measures, or the unit itself if the table has no such unit.

    Examples
    --------
    >>> coherent_unit("MPa"), coherent_unit("rpm")
    ('Pa', 'rad/s')
    """
    if unit not in UNITS:
        return unit
    dimension = UNITS[unit].dimension
    return next((name for name, one in UNITS.items() if one.dimension == dimension and one.factor == 1.0), unit)


def _dimension(dimension: str) -> Refusal:
    return Refusal(f"dimension_{dimension}")


def _short(text: str) -> str:
    text = " ".join(text[:200].split())
    return text if len(text) <= 40 else text[:37] + "..."

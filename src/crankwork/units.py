"""Units of measurement as text, for input and output only; inside, everything is SI.

A table and a strict grammar: a number, an optional space, a unit of the table. Nothing is evaluated,
so neither `9**9**9 mm` nor `1 mm + 1 m` is valid, and a comma is never dropped.
"""

from __future__ import annotations

import contextlib
import difflib
import math
import re
import unicodedata
from collections.abc import Iterator
from contextvars import ContextVar
from typing import Any, Literal, NamedTuple

from crankwork.locale import ErrorMessage


class Unit(NamedTuple):
    """A unit: the dimension it measures, its size in SI and, for a temperature scale, its zero."""

    dimension: str
    factor: float
    zero: float = 0.0


class ParsedQuantity(NamedTuple):
    """A quantity as read: its value in SI, and the code of a notice about its interpretation, if any."""

    value: float
    dimension: str
    unit: str
    notice: str = ""


KGF = 9.80665
_IN, _FT, _LB = 0.0254, 0.3048, 0.45359237
_LBF = _LB * KGF
_SLUG = _LBF / _FT
_RPM = math.pi / 30

# dimension: {SI size: all spellings}. The first spelling is the suggested one.
_SPELLINGS: dict[str, list[tuple[float, str]]] = {
    "angle": [(math.pi / 180, "deg ° градус град độ"), (1.0, "rad рад"), (2 * math.pi, "rev об")],
    "length": [(1e-3, "mm мм"), (1e-2, "cm см"), (1.0, "m м"), (0.1, "dm дм"), (1e-6, "um µm μm мкм"),
               (_IN, "in inch"), (_FT, "ft")],
    "area": [(1e-4, "cm2 см2"), (1e-6, "mm2 мм2"), (1.0, "m2 м2"), (_IN**2, "in2"), (_FT**2, "ft2")],
    "volume": [
        (1e-6, "cm3 cc см3 ml мл"), (1e-3, "l L dm3 л дм3"), (1e-9, "mm3 мм3"), (1.0, "m3 м3"), (_IN**3, "in3 cu.in"),
        (_FT**3, "ft3 cu.ft"),
    ],
    "area_moment": [(1e-8, "cm4 см4"), (1e-12, "mm4 мм4"), (1.0, "m4 м4"), (_IN**4, "in4")],
    "mass": [
        (1.0, "kg кг"), (1e-3, "g г"), (1e3, "t т"), (_LB, "lb lbm"), (_LB / 16, "oz"), (_SLUG, "slug lbf*s2/ft"),
        (2000 * _LB, "ton(US)"), (2240 * _LB, "ton(UK)"), (KGF, "kgf*s2/m kG*s2/m кгс·с2/м"),
        (_LBF / _IN, "blob blobs lbf*s2/in"),
    ],
    "mass_per_area": [
        (10.0, "g/cm2 г/см2"), (1.0, "kg/m2 кг/м2"), (1e4, "kg/cm2 кг/см2"), (_LB / _IN**2, "lb/in2"),
        (_LB / _FT**2, "lb/ft2"),
    ],
    "mass_per_length": [(1.0, "kg/m кг/м"), (_LB / _IN, "lb/in"), (_LB / _FT, "lb/ft")],
    "inertia": [
        (1.0, "kg*m2 kgm2 кг·м²"), (1e-4, "kg*cm2 кг·см²"), (1e-6, "kg*mm2 кг·мм²"), (1e-7, "g*cm2 г·см²"),
        (_LB * _FT**2, "lb*ft2 lbm*ft2"), (_LB * _IN**2, "lb*in2 lbm*in2"), (_SLUG * _FT**2, "slug*ft2 lbf*ft*s2"),
        (_LBF * _IN, "lbf*in*s2 lb-in-s2 in-lb-s2"), (_LBF / 16 * _IN, "ozf*in*s2"), (KGF, "kgf*m*s2 kG*m*s2 кгс·м·с2"),
        (KGF / 100, "kgf*cm*s2 кгс·см·с2"),
    ],
    "speed": [
        (_RPM, "rpm r/min rev/min 1/min об/мин 1/мин об/хв 1/хв vg/ph vòng/phút vg/phút v/phút v/ph v/p U/min tr/min"),
        (1.0, "rad/s рад/с"),
        (2 * math.pi, "rev/s r/s rps об/с vg/s vòng/s"), (math.pi / 180, "°/s deg/s град/с độ/s"),
    ],
    "frequency": [(2 * math.pi, "Hz 1/s Гц 1/с")],
    "angular_acceleration": [
        (1.0, "rad/s2 рад/с2"), (math.pi / 180, "deg/s2 °/s2 град/с2"), (2 * math.pi, "rev/s2 об/с2"), (_RPM, "rpm/s"),
    ],
    "angular_jerk": [(1.0, "rad/s3 рад/с3")],
    "jerk": [(1.0, "m/s3 м/с3"), (1e-3, "mm/s3 мм/с3"), (_FT, "ft/s3"), (_IN, "in/s3")],
    "velocity": [(1.0, "m/s м/с"), (1e-3, "mm/s мм/с"), (1 / 3.6, "km/h км/ч"), (_FT, "ft/s"),
                 (_FT / 60, "ft/min fpm"), (_IN, "in/s"), (1e-2, "cm/s см/с"), (5280 * _FT / 3600, "mph mi/h"),
                 (1 / 60, "m/min м/мин"), (_IN / 60, "in/min")],
    "acceleration": [(1.0, "m/s2 м/с2"), (1e-3, "mm/s2 мм/с2"), (_FT, "ft/s2"), (_IN, "in/s2"),
                     (1e-2, "cm/s2 см/с2")],
    "pressure": [
        (1e6, "MPa МПа MN/m2 МН/м2 N/mm2 Н/мм2"), (1e9, "GPa ГПа GN/m2 kN/mm2"),
        (1e3, "kPa кПа kN/m2"), (1.0, "Pa Па N/m2"), (1e5, "bar бар"),
        (1e2, "hPa гПа mbar мбар"), (KGF * 1e4, "kgf/cm2 кгс/см2 kG/cm2 kp/cm2 at ат"),
        (133.322387415, "mmHg mm_Hg ммртст мм_рт.ст."), (101325.0 / 760, "Torr торр"), (101325.0, "atm атм"),
        (KGF, "mmH2O mm_H2O mmWC ммводст мм_вод.ст. kgf/m2 кгс/м2"), (KGF * 10, "cmH2O cm_H2O cmWC смводст см_вод.ст."),
        (KGF * 1e3, "mH2O m_H2O mWC мводст м_вод.ст."), (KGF * 25.4, "inH2O in_H2O"),
        (KGF * 304.8, "ftH2O ft_H2O"), (1333.22387415, "cmHg cm_Hg смртст см_рт.ст."), (3386.388640341, "inHg in_Hg"),
        (KGF * 1e6, "kgf/mm2 кгс/мм2"), (1e4, "N/cm2 Н/см2"),
        (_LBF / _IN**2, "psi lbf/in2"), (_LBF / _FT**2, "psf lbf/ft2"),
        (1e3 * _LBF / _IN**2, "ksi"), (1e6 * _LBF / _IN**2, "Mpsi"),
    ],
    "time": [(1.0, "s с"), (1e-3, "ms мс"), (60.0, "min мин"), (3600.0, "h ч")],
    "stiffness": [(1.0, "N/m Н/м"), (1e3, "N/mm kN/m Н/мм кН/м"), (_LBF / _IN, "lbf/in"), (_LBF / _FT, "lbf/ft"),
                  (1e2, "N/cm Н/см"), (KGF * 1e2, "kgf/cm кгс/см"), (KGF * 1e3, "kgf/mm кгс/мм"), (KGF, "kgf/m кгс/м"),
                  (1e3 * _LBF / _IN, "kip/in")],
    "damping": [
        (1.0, "N*s/m Ns/m Н·с/м"), (1e3, "kN*s/m N*s/mm кН·с/м"), (_LBF / _IN, "lbf*s/in"), (_LBF / _FT, "lbf*s/ft"),
        (KGF, "kgf*s/m кгс·с/м"),
    ],
    "angular_damping": [(1.0, "N*m*s/rad N*m*s Н·м·с/рад Н·м·с"), (_LBF * _FT, "lbf*ft*s/rad lbf*ft*s"),
                        (_LBF * _IN, "lbf*in*s/rad lbf*in*s"), (KGF, "kgf*m*s/rad kgf*m*s кгс·м·с/рад")],
    "torsional_stiffness": [
        (1.0, "N*m/rad Н·м/рад"), (1e3, "kN*m/rad кН·м/рад"), (1e6, "MN*m/rad МН·м/рад"), (KGF, "kgf*m/rad кгс·м/рад"),
        (_LBF * _FT, "lbf*ft/rad lb-ft/rad"), (_LBF * _IN, "lbf*in/rad lb-in/rad in-lb/rad"),
        (180 / math.pi, "N*m/deg N*m/° Н·м/град"),
    ],
    "force": [
        (1.0, "N Н"), (1e3, "kN кН"), (1e6, "MN МН"), (10.0, "daN даН"), (KGF, "kgf кгс kG kp"), (1e3 * KGF, "tf тс"),
        (_LBF, "lbf"), (1e3 * _LBF, "kip klbf"),
        (_LBF / 16, "ozf"),
    ],
    "torque": [
        (1.0, "N*m Nm Н·м Нм"), (1e3, "kN*m kNm кН·м"), (KGF, "kgf*m kG*m kpm кгс·м"), (_LBF * _FT, "lbf*ft lb-ft"),
        (_LBF * _IN, "lbf*in lb-in"), (_LBF / 16 * _IN, "ozf*in"),
        (1e-3, "N*mm Nmm Н·мм"), (1e-2, "N*cm Ncm Н·см"), (KGF / 100, "kgf*cm кгс·см"), (1e3 * _LBF * _FT, "kip*ft"),
        (1e3 * _LBF * _IN, "kip*in"), (1e3 * KGF, "tf*m тс·м"),
    ],
    "energy": [
        (1.0, "J Дж"), (1e3, "kJ кДж"), (1e6, "MJ МДж"), (_LBF * _FT, "ft*lbf ft-lb"), (_LBF * _IN, "in*lbf in-lb"),
        (1055.05585262, "Btu"), (4186.8, "kcal ккал"), (3.6e6, "kWh kW*h кВт·ч"),
    ],
    "energy_per_area": [
        (1e6, "J/mm2 Дж/мм2 N*m/mm2 Н·м/мм2"), (1e4, "J/cm2 Дж/см2 N*m/cm2 Н·м/см2"), (1.0, "J/m2 Дж/м2"),
        (_LBF * _FT / _IN**2, "ft*lbf/in2 ft-lb/in2"), (_LBF / _IN, "in*lbf/in2 in-lb/in2"),
        (KGF * 1e6, "kgf*m/mm2 кгс·м/мм2"), (KGF * 1e4, "kgf*m/cm2 кгс·м/см2"), (1e9, "kJ/mm2"), (1e7, "kJ/cm2"),
    ],
    "torque_per_length": [(1e3, "N*m/mm Н·м/мм"), (1e2, "N*m/cm Н·м/см"), (1.0, "N*m/m Н·м/м"),
                          (KGF * 1e3, "kgf*m/mm кгс·м/мм"), (1e6, "kN*m/mm кН·м/мм"), (_LBF * _FT / _IN, "lbf*ft/in")],
    "angle_per_length": [
        (math.pi / 180 * 1e3, "deg/mm °/mm град/мм °/мм"), (math.pi / 180 * 1e2, "deg/cm °/cm град/см"),
        (1.0, "rad/m рад/м"), (math.pi / 180 / _IN, "deg/in"),
    ],
    "temperature_rise": [(1.0, "K degC"), (5 / 9, "degR degF")],
    "temperature": [(1.0, "K К"), (5 / 9, "degR °R R")],
    "specific_energy": [(1e6, "MJ/kg МДж/кг"), (1e3, "kJ/kg кДж/кг"), (1.0, "J/kg Дж/кг"), (2326.0, "Btu/lb"),
                        (4186.8, "kcal/kg ккал/кг")],
    "mass_moment": [
        (1.0, "kg*m кг·м"), (1e-3, "kg*mm кг·мм"), (1e-5, "g*cm г·см"), (_LB * _FT, "lb*ft"), (_LB * _IN, "lb*in"),
        (_LB / 16 * _IN, "oz*in"),
    ],
    "pressure_rise": [
        (1e6 * 180 / math.pi, "MPa/deg MPa/° МПа/град"), (1e5 * 180 / math.pi, "bar/deg бар/град"),
        (1.0, "Pa/rad Па/рад"), (_LBF / _IN**2 * 180 / math.pi, "psi/deg"),
    ],
    "energy_by_angle": [(180 / math.pi, "J/deg Дж/град J/°"), (1.0, "J/rad Дж/рад"),
                        (_LBF * _FT * 180 / math.pi, "ft*lbf/deg")],
    "pressure_by_velocity": [(1e6, "MPa*s/m МПа*с/м"), (1.0, "Pa*s/m Па*с/м")],
    "pressure_by_square_velocity": [(1.0, "Pa*s2/m2 Па*с2/м2"), (1e3, "kPa*s2/m2 кПа*с2/м2")],
    "pressure_by_length": [
        (1e9, "MPa/mm N/mm2/mm МПа/мм"), (1e8, "bar/mm бар/мм"), (1e7, "bar/cm бар/см"),
        (1e6, "MPa/m kPa/mm kN/m2/mm МПа/м кПа/мм"), (1.0, "Pa/m Па/м"),
        (_LBF / _IN**3, "psi/in"), (KGF * 1e7, "kgf/cm2/mm at/mm кгс/см2/мм"),
    ],
    "heat_transfer": [(1.0, "W/(m2*K) W/m2K Вт/(м2*К)"), (1e3, "kW/(m2*K) кВт/(м2*К)")],
    "specific_heat": [
        (1.0, "J/(kg*K) Дж/(кг*К) J/kg*K J/kgK"), (1e3, "kJ/(kg*K) кДж/(кг*К) kJ/kg*K kJ/kgK"),
        (4186.8, "kcal/(kg*K) Btu/(lb*R) Btu/lb*R ккал/(кг*К)"), (KGF, "kgf*m/(kg*K) кгс·м/(кг*К)"),
        (_FT * KGF * 1.8, "ft*lbf/(lb*R) ft*lbf/lb*R lbf*ft/(lb*R)"),
    ],
    "density": [(1.0, "kg/m3 кг/м3"), (1e3, "g/cm3 г/см3 kg/l kg/L kg/dm3 g/ml g/cc кг/л кг/дм3"),
                (_LB / _FT**3, "lb/ft3"), (_LB / _IN**3, "lb/in3"), (_SLUG / _FT**3, "slug/ft3")],
    "specific_amount": [(1.0, "kmol/kg кмоль/кг")],
    "molar_mass": [(1.0, "kg/kmol кг/кмоль")],
    "molar_energy": [(1.0, "kJ/kmol кДж/кмоль")],
    "molar_heat": [(1.0, "kJ/(kmol*K) кДж/(кмоль*К)")],
    "fuel_consumption": [
        (1 / 3.6e9, "g/(kW*h) g/kWh г/(кВт*ч)"), (1.0, "kg/J кг/Дж"),
        (_LB / (550 * 3600 * _LBF * _FT), "lb/(hp*h) lb/hph lb/hp*h lb/(bhp*h) lb/bhp*h"),
        (1 / 3.6e6, "kg/(kW*h) kg/kWh кг/(кВт*ч)"), (1e-3 / (75 * KGF * 3600), "g/(PS*h) г/(л.с.*ч)"),
    ],
    "mass_rate": [
        (1 / 3600, "kg/h кг/ч"), (1.0, "kg/s кг/с"), (1 / 60, "kg/min кг/мин"), (_LB / 3600, "lb/h"),
        (_LB / 60, "lb/min"), (_LB, "lb/s"), (1e-3, "g/s г/с"), (1 / 3.6, "t/h т/ч"),
    ],
    "volume_rate": [
        (1 / 60, "m3/min м3/мин"), (1.0, "m3/s м3/с"), (1 / 3600, "m3/h м3/ч"), (1e-3, "l/s L/s л/с"),
        (1e-3 / 60, "l/min L/min л/мин"), (_FT**3 / 60, "ft3/min cfm"), (_FT**3, "ft3/s cfs"), (_IN**3, "in3/s"),
        (1e-3 / 3600, "l/h L/h л/ч"), (1e-6, "cm3/s cc/s ml/s см3/с"), (1e-6 / 60, "cm3/min cc/min ml/min см3/мин"),
        (231 * _IN**3 / 60, "gal(US)/min gpm(US)"), (4.54609e-3 / 60, "gal(UK)/min gpm(UK)"),
    ],
    "power_density": [(1e6, "kW/l кВт/л"), (1.0, "W/m3 Вт/м3")],
    "per_temperature": [(1.0, "1/K 1/К")],
    "volume_per_temperature": [(1e-6, "cm3/K см3/К"), (1.0, "m3/K м3/К")],
    "speed_per_temperature": [(1.0, "m/(s*K) м/(с*К)")],
    "power": [
        (1e3, "kW кВт"), (1.0, "W Вт"), (1e6, "MW МВт"), (75 * KGF, "PS л.с. лс mã_lực hp(M) CV cv ch"),
        (550 * _LBF * _FT, "hp(I) bhp"), (_LBF * _FT, "ft*lbf/s"), (KGF, "kgf*m/s кгс·м/с"),
        (1e3 / 60, "kJ/min кДж/мин"), (1e3 / 3600, "kJ/h кДж/ч"), (4186.8 / 3600, "kcal/h ккал/ч"),
        (1055.05585262 / 60, "Btu/min"), (1055.05585262 / 3600, "Btu/h"), (_LBF * _FT / 60, "ft*lbf/min"),
    ],
}  # fmt: skip

UNITS: dict[str, Unit] = {
    name: Unit(dimension, factor)
    for dimension, rows in _SPELLINGS.items()
    for factor, names in rows
    for name in names.split()
} | {
    **{name: Unit("temperature", 1.0, 273.15) for name in ("degC", "°C", "°С")},
    **{name: Unit("temperature", 5 / 9, 459.67 * 5 / 9) for name in ("degF", "°F")},
}

# signs and words that textbooks print otherwise than the table
_SIGNS = str.maketrans("²³¹⁻−⋅∙•×·", "231--*****", "^{}")
_WORDS = {"sec": "s", "сек": "с", "giây": "s", "phút": "min", "lbm": "lb", "lbs": "lb", "inches": "in", "feet": "ft",
          "hr": "h", "hertz": "Hz", "Hertz": "Hz", "герц": "Гц", "Герц": "Гц"}  # fmt: skip


def _plain(name: str) -> str:
    """Return a unit in plain signs: `N·m`, `N.m`, `кг⋅м^2`, `об./мин`, `мин⁻¹` and `m·s⁻²` are the same as others."""
    name = re.sub(r"\s*([/*])\s*", r"\1", name.translate(_SIGNS)).replace(" ", "*")
    # per degree of a scale is per kelvin, or per degree of Rankine
    name = re.sub(r"(?<=[/*])(?:deg|°)([CСFR])", lambda scale: "K" if scale[1] in "CС" else "R", name)
    name = re.sub(r"\.(?=[/*]|\Z)", "", name).replace(".", "*")
    name = re.sub(r"[^\W\d_]+", lambda word: _WORDS.get(word[0], word[0]), name)
    name = re.sub(r"(?:\A|\*)([^\W\d]+)-([123])(?=[*/]|\Z)", lambda part: f"/{part[1]}{part[2].replace('1', '')}", name)
    return f"1{name}" if name.startswith("/") else name


# letters that look alike in both alphabets
TO_LATIN = str.maketrans("АВЕКМНОРСТУХаеокмрсухі", "ABEKMHOPCTYXaeokmpcyxi")
_TO_CYRILLIC = {latin: cyrillic for cyrillic, latin in TO_LATIN.items()}
_PLAIN = {_plain(name): name for name in reversed(UNITS)}


def known_unit(name: str) -> str:
    """Return a unit as the table spells it, empty if it is none.

    Examples
    --------
    >>> known_unit("кг⋅м^2"), known_unit("min⁻¹"), known_unit("furlong")
    ('кг·м²', '1/min', '')
    """
    name = unicodedata.normalize("NFC", name.strip())
    spellings_of_name = (name, name.replace(" ", "_"), name.replace(". ", ".").replace(" ", "_"))
    return next((spelling for spelling in spellings_of_name if spelling in UNITS), "") or next(
        # books join the factors of a product with a hyphen, N-m
        (_PLAIN[plain] for text in (name, name.replace("-", "*")) if (plain := _plain(text)) in _PLAIN),
        "",
    )


_FIRST = {unit: name for name, unit in reversed(UNITS.items())}


def first_spelling(unit: Unit) -> str:
    """Return the first spelling of a unit."""
    return _FIRST[unit]


System = Literal["metric", "si", "imperial"]
# Imperial units by the metric ones that quantities are stated with
_IMPERIAL = {
    "mm": "in", "m": "ft", "cm2": "in2", "mm2": "in2", "cm3": "in3", "l": "in3", "m3": "ft3", "kg": "lb", "g": "oz",
    "g/cm2": "lb/ft2", "kg*m2": "lb*ft2", "kg*m": "lb*ft", "m/s": "ft/s", "m/s2": "ft/s2", "MPa": "psi", "N": "lbf",
    "m/s3": "ft/s3",
    "kPa": "psi", "bar": "psi", "kN": "lbf", "N*m": "lbf*ft", "J": "ft*lbf", "kJ": "Btu", "kW": "hp(I)",
    "W": "ft*lbf/s", "N/m": "lbf/in", "N/mm": "lbf/in", "N*s/m": "lbf*s/in", "N*m*s/rad": "lbf*ft*s/rad",
    "N*m/rad": "lbf*in/rad", "cm4": "in4",
    "kg/m3": "lb/ft3", "kg/m": "lb/ft", "MJ/kg": "Btu/lb", "kJ/kg": "Btu/lb", "g/(kW*h)": "lb/(hp*h)", "kg/h": "lb/h",
    "l/s": "ft3/min",
    "m3/min": "ft3/min", "MPa/deg": "psi/deg", "MPa/mm": "psi/in", "J/deg": "ft*lbf/deg", "degC": "degF",
    "K": "degR", "J/(kg*K)": "Btu/(lb*R)",
}  # fmt: skip


class DisplayUnits(NamedTuple):
    """A system of units, and larger metric units that replace others to keep numbers short."""

    system: System = "metric"
    larger: tuple[tuple[str, str], ...] = ()


METRIC = DisplayUnits()
# the units of tables, figures and notes in this context, as the precision of `decimal`
_DISPLAY_UNITS: ContextVar[DisplayUnits] = ContextVar("shown", default=METRIC)


@contextlib.contextmanager
def use_units(shown: System | DisplayUnits) -> Iterator[None]:
    """Display values in a system of units within this context; a system alone keeps the larger units."""
    token = _DISPLAY_UNITS.set(_DISPLAY_UNITS.get()._replace(system=shown) if isinstance(shown, str) else shown)
    try:
        yield
    finally:
        _DISPLAY_UNITS.reset(token)


def shown_unit(unit: str) -> str:
    """Return the unit of the system in use for what is stated with another.

    Examples
    --------
    >>> with use_units("imperial"):
    ...     shown_unit("MPa")
    'psi'
    """
    system, larger = _DISPLAY_UNITS.get()
    if system == "imperial":
        return _IMPERIAL.get(unit, unit)
    if system == "metric":
        return next((replacement for stated, replacement in larger if stated == unit), unit)
    return unit if unit in _UNCHANGED else coherent_unit(unit)


# angles and temperatures are displayed in degrees in all systems, rotation and mains by what is counted
_UNCHANGED = ("deg", "degC", "rpm", "Hz")

# "ratio" has no unit; the report chooses whether a fraction is shown in per cent.
EXAMPLES = {
    dimension: {"speed": "2300 rpm", "temperature": "293 K", "density": "1000 kg/m3"}.get(
        dimension, f"30 {rows[0][1].split()[0]}"
    )
    for dimension, rows in _SPELLINGS.items()
}

# names of more than one unit, and the messages that ask which is meant
_DOUBTFUL = {"hp": "horsepower", "ton": "ton", "tons": "ton"}
_MAX_LENGTH = 100
# products of smaller numbers have no digits left [SI]
_LEAST = 1e-60
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?"
# a unit that starts with a digit, 1/min, needs a space before it
_UNIT = r"\s*(?P<unit>[^\s\d.,+-].*?|(?<=\s)1/\w+)?\s*\Z"
_QUANTITY = re.compile(rf"\s*(?P<number>{_NUMBER}(?:/[1-9][0-9]*)?){_UNIT}")
_WITH_COMMA = re.compile(rf"\s*(?P<number>[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{{1,3}})?){_UNIT}")
# three digits to a group, and a multiple of pi: `10 000 N/m`, `60π rad/s`, `2π/3 rad`
_GROUPS = re.compile(r"\s*[+-]?\d{1,3}(?:[ \u00a0\u2009\u202f]\d{3})+(?!\d)")
_PI = re.compile(r"\s*([+-]?)(\d+(?:\.\d+)?)?\s*[*·]?\s*(?:π|pi\b)(?:\s*/\s*(\d+))?")
# a weight and what it is the weight of
_WEIGHTS = {"force": "mass", "stiffness": "mass_per_length"}
_BARE = re.compile(rf"{_NUMBER}|[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]{{1,3}})?")


def spellings(dimension: str) -> list[str]:
    """Return the first spelling of every unit of a dimension."""
    return [names.split()[0] for _, names in _SPELLINGS[dimension]]


def parse(
    text: str,
    dimensions: tuple[str, ...],
    *,
    decimal_comma: bool = False,
    metric_hp: bool = False,
    gravity: float = KGF,
) -> ParsedQuantity:
    """Parse a quantity.

    `dimensions`: valid dimensions; the first is used in the advice; a weight is accepted for a mass, also per length;
    `decimal_comma`: read `1,1 kg` as 1.1 kg. Otherwise a comma is an error, because it also separates thousands;
    `metric_hp`: read hp as 735.5 W instead of asking which one is meant; `gravity`: makes a mass of newtons [m/s2].

    Examples
    --------
    >>> parse("75 mm", ("length",)).value, parse("3/4 m", ("length",)).value
    (0.075, 0.75)
    """
    example = EXAMPLES[dimensions[0]]
    text = unicodedata.normalize("NFC", text) if len(text) <= _MAX_LENGTH else text
    plain = _plain_number(text) if len(text) <= _MAX_LENGTH else ""
    match = _WITH_COMMA.match(plain) or _QUANTITY.match(plain)
    if match is None:
        raise ValueError(ErrorMessage("no_quantity", text=_short(text), example=example))
    number, name = match["number"].replace(",", "."), match["unit"]
    spelling = known_unit(name or "") or name or ""
    notice = ""
    if spelling.lower() == "hp" and metric_hp:
        spelling, notice = "PS", "metric_horsepower"
    _ask_which(spelling, dimensions, number, name or "")
    spelling = _of_weight(spelling, dimensions)
    unit = UNITS.get(spelling)
    if unit is not None and _is_also(unit, spelling) in dimensions and unit.dimension not in dimensions:
        # a rise has no zero
        spelling = first_spelling(unit._replace(zero=0.0)) if unit.zero else spelling
        unit = unit._replace(dimension=_is_also(unit, spelling))
    weighed = _WEIGHTS.get(unit.dimension, "") if unit is not None and unit.dimension not in dimensions else ""
    fits = unit is not None and (unit.dimension in dimensions or weighed in dimensions)
    wanted = tuple(_dimension(dimension) for dimension in dimensions)
    known = ", ".join(spelling for dimension in dimensions for spelling in spellings(dimension))
    known += ", °C" * ("temperature" in dimensions[0])
    if "," in match["number"] and not decimal_comma:
        point = f"{number} {name if fits else example.split()[1]}"
        if fits or name is None:
            raise ValueError(ErrorMessage("decimal_comma", text=_short(text), point=point))
        raise ValueError(ErrorMessage("decimal_comma_unit", text=_short(text), wanted=wanted, point=point, known=known))
    if name is None:
        raise ValueError(ErrorMessage("unit_missing", text=_short(text), example=example))
    if unit is None:
        raise ValueError(_unknown_unit(name, number, dimensions, wanted=wanted, known=known))
    if not fits:
        measured = _dimension(unit.dimension)
        raise ValueError(ErrorMessage("unit_other", unit=_short(name), measured=measured, wanted=wanted, known=known))
    above, _, below = number.partition("/")
    value = to_si(float(above) / float(below or 1), spelling)
    if not math.isfinite(value) or 0 < abs(value) < _LEAST:
        size = "too_small" if abs(value) < 1.0 else "too_large"
        raise ValueError(ErrorMessage(size, text=_short(text), example=example))
    return (
        ParsedQuantity(value / (gravity if {"N", "Н"} & {*spelling} else KGF), weighed, spellings(weighed)[0], "weight")
        if weighed
        else ParsedQuantity(value, unit.dimension, spelling, notice)
    )


def _of_weight(spelling: str, dimensions: tuple[str, ...]) -> str:
    """Return a unit, or that with weights in the place of masses, lbf/in of lb/in, where that alone fits."""
    unit = UNITS.get(spelling)
    if unit is not None and {unit.dimension, _is_also(unit, spelling)} & {*dimensions}:
        return spelling
    weight = known_unit(re.sub(r"\bкг(?=\W)", "кгс", re.sub(r"\b(kg(?=\W)|lb|oz)s?\b", r"\1f", spelling)))
    fits = weight and {UNITS[weight].dimension, _is_also(UNITS[weight], weight)} & {*dimensions}
    return weight if fits else spelling


def _is_also(unit: Unit, spelling: str) -> str:
    """Return what else a unit measures, work or torque, or a rise of temperature; empty for most."""
    if unit.dimension == "energy" and re.search("[*-]lb", spelling):
        return "torque"
    if unit.dimension == "temperature":
        return "temperature_rise"
    return "energy" if unit.dimension == "torque" else ""


def _plain_number(text: str) -> str:
    """Return a quantity whose number has neither groups of digits nor a multiple of pi."""
    text = _GROUPS.sub(lambda digits: re.sub(r"\s", "", digits[0]), text, count=1)
    if match := _PI.match(text):
        number = float(match[2] or 1) * math.pi / float(match[3] or 1)
        return f"{match[1]}{number!r}{text[match.end() :]}"
    return text


def _ask_which(spelling: str, dimensions: tuple[str, ...], number: str, name: str) -> None:
    """Raise for a unit of several meanings; those of a speed are radians and revolutions."""
    if spelling.lower() in _DOUBTFUL:
        raise ValueError(ErrorMessage(_DOUBTFUL[spelling.lower()], unit=_short(name), number=number))
    unit = UNITS.get(spelling) or UNITS.get(_other_alphabet(name))
    if unit is not None and unit.dimension == "frequency" and "speed" in dimensions and "frequency" not in dimensions:
        options = (f'"{number} rad/s"', f'"{number} rev/s"')
        raise ValueError(ErrorMessage("speed_per_second", unit=_short(name), options=options))


def _other_alphabet(name: str) -> str:
    """Return the unit that a name is in the letters of one alphabet, empty if it is none."""
    return next((unit for table in (TO_LATIN, _TO_CYRILLIC) if (unit := known_unit(name.translate(table)))), "")


def _is_slip(name: str, unit: str) -> bool:
    """Return whether a name has the powers and as many factors as a unit, and below the stroke the same or no unit."""
    (above, _, below), (of_unit, _, below_unit) = (_plain(text.lower()).partition("/") for text in (name, unit))
    same = [(text.count("*"), re.findall(r"\d", text)) for text in (above, of_unit)]
    return same[0] == same[1] and (below == below_unit or (bool(below and below_unit) and not known_unit(below)))


def _unknown_unit(name: str, number: str, dimensions: tuple[str, ...], **values: object) -> ErrorMessage:
    rows = [names for dimension in dimensions for _, names in _SPELLINGS[dimension]]
    all_spellings = [spelling for names in rows for spelling in names.split()]
    same = [spelling for spelling in all_spellings if spelling.casefold() == name.casefold()]
    near = same if len(name) > 2 or name.isupper() else []
    # one or two letters are close to anything
    near = near or (difflib.get_close_matches(name, all_spellings, n=1) if len(name) > 2 else [])
    # a slip of the pen keeps the letters; what stands behind a unit has a meaning, as in `barg` and `Nmm`
    near = [unit for unit in all_spellings if len(name) > 2 and sorted(unit) == sorted(name)][:1] or [
        unit
        for unit in near
        if _is_slip(name, unit) and ("/" in unit or not re.fullmatch(rf"{re.escape(unit)}[^s]", name))
    ]
    if "temperature" in dimensions[0] and name.translate(TO_LATIN).upper() in {"C", "F"}:
        near = [f"°{name.translate(TO_LATIN).upper()}"]
    # absolute or gauge, as in `psig`, `bar(a)` and `ата`
    counted = known_unit(re.sub(r"\(?[agüаи]\)?\Z", "", name))
    if counted in all_spellings and "pressure" in dimensions:
        return ErrorMessage("unit_counted", unit=_short(name), plain=f"{number} {counted}")
    mixed = _other_alphabet(name)
    if mixed in all_spellings:
        return ErrorMessage("unit_look_alike", unit=_short(name), nearest=f"{number} {mixed}")
    if near:
        return ErrorMessage("unit_unknown_near", unit=_short(name), nearest=f"{number} {near[0]}", **values)
    return ErrorMessage("unit_unknown", unit=_short(name), **values)


def deviation_in_si(quantity: ParsedQuantity, deviation: str) -> float:
    """Return a tolerance or standard deviation in SI, given in the unit of the value or as a percentage of it, `2%`."""
    size = float(deviation.rstrip("%").replace(",", "."))
    if deviation.endswith("%"):
        return abs(quantity.value) * size / 100
    return size * UNITS[quantity.unit].factor if quantity.unit else size


def parse_in(text: str, unit: str, dimension: str = "") -> float:
    """Parse a quantity written by hand: a bare number is in `unit`, and a comma is a decimal mark. [SI]

    `dimension`: what it measures, by default what the unit does.

    Examples
    --------
    >>> parse_in("1,5", "mm"), parse_in("2 cm", "mm")
    (0.0015, 0.02)
    """
    text = text.strip()
    text = f"{text} {unit}" if _BARE.fullmatch(text) else text
    return parse(text, (dimension or UNITS[unit].dimension,), decimal_comma=True)[0]


def to_si(value: Any, unit: str) -> Any:  # noqa: ANN401 - a float or an array, as given
    """Convert a value (or array) in `unit` to SI.

    Small units divide by their integer reciprocal, so that 120 cm3 is the double nearest to 0.00012.
    """
    _, factor, zero = UNITS[unit]
    if zero:
        return value * factor + zero
    inverse = round(1 / factor)
    return value / inverse if inverse > 1 and abs(inverse * factor - 1) < 1e-12 else value * factor


def from_si(value: Any, unit: str) -> Any:  # noqa: ANN401 - a float or an array, as given
    """Convert an SI value (or array) to `unit`; `""` leaves it unchanged."""
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
    # the mains too are held in radians per second
    dimension = {"frequency": "speed"}.get(UNITS[unit].dimension, UNITS[unit].dimension)
    return next((name for name, other in UNITS.items() if other.dimension == dimension and other.factor == 1.0), unit)


def _dimension(dimension: str) -> ErrorMessage:
    return ErrorMessage(f"dimension_{dimension}")


def _short(text: str) -> str:
    text = " ".join(text[:200].split())
    return text if len(text) <= 40 else text[:37] + "..."

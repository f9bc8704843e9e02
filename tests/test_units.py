"""Units as text: what is read, what is refused, and that every refusal says what to write."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
import unicodedata

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from crankwork.quantities import QUANTITIES
from crankwork.units import EXAMPLES, UNITS, System, from_si, parse, spellings, use_units
from each import failing, for_each

DIMENSIONS = tuple(EXAMPLES)


def test_every_spelling_is_read_back_as_the_number_that_was_written() -> None:
    def check(unit: str) -> None:
        dimension, decomposed = UNITS[unit].dimension, unicodedata.normalize("NFD", unit)
        for number in (0.1, 37.5, -2300.0, 1.234567e-5):
            value, measured = parse(f"{number!r} {unit}", (dimension,))[:2]
            assert measured == dimension
            assert from_si(value, unit) == pytest.approx(number, rel=2**-52)
            # accents typed as separate characters are the same unit
            assert parse(f"{number!r} {decomposed}", (dimension,))[:2] == (value, dimension)

    assert failing({unit: unit for unit in UNITS}, check) == {}


@for_each(
    ["text", "dimension", "value"],
    [
        ("1/4 m", "length", 0.25),
        ("-3/8 kg", "mass", -0.375),
        ("90/2 1/min", "speed", 1.5 * math.pi),
        ("1/2 1/s", "frequency", 0.5 * 2 * math.pi),
    ],
)
def test_fractions_are_read(text: str, dimension: str, value: float) -> None:
    assert parse(text, (dimension,)).value == pytest.approx(value, rel=1e-15)


@for_each("dimension", EXAMPLES)
def test_what_is_suggested_for_a_dimension_is_accepted_and_the_first_spelling_of_each_size(dimension: str) -> None:
    assert parse(EXAMPLES[dimension], (dimension,))[1] == dimension
    sizes = [UNITS[name].factor for name in spellings(dimension)]
    # degrees of a rise are those of the scales
    scale = "temperature" if dimension == "temperature_rise" else dimension
    others = {unit.factor for unit in UNITS.values() if unit.dimension == scale and not unit.zero}
    assert len(set(sizes)) == len(sizes) == len(others)


# sizes in SI, written out from the definitions of the units, not from the table
DEFINED = {
    "angle": {"2π/3 rad": 2 * math.pi / 3, "180 °": math.pi, "90 град": math.pi / 2, "60 độ": math.pi / 3},
    "length": {"75 мм": 0.075, "0.5 мкм": 0.5e-6, "1 ft": 0.3048},
    "area": {"2 см²": 2e-4, "2 in2": 2 * 6.4516e-4},
    "volume": {"1.5 л": 1.5e-3, "3 in3": 3 * 16.387064e-6, "1 ft3": 0.028316846592},
    "mass": {"2 lb": 0.90718474, "2 slug": 2 * 14.593902937206364, "3 oz": 3 * 0.028349523125, "1 ton(US)": 907.18474,
             "1 ton(UK)": 1016.0469088, "1 blob": 175.12683524647636, "1 кгс·с²/м": 9.80665,
             "1 lbf·s2/ft": 14.593902937206364},
    "mass_per_area": {"15.87 g/cm2": 158.7},
    "mass_per_length": {"60 кг/м": 60.0, "1 lb/in": 0.45359237 / 0.0254, "1 lb/ft": 0.45359237 / 0.3048},
    "inertia": {"0.2 кг·м²": 0.2, "5 lb*ft2": 5 * 0.45359237 * 0.09290304, "1 slug*ft2": 1.3558179483314004,
                "1 lb-in-sec2": 0.1129848290276167, "3 kg-m2": 3.0},
    "speed": {"60 об/мин": 2 * math.pi, "2300 vòng/phút": 2300 * math.pi / 30, "2300 vg/ph": 2300 * math.pi / 30,
              "60π rad/s": 60 * math.pi, "1 500 об/хв": 50 * math.pi},
    "angular_acceleration": {"2 рад/с²": 2.0},
    "velocity": {"36 км/ч": 10.0, "3 м/с": 3.0, "10 ft/s": 3.048, "60 mph": 26.8224, "60 m/min": 1.0,
                 "60 in/min": 0.0254},
    "acceleration": {"3 мм/с2": 3e-3, "10 ft/s2": 3.048},
    "pressure": {"1 кгс/см2": 98066.5, "1 кг/см2": 98066.5, "1 kg/cm2": 98066.5,
                 "2 МН/м²": 2e6, "120 mm H2O": 1176.798, "1 м вод. ст.": 9806.65,
                 "750 mm Hg": 99991.79056125, "1 psi": 0.45359237 * 9.80665 / 0.0254**2, "1 Mpsi": 6894757293.168361,
                 "1 ksi": 6894757.293168361, "1 N/cm2": 1e4, "76 cm Hg": 101325.0144354,
                 "30 in Hg": 3386.388640341 * 30, "1 ft H2O": 2989.06692, "2 кгс/мм²": 19613300.0},
    "pressure_by_length": {"0.8 bar/cm": 8e6, "100 kN/m2/mm": 1e8, "10 bar/mm": 1e9},
    "force": {"1 000 N": 1000.0, "2 тс": 19613.3, "1 lbf": 0.45359237 * 9.80665, "2 кН": 2000.0,
              # books leave the f of a weight out
              "5 lb": 5 * 0.45359237 * 9.80665, "16 oz": 0.45359237 * 9.80665},
    "stiffness": {"1 lbf/ft": 14.593902937206364, "1 kip/in": 175126.83524647636, "12 lb/in": 12 * 175.12683524647636},
    "torque": {"1 кгс·м": 9.80665, "2 lbf*ft": 2.7116358966628, "1 ft-lb": 1.3558179483314004,
               "1 in-lb": 0.1129848290276167, "5 N-m": 5.0, "7 N-mm": 7e-3, "1 kip-ft": 1355.8179483314004,
               "2 tf*m": 19613.3, "16 oz-in": 0.1129848290276167, "3 lb·ft": 3 * 1.3558179483314004, "2 kg-m": 19.6133},
    "energy": {"2 кДж": 2000.0, "1 Btu": 1055.05585262, "2 кгс·м": 19.6133, "3 N-m": 3.0,
               "1 in-lb": 0.1129848290276167, "1 lbf*ft": 1.3558179483314004, "2 kWh": 7.2e6},
    "specific_heat": {"53.35 ft-lbf/(lb-R)": 53.35 * 0.3048 * 9.80665 * 1.8, "0.24 Btu/lb-R": 1004.832,
                      "287 J/kg K": 287.0, "29.27 kgf·m/(kg·K)": 29.27 * 9.80665,
                      "1.005 kJ/kg·°C": 1005.0, "0.24 Btu/(lbm·°F)": 1004.832,
                      "53.35 lbf·ft/(lbm·°R)": 53.35 * 0.3048 * 9.80665 * 1.8},
    "volume_rate": {"10 gpm(US)": 10 * 3.785411784e-3 / 60, "360 л/ч": 1e-4, "1 in3/s": 16.387064e-6},
    "energy_per_area": {"5 N-m/mm2": 5e6, "900 ft-lb/in2": 900 * 1.3558179483314004 / 6.4516e-4},
    "torque_per_length": {"5 N-m/mm": 5000.0, "1 lbf-ft/in": 1.3558179483314004 / 0.0254},
    "power": {"10 л.с.": 7354.9875, "1 hp(I)": 745.6998715822702, "1 hp(M)": 735.49875,
              "33000 ft-lbf/min": 745.6998715822702, "6 kJ/min": 100.0, "2 кВт": 2000.0, "36 kJ/h": 10.0,
              "3600 kcal/h": 4186.8, "60 Btu/min": 1055.05585262, "3600 Btu/h": 1055.05585262},
    "fuel_consumption": {"0.36 kg/kWh": 1e-7, "1 lb/hp-h": 0.45359237 / 745.6998715822702 / 3600,
                         "180 г/(л.с.·ч)": 0.05e-3 / 735.49875},
    "time": {"2 h": 7200.0}, "damping": {"2 kgf-s/m": 19.6133, "3 lb-sec/in": 525.380505739429, "3 Ns/m": 3.0},
    "angular_damping": {"2 kgf·m·s/rad": 19.6133},
    "torsional_stiffness": {"1 N-m/deg": 180 / math.pi},
    "temperature": {"540 °R": 300.0, "212 degF": 373.15, "-40 °F": 233.15, "540 R": 300.0},
    # of a rise no scale has a zero
    "temperature_rise": {"12 K": 12.0, "12 °C": 12.0, "12 degC": 12.0, "18 °F": 10.0, "18 degF": 10.0, "18 R": 10.0},
    "heat_transfer": {"300 W/(m2·°C)": 300.0},
    "density": {"0.284 lb/in3": 0.284 * 27679.904710203125, "1 slug/ft3": 14.593902937206364 / 0.028316846592},
}  # fmt: skip


@for_each("dimension", DEFINED)
def test_a_unit_has_its_defined_size_in_every_language(dimension: str) -> None:
    found = {text: parse(text, (dimension,))[:2] for text in DEFINED[dimension]}
    assert {text: size for text, (size, _) in found.items()} == pytest.approx(DEFINED[dimension], rel=5e-16)
    assert {measured for _, measured in found.values()} == {dimension}


@for_each("text", ["75mm", "75 mm", "  75   mm  ", "75\u00a0mm", "+75 mm", "75. mm", "7.5e1 mm", "7.5E+1mm"])
def test_spaces_signs_and_exponents_do_not_change_the_number(text: str) -> None:
    assert parse(text, ("length",))[:2] == (0.075, "length")


def test_units_that_begin_with_a_digit_or_are_two_words_are_read() -> None:
    assert parse("2300 1/min", ("speed",))[0] == pytest.approx(2300 * math.pi / 30, rel=1e-15)
    assert parse("5 1/s", ("frequency",))[0] == pytest.approx(10 * math.pi, rel=1e-15)
    assert parse("10 mã lực", ("power",))[0] == pytest.approx(7354.9875, rel=1e-15)


def test_a_quantity_with_two_meanings_takes_either_and_says_which() -> None:
    assert parse("3 kg", ("mass", "mass_per_area"))[:2] == (3.0, "mass")
    assert parse("3 g/cm2", ("mass", "mass_per_area"))[:2] == (30.0, "mass_per_area")


@for_each(
    ("text", "dimension", "fix"),
    [
        ("1,1 kg", "mass", 'write "1.1 kg"'),
        ("1,1 kg", "mass", 'decimal_mark = ","'),
        ("105,8 mn", "length", 'not one of length; write it like "105.8 mm", in one of the units mm, cm, m'),
        ("1,5 kg", "length", 'write it like "1.5 mm", in one of'),
        ("1,5", "length", 'write "1.5 mm"'),
        ("80,5 hp", "power", "745.7 W in others"),
        ("٥ mm", "length", 'write it like "30 mm"'),
        ("9**9**9 mm", "length", "length is wanted: mm"),
        ("nan mm", "length", 'write it like "30 mm"'),
        ("inf mm", "length", 'write it like "30 mm"'),
        ("-inf mm", "length", 'write it like "30 mm"'),
        ("", "length", 'write it like "30 mm"'),
        ("   ", "speed", 'write it like "2300 rpm"'),
        ("mm", "length", 'write it like "30 mm"'),
        ("75", "length", 'has no unit; write it like "30 mm"'),
        ("1e999 mm", "length", 'write a finite number like "30 mm"'),
        ("1e999999 mm", "length", "mm"),
        ("75 furlong", "length", '"furlong" is not a unit known here; length is wanted: mm, cm, m'),
        ("75 kg", "length", '"kg" measures mass; length is wanted: mm'),
        ("75 Mm", "length", '"Mm" is not a unit known here; length is wanted: mm'),
        ("1 mm + 1 m", "length", "length is wanted: mm"),
        ("1_000 mm", "length", "length is wanted: mm"),
        ("0x10 mm", "length", "length is wanted: mm"),
        ("1.234,5 mm", "length", 'write it like "30 mm"'),
        ("1,234,567 mm", "length", 'write it like "30 mm"'),
        ("1,", "length", 'write it like "30 mm"'),
        ("3 kJ", "torque", "measures energy; torque is wanted: N*m"),
        ("3 rad/s", "angular_acceleration", "measures speed; angular acceleration is wanted: rad/s2"),
    ],
)
def test_a_refusal_names_what_is_wrong_and_what_to_write(text: str, dimension: str, fix: str) -> None:
    with pytest.raises(ValueError, match=re.escape(fix)):
        parse(text, (dimension,))


def test_a_refusal_lists_the_units_of_every_dimension_that_would_do() -> None:
    with pytest.raises(ValueError, match="mass or mass per area is wanted") as caught:
        parse("3 m", ("mass", "mass_per_area"))
    assert all(unit in str(caught.value) for unit in (*spellings("mass"), *spellings("mass_per_area")))


@for_each("text", ["1e308 MPa", "-1e308 MPa", "1e306 kgf/cm2"])
def test_a_number_that_overflows_in_si_is_too_large(text: str) -> None:
    with pytest.raises(ValueError, match="too large"):
        parse(text, ("pressure",))


@for_each(("text", "dimension"), [("5 m m", "length"), ("5 k g", "mass"), ("5 M Pa", "pressure")])
def test_a_space_inside_a_unit_symbol_does_not_make_it_another_unit(text: str, dimension: str) -> None:
    """Read as SI writes it, `m m` is a square metre, not a millimetre."""
    with pytest.raises(ValueError, match="is wanted"):
        parse(text, (dimension,))


@for_each(
    ("text", "si"),
    [("1,1 kg", 1.1), ("1.1 kg", 1.1), ("-0,25 kg", -0.25), ("2 kg", 2.0), ("1,5e-1кг", 0.15), (" 1,1  kg ", 1.1)],
)
def test_a_decimal_comma_is_read_where_the_file_says_so(text: str, si: float) -> None:
    assert parse(text, ("mass",), decimal_comma=True)[:2] == (si, "mass")


@for_each("text", ["1,1,1 kg", "1.000,5 kg", ",5 kg", "1, kg", "1 , 1 kg", "1,1"])
def test_a_decimal_comma_does_not_let_malformed_numbers_in(text: str) -> None:
    with pytest.raises(ValueError, match="write it like"):
        parse(text, ("mass",), decimal_comma=True)


# pieces that bring the fuzz close to the grammar
PIECES = st.sampled_from([
    *"0123456789+-.,eE_^*/()²³·°",
    *("1e5", "1e308", "1e-308", "1,1", "nan", "inf", "0x1", " ", "  ", "\n", "\t", "\u00a0", "\u2212"),
    *UNITS,
])  # fmt: skip
TEXTS = st.one_of(st.text(max_size=30), st.lists(PIECES, max_size=6).map("".join))
NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?")


@settings(deadline=None)  # other work on the same machine is no failure
@given(text=TEXTS, dimension=st.sampled_from(DIMENSIONS), comma=st.booleans())
@example(text="1e308 MPa", dimension="pressure", comma=False)
@example(text="1 m m", dimension="length", comma=False)
@example(text="1 mm", dimension="length", comma=False)
def test_any_text_is_a_finite_number_with_a_unit_or_a_value_error(text: str, dimension: str, comma: bool) -> None:
    try:
        value, measured = parse(text, (dimension,), decimal_comma=comma)[:2]
    except ValueError as refusal:
        assert re.search("write|is wanted", str(refusal))  # noqa: PT017 - both outcomes are right, each has its claim
        return
    assert measured == dimension
    assert math.isfinite(value)
    matched = NUMBER.match(text.strip())
    assert matched, "accepted without a number"
    number, unit = matched[0], unicodedata.normalize("NFC", text.strip()[matched.end() :].strip())
    assert comma or "," not in number
    unit = re.sub(r"\s*([/*·.])\s*", r"\1", unit)  # spaces around an operator of the unit are harmless
    marks = {"^": "", "²": "2", "³": "3", "·": "*", ".": "*"}
    candidates = [unit, unit.replace(" ", "_"), unit.replace(" ", "*")]
    candidates += [re.sub(r"[\^²³·.]", lambda mark: marks[mark[0]], one).rstrip("*") for one in candidates]
    known = [UNITS[one] for one in candidates if one in UNITS]
    assert known, f"{unit!r} accepted, but it is no unit of the table"
    assert known[0].dimension == dimension
    assert value == float(number.replace(",", ".")) * known[0].factor


LONG = (
    '"1" * 100_000 + "+"', '"1" * 100_000 + " mm"', '"0." + "1" * 100_000 + "+"', '"1," + "1" * 100_000 + "+"',
    '"1," + "1" * 100_000 + " kg"', '" " * 100_000', '"1" + " " * 100_000 + "+"', '"1 a" + " " * 100_000 + "\\n+"',
    '"1 " + "a " * 50_000 + "\\nb"', '"m" * 100_000',
)  # fmt: skip


def test_a_hundred_kilobytes_are_refused_at_once_and_briefly() -> None:
    """In another process, because a regular expression that backtracks cannot be interrupted everywhere."""
    program = (
        "from crankwork.units import parse\n"
        f"for text in ({', '.join(LONG)}):\n"
        "    try: parse(text, ('length',))\n"
        "    except ValueError as refusal: print(len(str(refusal)))"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", program]
    shown = subprocess.run(command, capture_output=True, text=True, timeout=20, check=True, env=environment)
    lengths = [int(one) for one in shown.stdout.split()]
    assert len(lengths) == len(LONG)
    assert all(0 < one < 400 for one in lengths)


# one of each unit that tables and figures may show, in SI, from its definition
SIZES = {
    "": 1.0, "deg": math.pi / 180, "rad": 1.0, "s": 1.0, "K": 1.0, "1/K": 1.0, "rpm": math.pi / 30, "Hz": 2 * math.pi,
    "rad/s": 1.0, "rad/s2": 1.0, "mm": 1e-3, "m": 1.0, "cm2": 1e-4, "m2": 1.0, "cm3": 1e-6, "l": 1e-3, "m3": 1.0,
    "l/s": 1e-3, "degR": 5 / 9, "Btu/(lb*R)": 4186.8,
    "m/s": 1.0, "m/s2": 1.0, "m/s3": 1.0, "rad/s3": 1.0,
    "km/h": 1 / 3.6, "kg": 1.0, "g": 1e-3, "g/cm2": 10.0, "kg/m2": 1.0, "kg*m2": 1.0, "kg*m": 1.0, "N": 1.0,
    "N*m": 1.0, "MPa": 1e6, "Pa": 1.0, "J": 1.0, "kW": 1e3, "W": 1.0, "N/m": 1.0, "N*s/m": 1.0, "N*m*s/rad": 1.0,
    "N*m/rad": 1.0, "cm4": 1e-8, "m4": 1.0,
    "kg/m3": 1.0, "kg/m": 1.0, "lb/ft": 0.45359237 / 0.3048,
    "MJ/kg": 1e6, "kJ/kg": 1e3, "J/kg": 1.0, "g/(kW*h)": 1e-3 / 3.6e6, "kg/J": 1.0, "kg/h": 1 / 3600,
    "kg/s": 1.0, "kW/l": 1e6, "W/m3": 1.0, "MPa/deg": 1e6 * 180 / math.pi, "Pa/rad": 1.0, "MPa*s/m": 1e6,
    "m3/min": 1 / 60, "m3/s": 1.0, "ft3/min": 4.719474432e-4,
    "Pa*s/m": 1.0, "cm3/K": 1e-6, "m3/K": 1.0, "m/(s*K)": 1.0, "W/(m2*K)": 1.0, "J/(kg*K)": 1.0, "kg/kmol": 1.0,
    "kmol/kg": 1.0, "kJ/(kmol*K)": 1.0, "kJ/kmol": 1.0,
    "mm2": 1e-6, "J/mm2": 1e6, "J/m2": 1.0, "N*m/mm": 1e3, "N*m/m": 1.0,
    "ft": 0.3048, "deg/mm": 1e3 * math.pi / 180, "rad/m": 1.0,
    "in": 0.0254, "in2": 6.4516e-4, "in3": 1.6387064e-5, "ft/s": 0.3048, "ft/s2": 0.3048, "ft/s3": 0.3048,
    "lb": 0.45359237,
    "oz": 0.028349523125, "lb/ft2": 4.882427636383051, "lb*ft2": 0.04214011009380481, "lb*ft": 0.138254954376,
    "lbf": 4.4482216152605, "lbf*ft": 1.3558179483314004, "psi": 6894.757293168361, "ft*lbf": 1.3558179483314004,
    "hp(I)": 745.6998715822702, "ft*lbf/s": 1.3558179483314004, "lbf/in": 175.12683524647636,
    "lbf*s/in": 175.12683524647636, "lbf*ft*s/rad": 1.3558179483314004,
    "lbf*in/rad": 0.1129848290276167, "in4": 4.162314256e-7, "lb/ft3": 16.018463373960138,
    "Btu/lb": 2326.0, "lb/(hp*h)": 1.6896594106715586e-07, "lb/h": 1.2599788055555556e-4,
    "psi/deg": 6894.757293168361 * 180 / math.pi, "J/deg": 180 / math.pi, "MPa/mm": 1e9, "Pa/m": 1.0, "J/rad": 1.0,
    "psi/in": 6894.757293168361 / 0.0254, "Pa*s2/m2": 1.0,
    "ft*lbf/deg": 1.3558179483314004 * 180 / math.pi,
}  # fmt: skip


@for_each("system", ["metric", "si", "imperial"])
def test_every_quantity_is_shown_in_a_unit_of_its_own_kind_and_of_the_right_size(system: System) -> None:
    for quantity in QUANTITIES.values():
        kinds = quantity.metric, quantity.metric_per_area
        with use_units(system):
            shown = quantity.unit, quantity.per_area_unit
        for metric, unit in zip(kinds, shown, strict=True):
            assert from_si(1.0, unit) == pytest.approx(1 / SIZES[unit], rel=1e-15), quantity.key
            assert UNITS.get(unit, UNITS["deg"]).dimension == UNITS.get(metric, UNITS["deg"]).dimension, quantity.key
        if system == "si" and shown[0] not in ("", "deg", "rpm", "Hz"):
            assert SIZES[shown[0]] == 1.0 or "kJ" in shown[0], quantity.key
        assert quantity.unit == quantity.metric


# as textbooks and their typesetters print units, with sizes from the definitions
PRINTED = {
    "speed": {
        **dict.fromkeys(
            ("60 мин⁻¹", "60 об/мин", "60 1/мин", "60 min^-1", "60 min⁻¹", "60 1/min", "60 vòng/phút", "60 min-1",
             "60 мин^-1", "60 об./мин", "60 r/min"), 2 * math.pi),
        **dict.fromkeys(("3 рад/с", "3 рад/сек", "3 rad/giây", "3 rad/sec", "3 rad·s⁻¹"), 3.0),
        **dict.fromkeys(("3 об/с", "3 vòng/giây", "3 rev/s"), 6 * math.pi),
    },
    "inertia": dict.fromkeys(("2 кг·м²", "2 кг·м2", "2 кг∙м^2", "2 кг · м²", "2 kg⋅m²", "2 kg×m2", "2 kg.m²"), 2.0),
    "pressure": {
        **dict.fromkeys(("2 MN/m2", "2 МН/м²", "2 МН/м^2", "2 MN/m²", "2 MN·m⁻²", "2 Н/мм²"), 2e6),
        **dict.fromkeys(("1 kG/cm2", "1 кгс/см^2", "1 kgf/cm²"), 98066.5),
        "3 мм рт. ст.": 3 * 133.322387415,
    },
    "length": {"2 мм": 0.002},
    "force": {"2 кН": 2000.0},
    "torque": dict.fromkeys(("2 Н·м", "2 Н⋅м", "2 Н.м", "2 N.m"), 2.0),
    "acceleration": dict.fromkeys(("2 м/с²", "2 м/с^2", "2 m·s⁻²", "2 м/сек²", "2 м/сек2"), 2.0),
    "power": {"2 л. с.": 1470.9975},
    "frequency": dict.fromkeys(("50 Hz", "50 Гц", "50 1/s", "50 s⁻¹", "50 с⁻¹", "50 1/с"), 100 * math.pi),
}  # fmt: skip


@for_each("dimension", PRINTED)
def test_units_are_read_as_books_print_them(dimension: str) -> None:
    found = {text: parse(text, (dimension,)).value for text in PRINTED[dimension]}
    assert found == pytest.approx(PRINTED[dimension], rel=1e-15)


@for_each("unit", ["1/s", "s-1", "s^-1", "s⁻¹", "с⁻¹", "1/с", "с-1", "Hz", "Гц", "1/сек"])
def test_a_speed_per_second_is_asked_about_with_both_speeds_that_it_may_be(unit: str) -> None:
    for number in ("9.42478", "9,42478"):
        with pytest.raises(ValueError, match="radians or revolutions per second") as refused:
            parse(f"{number} {unit}", ("speed",), decimal_comma=number == "9,42478")
        first, second = re.findall(r'write "(.*)" or "(.*)"', str(refused.value.args[0]))[0]
        assert parse(first, ("speed",)).value == pytest.approx(9.42478, rel=1e-15)
        assert parse(second, ("speed",)).value == pytest.approx(9.42478 * 2 * math.pi, rel=1e-15)
    with pytest.raises(ValueError, match="radians or revolutions per second"):
        parse(f"9,4 {unit}", ("speed",))


def test_a_unit_of_many_meanings_is_asked_about() -> None:
    for text in ("3 ton", "3 tons"):
        with pytest.raises(ValueError, match=r"907\.2") as refused:
            parse(text, ("mass",))
        assert re.findall(r'"(3 \S+)"', str(refused.value.args[0])) == ["3 t", "3 ton(US)", "3 ton(UK)"]
    with pytest.raises(ValueError, match="hp\\(I\\)"):
        parse("80 hp", ("power",))
    old = parse("80 hp", ("power",), metric_hp=True)
    assert (old.value, old.unit, old.notice) == (pytest.approx(80 * 735.49875), "PS", "metric_horsepower")


def test_a_weight_is_a_mass_where_one_is_asked_for() -> None:
    weight = parse("19.6133 N", ("mass",))
    assert (weight.value, weight.unit, weight.notice) == (pytest.approx(2.0, rel=1e-15), "kg", "weight")
    assert parse("5 kgf", ("mass", "mass_per_area")).value == pytest.approx(5.0, rel=1e-15)
    # the gravity of a course sheet: G2 = 30 N and g = 10 m/s2 are 3 kg there
    assert parse("30 N", ("mass",), gravity=10.0).value == pytest.approx(3.0, rel=1e-15)
    assert parse("5 kgf", ("mass",), gravity=10.0).value == pytest.approx(5.0, rel=1e-15)
    assert parse("98.0665 N/m", ("mass", "mass_per_length"))[:3] == (pytest.approx(10.0), "mass_per_length", "kg/m")
    assert parse("98.0665 N/m", ("stiffness",)).notice == ""
    assert parse("5 N", ("force",)).notice == ""
    with pytest.raises(ValueError, match="force"):
        parse("5 N", ("length",))


def test_a_unit_made_of_others_has_their_size() -> None:
    """Quotients and powers against the units that they are written with, kilo-pounds against pounds."""
    raised = {"2": 2, "3": 3, "4": 4, "²": 2, "³": 3, "⁴": 4}

    def size(name: str) -> float | None:
        power = raised.get(name[-1:], 1)
        part = UNITS.get(name[: -1 if power > 1 else None])
        return None if part is None or part.zero else part.factor**power

    wrong, compared = {}, 0
    for name, unit in UNITS.items():
        if name.count("/") != 1 or unit.dimension in ("speed", "angular_acceleration"):
            continue
        above, below = (size(part) for part in name.split("/"))
        if above is not None and below is not None:
            compared += 1
            if not math.isclose(unit.factor, above / below, rel_tol=1e-12):
                wrong[name] = unit.factor, above / below
    assert wrong == {}
    assert compared > 80
    assert UNITS["kip"].factor == pytest.approx(4448.2216152605, rel=1e-13)

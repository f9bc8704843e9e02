"""Natural torsional vibration as textbooks print it, each case from its machine file.

T. Bevan: The Theory of Machines. 3rd ed., Longmans, London 1956. Chapter 15, printed values from the public notebooks
of its examples, github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, file
The_Theory_of_Machines_by_T._Bevan/ch15.ipynb, so secondary to the book. M. I. Friswell, J. E. T. Penny, S. D. Garvey,
A. W. Lees: Dynamics of Rotating Machines. Cambridge 2010, printed values from the tests of
github.com/Aalto-Arotor/openTorsion at commit 88ab7893d24ce9bf6a03725e246d043c6fd9e657. W. T. Thomson: Theory of
Vibration with Applications, ex. 12.4-1. Torsional vibrations, tables 10-2 and 10-3, p. 295 of a book scanned as
uc1.b4353161.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest

from crankwork.analysis import Results
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

HERTZ = 2 * math.pi
PER_MINUTE = math.pi / 30
# Bevan takes g = 32.2 ft/s2 for a pound of mass, whose weight has 32.174
BEVAN = math.sqrt(9.80665 / 0.3048 / 32.2)


class Case(NamedTuple):
    """A machine file, and values and relative tolerances by key in SI."""

    text: str
    values: dict[str, tuple[float, float]]


def frequencies(*printed: float, unit: float = HERTZ, within: float) -> dict[str, tuple[float, float]]:
    """Return natural frequencies by their keys, ascending; `within`: as they are printed."""
    return {f"natural_frequency.{k}": (value * unit, within / value) for k, value in enumerate(printed, start=1)}


def chain(inertias: str, stiffnesses: str) -> str:
    """Return discs in a row: inertias and stiffnesses with blanks between them, units after a slash."""
    (values, unit), (springs, per) = (text.split("/", 1) for text in (inertias, stiffnesses))
    discs = [f'discs.d{k}.inertia = "{value} {unit}"' for k, value in enumerate(values.split())]
    shafts = [
        f'shafts.s{k} = {{ between = ["d{k}", "d{k + 1}"], stiffness = "{value} {per}" }}'
        for k, value in enumerate(springs.split())
    ]
    return "\n".join(["[torsion]", *discs, *shafts])


STEPPED = """
[torsion]
modulus = "12e6 psi"
discs.A.inertia = "1500 lb*ft2"
discs.B.inertia = "1000 lb*ft2"
[torsion.shafts.stepped]
between = ["A", "B"]
parts = [
    { length = "11 in", diameter = "3 in" }, { length = "10 in", diameter = "5 in" },
    { length = "15 in", diameter = "3.5 in" }, { length = "4 in", diameter = "7 in" },
    { length = "10 in", diameter = "5 in" },
]
"""
GEARED = """
[torsion]
modulus = "12e6 psi"
discs = { A.inertia = "1500 lb*in2", B.inertia = "%s lb*in2", C.inertia = "%s lb*in2", D.inertia = "50000 lb*in2" }
shafts.motor = { between = ["A", "B"], length = "39.5 in", diameter = "2.75 in" }
shafts.load = { between = ["C", "D"], length = "25.5 in", diameter = "3.5 in" }
gears.mesh = { between = ["B", "C"], ratio = 0.6 }
"""
LONG_SHAFT = """
[torsion]
modulus = "75 GPa"
discs = { left.inertia = "200 kg*m2", right.inertia = "10 kg*m2" }
[torsion.shafts.string]
between = ["left", "right"]
length = "800 m"
diameter = "0.78 m"
bore = "0.65 m"
density = "8000 kg/m3"
"""

CASES = {
    # ex. 1c: one disc on a shaft that is fixed at its other end; printed 786 per minute
    "bevan 15.1": Case("""
        [torsion]
        modulus = "12e6 psi"
        discs.wheel = { mass = "672 lb", radius_of_gyration = "15 in" }
        shafts.rod = { between = ["ground", "wheel"], length = "36 in", diameter = "3 in" }
    """, frequencies(786, unit=PER_MINUTE, within=0.5)),
    # ex. 2c: a wheel between two clamped shafts; printed 321 per minute, recomputed 320.863
    "bevan 15.2": Case("""
        [torsion]
        modulus = "12e6 psi"
        discs.wheel = { mass = "1120 lb", radius_of_gyration = "20 in" }
        shafts.left = { between = ["ground", "wheel"], length = "36 in", diameter = "2 in" }
        shafts.right = { between = ["wheel", "ground"], length = "24 in", diameter = "2 in" }
    """, {"natural_frequency.1": (320.863450416 * PER_MINUTE * BEVAN, 1e-9)}),
    # ex. 8: printed 23.8 is wrong, since the notebook divides whole numbers, (3/5)**4 = 0, and drops three parts
    "bevan 15.8": Case(STEPPED, {
        "natural_frequency.1": (22.25625 * HERTZ * BEVAN, 1e-6), "equivalent_length.stepped": (21.82357 * 0.0254, 1e-6),
    }),
    # ex. 9: three rotors in tons (of 2240 lb); the two-node frequency is printed as 16 (lc1/lc2)**0.5 = 1784 of 961
    "bevan 15.9": Case("""
        [torsion]
        modulus = "11.8e6 psi"
        discs = { A.inertia = "5600 lb*ft2", B.inertia = "16800 lb*ft2", C.inertia = "6720 lb*ft2" }
        shafts.AB = { between = ["A", "B"], length = "9.5 ft", diameter = "8.5 in" }
        shafts.BC = { between = ["B", "C"], length = "25 ft", diameter = "8.5 in" }
    """, frequencies(961, 1784, unit=PER_MINUTE, within=4.0)),
    # ex. 11: gears with and without inertia; printed 84.8, 83.6 and 347 with g = 32.3
    "bevan 15.11 without": Case(GEARED % ("0", "0"), {
        "natural_frequency.1": (84.6316774598 * HERTZ * BEVAN, 1e-9),
        "equivalent_length": (66.4958046994 * 0.0254, 1e-9),
    }),
    "bevan 15.11 with": Case(GEARED % ("54", "850"), {
        "natural_frequency.1": (83.4143690933 * HERTZ * BEVAN, 1e-9),
        "natural_frequency.2": (346.065440008 * HERTZ * BEVAN, 1e-9),
        # of the rotor behind the gears, 50000 lb in2 at 0.6 of the speed
        "equivalent_inertia.D": (18000 * 0.45359237 * 0.0254**2, 1e-12),
        # from rotor A, printed 3.661 in
        "node_distance.2.motor": (3.661 * 0.0254, 3e-3),
    }),
    "friswell 9.7.1": Case(
        chain("0.0035 0.0035 0.0035 0.15 0.05/kg*m2", "12 12 14 10/kN*m/rad"),
        frequencies(81.207629, 141.214071, 378.952954, 536.363283, within=1e-6),
    ),
    "friswell 9.9, 5 elements": Case(
        f"{LONG_SHAFT}elements = 5", frequencies(1.9416617394, 4.07192090551, 6.54374088618, 9.15472684169, within=1e-9)
    ),
    "friswell 9.9, 8 elements": Case(
        f"{LONG_SHAFT}elements = 8",
        frequencies(1.92254274164, 3.91872741182, 6.06247940141, 8.41847641188, within=1e-9),
    ),
    "friswell 9.9, 50 elements": Case(
        f"{LONG_SHAFT}elements = 50",
        frequencies(1.91064436161, 3.82316164823, 5.73942648968, 7.66131682683, within=1e-9),
    ),
    "friswell 9.9, exact": Case(
        LONG_SHAFT, frequencies(1.91033229362, 3.82066475913, 5.73099756836, 7.64133089303, within=1e-9)
    ),
    "friswell, geared branch": Case("""
        [torsion]
        discs.motor.inertia = "0.0004 kg*m2"
        discs.gear_1.inertia = "2.5e-5 kg*m2"
        discs.gear_2.inertia = "2.5e-5 kg*m2"
        discs.rotor_1.inertia = "0.0007 kg*m2"
        discs.rotor_2.inertia = "0.0007 kg*m2"
        shafts.input = { between = ["motor", "gear_1"], stiffness = "10 kN*m/rad" }
        shafts.first = { between = ["gear_1", "rotor_1"], stiffness = "5 kN*m/rad" }
        shafts.second = { between = ["gear_2", "rotor_2"], stiffness = "5 kN*m/rad" }
        gears.mesh = { between = ["gear_1", "gear_2"], ratio = 1 }
    """, frequencies(425.3595, 634.0728, 3247.1924, within=6e-5)),
    "two inertias": Case(chain("211.4 8.3/kg*m2", "9.775/MN*m/rad"), frequencies(176.0767, within=6e-5)),
    # exact square of the first frequency 1210.54956115; printed remainders give 1210.445 between them
    "holzer 10-3": Case(
        chain("0.25 0.25 0.25 0.25 3.5 50/lbf*in*s2", "1e6 1e6 1e6 1e6 5000/lbf*in/rad"),
        {"natural_frequency.1": (math.sqrt(1210.54956115), 1e-11)}
        | {f"natural_frequency.{k}": (value * PER_MINUTE, 1e-10)
           for k, value in enumerate((332.248224908, 7407.39996392, 19329.9138635, 29344.7505192, 35913.052214), 1)},
    ),
    "thomson 12.4-1": Case(
        chain("5 11 22/kg*m2", "0.1 0.2/MN*m/rad"),
        {"natural_frequency.1": (123.665800083, 1e-11), "natural_frequency.2": (202.65834859, 1e-11)},
    ),
}  # fmt: skip


@for_each("name", CASES)
def test_natural_frequencies_and_lengths_are_those_printed(name):
    case, results = CASES[name], analysed(CASES[name].text)
    for key, (value, relative) in case.values.items():
        assert results[key] == pytest.approx(value, rel=relative), f"{name}: {key}"


def trial(results: Results, frequency: float) -> dict[str, np.ndarray]:
    """Return the rows of a table by Holzer at a trial frequency. [rad/s]"""
    columns = results.listings["holzer_trials"].columns
    rows = np.isclose(columns["angular_frequency"], frequency)
    return {key: column[rows] for key, column in columns.items()}


def test_tables_by_holzer_have_the_rows_of_thomson():
    results = analysed(CASES["thomson 12.4-1"].text + '\ntrials = ["20 rad/s", "40 rad/s"]')
    printed = {20: ((1, 0.98, 0.94844), (2000, 6312, 14658.272)), 40: ((1, 0.92, 0.79904), (8000, 24192, 52318.208))}
    for frequency, (amplitudes, sums) in printed.items():
        table = trial(results, frequency)
        assert table["relative_amplitude"] == pytest.approx(amplitudes, rel=1e-12)
        assert table["holzer_sum"] == pytest.approx(sums, rel=1e-12)


def test_tables_by_holzer_have_the_remainders_of_an_engine_on_a_soft_coupling():
    trials = [f"{math.sqrt(square)!r} rad/s" for square in (1200, 1220)]
    results = analysed(f"{CASES['holzer 10-3'].text}\ntrials = {trials}")
    unit = 0.0254 * 0.45359237 * 9.80665
    # printed 568.51 and -520.04, the second with an amplitude rounded to four digits
    assert results["holzer_remainder.1"] == pytest.approx(568.516845481 * unit, rel=1e-9)
    table = trial(results, math.sqrt(1220))
    assert table["holzer_sum"] == pytest.approx(
        np.array([305.0, 609.906975, 914.627928373, 1219.06992023, 5476.05237763, -517.751523699]) * unit, rel=1e-9
    )
    assert table["relative_amplitude"] == pytest.approx(
        [1.0, 0.999695, 0.999085093025, 0.998170465097, 0.996951395176, -0.0982590803497], rel=1e-9
    )


def test_the_discretisation_of_a_shaft_by_five_elements_is_1_6_per_cent_high():
    coarse, exact = (
        analysed(text)["natural_frequency.1"] for text in (f"{LONG_SHAFT}elements = 5", LONG_SHAFT)
    )  # fmt: skip
    assert coarse / exact - 1 == pytest.approx(1.9417 / 1.91033 - 1, abs=3e-5)

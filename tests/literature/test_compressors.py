"""Compressors and pumps with valves that open by themselves, each from its machine file.

R. K. Rajput: A textbook of internal combustion engines. Laxmi Publications, New Delhi. Chapter 20, Air compressors.
P. K. Nag: Basic and applied thermodynamics. Tata McGraw-Hill, New Delhi. Chapter 19. K. Subramanya: 1000 solved
problems in fluid mechanics. Tata McGraw-Hill, New Delhi 2005. Chapter 16. The printed values were read from the public
notebooks of the books' examples, github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b, files
A_textbook_of_Internal_Combustion_Engines_by_R._K._Rajput/CHAPTER20_3.ipynb,
Basic_And_Applied_Thermodynamics_by_P._K._Nag/Chapter19.ipynb and
1000_solved_Problems_in_Fluid_Mechanics_includes_Hydraulic_machines_by_K.Subramanya/chapter16_3.ipynb, so they are
secondary to the books. Values with more digits than are printed were recalculated from the same numbers.
"""

import math
from typing import NamedTuple

import pytest

import crankwork
from crankwork.analysis import Results
from each import for_each
from machine_texts import analysed

GEAR = """
fixed_points.O = ["0 mm", "0 mm"]
crank = {{ pivot = "O", pin = "A", radius = "{radius!r} mm", speed = "{speed} rpm", start = "180 deg" }}
links.rod = {{ joins = ["A", "B"], length = "10 m" }}
guides.bed = {{ through = "O" }}
sliders.piston = {{ guide = "bed", pin = "B" }}
branch.B = -1
efficiency.chain = {chain}
"""

SIDE = """
[chambers.{name}]
slider = "piston"
bore = "{bore!r} mm"
sense = {sense}
{clearance}
pressures = "absolute"
ambient = "1 bar"
[chambers.{name}.valves]
{valves}
"""


def stage(
    sizes: tuple[float, float],
    clearance: float,
    valves: str,
    speed: float = 300.0,
    chain: tuple[float, ...] = (1.0,),
    sides: tuple[str, ...] = ("head",),
) -> str:
    """Return the file of a cylinder by its bore and stroke [mm], clearance over swept volume, and valves."""
    bore, stroke = sizes
    text = GEAR.format(radius=stroke / 2, speed=speed, chain=list(chain))
    ratio = f"compression_ratio = {1 + 1 / clearance!r}" if clearance else ""
    for name in sides:
        sense = 1 if name == "head" else -1
        text += SIDE.format(name=name, bore=bore, sense=sense, clearance=ratio, valves=valves.replace("; ", "\n"))
    return text


def of_volume(swept: float, ratio: float = 1.0) -> tuple[float, float]:
    """Return bore and stroke [mm] of a swept volume [m3], by the stroke over the bore."""
    bore = 1e3 * (swept / (math.pi / 4 * ratio)) ** (1 / 3)
    return bore, ratio * bore


BOTH = ("head", "crank")


class Case(NamedTuple):
    """A machine file and what is printed of it: value and tolerance by key, in SI."""

    text: str
    printed: dict[str, tuple[float, float]]


CASES = {
    # p. 750; no clearance, 1 m3/min, of which 20.2 finds the bore and the motor behind two efficiencies
    "rajput 20.1": Case(
        stage((141.44, 1.5 * 141.44), 0.0, 'suction = "1.013 bar"; discharge = "7 bar"; compression_exponent = 1.35',
              chain=(0.85, 0.9)),
        {"indicated_power.head": (-4.24e3, 5.0), "inlet_flow.head": (1 / 60, 2e-6), "motor_power": (5.54e3, 5.0)},
    ),
    # p. 751; of 1 kg in a second
    "rajput 20.3": Case(
        stage(of_volume(287 * 293 / 1e5), 0.0, 'suction = "1 bar"; discharge = "10 bar"; compression_exponent = 1.2;'
              ' temperature = "293 K"; gas_constant = "287 J/(kg*K)"', 60.0),
        {"discharge_temperature.head": (430.07, 5e-3), "gas_mass_flow.head": (1.0, 1e-9),
         "indicated_power.head": (-236.03e3, 5.0)},
    ),
    # p. 754; 14 m3/min by two sides, the swept volume is printed as 0.03
    "rajput 20.6": Case(
        stage(of_volume(14 / 600 / (1.05 - 0.05 * (7 / 1.013) ** (1 / 1.3))), 0.05,
              'suction = "1.013 bar"; discharge = "7 bar"; compression_exponent = 1.3; temperature = "288 K"',
              sides=BOTH),
        {"swept_volume.head": (0.03, 5e-3), "discharge_temperature.head": (449.90, 5e-3), "inlet_flow": (14 / 60, 1e-9),
         "indicated_power": (-57.58e3, 5.0)},
    ),
    # p. 756
    "rajput 20.9": Case(
        stage((100.0, 150.0), 0.03, 'suction = "1 bar"; discharge = "6 bar"; compression_exponent = 1.3;'
              ' temperature = "303 K"; gas_constant = "287 J/(kg*K)"', 486.0, (0.85,)),
        {"clearance_volumetric_efficiency.head": (0.9110, 5e-5), "motor_power": (2.27e3, 5.0),
         "gas_mass_flow.head": (0.01, 1e-5)},
    ),
    # p. 759; the only one in which compression and expansion differ
    "rajput 20.13": Case(
        stage((179.78573864, 179.78573864), 0.05, 'suction = "1 bar"; discharge = "7.5 bar"; temperature = "298 K";'
              ' compression_exponent = 1.25; expansion_exponent = 1.3; free_pressure = "1.03 bar";'
              ' free_temperature = "293 K"', 310.0, (0.85,), BOTH),
        {"clearance_volumetric_efficiency.head": (0.814444063901, 1e-12), "free_air_delivery": (2.2 / 60, 1e-11),
         "indicated_power": (-9438.14820093, 1e-6), "motor_power": (11103.7037658, 1e-5)},
    ),
    # p. 819; all digits of the notebook
    "nag 19.3": Case(
        stage(of_volume(2e-3), 0.05, 'suction = "101.3 kPa"; discharge = "810.4 kPa"; compression_exponent = 1.25;'
              ' temperature = "288 K"; gas_constant = "287 J/(kg*K)"', 800.0, (0.85,)),
        {"indicated_power.head": (-5475.65638255, 1e-7),
         "clearance_volumetric_efficiency.head": (0.786098417845, 1e-12),
         "gas_mass_flow.head": (1.54145895718 / 60, 1e-13), "inlet_flow.head": (1.25775746855 / 60, 1e-13),
         "isothermal_efficiency.head": (0.806428056306, 1e-12), "motor_power": (6441.94868535, 1e-7)},
    ),
    # p. 420; the notebook rounds the flow to 0.0053 m3/s; of 15 m of water at 9800 N/m3
    "subramanya 16.38": Case(
        stage((150.0, 300.0), 0.0, 'suction = "50 kPa"; discharge = "197 kPa"; delivered = "310 l/min"', 60.0),
        {"inlet_flow.head": (318.086256176e-3 / 60, 1e-13), "pump_slip.head": (0.0254215830422, 1e-12),
         "discharge_coefficient.head": (0.974578416958, 1e-12), "motor_power": (779.311327631, 1e-8)},
    ),
}  # fmt: skip

PRINTED = [(name, key, *one) for name, case in CASES.items() for key, one in case.printed.items()]


@pytest.fixture(scope="module")
def results() -> dict[str, Results]:
    return {name: analysed(case.text) for name, case in CASES.items()}


@for_each(("name", "key", "value", "tolerance"), PRINTED, ids=[f"{one[0]}: {one[1]}" for one in PRINTED])
def test_a_printed_value(results: dict[str, Results], name: str, key: str, value: float, tolerance: float) -> None:
    assert results[name][key] == pytest.approx(value, abs=tolerance)


@for_each("name", CASES)
def test_the_routes_agree(results: dict[str, Results], name: str) -> None:
    assert not results[name].unmet
    assert max(results[name].checks.values()) < 1e-11


def solved(text: str, equation: str, sought: str, *limits: str) -> Results:
    """Return the results of a file with the number that makes a value what is wanted."""
    description = crankwork.Description(text)
    found = crankwork.solve(description, equation, sought, limits=limits, steps=10)
    (root,) = found.roots
    description[sought] = found.sought.written(root.at)
    return crankwork.analyse(description)


def test_rajput_20_4() -> None:
    """Page 752: the exponent by the temperatures, and the clearance by the mass of air that is delivered."""
    text = stage((140.0, 100.0), 0.0, 'suction = "1 bar"; discharge = "6 bar"; temperature = "293 K";'
                 ' discharge_temperature = "453 K"; gas_constant = "287 J/(kg*K)"', 1200.0, (0.8560364,))  # fmt: skip
    text = text.replace("sense = 1", 'sense = 1\nclearance_volume = "100 cm3"')
    found = solved(text, "gas_mass_flow.head = 1.7 kg/min", "chambers.head.clearance_volume", "1 cm3", "300 cm3")
    assert found["polytropic_exponent.head"] == pytest.approx(1.32132, abs=5e-6)
    assert found["clearance_volumetric_efficiency.head"] == pytest.approx(0.7739, abs=5e-5)
    assert found["indicated_power.head"] == pytest.approx(-5.35e3, abs=5.0)
    assert found["isothermal_efficiency.head"] == pytest.approx(0.7979, abs=5e-5)
    # 85.6 per cent of the shaft's 6.25 kW is indicated
    assert found["motor_power"] == pytest.approx(6.25e3, abs=5.0)
    assert found["isothermal_power.head"] / found["motor_power"] == pytest.approx(0.683, abs=5e-4)


def test_rajput_20_7() -> None:
    """Page 754. The notebook has lost the lines of the volumetric efficiency and prints that of another example."""
    text = stage((300.0, 300.0), 0.05, 'suction = "0.95 bar"; discharge = "7 bar"; compression_exponent = 1.3;'
                 ' temperature = "305 K"; free_pressure = "1.013 bar"; free_temperature = "288 K"')  # fmt: skip
    found = solved(text, "free_air_delivery.head = 14 m3/min", "crank.speed", "100 rpm", "3000 rpm")
    assert found["indicated_power.head"] == pytest.approx(-63508.913769, rel=1e-9)
    assert found["clearance_volumetric_efficiency.head"] == pytest.approx(0.817629438205, rel=1e-12)
    swept = found["swept_volume.head"] * found["speed"] / (2 * math.pi)
    assert found["free_air_delivery.head"] / swept == pytest.approx(0.724041280704, rel=1e-9)
    assert found["discharge_temperature.head"] == pytest.approx(483.574253918, rel=1e-12)


def test_rajput_20_8() -> None:
    """Page 755; a compressor efficiency stands beside the mechanical one."""
    text = stage((291.43, 300.0), 0.04, 'suction = "0.96 bar"; discharge = "6 bar"; compression_exponent = 1.3;'
                 ' temperature = "303 K"; free_pressure = "1 bar"; free_temperature = "288 K"', 500.0, (0.9, 0.85),
                 BOTH)  # fmt: skip
    found = analysed(text)
    assert found["free_air_delivery"] == pytest.approx(16 / 60, rel=5e-5)
    assert found["motor_power"] == pytest.approx(83.65e3, rel=1e-4)


def test_rajput_20_10() -> None:
    """Page 756: a distance piece of 5.5 mm gives clearance to a stroke of 88 cm."""
    flows = []
    for clearance in (0.02, 0.02 + 0.55 / 88):
        text = stage((500.0, 880.0), clearance, 'suction = "1.025 bar"; discharge = "8.2 bar";'
                     ' compression_exponent = 1.3')  # fmt: skip
        flows.append(analysed(text))
    one, other = flows
    assert one["clearance_volumetric_efficiency.head"] == pytest.approx(0.920981897176, rel=1e-11)
    assert other["clearance_volumetric_efficiency.head"] == pytest.approx(0.896288740043, rel=1e-11)
    for key in ("inlet_flow.head", "indicated_power.head"):
        assert 1 - other[key] / one[key] == pytest.approx(0.0268117725314, rel=1e-10)


def test_rajput_20_27() -> None:
    """Page 771: three stages on one piston, cooled to the temperature of the suction between them, and one."""
    pressures = [1.05 * (40 / 1.05) ** (k / 3) for k in range(4)]
    gear = GEAR.format(radius=100.0, speed=60.0, chain=[1.0])
    swept, text = 3.0, gear
    for number in range(3):
        low, high = pressures[number : number + 2]
        area = swept / 0.2 * pressures[0] / low
        valves = f'suction = "{low!r} bar"\ndischarge = "{high!r} bar"\ncompression_exponent = 1.25'
        side = SIDE.format(name=f"stage{number + 1}", bore=1.0, sense=1, clearance="", valves=valves)
        text += side.replace('bore = "1.0 mm"', f'area = "{area!r} m2"')
    found = analysed(text)
    assert -found["indicated_power"] == pytest.approx(1297727.2017, rel=1e-11)
    assert found["isothermal_power"] == pytest.approx(1146628.12633, rel=1e-11)
    assert found["isothermal_efficiency"] == pytest.approx(0.883566380382, rel=1e-11)
    assert found["inlet_flow"] == pytest.approx(swept, rel=1e-12)
    single = gear + SIDE.format(name="all", bore=1.0, sense=1, clearance="", valves=(
        'suction = "1.05 bar"\ndischarge = "40 bar"\ncompression_exponent = 1.25'
    )).replace('bore = "1.0 mm"', f'area = "{swept / 0.2!r} m2"')  # fmt: skip
    alone = -analysed(single)["indicated_power.all"]
    assert alone == pytest.approx(1686780.23364, rel=1e-11)
    assert 1 + found["indicated_power"] / alone == pytest.approx(0.230648322867, rel=1e-10)


def test_a_crank_gear_has_the_valves_of_a_chamber() -> None:
    """The cylinder of P. K. Nag, example 19.3, as a crank gear with its axis beside the shaft."""
    bore, stroke = of_volume(2e-3)
    found = crankwork.analyse(
        crankwork.read_machine(f"""
        crank = {{ stroke = "{stroke!r} mm", speed = "800 rpm" }}
        rod.length = "10 m"
        cylinder = {{ bore = "{bore!r} mm", compression_ratio = 21 }}
        gas.cycle = "360 deg"
        gas.pressures = "absolute"
        gas.ambient = "101.3 kPa"
        gas.valves.suction = "101.3 kPa"
        gas.valves.discharge = "810.4 kPa"
        gas.valves.compression_exponent = 1.25
        gas.valves.temperature = "288 K"
        gas.valves.gas_constant = "287 J/(kg*K)"
    """)
    )
    assert found["indicated_power"] == pytest.approx(-5475.65638255, rel=1e-11)
    assert found["clearance_volumetric_efficiency"] == pytest.approx(0.786098417845, rel=1e-11)
    assert found["gas_mass_flow"] == pytest.approx(1.54145895718 / 60, rel=1e-11)
    assert found["isothermal_efficiency"] == pytest.approx(0.806428056306, rel=1e-11)
    assert not found.unmet


PUMP = """
fixed_points.O = ["0 mm", "0 mm"]
crank = {{ pivot = "O", pin = "C", radius = "{radius} mm", speed = "{speed} rpm"{turning} }}
guides = {{ bore = {{ through = "O" }}, slot = {{ link = "plunger", angle = "90 deg" }} }}
sliders = {{ plunger = {{ guide = "bore" }}, block = {{ pin = "C", guide = "slot" }} }}
[chambers.water]
slider = "plunger"
bore = "{bore} mm"
sense = -1
pressures = "absolute"
ambient = "0 MPa"
[chambers.water.valves]
suction = "{low} Pa"
discharge = "{high} Pa"
density = "1000 kg/m3"
{more}
"""
NARROW = 'suction_pipe = { length = "5 m", diameter = "50 mm" }'
# pressure of a metre of water
METRE = 9810.0


def pump(sizes: tuple[float, float, float], heads: tuple[float, float], more: str, turning: str = "") -> Results:
    """Return the results of a plunger moved as a cosine: its bore and crank radius [mm], speed [rpm], heads [m]."""
    (bore, radius, speed), (low, high) = sizes, [METRE * one for one in heads]
    text = PUMP.format(bore=bore, radius=radius, speed=speed, low=low, high=high, more=more, turning=turning)
    return analysed(text)


@for_each(
    ("sizes", "heads", "pipe", "least", "tolerance"),
    [
        # p. 420: separation in the discharge pipe; the notebook cuts a head of 47.5 m to 47
        ((200.0, 400.0, 24.17), (7.5, 50.0), 'discharge_pipe = { length = "45 m", diameter = "100 mm" }', 3.0, 0.03),
        # p. 421, with all digits of the speed that is printed as 27
        ((150.0, 150.0, 26.9982331852), (7.5, 50.0), NARROW, 2.0, 1e-8),
        # p. 421
        ((200.0, 200.0, 30.0), (10 - 3.476, 50.0), 'suction_pipe = { length = "5 m", diameter = "100 mm" }', 2.5, 5e-4),
        # p. 422: the diameter of the pipe; a head of 0.70 m before the ratio of the areas
        ((250.0, 200.0, 25.0), (7.0, 50.0), 'suction_pipe = { length = "5 m", diameter = "98.6 mm" }', 2.5, 0.02),
    ],
    ids=["16.40", "16.41", "16.42", "16.45"],
)
def test_separation_in_a_pipe(
    sizes: tuple[float, float, float], heads: tuple[float, float], pipe: str, least: float, tolerance: float
) -> None:
    """K. Subramanya: the pressure is least where the plunger turns back."""
    found = pump(sizes, heads, pipe)
    assert found["diagram_pressure_min.water"] / METRE == pytest.approx(least, abs=tolerance)
    # liquid that is sped up is slowed down again
    swept = math.pi / 4 * sizes[0] ** 2 * 2 * sizes[1] * 1e-9
    assert found["indicated_work.water"] == pytest.approx((heads[0] - heads[1]) * METRE * swept, rel=1e-11)


@for_each(("vapour", "told"), [(1.9, False), (2.1, True)])
def test_separation_is_told(vapour: float, told: bool) -> None:
    pipe = f'{NARROW}\nvapour_pressure = "{vapour * METRE} Pa"'
    found = pump((150.0, 150.0, 26.9982331852), (7.5, 50.0), pipe)
    assert [one.code for one in found.notices] == ["separation"] * told


def test_friction_takes_two_thirds_of_its_greatest_head() -> None:
    """K. Subramanya, chapter 16: the work of friction over a stroke, where the plunger moves as a cosine."""
    one = '{ length = "5 m", diameter = "50 mm", friction = 0.03 }'
    found = pump((150.0, 150.0, 30.0), (7.5, 50.0), f"suction_pipe = {one}\ndischarge_pipe = {one}")
    greatest = 0.03 * 5 / 0.05 * 1000 / 2 * ((150 / 50) ** 2 * math.pi * 0.15) ** 2
    swept = math.pi / 4 * 0.15**2 * 0.3
    lost = 42.5 * METRE + 2 * (2 / 3) * greatest
    assert found["indicated_work.water"] == pytest.approx(-lost * swept, rel=1e-11)
    assert not found.unmet


def test_a_pump_that_speeds_up() -> None:
    """Half-way the plunger keeps its speed by itself, and the head is that of the radius times what the shaft gains."""
    found = pump((150.0, 150.0, 20.0), (7.5, 50.0), NARROW, ', angular_acceleration = "2 rad/s2"')
    head = 5 / 9.81 * (150 / 50) ** 2 * 0.15 * 2
    assert found.value("diagram_pressure.water", 90.0) / METRE == pytest.approx(7.5 - head, rel=1e-12)
    assert not found.unmet

"""The calculated cycle keeps its own books: energy, mass, work and the steps it shows."""

from dataclasses import replace

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crankwork import Description, analyse, template
from crankwork.formula.traced_value import FormulaCall, Input, ProcedureValue, TracedValue, in_order
from crankwork.quantities import QUANTITIES, base_key
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import FUELS, CycleError
from crankwork.working_cycle.grinevetsky import grinevetsky
from crankwork.working_cycle.heat_capacities import HeatLaw
from each import for_each

pytestmark = pytest.mark.elsewhere

PETROL = GrinevetskyData("petrol", 8.5, 5600.0, excess_air=0.96, power=60e3, cylinders=4)
LEAN = replace(PETROL, excess_air=1.1)
DIESEL = GrinevetskyData("diesel", 17.0, 2600.0, power=170e3, cylinders=8, pressure_ratio=2.0)
CHARGED = replace(DIESEL, charge_pressure=0.17e6, cooler_drop=20.0)
TWO_STROKE = GrinevetskyData(
    "diesel", 14.0, 2000.0, strokes=2, lost_stroke=0.18, charge_pressure=0.15e6, power=150e3, cylinders=4
)
ALL = {"petrol": PETROL, "lean": LEAN, "diesel": DIESEL, "charged": CHARGED, "two-stroke": TWO_STROKE}
every_engine = for_each("data", ALL.values(), ids=ALL)
every_law = for_each("law", ["kolchin", "vietnamese", "linear"])


@every_engine
@every_law
def test_every_value_is_followed_to_what_was_given(data: GrinevetskyData, law: HeatLaw):
    trace = grinevetsky(replace(data, heat_capacities=law)).trace
    assert all(key == one.key and base_key(key) in QUANTITIES for key, one in trace.items())
    made = list(in_order(trace.values()))
    assert len(made) > 90
    constants = {
        value
        for one in made
        if isinstance(one.node, FormulaCall)
        for name, value in zip(one.node.formula.arguments, one.node.inputs, strict=True)
        if not isinstance(value, TracedValue) and name != "pi"
    }
    assert constants == set()
    found = [one for one in made if isinstance(one.node, ProcedureValue)]
    assert [one.key for one in found] == ["stroke"], "the stroke that gives itself"
    assert found[0].value == pytest.approx(trace["stroke"].value, rel=1e-12)


def test_given_values_stand_where_the_file_states_them():
    leaves = {one.key: one.node.path for one in in_order(grinevetsky(PETROL).trace.values()) if _is_given(one)}
    places = {
        "compression_ratio": "cylinder.compression_ratio", "rotational_speed": "crank.speed",
        "excess_air": "cycle.excess_air", "effective_power": "cycle.power", "cylinder_count": "engine.cylinders",
        "charge_heating": "cycle.heating", "fuel_carbon": "cycle.fuel.carbon",
        "mechanical_loss_slope": "cycle.mechanical_loss[2]",
    }  # fmt: skip
    assert leaves | places == leaves
    assert {key for key, path in leaves.items() if not path} == {
        "cooling_exponent", "cooling_factor", "exhaust_exponent", "heat_zero_temperature", "hydrogen_share",
        "molar_gas_constant", "specific_gas_constant",
    }  # fmt: skip


def _is_given(one: TracedValue) -> bool:
    return isinstance(one.node, Input) and not one.is_absent


LOW = {
    "CO2": (27.941, 0.019, -5.487e-6),
    "CO": (20.597, 0.00267, 0),
    "H2O": (24.953, 0.005359, 0),
    "H2": (20.684, 0.000206, 5.88e-7),
    "N2": (20.398, 0.0025, 0),
    "O2": (20.93, 0.004641, -8.4e-7),
}
HIGH = {
    "CO2": (39.123, 0.003349),
    "CO": (22.49, 0.00143),
    "H2O": (26.67, 0.004438),
    "H2": (19.678, 0.001758),
    "N2": (21.951, 0.001457),
    "O2": (23.723, 0.00155),
}


@every_engine
def test_energy_at_z_is_that_at_c_and_the_heat_of_the_fuel(data: GrinevetskyData):
    """The equation of burning, in 30 digits, species by species, in internal energies counted from 0 degrees."""
    values = grinevetsky(data).values
    species = {name: values.get(f"product_{name.lower()}", 0.0) for name in HIGH}
    with mpmath.workdps(30):
        t_c, t_z = (mpmath.mpf(values[key]) - mpmath.mpf("273.15") for key in _TEMPERATURES)
        residual = values["residual_fraction"] * values["fresh_charge_amount"]
        share = residual / values["product_amount"]
        before = values["fresh_charge_amount"] * (mpmath.mpf("20.6") + mpmath.mpf("0.002638") * t_c) * t_c
        before += share * sum(n * sum(c * t_c**k for k, c in enumerate(LOW[name])) * t_c for name, n in species.items())
        after = (1 + share) * sum(n * (HIGH[name][0] + HIGH[name][1] * t_z) * t_z for name, n in species.items())
        used = mpmath.mpf(values["heat_use"]) * (values["fuel_heating_value"] - values.get("heat_lost_incomplete", 0))
        work = mpmath.mpf(0)
        if data.kind == "diesel":
            # work at constant pressure, p_z (V_z - V_c) = R (M_z T_z - lambda M_c T_c)
            whole = values["fresh_charge_amount"] + residual
            burnt = values["product_amount"] + residual
            temperatures = [values[key] for key in _TEMPERATURES]
            rise = values["pressure_rise_ratio"]
            work = mpmath.mpf("8.315") * (burnt * temperatures[1] - rise * whole * temperatures[0])
        assert float(abs(after + work - before - used / 1000) / after) < 1e-13


@every_engine
@for_each("law", ["vietnamese", "linear"])
def test_energy_at_z_from_absolute_zero(data: GrinevetskyData, law: HeatLaw):
    values = grinevetsky(replace(data, heat_capacities=law)).values
    with mpmath.workdps(30):
        gas = mpmath.mpf("8.315" if data.kind == "diesel" else 0)
        rise = values["pressure_rise_ratio"]
        cold, hot = (mpmath.mpf(values[key]) for key in _TEMPERATURES)
        constant, slope = values["product_heat_constant"], values["product_heat_slope"]
        capacity = values["fresh_charge_heat" if law == "linear" else "mixture_heat"]
        after = values["molar_change"] * (constant + gas + slope * hot) * hot
        before = values["heat_use"] * values["working_mixture_heat"] + (capacity + gas * rise) * cold
        assert float(abs(after - before) / after) < 1e-14


_TEMPERATURES = ("compression_temperature", "combustion_temperature")


@every_engine
def test_charge_and_residual_gas_fill_the_cylinder(data: GrinevetskyData):
    """Ideal-gas mass balance at the end of intake, with unit gas constant and clearance volume."""
    values = grinevetsky(data).values
    ratio = data.compression_ratio
    residual = values["residual_pressure"] / values["residual_temperature"]
    fresh = residual / values["residual_fraction"]
    warm = values["charge_temperature"] + values["charge_heating"]
    assert fresh * warm + residual * values["residual_temperature"] == pytest.approx(
        values["intake_pressure"] * ratio, rel=1e-12
    )
    whole = (fresh + residual) * values["intake_temperature"]
    assert whole == pytest.approx(values["intake_pressure"] * ratio, rel=1e-12)
    swept = (ratio - 1) / (1 - values["lost_stroke"])
    drawn = values["charge_pressure"] / values["charge_temperature"] * swept
    assert values["volumetric_efficiency"] == pytest.approx(fresh / drawn, rel=1e-12)


@every_engine
def test_the_vietnamese_balance_of_the_intake_is_the_other_one_where_the_residual_gas_keeps_its_pressure(
    data: GrinevetskyData,
):
    kept = replace(data, exhaust_exponent=1.0, heat_correction=1.0)
    one, other = (grinevetsky(replace(kept, intake_school=school)).values for school in ("kolchin", "vietnamese"))
    for key, value in one.items():
        assert other[key] == pytest.approx(value, rel=1e-12), key


@every_engine
def test_the_vietnamese_balance_of_the_intake_keeps_charge_and_residual_gas_together(data: GrinevetskyData):
    """What is drawn in, over what the swept volume holds, by volumetric efficiency and by residual gas fraction."""
    values = grinevetsky(replace(data, intake_school="vietnamese", heat_correction=1.15)).values
    residual = data.scavenging * values["residual_pressure"] / values["residual_temperature"]
    swept = (data.compression_ratio - 1) / (1 - values["lost_stroke"])
    drawn = values["volumetric_efficiency"] * values["charge_pressure"] / values["charge_temperature"] * swept
    assert values["residual_fraction"] == pytest.approx(residual / drawn, rel=1e-12)
    other = grinevetsky(data).values["residual_fraction"]
    assert values["residual_fraction"] == pytest.approx(other, rel=0.05)
    assert values["residual_fraction"] != other


@every_engine
def test_states_after_burning_and_expansion_are_those_of_an_ideal_gas(data: GrinevetskyData):
    cycle = grinevetsky(data)
    values, corners = cycle.values, cycle.corners
    at_c = corners.p_c.value / values["compression_temperature"]
    at_z = corners.p_z.value * corners.rho.value / values["combustion_temperature"]
    at_b = corners.p_b.value * corners.epsilon.value / values["expansion_temperature"]
    assert at_z / at_c == pytest.approx(values["molar_change"], rel=1e-12)
    assert at_b == pytest.approx(at_z, rel=1e-12)


@every_engine
@every_law
def test_heat_balance_is_whole_and_its_power_is_the_effective_one(data: GrinevetskyData, law: HeatLaw):
    values = grinevetsky(replace(data, heat_capacities=law)).values
    shares = {key: value for key, value in values.items() if key.startswith("heat_share.")}
    assert len(shares) == 5
    assert sum(shares.values()) == pytest.approx(1.0, abs=1e-13)
    assert shares["heat_share.effective"] == pytest.approx(values["effective_efficiency"], rel=1e-12)


@every_engine
def test_fuel_by_the_charge_is_fuel_by_the_consumption(data: GrinevetskyData):
    """Air drawn in per time over the air of 1 kg of fuel; two ways that share no formula but the efficiency."""
    values = grinevetsky(data).values
    cycles = data.rotational_speed / 60 / (data.strokes / 2)
    air = values["volumetric_efficiency"] * values["charge_density"] * values["displacement"] * cycles
    assert values["fuel_rate"] == pytest.approx(air / values["excess_air"] / values["air_mass_needed"], rel=1e-12)


@given(factor=st.floats(0.2, 5.0))
@settings(max_examples=20)
def test_pressures_scale_and_temperatures_do_not(factor: float):
    base = replace(CHARGED, charge_temperature=330.0, intake_pressure=0.16e6, residual_pressure=0.17e6)
    base = replace(base, power=None)
    pressures = ("ambient_pressure", "charge_pressure", "intake_pressure", "residual_pressure")
    scaled = replace(base, **{name: factor * getattr(base, name) for name in pressures})
    one, other = grinevetsky(base).values, grinevetsky(scaled).values
    for key, value in one.items():
        grows = QUANTITIES[base_key(key)].unit in ("MPa", "kg/m3")
        assert other[key] == pytest.approx(value * (factor if grows else 1), rel=1e-11), key


# --- size


@every_engine
def test_the_engine_that_is_found_gives_the_wanted_power(data: GrinevetskyData):
    values = grinevetsky(data).values
    assert data.power is not None
    assert values["effective_power"] == pytest.approx(data.power, rel=1e-12)
    again = replace(data, power=None, bore=values["bore"], stroke=values["stroke"])
    assert grinevetsky(again).values["effective_power"] == pytest.approx(data.power, rel=1e-12)
    assert values["mean_piston_speed"] == pytest.approx(values["stroke"] * data.rotational_speed / 30, rel=1e-12)


def test_bore_and_stroke_are_rounded_to_millimetres_and_that_is_said():
    cycle = grinevetsky(replace(PETROL, rounds_size=True, stroke_bore_ratio=0.9))
    said = dict(cycle.notices)["cycle_rounded_size"]
    assert said["bore_taken"] == round(said["bore"])
    assert said["stroke_taken"] == round(said["stroke"])
    assert cycle.values["mean_piston_speed"] == said["stroke_taken"] / 1e3 * 5600.0 / 30
    assert cycle.values["effective_power"] != pytest.approx(60e3, rel=1e-6)
    assert cycle.values["effective_power"] == pytest.approx(60e3, rel=0.05)


def test_without_size_the_cycle_ends_with_the_indicated_results():
    values = grinevetsky(replace(PETROL, power=None)).values
    assert "indicated_fuel_consumption" in values
    assert "effective_mean_pressure" not in values


def test_clearance_volume_goes_with_the_whole_stroke():
    values = grinevetsky(TWO_STROKE).values
    clearance, swept = values["clearance_volume"], values["swept_volume"]
    assert (clearance + (1 - 0.18) * swept) / clearance == pytest.approx(14.0, rel=1e-12)


# --- what is said and refused


def test_what_was_not_given_is_said():
    description = Description(template("whole-engine"))
    del description["cycle.heat_use"]
    assumed = {key: item for item in analyse(description).assumptions for key in item.keys if item.code == "taken"}
    # kolchin_demidov_2008, ch. 3 and 5
    assert (assumed["cycle.heat_use"].value, assumed["cycle.filling"].value) == (0.9, 0.96)
    assert "cycle.residual_temperature" not in assumed  # stated
    full = replace(
        PETROL, fuel=FUELS["petrol"], intake_pressure=85e3, residual_pressure=118e3, residual_temperature=1060.0,
        heating=8.0, compression_exponent=1.377, expansion_exponent=1.251, heat_use=0.91, filling=0.96,
    )  # fmt: skip
    assert grinevetsky(full).notices == ()


@for_each(
    ("changes", "code"),
    [
        ({"compression_ratio": 13.0}, "cycle_knock"),
        ({"excess_air": 1.8}, "cycle_flammability"),
        ({"excess_air": 1.8}, "cycle_excess_air"),
        ({"excess_air": 3.5}, "cycle_heat_high"),
        ({"residual_temperature": 1500.0}, "cycle_residual_check"),
        ({"residual_temperature": 1500.0}, "cycle_residual_temperature"),
        ({"compression_exponent": 1.5}, "cycle_compression_exponent"),
        ({"expansion_exponent": 1.4}, "cycle_expansion_exponent"),
        ({"intake_speed": 150.0}, "cycle_volumetric_efficiency"),
        ({"residual_pressure": 0.25e6}, "cycle_residual_fraction"),
        ({"compression_ratio": 60.0, "compression_exponent": 1.5}, "formula_range"),
        ({"charge_pressure": 0.25e6}, "cycle_combustion_pressure"),
    ],
)
def test_what_is_unusual_is_said_and_used(changes, code):
    base = replace(PETROL, power=None)
    assert code not in dict(grinevetsky(base).notices)
    cycle = grinevetsky(replace(base, **changes))
    assert code in dict(cycle.notices)
    for name, value in changes.items():
        assert cycle.values.get(name, value) == value


@for_each(
    ("changes", "words"),
    [
        ({"compression_ratio": 0.5}, "above 1"),
        ({"excess_air": -1.0}, "excess_air"),
        ({"compression_exponent": 1.0}, "exactly 1"),
        ({"lost_stroke": 0.2}, "two-stroke"),
        ({"strokes": 2, "lost_stroke": 1.0}, "below 1"),
        ({"rotational_speed": 90000.0}, "take all"),
        ({"intake_speed": 255.0}, "no fresh charge"),
        ({"heating": -300.0}, "charge of -7 K; correct heating"),
        ({"kind": "diesel", "pressure_ratio": 6.0}, "lower the pressure_ratio"),
    ],
)
def test_data_without_a_cycle_are_refused(changes, words):
    with pytest.raises(CycleError, match=words):
        grinevetsky(replace(PETROL, **changes))

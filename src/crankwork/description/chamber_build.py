"""From the values of a machine file to the chambers of a linkage and the gas that is sealed in them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from crankwork.description.measured_build import (
    build_diagram,
    build_valves,
    check_parts,
    pressures_of,
    with_valves,
)
from crankwork.description.schema import Values, no_effect_message
from crankwork.description.value_types import Reader
from crankwork.loads.chamber import Chamber, Charge, DeadVolume, Face, PressureOfCycle
from crankwork.loads.valves import Valves
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import DrivingSlider
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Mechanism

_OWN_PRESSURE = ("pressure", "points", "pieces", "measured", "valves", "cycle")
_AMOUNTS = ("mean_pressure", "pressure", "mass")


def build_chambers(
    values: Values,
    linkage: Linkage | None,
    mechanism: Mechanism | None,
    reader: Reader,
    pi: float,
    staged: Mapping[str, Valves],
) -> tuple[dict[str, Chamber], dict[str, Charge]]:
    """Return chambers and charges by name; those with mistakes may be left out.

    `staged`: valves of chambers that are told by the stages of a compressor, by name.
    """
    tables = {name: table for name, table in values["chambers"].items() if table is not None}
    sealed = {name: charge for name, charge in values["charges"].items() if charge is not None}
    sliders = {member.name for member in linkage.members if member.guide} if linkage is not None else None
    if linkage is not None and sliders is not None and isinstance(linkage.driver, DrivingSlider):
        sliders.add(linkage.driver.link)
    holder = _holders(sealed, tables, reader)
    for name, charge in sealed.items():
        _check_charge(f"charges.{name}", charge, reader)
    chambers = dict[str, Chamber]()
    pressures: Mapping[str, PressureOfCycle] = {}
    if any("cycle" in table for table in tables.values()):
        from crankwork.description.cycle_build import chamber_cycles  # noqa: PLC0415 - few chambers have one

        tables, pressures = chamber_cycles(tables, mechanism, values, reader, pi)
    for name, table in tables.items():
        path = f"chambers.{name}"
        faces = tuple(_faces(path, table, sliders, reader))
        if name in staged:
            _check_staged(path, table, reader)
        else:
            _check_pressure(path, table, sealed.get(holder.get(name, "")), reader)
        diagram, valves = build_diagram(table, path, reader), staged.get(name) or build_valves(table, path, reader)
        if not faces or any(problem.key.startswith(path) for problem in reader.problems):
            continue
        if valves is not None:
            volumes = (table.si("clearance_volume"), table["compression_ratio"])
            diagram = with_valves(diagram, valves, has_clearance=any(volumes))
        is_absolute = pressures_of(table, diagram.measured) == "absolute" or name in holder or "cycle" in table
        is_absolute |= name in staged
        counted = table.but(pressures="absolute") if is_absolute else table
        chambers[name] = table.made(
            Chamber,
            faces=faces,
            ambient=counted.si("ambient") or 0.0,
            names_ambient="ambient" in table or not is_absolute,
            cycle=float(table["period"].split()[0]),
            delay=table.degrees("delay") or 0.0,
            factor=table["pressure_factor"],
            valves=valves,
            calculated=pressures.get(name),
            **diagram._asdict(),
        )
    return chambers, {} if reader.problems else {name: _charge(charge) for name, charge in sealed.items()}


def _faces(path: str, chamber: Values, sliders: set[str] | None, reader: Reader) -> Iterator[Face]:
    """Yield the faces of a chamber; report invalid faces."""
    listed = chamber["faces"]
    written = listed or [chamber]
    taken: set[str] = set()
    for number, face in enumerate(written, start=1):
        place = f"{path}.faces[{number}]" if listed else path
        if face is None or reader.has_errors(place):
            continue
        slider, bore, rod = face["slider"] or "", face.si("bore"), face.si("rod_diameter") or 0.0
        if not slider and not reader.has_errors(f"{place}.slider"):
            reader.add_error(f"{place}.slider", ErrorMessage("face_slider"))
        elif slider and sliders is not None and slider not in sliders:
            reader.add_error(
                f"{place}.slider", ErrorMessage("absent_slider", name=slider, known=", ".join(sorted(sliders)))
            )
        elif slider in taken:
            reader.add_error(f"{place}.slider", ErrorMessage("face_twice", slider=slider))
        if bore is None and "area" not in face and not reader.has_errors(f"{place}.bore", f"{place}.area"):
            reader.add_error(f"{place}.bore", ErrorMessage("face_area"))
        if rod and not rod < (bore or 0.0) and not reader.has_errors(f"{place}.bore"):
            reader.add_error(f"{place}.rod_diameter", ErrorMessage("face_rod"))
        taken.add(slider)
        yield Face(slider, bore, rod, face.si("area"), -1 if face["sense"] == -1 else 1)


def _check_staged(path: str, chamber: Values, reader: Reader) -> None:
    """Report a pressure of its own of a chamber that a stage gives its pressures."""
    for key in (*_OWN_PRESSURE, "pressures", "period"):
        if key in chamber and (key, chamber[key]) not in (("pressures", "absolute"), ("period", "360 deg")):
            reader.add_error(f"{path}.{key}", ErrorMessage("chamber_staged"))


def _check_pressure(path: str, chamber: Values, charge: Values | None, reader: Reader) -> None:
    """Report a chamber without a pressure or with several, and keys of another kind of pressure."""
    own = [key for key in _OWN_PRESSURE if key in chamber]
    if charge is not None:
        for key in (*own, "pressures", "period", "delay", "pressure_factor"):
            if key in chamber:
                reader.add_error(f"{path}.{key}", ErrorMessage("chamber_sealed"))
    else:
        if (
            chamber["pressures"] != "absolute"
            and "ambient" in chamber
            and "cycle" not in own
            and not reader.has_errors(f"{path}.pressures")
        ):
            reader.add_error(f"{path}.ambient", no_effect_message("pressures", "gauge", ("absolute",)))
        if not own and not reader.has_errors(*(f"{path}.{key}" for key in _OWN_PRESSURE), "charges"):
            reader.add_error(path, ErrorMessage("chamber_pressure", path=path))
        elif own and {"pressure", "cycle"}.isdisjoint(own):
            check_parts(chamber, path, reader)
        if "delay" in chamber and "pressure" in own:
            reader.add_error(f"{path}.delay", ErrorMessage("delay_constant"))
    if "temperature" in chamber and (charge is None or "exponent" in charge):
        reader.add_error(f"{path}.temperature", ErrorMessage("temperature_unused"))
    elif charge is not None and "exponent" not in charge and "temperature" not in chamber:
        _miss(path, "temperature", reader)


def _miss(path: str, key: str, reader: Reader) -> None:
    if not reader.has_errors(f"{path}.{key}"):
        reader.add_error(f"{path}.{key}", ErrorMessage(f"charge_{key}"))


def _holders(sealed: Mapping[str, Values], chambers: Mapping[str, Values], reader: Reader) -> dict[str, str]:
    """Return the charge of each chamber; report unknown names, and chambers of two charges."""
    holder: dict[str, str] = {}
    for charge, table in sealed.items():
        for number, name in enumerate(table["chambers"], start=1):
            place = f"charges.{charge}.chambers[{number}]"
            if name is not None and name not in chambers and not reader.has_errors(f"chambers.{name}"):
                reader.add_error(
                    place, ErrorMessage("absent_chamber", name=name, known=", ".join(sorted(chambers)) or "–")
                )
            elif name in holder:
                reader.add_error(place, ErrorMessage("chamber_twice", name=name))
            elif name is not None:
                holder[name] = charge
    return holder


def _check_charge(path: str, charge: Values, reader: Reader) -> None:
    """Report missing and superfluous keys of the state of a charge."""
    amounts = [key for key in _AMOUNTS if key in charge]
    if not amounts and not reader.has_errors(*(f"{path}.{key}" for key in _AMOUNTS)):
        reader.add_error(path, ErrorMessage("charge_amount"))
    parts = [(f"{path}.dead_volumes[{k}]", volume) for k, volume in enumerate(charge["dead_volumes"], start=1)]
    if "exponent" in charge:
        unused = [f"{path}.{key}" for key in ("gas_constant", "mass") if key in charge]
        unused += [f"{place}.temperature" for place, volume in parts if volume and "temperature" in volume]
        for place in unused:
            reader.add_error(place, ErrorMessage("charge_polytrope"))
        return
    if "gas_constant" not in charge:
        _miss(path, "gas_constant", reader)
    for place, volume in parts:
        if volume and "temperature" not in volume:
            _miss(place, "temperature", reader)


def _charge(values: Values) -> Charge:
    return values.made(
        Charge,
        chambers=tuple(values["chambers"]),
        dead_volumes=tuple(volume.made(DeadVolume) for volume in values["dead_volumes"] if volume),
        angle=math.degrees(values.si("angle") or 0.0),
    )

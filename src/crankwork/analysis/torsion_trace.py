"""The numbers of a torsional system, traced: inertias of discs, stiffnesses of shafts, ratios of gears."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from crankwork.formula.traced_value import TracedValue, absent, given, total
from crankwork.shaft.torsion_formulas import (
    THROW_FORMULAS,
    equivalent_length,
    inertia_at_first_speed,
    inertia_of_disc,
    inertia_of_shaft,
    length_at_first_speed,
    polar_moment,
    stiffness_of_length,
)
from crankwork.shaft.torsion_model import ElasticShaft, ShaftPart, TorsionModel, structure_of, walked
from crankwork.shaft.torsional_system import TorsionalStructure

_PATH = "torsion"


@dataclass(frozen=True)
class TorsionTrace:
    """A torsional system with its traced numbers: discs and rings by name, shafts and springs, gears."""

    model: TorsionModel
    structure: TorsionalStructure
    names: tuple[str, ...]  # Of discs, rings last
    inertia: Mapping[str, TracedValue]
    stiffness: Mapping[str, TracedValue]  # Of shafts and of springs of dampers
    ratio: Mapping[str, TracedValue]  # Of gears
    own_inertia: Mapping[str, TracedValue]  # Of shafts whose mass counts
    lengths: Mapping[str, TracedValue]  # Equivalent lengths of shafts
    values: Mapping[str, TracedValue]  # By key
    geared: Mapping[str, TracedValue]  # Speed of discs over that of the first one, where they differ

    @property
    def elastic(self) -> tuple[TracedValue, ...]:
        """The numbers of the system without what only dampers hold."""
        kept = self.names[: len(self.names) - self.structure.rings]
        return (*(self.inertia[name] for name in kept), *self.stiffness.values(), *self.ratio.values(),
                *self.own_inertia.values())  # fmt: skip


def torsion_trace(
    model: TorsionModel, own: Mapping[str, TracedValue], pi: float, radius: TracedValue | None = None
) -> TorsionTrace:
    """Return the traced numbers of a system; `own`: inertias of throws, `radius`: of the crank, of the machine."""
    names, values = walked(model), dict[str, TracedValue]()
    inertia = {name: _inertia(model, name, own).named(f"disc_inertia.{name}") for name in names}
    ratio = {name: _ratio(model, name) for name in model.gears}
    geared = _speed_ratios(model, names, ratio)
    reference = _reference(model, pi)
    stiffness, lengths, heavy = dict[str, TracedValue](), dict[str, TracedValue](), dict[str, TracedValue]()
    for name, shaft in model.shafts.items():
        stiffness[name], length = _stiffness(model, shaft, f"torsional_stiffness.{name}", reference, (pi, radius))
        if length is not None:
            first = next(end for end in shaft.between if end in inertia)
            reduced = length_at_first_speed(length.named(f"equivalent_length.{name}.own"), geared[first]) if (
                first in geared) else length  # fmt: skip
            lengths[name] = reduced.named(f"equivalent_length.{name}")
        if shaft.density is not None:
            density = given("shaft_density", shaft.density, f"{shaft.path}.density")
            part, moment = shaft.parts[0], _moment(shaft.path, shaft.parts[0], pi)
            heavy[name] = inertia_of_shaft(density, moment, _length(shaft.path, part)).named(f"shaft_inertia.{name}")
    for name, damper in model.dampers.items():
        if damper.stiffness:
            stiffness[name] = given(
                f"torsional_stiffness.{name}", damper.stiffness, f"{_PATH}.dampers.{name}.stiffness"
            )
    values |= {item.key: item for item in (*inertia.values(), *stiffness.values(), *lengths.values(), *heavy.values())}
    for name, u in geared.items():
        values[u.key] = u
        values[f"equivalent_inertia.{name}"] = inertia_at_first_speed(inertia[name], u).named(
            f"equivalent_inertia.{name}"
        )
    if len(lengths) == len(model.shafts) > 1 and structure_of(model).is_tree:
        values["equivalent_length"] = total("equivalent_length", lengths.values())
    return TorsionTrace(model, structure_of(model), names, inertia, stiffness, ratio, heavy, lengths, values, geared)


def _inertia(model: TorsionModel, name: str, own: Mapping[str, TracedValue]) -> TracedValue:
    """Return the moment of inertia of a disc, of the ring of a damper, or of a throw."""
    if name in model.dampers:
        return given("disc_inertia", model.dampers[name].inertia, f"{_PATH}.dampers.{name}.inertia")
    if name in model.throws:
        parts = [own[name]] if name in own else []
        if model.throw_inertia or not parts:
            parts.append(given("disc_inertia", model.throw_inertia, f"{_PATH}.throw_inertia"))
        return total("disc_inertia", parts)
    disc, path = model.discs[name], f"{_PATH}.discs.{name}"
    if disc.inertia is not None:
        return given("disc_inertia", disc.inertia, f"{path}.inertia")
    mass = given("disc_mass", disc.mass or 0.0, f"{path}.mass")
    radius = given("disc_gyration_radius", disc.radius_of_gyration or 0.0, f"{path}.radius_of_gyration")
    inertia: TracedValue = inertia_of_disc(mass, radius)
    return inertia


def _ratio(model: TorsionModel, name: str) -> TracedValue:
    gear, path = model.gears[name], f"{_PATH}.gears.{name}"
    if gear.teeth is None:
        return given(f"speed_ratio.{name}", gear.ratio, f"{path}.ratio")
    first, second = (given("teeth", count, f"{path}.teeth[{place}]") for place, count in enumerate(gear.teeth, start=1))
    return (first / second).named(f"speed_ratio.{name}")


def _speed_ratios(
    model: TorsionModel, names: tuple[str, ...], ratio: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the speed of every disc that turns at another speed than the first one, over that speed."""
    if not model.gears:
        return {}
    known: dict[str, TracedValue | None] = {names[0]: None}
    links: list[tuple[tuple[str, str], str]] = [(shaft.between, "") for shaft in model.shafts.values()]
    links += [(gear.between, name) for name, gear in model.gears.items()]
    for _ in links:
        for (first, second), gear in links:
            for disc, other in ((first, second), (second, first)):
                if disc not in known or other in known or other not in names:
                    continue
                value = known[disc]
                if gear:
                    factor = ratio[gear] if disc == first else 1.0 / ratio[gear]
                    value = factor if value is None else value * factor
                known[other] = None if value is None else value.named(f"speed_ratio.{other}")
    return {name: value for name, value in known.items() if value is not None}


def _reference(model: TorsionModel, pi: float) -> TracedValue | None:
    """Return the polar moment of the shaft that equivalent lengths are of: stated, or the first section."""
    diameter = model.reference_diameter
    if diameter is not None:
        moment = _solid(pi, given("reference_diameter", diameter, f"{_PATH}.reference_diameter"))
        return moment.named("polar_moment.reference")
    first = next((shaft for shaft in model.shafts.values() if shaft.parts), None)
    return None if first is None else _moment(_part_path(first, 0), first.parts[0], pi).named("polar_moment.reference")


def _part_path(shaft: ElasticShaft, index: int) -> str:
    return shaft.path if len(shaft.parts) == 1 and shaft.diameter is not None else f"{shaft.path}.parts[{index + 1}]"


def _length(path: str, part: ShaftPart) -> TracedValue:
    return given("shaft_length", part.length, f"{path}.length")


def section(path: str, diameter: float, bore: float) -> tuple[TracedValue, TracedValue]:
    """Return outer diameter and bore of a section."""
    inner = given("shaft_bore", bore, f"{path}.bore") if bore else absent("shaft_bore")
    return given("shaft_diameter", diameter, f"{path}.diameter"), inner


def _solid(pi: float, diameter: TracedValue) -> TracedValue:
    moment: TracedValue = polar_moment(pi, diameter, absent("shaft_bore"))
    return moment


def _moment(path: str, part: ShaftPart, pi: float) -> TracedValue:
    moment: TracedValue = polar_moment(pi, *section(path, part.diameter, part.bore))
    return moment


def _stiffness(
    model: TorsionModel,
    shaft: ElasticShaft,
    key: str,
    reference: TracedValue | None,
    inputs: tuple[float, TracedValue | None],
) -> tuple[TracedValue, TracedValue | None]:
    """Return the stiffness of a shaft, and its equivalent length where its sizes are known; `inputs`: pi and radius."""
    (pi, radius), path, name = inputs, shaft.path, key.partition(".")[2]
    if shaft.stiffness is not None:
        return given(key, shaft.stiffness, f"{path}.stiffness"), None
    own = shaft.modulus is not None
    modulus = given("shear_modulus", shaft.modulus or model.modulus, f"{path}.modulus" if own else f"{_PATH}.modulus")
    if shaft.throw is not None:
        sizes = {item: _throw_size(shaft, item, radius) for item in _SIZES}
        length = THROW_FORMULAS[shaft.throw.formula](*sizes.values()).named(f"equivalent_length.{name}")
        moment = _solid(pi, sizes["journal_diameter"]).named(f"polar_moment.{name}")
        return stiffness_of_length(modulus, moment, length).named(key), length
    if reference is None:
        raise TypeError("a shaft without a stiffness has sections")
    lengths = []
    for index, part in enumerate(shaft.parts):
        place, number = _part_path(shaft, index), f"{name}.{index + 1}"
        moment = _moment(place, part, pi).named(f"polar_moment.{number}")
        lengths.append(equivalent_length(_length(place, part), reference, moment).named(f"equivalent_length.{number}"))
    length = total(f"equivalent_length.{name}", lengths)
    return stiffness_of_length(modulus, reference, length).named(key), length


_SIZES = ("journal_length", "journal_diameter", "journal_bore", "pin_length", "pin_diameter", "pin_bore", "radius",
          "web_thickness", "web_width")  # fmt: skip


def _throw_size(shaft: ElasticShaft, name: str, radius: TracedValue | None) -> TracedValue:
    value = getattr(shaft.throw, name)
    if name == "radius":
        return (
            radius
            if value is None and radius is not None
            else given("crank_radius", value, f"{shaft.path}.throw.radius")
        )
    return given(name, value, f"{shaft.path}.throw.{name}") if value else absent(name)

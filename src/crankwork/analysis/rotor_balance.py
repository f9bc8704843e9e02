"""Masses in planes of a shaft: the table of books, the masses that balance them, and what is left of pistons."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Iterable, Mapping

import numpy as np

from crankwork.analysis.harmonics import direction
from crankwork.analysis.results import Listing, Results
from crankwork.cylinders import planes
from crankwork.cylinders.counterweights import counterweight_moment
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.cylinders.planes import Arrangement, PlaneMass, Rotor, arrangements
from crankwork.dynamics.reaction import shaking_force
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import AngleFunction, ProcedureValue, TracedAngle, TracedValue, absent, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.preparation.prepared import Notice, PreparedMachine

Vector = tuple[TracedValue, TracedValue]
_COLUMNS = ("unbalanced_force_along", "unbalanced_force_across", "unbalanced_force", "unbalanced_couple")
_ROWS = ("plane_mass", "plane_radius", "plane_moment", "plane_arm", "plane_couple", "plane_angle")
_ROLLING = {"train_speed": "rotor.locomotive.speed", "wheel_diameter": "rotor.locomotive.wheel_diameter"}
_SECTOR = ("density", "width", "outer_radius", "inner_radius", "count")
_NOISE = 1e-11


def analyse_rotor(machine: Machine, rotor: Rotor, grid: CrankGrid | None = None) -> Results:
    """Return what masses on a shaft leave unbalanced, and the masses that balance them (khurmi_gupta_2005, ch. 21)."""
    grid = grid or CrankGrid.steps(machine.table_step, 360.0, special=machine.table_special)
    w, ways = traced_inputs.speed(machine, machine.method), arrangements(rotor)
    if _ROLLING["train_speed"] in machine.stated:
        v, wheel = (given(key, machine.stated[path].value, path) for key, path in _ROLLING.items())
        w = traced_inputs.checked(v / (wheel / 2), w.named("speed"))
    shaft = _Shaft(machine, rotor, ways[rotor.arrangement - 1], w)
    columns = {"crank_angle": TracedValue(AngleFunction("angle"), "crank_angle"), **shaft.columns}
    notice = Notice("rotor_ways", {"count": float(len(ways)), "number": float(rotor.arrangement)})
    return Results(
        PreparedMachine(machine, machine.method, w.value),
        grid,
        Program(columns)(grid),
        {key: value.value for key, value in shaft.summary.items()},
        shaft.checks(),
        (notice,) if len(ways) > 1 else (),
        {"rotor": _COLUMNS},
        {"planes": shaft.listing()},
        trace={**shaft.trace, **columns, **shaft.summary},
    )


class _Shaft:
    """The masses of a shaft, traced: everything by key, columns, and single values."""

    def __init__(self, machine: Machine, rotor: Rotor, state: Arrangement, w: TracedValue) -> None:
        self.machine, self.rotor, self.state, self.w = machine, rotor, state, w
        self.trace, self.columns, self.summary = (dict[str, TracedValue]() for _ in range(3))
        stated = given("balanced_share", rotor.share, "rotor.reciprocating_share")
        axles = given("coupled_axles", float(rotor.coupled), "rotor.locomotive.coupled")
        self.whole = stated if rotor.share else absent("balanced_share")
        self.share = (stated / axles).named("balanced_share.axle") if rotor.coupled > 1 else self.whole
        for index, mass in enumerate(rotor.masses):
            for key in ("mass", "radius", "moment", "angle", "position", "reciprocating"):
                if (stated := getattr(mass, key)) or (stated is not None and key != "reciprocating"):
                    path = f"rotor.masses[{index + 1}].{key}"
                    self._keep(f"plane_{key}.{mass.name}", given(f"plane_{key}.{mass.name}", stated, path))
        self.reference = absent("plane_position")
        if rotor.balancing and not rotor.is_flat:
            self.reference = self._of("position", rotor.balancing[0])
        self._find()
        if not rotor.balancing and not rotor.is_flat:
            self.reference = self._middle()
        for name in () if rotor.is_flat else self._names():
            self._keep(f"plane_couple.{name}", self._arm(name, self.reference) * self.trace[f"plane_moment.{name}"])
        if rotor.has_speed:
            self.summary["speed"] = w
        self._left()

    def _keep(self, key: str, value: TracedValue) -> TracedValue:
        self.trace[key] = value.named(key)
        return self.trace[key]

    def _names(self, without: Iterable[int] = ()) -> list[str]:
        return [mass.name for index, mass in enumerate(self.rotor.masses) if index not in without]

    def _of(self, kind: str, index: int) -> TracedValue:
        return self.trace[f"plane_{kind}.{self.rotor.masses[index].name}"]

    def _middle(self) -> TracedValue:
        """Return the position from which couples count: stated, or midway between the outermost planes."""
        if self.rotor.reference is not None:
            return given("plane_position.reference", self.rotor.reference, "rotor.reference")
        ends = [self._of("position", int(find(self.state.places))) for find in (np.argmin, np.argmax)]
        return ((ends[0] + ends[1]) / 2).named("plane_position.reference")

    def _find(self) -> None:
        """Keep the moments of all masses, those which are wanted last, with what follows from these."""
        rotor, wanted, operands = self.rotor, self.rotor.balancing, list(self.trace.values())
        for word, index in () if wanted else rotor.wanted:
            value = {"size": self.state.sizes, "angle": self.state.angles, "position": self.state.places}[word][index]
            key = f"plane_{'moment' if word == 'size' else word}.{rotor.masses[index].name}"
            self._keep(key, TracedValue(ProcedureValue(float(value), "closed_polygon", operands)))
            self.summary[key] = self.trace[key]
        for index, mass in enumerate(rotor.masses):
            if index not in wanted and f"plane_moment.{mass.name}" not in self.trace:
                self._keep(f"plane_moment.{mass.name}", self._moment(mass))
        if wanted:
            known = {name: self._vector(name) for name in self._names(wanted)}
            for name, (x, y) in self._opposed(known, "plane_moment", self._planes_of(wanted)).items():
                self._keep(f"plane_moment.{name}", planes.moment_size(x, y))
                self._keep(f"plane_angle.{name}", _in_one_turn(x, y))
                self.summary |= {key: self.trace[key] for key in (f"plane_moment.{name}", f"plane_angle.{name}")}
        for index in (index for word, index in rotor.wanted if word == "size"):
            self._size(rotor.masses[index])

    def _moment(self, mass: PlaneMass) -> TracedValue:
        """Return the moment of a mass that is stated."""
        if mass.sector is not None:
            angle = given(f"sector_angle.{mass.name}", mass.sector.angle or 0.0, f"{self._path(mass)}.angle")
            rho, b, outer, inner, count = self._ring(mass)
            return planes.sector_moment(rho, b, outer, inner, count, angle)  # type: ignore[no-any-return]
        pistons = self.trace.get(f"plane_reciprocating.{mass.name}", absent("reciprocating_mass"))
        share = self.share if mass.reciprocating else absent("balanced_share")
        own, radius = (self.trace[f"plane_{key}.{mass.name}"] for key in ("mass", "radius"))
        return counterweight_moment(own, share, pistons, radius)  # type: ignore[no-any-return]

    def _size(self, mass: PlaneMass) -> None:
        """Keep the mass or the radius, or the angle of a sector, that gives a wanted moment."""
        moment, name, values = self.trace[f"plane_moment.{mass.name}"], mass.name, dict[str, TracedValue]()
        for own, other in (("mass", "radius"), ("radius", "mass")):
            if getattr(mass, other):
                values[f"plane_{own}.{name}"] = moment / self.trace[f"plane_{other}.{name}"]
        if mass.sector is not None:
            values[f"sector_angle.{name}"] = planes.sector_angle(moment, *self._ring(mass))
        self.summary |= {key: self._keep(key, value) for key, value in values.items()}

    def _path(self, mass: PlaneMass) -> str:
        return f"rotor.masses[{self.rotor.masses.index(mass) + 1}].sector"

    def _ring(self, mass: PlaneMass) -> list[TracedValue]:
        return [
            given(f"sector_{key}.{mass.name}", float(getattr(mass.sector, key)), f"{self._path(mass)}.{key}")
            for key in _SECTOR
        ]

    def _vector(self, name: str, kind: str = "plane_moment") -> Vector:
        """Keep the parts of a moment in the direction of a mass, and return them."""
        moment, angle = self.trace[f"{kind}.{name}"], self.trace[f"plane_angle.{name}"]
        return self._kept(kind, name, (planes.plane_moment_x(moment, angle), planes.plane_moment_y(moment, angle)))

    def _opposed(
        self, vectors: Mapping[str, Vector], kind: str, planes_of: Mapping[str, TracedValue]
    ) -> dict[str, Vector]:
        """Keep the vectors of a kind in one or two planes, at positions by name, that balance others."""
        (first, start), *second = planes_of.items()
        result, parts = dict[str, Vector](), list(vectors.values())
        for name, place in second:
            x, y = _sum(self._turned(vectors, start))
            span = place - start
            parts.append(self._kept(kind, name, (-x / span, -y / span)))
            result[name] = parts[-1]
        x, y = _sum(parts)
        return {first: self._kept(kind, first, (-x, -y)), **result}

    def _kept(self, kind: str, name: str, vector: Vector) -> Vector:
        x, y = (self._keep(f"{kind}_{axis}.{name}", part) for axis, part in zip("xy", vector, strict=True))
        return x, y

    def _planes_of(self, indices: Iterable[int]) -> dict[str, TracedValue]:
        names = [self.rotor.masses[index].name for index in indices]
        return {name: self.trace.get(f"plane_position.{name}", absent("plane_position")) for name in names}

    def _turned(self, vectors: Mapping[str, Vector], about: TracedValue) -> list[Vector]:
        """Return the moments along the shaft of vectors."""
        return [_times(self._arm(name, about), vector) for name, vector in vectors.items()]

    def _arm(self, name: str, about: TracedValue) -> TracedValue:
        """Return the distance of a plane from another, kept where the table counts from that one."""
        arm = self.trace[f"plane_position.{name}"] - about
        return self._keep(f"plane_arm.{name}", arm) if about is self.reference else arm

    def _left(self) -> None:
        """Keep what is left unbalanced: of all masses where none was found, of what moves along the line of stroke."""
        rotor = self.rotor
        vectors = {name: self._vector(name) for name in self._names(rotor.balancing)}
        pistons = dict[str, Vector]()
        for mass in rotor.masses:
            if mass.reciprocating and mass.radius is not None:
                moving, radius = (self.trace[f"plane_{key}.{mass.name}"] for key in ("reciprocating", "radius"))
                self._keep(f"reciprocating_moment.{mass.name}", moving * radius)
                pistons[mass.name] = self._vector(mass.name, "reciprocating_moment")
        if not rotor.wanted:
            self._force("1", vectors, has_couple=not rotor.is_flat)
        if pistons:
            along, across = 1.0 - self.whole, -self.whole
            self._swinging(pistons, {} if rotor.wanted else vectors, (along, across))
            self._hammer_blow(pistons)
        if rotor.bearings and rotor.has_speed and not rotor.wanted:
            places: dict[str, TracedValue] = {
                f"bearing_{number}": given(f"plane_position.bearing_{number}", place, f"rotor.bearings[{number}]")
                for number, place in enumerate(rotor.bearings, start=1)
            }
            for name, vector in self._opposed(vectors, "rotor_unbalance", places).items():
                force = unbalance_force(planes.moment_size(*vector).named(f"rotor_unbalance.{name}"), self.w)
                key = f"bearing_load.{name.removeprefix('bearing_')}"
                self.summary[key] = force.named(key)
        if rotor.kind == "reciprocating" and rotor.rod_length is not None:
            rod, second = given("rod_length", rotor.rod_length, "rotor.rod_length"), dict[str, Vector]()
            for mass in rotor.masses:
                if mass.radius is not None:
                    own = (*(self.trace[f"plane_{key}.{mass.name}"] for key in ("moment", "angle", "radius")), rod)
                    parts = planes.secondary_moment_x(*own), planes.secondary_moment_y(*own)
                    second[mass.name] = self._kept("secondary_moment", mass.name, parts)
            self._force("2", second, has_couple=not rotor.is_flat)

    def _force(self, name: str, vectors: Mapping[str, Vector], *, has_couple: bool) -> None:
        """Keep the resultants of vectors of one order and of their moments about the middle, and their forces."""
        sums = {"rotor_unbalance": _sum(vectors.values())}
        if has_couple:
            sums["rotor_couple"] = _sum(self._turned(vectors, self._middle()))
        for key, parts in sums.items():
            law = planes.moment_size if key == "rotor_unbalance" else planes.couple_size
            size = law(*self._kept(key, name, parts)).named(f"{key}.{name}")
            self.summary[f"{key}.{name}"] = size
            if self.rotor.has_speed:
                force = f"{'free_force' if key == 'rotor_unbalance' else 'free_moment'}.{name}"
                self.summary[force] = (size * self.w * self.w).named(force)

    def _swinging(
        self, pistons: Mapping[str, Vector], left: Mapping[str, Vector], shares: tuple[TracedValue, TracedValue]
    ) -> None:
        """Keep the forces along and across the line of stroke, and the couple of those along it."""
        turn, phi = (self.w,), TracedAngle()
        words, laws = ("along", "across"), (planes.force_along_stroke, planes.force_across_stroke)
        for word, share, law in zip(words, shares, laws, strict=True):
            parts = [_times(share, _sum(pistons.values())), *left.values()]
            x, y = self._kept("rotor_unbalance", word, _sum(parts))
            if self.rotor.has_speed:
                self.columns[f"unbalanced_force_{word}"] = law(*turn, x, y, phi.cos, phi.sin)
                size = planes.moment_size(x, y).named(f"rotor_unbalance.{word}")
                key = "tractive_effort_variation" if word == "along" and self.rotor.coupled else f"free_force.{word}"
                self.summary[key] = unbalance_force(size, self.w).named(key)
        if self.rotor.has_speed:
            both = (self.columns["unbalanced_force_along"], self.columns["unbalanced_force_across"])
            self.columns["unbalanced_force"] = shaking_force(*both)
        if self.rotor.is_flat or not self.rotor.has_speed:
            return
        about = self._middle()
        parts = [_times(shares[0], _sum(self._turned(pistons, about))), *self._turned(left, about)]
        x, y = self._kept("rotor_couple", "along", _sum(parts))
        self.columns["unbalanced_couple"] = planes.couple_along_stroke(*turn, x, y, phi.cos, phi.sin)
        key = "swaying_couple" if self.rotor.coupled else "free_moment.along"
        self.summary[key] = (planes.couple_size(x, y).named("rotor_couple.along") * self.w * self.w).named(key)

    def _hammer_blow(self, pistons: Mapping[str, Vector]) -> None:
        """Keep what the reciprocating share in the balance masses does to the rails."""
        rotor, wheel = self.rotor, self.rotor.wheel
        if not rotor.coupled or not rotor.balancing:
            return
        parts = {name: _times(self.share, vector) for name, vector in pistons.items()}
        balancing = self._opposed(parts, "reciprocating_moment", self._planes_of(rotor.balancing))
        for name, (x, y) in balancing.items():
            size = planes.moment_size(x, y).named(f"reciprocating_moment.{name}")
            values = {f"reciprocating_moment.{name}": size}
            if rotor.has_speed:
                values[f"hammer_blow.{name}"] = unbalance_force(size, self.w)
            if wheel[1] is not None:
                load = given("wheel_load", wheel[1], "rotor.locomotive.wheel_load")
                if rotor.has_speed:
                    values[f"rail_load_max.{name}"] = load + values[f"hammer_blow.{name}"]
                    values[f"rail_load_min.{name}"] = load - values[f"hammer_blow.{name}"]
                key = f"lifting_rotation.{name}"
                values[key] = planes.lifting_rotation(load, size).named(key)
                if wheel[0] is not None:
                    diameter = given("wheel_diameter", wheel[0], _ROLLING["wheel_diameter"])
                    values[f"lifting_speed.{name}"] = values[key] * (diameter / 2)
            self.summary |= {key: value.named(key) for key, value in values.items()}

    def listing(self) -> Listing:
        """Return the table of masses, moments and couples of books."""
        names = self._names()
        rows = {
            kind: np.array([self.trace[f"{kind}.{name}"].value if f"{kind}.{name}" in self.trace else math.nan
                            for name in names])
            for kind in _ROWS
        }  # fmt: skip
        return Listing({kind: values for kind, values in rows.items() if not np.isnan(values).all()}, tuple(names))

    def checks(self) -> dict[str, float]:
        """Return how far balanced masses are from balance, and from what Newton's method found."""
        if not self.rotor.wanted:
            return {}
        sizes, angles = (
            np.array([self.trace[f"plane_{kind}.{name}"].value for name in self._names()])
            for kind in ("moment", "angle")
        )
        span = float(np.ptp(self.state.places)) or 1.0
        places = (self.state.places - self.state.places.min()) / span
        left = Arrangement(sizes, angles, places).open_ends()
        difference = sizes * np.exp(1j * angles) - self.state.sizes * np.exp(1j * self.state.angles)
        return {"rotor_balance": float(max(np.abs(left).max(), np.abs(difference).max()) / sizes.sum())}


def _sum(vectors: Iterable[Vector]) -> Vector:
    # written out in one line, as books do
    x, y = (functools.reduce(operator.add, parts) for parts in zip(*vectors, strict=True))
    return x, y


def _times(share: TracedValue, vector: Vector) -> Vector:
    return share * vector[0], share * vector[1]


def _in_one_turn(x: TracedValue, y: TracedValue) -> TracedValue:
    """Return the direction of a vector between 0 and one turn. [rad]"""
    angle = direction(x, y)
    positive = angle + math.tau if angle.value < 0 else angle
    return TracedValue(ProcedureValue(positive.value, "vector_direction", (x, y), argument=positive))


def polygons(results: Results) -> dict[str, tuple[tuple[str, ...], Array]]:
    """Return the corners of the polygons of moments and of couples, with the names of their sides, shape (n + 1, 2)."""
    trace, drawn = results.trace, dict[str, tuple[tuple[str, ...], Array]]()
    for kind in ("plane_moment", "plane_couple"):
        names = [name for name in results.listings["planes"].names if f"{kind}.{name}" in trace]
        sizes, angles = (np.array([trace[f"{key}.{name}"].value for name in names]) for key in (kind, "plane_angle"))
        kept = np.abs(sizes) > _NOISE * np.abs(sizes).max(initial=0.0)
        if kept.any():
            corners = np.concatenate([[0j], np.cumsum((sizes * np.exp(1j * angles))[kept])])
            sides = tuple(name for name, is_kept in zip(names, kept, strict=True) if is_kept)
            drawn[kind] = sides, np.column_stack([corners.real, corners.imag])
    return drawn

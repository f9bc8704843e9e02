"""The gas of parts of a machine that do what earlier ones do: the same values at another crank angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from crankwork.formula.traced_value import TracedValue, delayed
from crankwork.loads.chamber import Chamber, face_names
from crankwork.loads.chamber_gas import ChamberGas, GasForce
from crankwork.mechanism.equal_parts import EqualPart
from crankwork.quantities.key import key_of


def with_equal_chambers(filling: ChamberGas, chambers: Mapping[str, Chamber], parts: Sequence[EqualPart]) -> ChamberGas:
    """Return the gas of all chambers, by that of those in parts that later parts are equal to."""
    if not parts or not chambers:
        return filling
    columns, singles, forces = dict(filling.columns), dict(filling.singles), [*filling.forces]
    for part in parts:
        for first, own in part.chambers.items():
            owners = dict(zip(face_names(first, chambers[first]), face_names(own, chambers[own]), strict=True))
            owners |= {first: own} | {face.slider: part.names[face.slider] for face in chambers[first].faces}
            for values in (columns, singles):
                for key, known in [*values.items()]:
                    kind, owner = key_of(key)
                    if owner in owners:
                        name = f"{kind}.{owners[owner]}"
                        values[name] = (
                            delayed(known, part.delay, part.cycle, name) if known.varies else known.named(name)
                        )
            forces += [
                GasForce(own, owners[force.slider], columns[f"gas_force.{owners[force.force.key.partition('.')[2]]}"])
                for force in filling.forces
                if force.chamber == first
            ]
    order = {name: number for number, name in enumerate(chambers)}
    forces.sort(key=lambda force: order[force.chamber])
    columns, singles = _in_order(columns, chambers), _in_order(singles, chambers)
    return filling._replace(columns=columns, singles=singles, forces=tuple(forces))


def _in_order(values: Mapping[str, TracedValue], chambers: Mapping[str, Chamber]) -> dict[str, TracedValue]:
    """Return values of each chamber in the order of chambers; gas forces and rod loads come last."""
    order = dict[str, int]()
    for number, (name, chamber) in enumerate(chambers.items()):
        order |= dict.fromkeys((name, *face_names(name, chamber), *(face.slider for face in chamber.faces)), number)
    last = ("gas_force", "rod_load")

    def rank(key: str) -> tuple[int, int]:
        kind, owner = key_of(key)
        return last.index(kind) + 1 if kind in last else 0, order.get(owner, -1)

    return {key: values[key] for key in sorted(values, key=rank)}

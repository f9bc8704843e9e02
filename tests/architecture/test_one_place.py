"""Each quantity is created in one place: those with more than one are pinned, and become fewer."""

from __future__ import annotations

import crankwork
from architecture.one_place import LIST, listed, places, several
from crankwork.quantities import QUANTITIES
from crankwork.quantities.key import key_of
from machine_texts import POINTS_ENGINE

# what other rooms give the keys of
_OF_KINEMATICS = {"side_factor", "rod_factor", "radial_factor", "tangential_factor"}
_MACHINES = ("slider-crank", "compressor", "turning-moment")


def test_quantities_get_no_further_places() -> None:
    found, allowed = several(), listed()
    new = {quantity: {*own} - {*allowed.get(quantity, ())} for quantity, own in found.items()}
    assert {quantity: own for quantity, own in new.items() if own} == {}
    assert {quantity: own for quantity, own in allowed.items() if own != found.get(quantity)} == {}, (
        f"write what `PYTHONPATH=src:tests python tests/architecture/one_place.py` prints into {LIST.name}"
    )


def test_every_quantity_of_results_has_a_place() -> None:
    texts = [POINTS_ENGINE, *map(crankwork.template, _MACHINES)]
    traces = [crankwork.analyse(crankwork.Description(text)).trace for text in texts]
    quantities = {key_of(key).quantity for trace in traces for key in trace} & {*QUANTITIES}
    assert quantities - {*places()} == _OF_KINEMATICS

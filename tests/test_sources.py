"""The bibliography is read whole, and cited as a list of references would."""

from __future__ import annotations

import pytest

from crankwork.resources import read_resource
from crankwork.sources import cite, sources


def test_every_entry_and_every_field_is_read():
    text = read_resource("sources.bib")
    fields = sum(bool(value) for source in sources().values() for value in source) - 2 * len(sources())
    assert len(sources()) == text.count("@")
    assert fields == text.count(" = ")


def test_entries_are_sorted():
    assert list(sources()) == sorted(sources())


CITED = {
    "kolchin_demidov_2008": (
        "Колчин А. И., Демидов В. П. Расчет автомобильных и тракторных двигателей. 4-е изд. Москва: Высшая школа, 2008."
    ),
    "fritsch_carlson_1980": (
        "Fritsch F. N., Carlson R. E. Monotone Piecewise Cubic Interpolation. "
        "SIAM Journal on Numerical Analysis 17(2), 238-246, 1980."
    ),
    "nguyen_tat_tien_2000, p. 41": ("Nguyễn Tất Tiến. Nguyên lý động cơ đốt trong. Hà Nội: NXB Giáo dục, 2000, p. 41."),
}


def test_cite():
    assert {reference: cite(reference) for reference in CITED} == CITED


def test_an_unknown_key_is_an_error():
    with pytest.raises(KeyError, match="nobody_1900"):
        cite("nobody_1900")

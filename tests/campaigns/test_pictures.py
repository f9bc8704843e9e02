"""The pictures of the README and the guide are those that the program draws today of the files beside them."""

from __future__ import annotations

import re

from campaigns import pictures

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
# two hundredths of a millimetre or of a degree, twice what rounding to two decimals moves
SAME = 0.02


def _parts(svg):
    return NUMBER.sub("#", svg), [float(one) for one in NUMBER.findall(svg)]


def test_pictures_are_those_of_today(tmp_path):
    pictures.draw(tmp_path)
    kept = {one.name: _parts(one.read_text("utf-8")) for one in pictures.IMAGES.iterdir()}
    today = {one.name: _parts(one.read_text("utf-8")) for one in tmp_path.iterdir()}
    assert kept.keys() == today.keys(), "draw them again with scripts/pictures"
    differ = [
        name
        for name, (text, numbers) in today.items()
        if text != kept[name][0] or any(abs(a - b) > SAME for a, b in zip(numbers, kept[name][1], strict=True))
    ]
    assert differ == [], "draw them again with scripts/pictures"


def test_every_picture_is_shown():
    docs = pictures.ROOT / "docs"
    # the site draws pictures of its own
    pages = [pictures.ROOT / "README.md", *(page for page in docs.rglob("*.md") if page.parent != docs / "site")]
    shown = {name for page in pages for name in re.findall(r"images/([\w-]+\.svg)", page.read_text("utf-8"))}
    assert shown == {one.name for one in pictures.IMAGES.iterdir()}

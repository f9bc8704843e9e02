"""What tests ask the studio without a browser, and sketches of linkages that they draw."""

from __future__ import annotations

from crankwork.studio.session import Session

FOUR = {"1": "OA", "2": "AB", "3": "BC"}
PLACES = {
    "O": (60, 120), "A": (60, 90), "B": (140, 60), "C": (150, 120), "D": (100, 40), "E": (190, 60), "F": (200, 120),
}  # fmt: skip


def answer(text, do="show", language="en", **asked):
    """Return the answer to a question of a text; nothing is drawn but what is asked for."""
    return Session(language).answer({"do": do, "text": text, "figures": [], **asked})


def typed(text, language="en", **fields):
    """Return the answer to what is typed into fields, `__` for `.` in their names."""
    stated = {key.replace("__", "."): value for key, value in fields.items()}
    return answer(text, "set", language, fields=stated)


def rows_of(answered):
    return {row["key"]: row for group in answered["form"] for row in group["rows"]}


def sketch(links=FOUR, at=None, slides="", **more):
    """Return a sketch of a six-bar, or of a part of it, some of its pins elsewhere; some of them slide."""
    places = {name: xy for name, xy in (PLACES | (at or {})).items() if name in "".join(links.values())}
    pins = [{"name": name, "x": x, "y": y, "ground": name in "OCF"} for name, (x, y) in places.items()]
    for one in pins:
        one.update({"slides": 0} if one["name"] in slides else {})
    listed = [{"name": name, "pins": list(one)} for name, one in links.items()]
    return {"do": "sketch", "pins": pins, "links": listed, "figures": [], **more}


def drawn(links=FOUR, **asked):
    """Return the answer to a sketch."""
    return Session("en").answer(sketch(links, **asked))

"""Files that the examples of keys name, as a test bench and a document would have them: made, not measured."""

from __future__ import annotations

import math
from pathlib import Path

HEADINGS = ("time", "angle", "cylinder 1", "cylinder 2")
_STEP = 2.0
_RADIUS, _ROD, _RATIO = 45.0, 160.0, 9.0


def _volume(degrees: float) -> float:
    """Return the volume over the clearance volume, at an angle from top dead centre."""
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    travel = _RADIUS * (1 - cosine) + _ROD - math.sqrt(_ROD**2 - (_RADIUS * sine) ** 2)
    return 1.0 + (_RATIO - 1.0) * travel / (2 * _RADIUS)


def _pressure(degrees: float, *, burns: bool) -> float:
    """Return the pressure of a four-stroke cylinder, 360 degrees at the top dead centre of firing. [bar]"""
    if not 180.0 <= degrees <= 540.0:
        return 1.0
    burnt = burns * (1.0 - math.exp(-5.0 * (max(degrees - 350.0, 0.0) / 60.0) ** 3))
    return (_RATIO / _volume(degrees)) ** 1.33 * (1.0 + 2.2 * burnt)


def rows() -> list[tuple[float, ...]]:
    """Return time [s] at 3000 rpm, crank angle from the firing dead centre [deg] and pressures [bar] of a cycle."""
    angles = [_STEP * number for number in range(360)]
    return [
        (
            angle / 360.0 / 50.0,
            angle,
            round(_pressure((angle + 360.0) % 720.0, burns=True), 6),
            round(_pressure((angle + 360.0) % 720.0, burns=False), 6),
        )
        for angle in angles
    ]


def write(folder: Path) -> None:
    """Write the recording as CSV and as a workbook, and the workbook of a press."""
    import xlsxwriter

    lines = [",".join(map(str, row)) for row in (HEADINGS, *rows())]
    (folder / "pressures.csv").write_text("\n".join(lines) + "\n", "utf-8")
    motion = [("angle [deg]", "torque [N*m]", "velocity [mm]"), (0, 10, 10), (60, 20, 60), (120, 50, 80),
              (180, 40, 20), (240, -10, -50), (300, 5, -70)]  # fmt: skip
    force = [("travel [mm]", "force [kN]"), (0.0, 0.0), (20.0, 0.9), (60.0, 4.0)]
    books = {"pressures.xlsx": {"notes": [("A made recording",)], "engine": [HEADINGS, *rows()]},
             "press.xlsx": {"force": force, "motion": motion}}  # fmt: skip
    for name, sheets in books.items():
        with xlsxwriter.Workbook(folder / name) as book:
            for sheet, table in sheets.items():
                page = book.add_worksheet(sheet)
                for number, row in enumerate(table):
                    page.write_row(number, 0, row)

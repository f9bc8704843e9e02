"""Random engines that somebody might have described."""

from __future__ import annotations

import random
from typing import Any

Values = dict[str, Any]


def mm(value: float) -> str:
    """Return a length as a file has it."""
    return f"{value:.6f} mm"


def random_engine(draw: random.Random) -> Values:  # noqa: C901 - chance after chance
    """Return an engine: its crank gear, perhaps gas, masses and many cylinders."""
    stroke = 10 ** draw.uniform(1.6, 2.7)
    values: Values = {
        "title": "Engine by chance",
        "crank": {"stroke": mm(stroke), "speed": f"{10 ** draw.uniform(2.3, 3.8):.4g} rpm", "mass": "1.2 kg"},
        "rod": {"ratio": round(draw.uniform(0.18, 0.45), 3), "mass": f"{draw.uniform(0.2, 5):.4g} kg",
                "small_end_share": round(draw.uniform(0.2, 0.4), 3)},
        "piston": {"mass": f"{draw.uniform(0.2, 5):.4g} kg"},
        "cylinder": {"bore": mm(stroke * draw.uniform(0.7, 1.3)), "compression_ratio": round(draw.uniform(5, 20), 2)},
        "table": {"step": "30 deg"},
    }  # fmt: skip
    if draw.random() < 0.3:
        values["rod"]["inertia"] = f"{draw.uniform(0.001, 0.1):.4g} kg*m2"
    if draw.random() < 0.2:
        values["cylinder"]["offset"] = mm(stroke * draw.uniform(-0.15, 0.15))
    if draw.random() < 0.1:
        values["cylinder"]["inclination"] = f"{draw.uniform(-60, 60):.4g} deg"
    kind = draw.choice(("petrol", "diesel", "otto", "ideal-diesel", "dual", "wiebe", ""))
    if kind:
        values["cycle"] = _cycle(draw, kind)
    layout = draw.choice(("", "inline", "inline", "V", "V", "boxer", "W", "radial"))
    if layout:
        values["engine"] = _layout(draw, layout)
    if layout and draw.random() < 0.6:
        values["bearings"] = {"crankpin_diameter": mm(stroke * 0.55), "crankpin_length": mm(stroke * 0.3),
                              "main_diameter": mm(stroke * 0.6), "main_length": mm(stroke * 0.3)}  # fmt: skip
    if layout and draw.random() < 0.6:
        values["balance"] = {"rotating_share": round(draw.uniform(0, 1), 2)}
        if draw.random() < 0.3:
            values["balance"]["reciprocating_share"] = 0.5
        if draw.random() < 0.2:
            values["balance"]["shafts"] = draw.choice(([1], [2], [1, 2]))
    if draw.random() < 0.7:
        values["flywheel"] = {"fluctuation": 0.02, "inertia": "0.3 kg*m2"}
    if draw.random() < 0.2:
        values["method"] = {"kinematics": draw.choice(("exact", "textbook", "series:4")), "weights": True}
    return values


def smooth_engine(draw: random.Random) -> Values:
    """Return an engine with more of its parts, of which no pressure jumps: a row where it does is of either side."""
    values = random_engine(draw)
    if values.get("cycle", {}).get("kind") in ("otto", "ideal-diesel", "dual"):
        values.pop("cycle")
    count = values.get("engine", {}).get("cylinders", 1)
    values["method"] = {"weights": draw.random() < 0.3}
    if draw.random() < 0.3:
        values["crank"]["angular_acceleration"] = "300 rad/s2"
    if "articulated" in values.get("engine", {}):
        values["engine"]["articulated"] |= {"mass": "0.9 kg", "small_end_share": 0.35, "inertia": "0.02 kg*m2"}
    elif count > 1 and draw.random() < 0.4:
        values["cylinder"].pop("offset", None)
        values["engine"]["offsets"] = [draw.choice(("4 mm", "-4 mm", "0 mm")) for _ in range(count)]
    if "cycle" in values and count > 1 and draw.random() < 0.3:
        values["engine"]["misfire"] = [draw.randint(1, count)]
    return values


def _cycle(draw: random.Random, kind: str) -> Values:
    cycle: Values = {"kind": kind}
    if kind in ("petrol", "diesel"):
        cycle |= {
            "excess_air": round(draw.uniform(0.85, 1.1) if kind == "petrol" else draw.uniform(1.3, 2.0), 3),
            "residual_temperature": f"{draw.uniform(750, 1100):.4g} K",
            "compression_exponent": round(draw.uniform(1.33, 1.39), 3),
            "expansion_exponent": round(draw.uniform(1.2, 1.28), 3),
        }
        if kind == "diesel":
            cycle["pressure_ratio"] = round(draw.uniform(1.3, 2.0), 2)
        if draw.random() < 0.3:
            cycle["cycle"] = "360 deg"
        cycle["timing"] = {"ignition": "25 deg", "ignition_delay": "6 deg", "intake_opens": "12 deg",
                           "intake_closes": "50 deg", "exhaust_opens": "55 deg",
                           "exhaust_closes": "15 deg"}  # fmt: skip
    elif kind == "wiebe":
        cycle |= {"combustion_start": "20 deg", "combustion_duration": f"{draw.uniform(30, 80):.4g} deg",
                  "shape": round(draw.uniform(0.5, 3), 2), "cycle_heat": f"{draw.uniform(0.2, 5):.4g} kJ",
                  "intake_pressure": "0.1 MPa", "intake_temperature": "330 K"}  # fmt: skip
        if draw.random() < 0.4:
            cycle["wall_temperature"] = "450 K"
    else:
        cycle |= {"intake_pressure": "0.1 MPa", "intake_temperature": "320 K",
                  "heat": f"{draw.uniform(500, 2000):.4g} kJ/kg"}  # fmt: skip
        if kind == "dual":
            cycle["pressure_ratio"] = 1.4
    return cycle


def _layout(draw: random.Random, layout: str) -> Values:  # noqa: C901 - chance after chance
    made: Values = {"layout": layout, "spacing": "120 mm", "uneven": True}
    if draw.random() < 0.7:
        del made["uneven"]
    match layout:
        case "inline":
            made["cylinders"] = draw.choice((1, 2, 3, 4, 5, 6, 8))
        case "V":
            made |= {"cylinders": draw.choice((2, 4, 6, 8, 10, 12)), "bank_angle": draw.choice(
                ("60 deg", "90 deg", "120 deg", f"{draw.uniform(20, 150):.4g} deg"))}  # fmt: skip
            if draw.random() < 0.3:
                made["numbering"] = draw.choice(("banks", "pairs"))
        case "boxer":
            made["cylinders"] = draw.choice((2, 4, 6, 8))
        case "W":
            made |= {"cylinders": draw.choice((3, 6, 12)), "bank_angles": ["-60 deg", "0 deg", "60 deg"]}
        case "radial":
            made["cylinders"] = draw.choice((3, 5, 7, 9))
            if draw.random() < 0.6:
                made["articulated"] = {"knuckle_radius": "20 mm"}
    if draw.random() < 0.3:
        count = made["cylinders"]
        made["firing_order"] = [1, *draw.sample(range(2, count + 1), count - 1)]
    if draw.random() < 0.15:
        made["strokes"] = draw.choice((2, 4))
    return made

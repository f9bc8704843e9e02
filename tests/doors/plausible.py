"""Random machine files that an engineer might have written: linkages drawn group by group, and whole engines.

File `i` of a seed is always the same. A linkage is drawn where everything fits at the beginning; whether it gets any
further is left to chance, as are masses, loads, gas and laws. Some are drawn with a link too many, or one too few.
"""

from __future__ import annotations

import math
import random
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

written: Callable[[dict[str, Any]], str] = runpy.run_path(str(Path(__file__).with_name("mutations.py")))["written"]
random_engine = runpy.run_path(str(Path(__file__).with_name("plausible_engines.py")))["random_engine"]
RISES = ("constant", "parabolic", "trapezoidal", "modified-trapezoidal", "cubic", "3-4-5", "4-5-6-7", "harmonic",
         "cycloidal", "modified-sine", "table")  # fmt: skip
Values = dict[str, Any]


class Plausible(NamedTuple):
    """A file, and the parts that cannot be where it was spoilt: one of them has to be told."""

    text: str
    wrong: str = ""
    parts: tuple[str, ...] = ()


def plausible_file(seed: int, number: int) -> Plausible:
    """Return a file."""
    draw = random.Random(f"plausible {seed}:{number}")  # noqa: S311 - the same file every time
    if draw.random() < 0.12:
        return Plausible(written(random_engine(draw)))
    drawing = _Drawing(draw)
    drawing.all()
    return Plausible(written(drawing.values), drawing.wrong, drawing.parts)


def _mm(value: float) -> str:
    return f"{value:.6f} mm"


def _deg(radians: float) -> str:
    return f"{math.degrees(radians):.6f} deg"


class _Drawing:
    """A linkage as it grows: where its points are at the beginning, and what they belong to."""

    def __init__(self, draw: random.Random) -> None:
        self.draw = draw
        self.size = 10 ** draw.uniform(1.3, 3.3)
        self.values: Values = {"title": "Drawn by chance", "fixed_points": {}, "links": {}, "guides": {}, "sliders": {}}
        self.at: dict[str, complex] = {}
        self.frames: dict[str, tuple[complex, complex]] = {}  # origin and direction of each link
        self.moving: list[str] = []  # points that something can hang on
        self.placed: list[str] = []  # joints whose positions are stated
        self.count, self.wrong, self.parts = 0, "", ()

    def all(self) -> None:
        """Draw the whole of it."""
        draw = self.draw
        others = (self.crank_by_law, self.slider, self.cylinder, self.motor, self.geared)
        draw.choice((self.crank,) * 7 + others)()
        kinds = (self.rrr, self.rrr, self.rrr, self.rrp, self.rrp, self.rpr, self.rpp, self.prp, self.ternary,
                 self.on_rocker, self.double)  # fmt: skip
        least = 0 if self.values["links"] else 1
        for _ in range(draw.choice((least, 1, 1, 2, 2, 2, 3))):
            draw.choice(kinds)()
        if draw.random() < 0.06:
            draw.choice((self.stiffen, self.loosen if self.values["links"] else self.stiffen))()
        self.weigh()
        if draw.random() < 0.85:
            self.values["positions"] = {name: self.place(self.at[name]) for name in self.placed}
        elif self.placed and draw.random() < 0.5:
            self.values["branch"] = {draw.choice(self.placed): draw.choice((1, -1))}
        if draw.random() < 0.6:
            self.load()
        if "driver" not in self.values:
            self.shaft()
        if draw.random() < 0.5:
            self.values["method"] = {"weights": True}
        self.values = {name: one for name, one in self.values.items() if one}

    # -- parts

    def name(self, kind: str) -> str:
        self.count += 1
        return f"{kind}{self.count}"

    def place(self, z: complex) -> list[str]:
        return [_mm(z.real), _mm(z.imag)]

    def near(self, z: complex, reach: float = 1.0) -> complex:
        """A place some way off."""
        way = self.draw.uniform(0.4, 2.0) * reach * self.size
        return z + way * complex(math.cos(a := self.draw.uniform(0, math.tau)), math.sin(a))

    def fixed(self, z: complex) -> str:
        name = self.name("O")
        self.values["fixed_points"][name] = self.place(z)
        self.at[name] = z
        return name

    def link(self, first: str, second: str, *further: str) -> str:
        """A link through points that are drawn."""
        name = self.name("link")
        start, way = self.at[first], self.at[second] - self.at[first]
        made: Values = {"joins": [first, second], "length": _mm(abs(way))}
        own = {one: (self.at[one] - start) / (way / abs(way)) for one in further}
        if self.draw.random() < 0.3:
            own[self.name("T")] = complex(self.draw.uniform(-1, 2) * abs(way), self.draw.uniform(-1, 1) * abs(way))
        if own:
            made["points"] = {one: self.place(z) for one, z in own.items()}
            self.at |= {one: start + z * way / abs(way) for one, z in own.items()}
            self.moving += [one for one in own if one not in self.moving]
        self.values["links"][name] = made
        self.frames[name] = start, way / abs(way)
        return name

    def joint(self, z: complex) -> str:
        name = self.name("P")
        self.at[name] = z
        self.placed.append(name)
        return name

    def start(self) -> str:
        """A point that moves."""
        return self.draw.choice(self.moving)

    def guide(self, z: complex, angle: float, link: str = "") -> str:
        """A guide through a place, drawn from some other point of it."""
        name, back = self.name("guide"), self.draw.choice((0.0, self.draw.uniform(-2, 2) * self.size))
        way = complex(math.cos(angle), math.sin(angle))
        made: Values = {"through": self.place(z - back * way), "angle": _deg(angle)}
        if link:
            made["link"] = link
        self.values["guides"][name] = made
        return name

    def piece(self, guide: str, pin: str = "") -> str:
        name = self.name("slider")
        self.values["sliders"][name] = {"guide": guide, **({"pin": pin} if pin else {})}
        return name

    def angle(self) -> float:
        return self.draw.choice((0.0, math.pi / 2, math.pi, self.draw.uniform(-math.pi, math.pi)))

    # -- drivers

    def crank(self) -> None:
        """A crank, short as a rule."""
        draw, start = self.draw, self.draw.choice((0.0, self.draw.uniform(-math.pi, math.pi)))
        radius = draw.choice((0.15, 0.3, 0.3, draw.uniform(0.05, 1.5))) * self.size
        self.at["O"], way = 0j, complex(math.cos(start), math.sin(start))
        self.values["fixed_points"]["O"] = self.place(0j)
        self.at["A"] = radius * way
        crank: Values = {
            "pivot": "O",
            "pin": "A",
            "radius": _mm(radius),
            "speed": f"{10 ** draw.uniform(0, 3.5):.4g} rpm",
        }
        self.values["crank"] = crank
        self.moving.append("A")
        if start:
            crank["start"] = _deg(start)
        if draw.random() < 0.3:
            crank["direction"] = draw.choice(("clockwise", "anticlockwise"))
        if draw.random() < 0.2:
            crank["angular_acceleration"] = f"{draw.uniform(-50, 50):.4g} rad/s2"
        if draw.random() < 0.2:
            z = radius * complex(draw.uniform(-1, 1), draw.uniform(-1, 1))
            crank["points"] = {"A2": self.place(z)}
            self.at["A2"] = z * way
            self.moving.append("A2")
        if draw.random() < 0.3:
            crank["inertia"] = f"{draw.uniform(0, 1) * (self.size / 1000) ** 4 * 100:.6g} kg*m2"
        if draw.random() < 0.2:
            crank["mass"] = f"{draw.uniform(0.1, 10):.4g} kg"
        if draw.random() < 0.05:
            crank |= {"from": f"{draw.uniform(-60, 40):.4g} deg", "to": f"{draw.uniform(41, 90):.4g} deg"}

    def crank_by_law(self) -> None:
        self.crank()
        for name in ("speed", "angular_acceleration", "from", "to"):
            self.values["crank"].pop(name, None)
        self.values["driver"] = self.law(0.0, self.draw.uniform(-1, 1) * math.pi, _deg)

    def slider(self) -> None:
        """A piece that is driven along a fixed guide."""
        angle, z = self.angle(), self.near(0j)
        guide = self.guide(z, angle)
        along = self.draw.uniform(-1, 1) * self.size
        through = complex(*(float(one.split()[0]) for one in self.values["guides"][guide]["through"]))
        self.at["A"] = through + along * complex(math.cos(angle), math.sin(angle))
        self.moving.append("A")
        name = self.piece(guide, "A")
        travel = along + self.draw.uniform(-0.6, 0.6) * self.size
        self.values["driver"] = {"slider": name, **self.law(along, travel, _mm)}

    def cylinder(self) -> None:
        """A boom that a cylinder swings."""
        pivot, foot = self.fixed(0j), self.fixed(self.near(0j, 0.7))
        tip = self.joint(self.near(0j))
        self.link(pivot, tip)
        self.moving.append(tip)
        long = abs(self.at[tip] - self.at[foot])
        self.values["driver"] = {"cylinder": [foot, tip], **self.law(long, long * self.draw.uniform(0.8, 1.25), _mm)}

    def motor(self) -> None:
        """Two links of an open chain with a motor in their pin, and a rocker at its end."""
        pivot, other = self.fixed(0j), self.fixed(self.near(0j))
        elbow = self.joint(self.near(0j))
        hand = self.joint(self.near(self.at[elbow]))
        upper, lower = self.link(pivot, elbow), self.link(elbow, hand)
        self.link(other, hand)
        self.moving += [elbow, hand]
        self.values["driver"] = {"between": [upper, lower], **self.law(0.0, self.draw.uniform(-0.6, 0.6), _deg)}

    def geared(self) -> None:
        """A second crank on gears, and a dyad between the two."""
        self.crank()
        draw, turned = self.draw, self.draw.uniform(-math.pi, math.pi)
        pivot = self.fixed(self.near(0j))
        arm = draw.uniform(0.1, 0.5) * self.size
        self.values["geared"] = {"second": {
            "pivot": pivot, "ratio": draw.choice((-1, 1, 2, -2, 3, 0.5, round(draw.uniform(-3, 3), 3))),
            "start": _deg(turned), "points": {"D": [_mm(arm), "0 mm"]},
        }}  # fmt: skip
        if draw.random() < 0.5:
            self.values["geared"]["second"] |= {"mass": "2 kg", "inertia": "0.01 kg*m2"}
        self.at["D"] = self.at[pivot] + arm * complex(math.cos(turned), math.sin(turned))
        joint = self.joint(self.near((self.at["A"] + self.at["D"]) / 2))
        self.link("A", joint)
        self.link("D", joint)
        self.moving += ["D", joint]

    def law(self, start: float, end: float, shown: Callable[[float], str]) -> Values:
        """There, perhaps in steps, perhaps a rest, and as a rule back again."""
        draw, segments, here = self.draw, [], start
        goals = [start + (end - start) * one for one in draw.choice(((1.0,), (0.4, 1.0), (1.0, 0.7)))]
        if draw.random() < 0.75:
            goals.append(start)
        for goal in goals:
            kind = draw.choice(RISES)
            one: Values = {"kind": kind, "to": shown(goal), "over": f"{10 ** draw.uniform(-1, 1):.4g} s"}
            if kind == "trapezoidal" and draw.random() < 0.5:
                one["ramp"] = round(draw.uniform(0.05, 0.5), 3)
            if kind == "table":
                shares = sorted(round(draw.uniform(0.05, 0.95), 3) for _ in range(3))
                one["at"] = sorted(set(shares))
                one["values"] = [shown(here + (goal - here) * share**1.5) for share in one["at"]]
            segments.append(one)
            if draw.random() < 0.3:
                segments.append({"kind": "dwell", "over": "0.5 s"})
            here = goal
        made: Values = {"start": shown(start), "law": segments}
        if draw.random() < 0.2:
            for one in segments:
                one["over"] = 1 / len(segments)
            made["period"] = "2 s"
        return made

    # -- groups

    def rrr(self) -> None:
        """Two links between a moving point and a fixed or another moving one."""
        p = self.start()
        q = self.start() if self.draw.random() < 0.25 else self.fixed(self.near(self.at[p]))
        c = self.joint(self.near((self.at[p] + self.at[q]) / 2))
        if p == q:
            q = self.fixed(self.near(self.at[p]))
        self.link(p, c)
        self.link(q, c)
        self.moving.append(c)

    def rrp(self, carrier: str = "") -> None:
        """A link and a piece that slides."""
        p = self.start()
        c = self.joint(self.near(self.at[p], 1.2))
        angle = self.angle()
        if carrier:
            origin, way = self.frames[carrier]
            own = (self.at[c] - origin) / way
            guide = self.guide(own, angle - math.atan2(way.imag, way.real), carrier)
        else:
            guide = self.guide(self.at[c], angle)
        self.link(p, c)
        self.piece(guide, c)
        self.moving.append(c)

    def on_rocker(self) -> None:
        """A guide that a link carries."""
        if self.frames:
            self.rrp(self.draw.choice(sorted(self.frames)))

    def rpr(self) -> None:
        """A lever with a slot."""
        p = self.start()
        q = self.fixed(self.near(self.at[p], 0.8))
        end = self.joint(self.at[q] + (self.at[p] - self.at[q]) * self.draw.choice((1.5, 2.0, -0.7)))
        lever = self.link(q, end)
        guide = self.name("guide")
        self.values["guides"][guide] = {"link": lever}
        self.piece(guide, p)
        self.moving.append(end)

    def rpp(self) -> None:
        """A yoke."""
        p = self.start()
        guide = self.guide(self.near(self.at[p]), self.angle())
        yoke, across = self.piece(guide), self.name("guide")
        turned = self.draw.choice((90.0, 90.0, self.draw.uniform(20, 160)))
        self.values["guides"][across] = {"link": yoke, "angle": f"{turned:.6g} deg"}
        self.piece(across, p)
        tip = self.name("T")
        self.values["sliders"][yoke]["points"] = {tip: self.place(self.size * complex(self.draw.uniform(-1, 1), 0.2))}

    def prp(self) -> None:
        """A piece on a link and a piece on a fixed guide, in one pin."""
        if not self.frames:
            return
        link = self.draw.choice(sorted(self.frames))
        origin, way = self.frames[link]
        own = self.size * complex(self.draw.uniform(0.2, 1), self.draw.uniform(-0.3, 0.3))
        c = self.joint(origin + own * way)
        self.piece(self.guide(own, self.draw.uniform(-0.5, 0.5), link), c)
        self.piece(self.guide(self.at[c], self.angle()), c)
        self.moving.append(c)

    def ternary(self) -> None:
        """A group of class III: a link with three joints, each on a link or a piece."""
        p = self.start()
        middle = self.near(self.at[p])
        joints = [self.joint(self.near(middle, 0.3)) for _ in range(3)]
        self.link(*joints)
        self.link(p, joints[0])
        for joint in joints[1:]:
            if self.draw.random() < 0.3:
                self.piece(self.guide(self.at[joint], self.angle()), joint)
            else:
                self.link(self.fixed(self.near(self.at[joint], 0.7)), joint)
        self.moving += joints

    def double(self) -> None:
        """Two rods from one point of a link, as the pistons of a V."""
        p = self.start()
        for angle in (math.pi / 4, 3 * math.pi / 4):
            way = complex(math.cos(angle), math.sin(angle))
            c = self.joint(self.at[p] + 1.3 * self.size * way)
            self.link(p, c)
            self.piece(self.guide(self.at[c], angle), c)

    # -- what makes it no machine

    def stiffen(self) -> None:
        """A link too many between two moving points, or a moving and a fixed one."""
        before = (*self.values["links"], *self.values["sliders"])
        p = self.start()
        q = self.fixed(self.near(self.at[p]))
        self.wrong, name = "locks", self.link(p, q)
        self.parts = (*before, name)

    def loosen(self) -> None:
        """Take a link away that others hang on, or a piece."""
        kind = self.draw.choice([one for one in ("links", "sliders") if self.values[one]])
        name = self.draw.choice(sorted(self.values[kind]))
        points = self.values[kind][name].get("joins", []) + list(self.values[kind][name].get("points", {}))
        del self.values[kind][name]
        self.frames.pop(name, None)
        self.wrong = "floats"
        self.parts = (*self.values["links"], *self.values["sliders"], *points, *self.values["guides"], name)

    # -- what acts on it

    def weigh(self) -> None:
        """Masses of most links and pieces, or of none."""
        draw = self.draw
        if draw.random() < 0.2:
            return
        for one in self.values["links"].values():
            if draw.random() < 0.8:
                long = float(one["length"].split()[0])
                mass = 10 ** draw.uniform(-1, 2)
                one["mass"] = f"{mass:.5g} kg"
                if draw.random() < 0.8:
                    one["inertia"] = f"{mass * (long / 1000) ** 2 / 12:.5g} kg*m2"
                inside = [point for point in one.get("points", {}) if point in self.at]
                one["centre"] = draw.choice([[_mm(long / 2), "0 mm"], [_mm(long * draw.uniform(-1, 2)), _mm(long / 9)],
                                             *inside])  # fmt: skip
        for one in self.values["sliders"].values():
            if draw.random() < 0.7:
                one["mass"] = f"{10 ** draw.uniform(-1, 2):.5g} kg"
                if "pin" not in one:
                    one["centre"] = ["0 mm", "0 mm"]

    def load(self) -> None:
        """Forces, torques, springs, process forces, gas."""
        draw, loads = self.draw, []
        points = [one for one in self.moving if one in self.at]
        fixed = sorted(self.values["fixed_points"])
        carried = self.carried()
        force = 10 ** draw.uniform(0, 4)
        for _ in range(draw.choice((1, 1, 2, 3))):
            kind = draw.choice(("force", "torque", "spring", "process", "held slider"))
            if kind == "force":
                loads.append({"kind": kind, "point": draw.choice(points), "x": f"{draw.uniform(-force, force):.5g} N",
                              "y": f"{draw.uniform(-force, force):.5g} N"})  # fmt: skip
            elif kind == "torque" and self.values["links"]:
                one: Values = {"kind": kind, "link": draw.choice(sorted(self.values["links"]))}
                if draw.random() < 0.5:
                    one |= {"at": ["0 deg", "90 deg", "200 deg", "360 deg"], "torque": ["0 N*m", "30 N*m", "-20 N*m",
                            "0 N*m"], "curve": draw.choice(("straight", "smooth"))}  # fmt: skip
                else:
                    one["torque"] = [f"{draw.uniform(-100, 100):.4g} N*m"]
                loads.append(one)
            elif kind == "spring" and fixed:
                loads.append({"kind": kind, "between": [draw.choice(fixed), draw.choice(points)],
                              "stiffness": f"{10 ** draw.uniform(1, 4):.5g} N/m", "free_length": _mm(self.size),
                              "preload": draw.choice(("0 N", "20 N"))})  # fmt: skip
            elif kind == "process" and carried:
                one = {"kind": kind, "slider": draw.choice(carried), "stroke": draw.choice(("growing", "falling"))}
                if draw.random() < 0.5:
                    shares = [one * self.size for one in (0.0, 0.1, 0.3, 0.8)]
                    one |= {"at": [_mm(share) for share in shares], "force": ["0 N", "200 N", "500 N", "100 N"],
                            "curve": draw.choice(("straight", "smooth"))}  # fmt: skip
                else:
                    one["force"] = [f"{force:.5g} N"]
                one["acts"] = draw.choice(("forward", "both"))
                loads.append(one)
            elif kind == "held slider" and carried:
                held = draw.choice(
                    (
                        {"kind": "spring", "stiffness": "1500 N/m", "free_length": "10 mm"},
                        {"kind": "damper", "damping": "200 N*s/m"},
                    )
                )
                loads.append({"slider": draw.choice(carried), **held})
        self.values["loads"] = loads
        pistons = [one for one in carried if "driver" not in self.values]
        if pistons and draw.random() < 0.35:
            self.gas(pistons)

    def carried(self) -> list[str]:
        """Pieces on fixed guides, but not the one that drives."""
        driven = self.values.get("driver", {}).get("slider")
        return [
            name
            for name, one in self.values["sliders"].items()
            if "link" not in self.values["guides"].get(one["guide"], {"link": ""}) and name != driven
        ]

    def gas(self, pistons: list[str]) -> None:
        draw, bore = self.draw, f"{0.3 * self.size:.5g} mm"
        slider = draw.choice(pistons)
        room: Values = {"slider": slider, "bore": bore, "sense": draw.choice((1, -1))}
        kind = draw.choice(("constant", "diagram", "sealed"))
        if kind == "constant":
            room |= {"pressure": f"{draw.uniform(-0.05, 2):.4g} MPa"}
        elif kind == "diagram":
            room |= {
                "compression_ratio": round(draw.uniform(2, 15), 2), "pressures": "absolute", "ambient": "0.1 MPa",
                "points": {
                    "a": {"angle": "0 deg", "pressure": "0.1 MPa"}, "b": {"angle": _deg(draw.uniform(1, 2.5))},
                    "c": {"angle": "200 deg"}, "d": {"angle": "360 deg", "pressure": "0.1 MPa"},
                },
                "pieces": [
                    {"law": "polytropic", "points": ["a", "b"], "exponent": 1.35},
                    {"law": draw.choice(("constant", "polytropic")), "points": ["b", "c"]},
                    {"law": "rounded", "points": ["c", "d"]},
                ],
            }  # fmt: skip
            if room["pieces"][1]["law"] == "polytropic":
                room["pieces"][1]["exponent"] = 1.2
        else:
            room |= {"clearance_volume": f"{(0.3 * self.size) ** 3 / 1000:.6g} cm3", "temperature": "700 K",
                     "ambient": "0.1 MPa"}  # fmt: skip
            self.values["charges"] = {"gas": {"chambers": ["room"], "mean_pressure": "0.5 MPa",
                                              "exponent": draw.choice((0.0, 1.0, 1.4))}}  # fmt: skip
            if draw.random() < 0.6:
                del self.values["charges"]["gas"]["exponent"]
            if len(pistons) > 1:
                other = next(one for one in pistons if one != slider)
                self.values["chambers"] = {"cold": {**room, "slider": other, "temperature": "300 K"}}
                self.values["charges"]["gas"]["chambers"].append("cold")
        self.values["chambers"] = {**self.values.get("chambers", {}), "room": room}

    def let_go(self) -> None:
        """A motion in time, some with stops, some with friction."""
        draw = self.draw
        wanted: dict[str, Any] = {"time": draw.choice(("0.1 s", "0.5 s")), "speed": f"{draw.uniform(-60, 60):.4g} rpm"}
        if draw.random() < 0.7:
            wanted["torque"] = f"{draw.uniform(-2, 10):.4g} N*m"
        if draw.random() < 0.2:
            wanted |= {"stops": ["-400 deg", "130 deg"], "restitution": draw.choice((0, 0.5, 1))}
        if draw.random() < 0.2:
            wanted["until"] = draw.choice(("rest", "steady"))
        self.values["transient"] = wanted
        if draw.random() < 0.3 and self.values["sliders"]:
            slider = draw.choice(sorted(self.values["sliders"]))
            self.values["friction"] = {"sliders": {slider: {"coefficient": 0.1, "length": "50 mm"}}}

    def shaft(self) -> None:
        """What the crank is driven with, and the tables."""
        draw = self.draw
        if draw.random() < 0.3:
            self.values["flywheel"] = {"fluctuation": round(10 ** draw.uniform(-2.5, -0.7), 4)}
        if draw.random() < 0.2:
            self.values["efficiency"] = {"chain": [0.95, [0.9, 0.97]]}
        if draw.random() < 0.15:
            power, ratio = f"{10 ** draw.uniform(-1, 2):.4g} kW", round(draw.uniform(1, 60), 2)
            fixed = {"rated_speed": "1430 rpm", "overload": 2.2, "pole_pairs": 2}
            self.values["motor"] = {"rated_power": power, **fixed, "ratio": ratio}
        if draw.random() < 0.05:
            self.let_go()
        if draw.random() < 0.2:
            self.values["table"] = {"step": draw.choice(("5 deg", "7 deg", "45 deg")), "special_angles": ["12.3 deg"]}

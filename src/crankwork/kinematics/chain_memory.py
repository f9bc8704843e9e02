"""Traced motion of a chain that is solved numerically: its coordinates are a root of the closure equations."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.formula.known import Component, Known, Root, absent, given
from crankwork.kinematics.closing import ChainBoundary, is_stretched
from crankwork.kinematics.dyads import (
    LinkMotion,
    guide_on_link,
    in_link_frame,
    named_link,
    named_point,
    point_on_guide,
    point_on_link,
)
from crankwork.kinematics.loops import ChainMotion
from crankwork.kinematics.plane_motion import cosine_of_direction, sine_of_direction, sine_of_turned
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.chain import Chain, ChainLink

_KEYS = ("point_x", "point_y", "link_angle")


def remembered_chain(chain: Chain, boundary: ChainBoundary, root: Root) -> ChainMotion:
    """Return the traced motion of a chain of links, with points, frames and distances by the formulas of any link.

    `root`: gives the coordinates of all links and their derivatives; its residuals are set here.
    """
    count = 3 * len(chain.links)

    def coordinate(link: int, which: int) -> Transfer:
        keys = (f"{_KEYS[which]}{order}.{chain.links[link].name}" for order in ("", "_1", "_2"))
        return Transfer(*(Known(Component(root, 3 * link + which + k * count), key) for k, key in enumerate(keys)))

    frames: dict[str, LinkMotion] = {}
    for k, link in enumerate(chain.links):
        angle = coordinate(k, 2)
        cos, sin = cosine_of_direction(angle.position), sine_of_direction(angle.position)
        frame = LinkMotion(PointMotion(coordinate(k, 0), coordinate(k, 1)), cos, sin, *angle[1:])
        frames[link.name] = named_link(frame, link.name)
    places = {
        (link.name, name): named_point(
            point_on_guide(frames[link.name], boundary.lengths[link.name])
            if is_stretched(link, name, boundary)
            else _point(frames[link.name], name, place, _path(chain, link, name)),
            name,
        )
        for link in chain.links
        for name, place in link.points.items()
    }
    points: dict[str, PointMotion] = {}
    for (_, name), place in places.items():
        points.setdefault(name, place)
    lines = {
        slide.link: guide_on_link(frames[slide.guide.link], slide.guide)
        if slide.guide.link in frames
        else boundary.guide(slide.guide)
        for slide in chain.slides
    }
    root.residuals = (
        *_pins(chain, places, points | {name: boundary.points[name] for name in chain.known}),
        *_slides(chain, frames, lines),
    )
    sliders = {link: in_link_frame(line, frames[link].origin).x for link, line in lines.items()}
    own = {name: point for name, point in points.items() if name not in chain.known}
    return ChainMotion(own, frames, sliders, None)


def _path(chain: Chain, link: ChainLink, name: str) -> str:
    """Return the path of a point in a description; the second joint of a bar is stated by the length."""
    if any(slide.link == link.name for slide in chain.slides):
        return f"sliders.{link.name}.points.{name}"
    return f"links.{link.name}.length" if [*link.points].index(name) == 1 else f"links.{link.name}.points.{name}"


def _point(frame: LinkMotion, name: str, place: tuple[float, float], path: str) -> PointMotion:
    along, across = place
    is_bar = path.endswith(".length")
    return point_on_link(
        frame,
        given(f"point_along.{name}", along, path if is_bar else f"{path}[1]") if along else absent("point_along"),
        given(f"point_across.{name}", across, f"{path}[2]") if across else absent("point_across"),
        name,
    )


def _pins(chain: Chain, places: dict[tuple[str, str], PointMotion], anchors: dict[str, PointMotion]) -> Iterator[Known]:
    """Yield the residuals of the pins, along x and y."""
    for (_, name), place in places.items():
        shared = name in chain.known or place is not anchors[name]
        for axis, end, anchor in zip("xy", place, anchors[name], strict=True):
            if shared:
                yield (end.position - anchor.position).named(f"distance_{axis}.{name}")


def _slides(chain: Chain, frames: dict[str, LinkMotion], lines: dict[str, LinkMotion]) -> Iterator[Known]:
    """Yield the residuals of the slides: distance from the guide, and the sine of the angle to it."""
    for slide in chain.slides:
        frame, line = frames[slide.link], lines[slide.link]
        yield in_link_frame(line, frame.origin).y.position.named(f"guide_across.{slide.link}")
        yield sine_of_turned(frame.sin, line.cos, -frame.cos, line.sin).named(f"guide_sine.{slide.link}")

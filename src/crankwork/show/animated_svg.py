"""Animations as SVG that plays by itself, even without scripts; opened alone it has a control bar."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.show.animation import Animation, Part, keyframes
from crankwork.show.scene import Item, Text
from crankwork.show.svg import SvgWriter, clean, page
from crankwork.show.theme import Palette, Theme, palette_of, themed_item

_LINE = 6.0
Written = Callable[[tuple[Item, ...], float], Iterator[str]]
# rounding tolerance: millimetres, degrees, shares
_TOLERANCE = 1e-4
_COLOUR = re.compile(r'(?:fill|stroke)="(#[0-9a-f]{6})"')
_SCRIPT = """<script><![CDATA[
const film = document.documentElement, moves = film.getAnimations({subtree: true});
let runs = !matchMedia("(prefers-reduced-motion: reduce)").matches;
const play = on => {
  const now = moves[0].currentTime;
  runs = on;
  // a time that is set holds at once
  moves.forEach(one => { if (on) one.play(); else { one.pause(); one.currentTime = now; } });
};
const share = () => (moves[0].currentTime / TIME + REST) % 1;
const go = to => { play(false); moves.forEach(one => { one.currentTime = (to - REST + 2) * TIME; }); };
const step = by => go((Math.round(share() * FRAMES) + by) / FRAMES);
const box = film.viewBox.baseVal, foot = box.height, left = 13, wide = box.width - 21;
const add = (name, of) => {
  const one = film.appendChild(document.createElementNS(film.namespaceURI, name));
  Object.entries(of).forEach(pair => one.setAttribute(...pair));
  return one;
};
film.setAttribute("viewBox", `0 0 ${box.width} ${foot + 9}`);
film.setAttribute("height", `${foot + 9}mm`);
film.setAttribute("style", "max-width:100vw;max-height:100vh;user-select:none");
const ground = film.appendChild(film.querySelector("rect").cloneNode());
ground.setAttribute("y", foot);
ground.setAttribute("height", 9);
const button = add("path", {id: "play", style: "cursor:pointer", "pointer-events": "bounding-box"});
const track = {x: left, width: wide, style: "cursor:pointer"};
add("rect", {...track, y: foot + 4.2, height: 0.6});
const knob = add("circle", {cy: foot + 4.5, r: 1.6});
const slide = add("rect", {...track, id: "slide", y: foot + 1, height: 7, "fill-opacity": 0});
const shown = () => {
  button.setAttribute("d", `M6 ${foot + 2}` + (runs ? "h1.6v5h-1.6zm3 0h1.6v5h-1.6z" : "v5l4.4-2.5z"));
  knob.setAttribute("cx", left + share() * wide);
  requestAnimationFrame(shown);
};
shown();
const scrub = event => {
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(film.getScreenCTM().inverse());
  go(Math.min(Math.max((at.x - left) / wide, 0), 1 - 1 / FRAMES));
};
slide.addEventListener("pointerdown", event => { slide.setPointerCapture(event.pointerId); scrub(event); });
slide.addEventListener("pointermove", event => event.buttons && scrub(event));
slide.addEventListener("click", event => event.stopPropagation());
addEventListener("click", () => play(!runs));
addEventListener("keydown", event => {
  const by = {ArrowRight: 1, ArrowLeft: -1, ArrowUp: 10, ArrowDown: -10}[event.key];
  if (event.key === " ") play(!runs); else if (by) step(by); else return;
  event.preventDefault();
});
]]></script>"""


def moving_svg(film: Animation, theme: Theme = "print") -> bytes:
    """Return an animation as SVG that plays by itself."""
    palette, moves = palette_of(theme), _Moves(film)

    def written(items: tuple[Item, ...], height: float) -> Iterator[str]:
        return SvgWriter(height, palette).written(tuple(themed_item(item, theme) for item in items))

    body = [*film_body(film, written, moves), *_readout(film, palette)]
    style = [*moves.rules(), *(() if theme == "dark" else _in_the_dark(film, theme))]
    numbers = {"TIME": 1000 * film.seconds, "FRAMES": film.frames, "REST": film.rest / film.frames}
    script = re.sub("TIME|FRAMES|REST", lambda match: f"{numbers[match[0]]:g}", _SCRIPT)
    return page(film.ground, palette, ["<style>", *style, "</style>", *body, script], film.about)


def film_body(film: Animation, written: Written, moves: _Moves | None = None) -> Iterator[str]:
    """Yield everything but the readout; without movements each part is at rest.

    Parts are groups with their name as `data-part`, which a page moves by `moving.data`; equal shapes are written once.
    `written`: items as elements, on a paper of a height. [mm]
    """
    yield from written(film.ground.items, film.ground.height)
    shapes: dict[str, str] = {}
    for part in film.parts:
        yield f'<g data-part="{clean(part.name)}" '
        x, y, turn, stretch, tint = part.track[film.rest if len(part.shift) > 1 else 0]
        inner = None
        if moves is not None:
            x, y, turn, inner = moves.of(part)
            stretch = tint = 1.0
        yield f'transform="{_placed(x, film.ground.height - y, -turn, stretch)}"{_opacity(tint)}>{inner or ""}'
        shape = "\n".join(written(part.items, 0.0))
        if shape in shapes:
            yield f'<use href="#{shapes[shape]}"/>'
        else:
            shapes[shape] = f"s{len(shapes) + 1}"
            yield f'<g id="{shapes[shape]}">{shape}</g>'
        yield "</g></g>" if inner else "</g>"


class _Moves:
    """Movements relative to mean positions; equal movements, also delayed ones, are shared."""

    def __init__(self, film: Animation) -> None:
        self._film = film
        self._movements: list[Array] = []

    def of(self, part: Part) -> tuple[float, float, float, str | None]:
        """Return mean position and angle of a part, and the group that moves in it."""
        track = part.track
        is_closed = bool(np.allclose(track[0], track[-1], atol=1e-6))
        x, y, turned = track[:-1, :3].mean(axis=0) if is_closed and len(track) > 1 else track[0, :3]
        cos, sin = np.cos(np.radians(turned)), np.sin(np.radians(turned))
        # from here on downward and clockwise, as in SVG
        offset = (track[:, :2] - (x, y)) @ np.array([[cos, -sin], [sin, cos]]) * (1.0, -1.0)
        own = np.column_stack([offset, turned - track[:, 2], track[:, 3:]])
        own = own[[0]] if np.all(np.abs(own - own[0]) < _TOLERANCE) else own
        number, later = self._number(own, is_closed=is_closed) if len(own) > 1 else (0, 0)
        right, down, turn, stretch, tint = own[self._film.rest if number else 0]
        moved = f' class="moves m{number}"' if number else ""
        moved += f' style="animation-delay:{self._delay(later)}s"' if later else ""
        is_plain = not number and max(abs(right), abs(down), abs(turn), abs(stretch - 1), abs(tint - 1)) < _TOLERANCE
        group = f'<g{moved} transform="{_placed(right, down, turn, stretch)}"{_opacity(tint)}>'
        return float(x), float(y), float(turned), None if is_plain else group

    def _number(self, own: Array, *, is_closed: bool) -> tuple[int, int]:
        """Return the number of a movement, and its lead in frames over the equal movement that has it."""
        count = len(own) - 1
        ahead = (np.arange(count)[:, None] + np.arange(count)) % count if is_closed else np.arange(count)[None]
        for number, other in enumerate(self._movements, start=1):
            if np.all(np.abs(other[:-1].mean(axis=0) - own[:-1].mean(axis=0)) < _TOLERANCE):
                difference = np.abs(other[ahead] - own[:-1]).max(axis=(1, 2))
                if difference.min() < _TOLERANCE:
                    return number, int(np.argmin(difference))
        self._movements.append(own)
        return len(self._movements), 0

    def _delay(self, later: int) -> str:
        return f"{-self._film.seconds * (self._film.rest + later) / self._film.frames:.4f}"

    def rules(self) -> Iterator[str]:
        """Yield the rules of animation; they begin at rest, so that nothing jumps if animation is off."""
        yield f".moves{{animation:{self._film.seconds:g}s linear {self._delay(0)}s infinite}}"
        for number, own in enumerate(self._movements, start=1):
            steps = "".join(
                f"{_short_number(100 * frame / self._film.frames)}%{{{_step(own, frame)}}}" for frame in keyframes(own)
            )
            yield f".m{number}{{animation-name:m{number}}}@keyframes m{number}{{{steps}}}"
        frames, end = self._film.frames, _short_number(-_LINE * self._film.frames)
        yield f".readout{{animation-name:readout;animation-timing-function:steps({frames})}}"
        yield f"@keyframes readout{{from{{transform:none}}to{{transform:translateY({end}px)}}}}"
        yield "@media (prefers-reduced-motion: reduce){.moves{animation-play-state:paused}}"


def _step(own: Array, frame: int) -> str:
    """Return a frame of a movement, without constant components."""
    right, down, turn, stretch, tint = own[frame]
    shifts, falls, turns, stretches, fades = np.any(
        np.abs(own - (0.0, 0.0, 0.0, 1.0, 1.0)) > _TOLERANCE, axis=0
    ).tolist()
    fall = f",{_short_number(down)}px" if falls else ""
    how = f"translate({_short_number(right)}px{fall})" if shifts or falls else ""
    how += f"rotate({_short_number(turn)}deg)" if turns else ""
    how += f"scale({_short_number(stretch)},1)" if stretches else ""
    return ";".join([*([f"transform:{how}"] if how else []), *([f"opacity:{_short_number(tint)}"] if fades else [])])


def _placed(right: float, down: float, turn: float, stretch: float) -> str:
    turned = f"rotate({_short_number(turn)})" if _short_number(turn) != "0" else ""
    scaled = f"scale({_short_number(stretch)} 1)" if stretch != 1 else ""
    return f"translate({_short_number(right)} {_short_number(down)}){turned}{scaled}"


def _opacity(tint: float) -> str:
    return f' opacity="{_short_number(tint)}"' if tint != 1 else ""


def _short_number(value: float) -> str:
    """Format a number with at most two decimals."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")


def _readout(film: Animation, palette: Palette) -> Iterator[str]:
    """Yield all readouts as a column that moves in steps behind a window of one line."""
    x, y = film.readout
    top = _short_number(film.ground.height - y - 0.75 * _LINE)
    yield f'<clipPath id="readout"><rect y="{top}" width="100%" height="{_short_number(_LINE)}"/></clipPath>'
    up = _short_number(-_LINE * film.rest)
    yield f'<g clip-path="url(#readout)"><g class="moves readout" transform="translate(0 {up})">'
    lines = tuple(Text((x, y - index * _LINE), text, anchor="end") for index, text in enumerate(film.readouts))
    yield from SvgWriter(film.ground.height, palette).written(lines)
    yield "</g></g>"


def _in_the_dark(film: Animation, theme: Theme) -> Iterator[str]:
    """Yield the colours on dark ground for readers who prefer it."""
    items = (*film.ground.items, *(item for part in film.parts for item in part.items))
    other: Theme = "print" if theme == "print" else "dark"
    dark, ground = palette_of("dark"), palette_of(theme).ground
    bright, dim = (
        _COLOUR.findall("\n".join(SvgWriter(0.0, palette).written(tuple(themed_item(item, name) for item in items))))
        for name, palette in ((theme, palette_of(theme)), (other, dark))
    )
    light = dict(zip(bright, dim, strict=True))
    attributes = "fill", "stroke"
    rules = [f'[{name}="{colour}"]{{{name}:{light[colour]}}}' for colour in sorted(light) for name in attributes]
    rules += [f'[{name}="{ground}"]{{{name}:{dark.ground}}}' for name in attributes]
    yield f"@media (prefers-color-scheme: dark){{svg{{fill:{dark.ink}}}{''.join(rules)}}}"

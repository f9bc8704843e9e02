"""All formats of a drawing: PDF and pictures by Typst, DXF (AutoCAD R2010), animations as GIF, or as MP4 by ffmpeg."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.show.animation import Animation
from crankwork.show.scene import (
    PENS,
    Arc,
    Circle,
    Drawing,
    Hatch,
    Item,
    LineKind,
    Pen,
    Polyline,
    Run,
    Text,
    arc_points,
    hatch_lines,
    pen_of,
    runs,
    shade_of,
    text_width,
)
from crankwork.show.svg import moving_svg, svg
from crankwork.show.theme import Theme, alt_text

# takes the fraction that is done, from 0 to 1
Progress = Callable[[float], None]
# number of frames that are drawn together, which is faster than one by one
_BATCH_SIZE = 10
# largest width in pixels, largest density in pixels per inch; colours of a GIF
_WIDEST, _DENSEST, _COLOURS = 760.0, 120.0, 28
_INCH = 25.4
_PAGE = """#let data = sys.inputs
#set document(title: data.title, date: none)
#set page(width: float(data.width) * 1mm, height: float(data.height) * 1mm, margin: 0mm)
#set text(lang: data.language)
#for at in range(int(data.count)) {
  page(image(bytes(data.at(str(at))), format: "svg", width: 100%, height: 100%, alt: data.described))
}
"""
_STYLE, _FONT = "SHEET", "times.ttf"
# in hundredths of a millimetre, those that the format has
_WEIGHTS = (0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100)
_BLACK, _GREY, _PALE = 7, 252, 254
_MILLIMETRES = 4
_HALIGN = {"start": 0, "middle": 1, "end": 2}
_MTEXT_MIDDLE = {"start": 4, "middle": 5, "end": 6}
_THROUGH_CORNERS = 128
# how much wider text may be in another font
_WIDENING = 1.5
# lighter lines than this are not black, and than this are the palest; shorter dashes than this are dots
_LIGHT, _PALER, _DOT = 0.3, 0.8, 2.0
# of slanted letters [deg]
_SLANT = 15.0
# characters that begin a code in a text with codes
_CODES = re.compile(r"[\\{}]")


def gif(film: Animation, theme: Theme = "colour", progress: Progress = lambda _: None) -> bytes:
    """Return an animation as GIF that repeats."""
    try:
        from PIL import Image  # noqa: PLC0415 - an optional part
        from PIL.PngImagePlugin import PngImageFile  # noqa: PLC0415
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names="GIF"), "report") from None
    frames = [PngImageFile(io.BytesIO(picture)).convert("RGB") for picture in _pictures(film, theme, progress)]
    # colours of all frames: gas and flashes are not visible on each
    wide, tall = frames[0].size
    samples = frames[:: max(len(frames) // 12, 1)]
    combined = Image.new("RGB", (wide, tall * len(samples)))
    for index, frame in enumerate(samples):
        combined.paste(frame, (0, index * tall))
    palette = combined.quantize(_COLOURS, dither=Image.Dither.NONE)
    shown: list[Any] = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    # in hundredths of a second, as in the format, without drift
    ends = [round(100 * film.seconds * index / len(shown)) for index in range(len(shown) + 1)]
    times = [10 * (end - start) for start, end in pairwise(ends)]
    stream = io.BytesIO()
    shown[0].save(
        stream, "GIF", save_all=True, append_images=shown[1:], duration=times, loop=0, disposal=1, optimize=True
    )
    return stream.getvalue()


def mp4(film: Animation, theme: Theme = "colour", progress: Progress = lambda _: None) -> bytes:
    """Return one cycle of an animation as MP4."""
    program = shutil.which("ffmpeg")
    if program is None:
        raise CrankworkError(ErrorMessage("ffmpeg_missing"))
    rate, even = f"{film.frames / film.seconds:.6g}", "pad=ceil(iw/2)*2:ceil(ih/2)*2"
    read = ["-f", "image2pipe", "-c:v", "png", "-framerate", rate, "-i", "-"]
    # output to a pipe cannot be rewound to write the header
    write = [
        "-c:v", "libx264", "-pix_fmt", "yuv420p", "-vf", even, "-movflags", "frag_keyframe+empty_moov", "-f", "mp4",
    ]  # fmt: skip
    ran = subprocess.run(  # noqa: S603 - the program that the owner has on the path
        [program, "-loglevel", "error", *read, *write, "-"],
        input=b"".join(_pictures(film, theme, progress)),
        capture_output=True,
        check=False,
    )
    if ran.returncode or not ran.stdout:
        messages = ran.stderr.decode("utf-8", "replace").strip().splitlines()
        raise CrankworkError(ErrorMessage("ffmpeg_failed", reason=(messages or [str(ran.returncode)])[-1][:200]))
    return ran.stdout


def _pictures(film: Animation, theme: Theme, progress: Progress) -> list[bytes]:
    density, pictures = min(_DENSEST, _WIDEST / film.ground.width * _INCH), list[bytes]()
    for start in range(0, film.frames, _BATCH_SIZE):
        frames = range(start, min(start + _BATCH_SIZE, film.frames))
        pictures += pngs([film.still(frame) for frame in frames], theme, density)
        progress(len(pictures) / film.frames)
    return pictures


def pdf(drawing: Drawing, theme: Theme = "print") -> bytes:
    """Return a drawing as PDF, in true millimetres, the same bytes every time."""
    return _placed([drawing], theme, "PDF", format="pdf")[0]


def png(drawing: Drawing, theme: Theme = "print", pixels_per_inch: float = 200.0) -> bytes:
    """Return a drawing as a picture of pixels."""
    return pngs([drawing], theme, pixels_per_inch)[0]


def pngs(drawings: Sequence[Drawing], theme: Theme, pixels_per_inch: float, drawn: Sequence[bytes] = ()) -> list[bytes]:
    """Return drawings of one size as pictures of pixels, faster than one by one; `drawn`: their SVG, if at hand."""
    return _placed(drawings, theme, "PNG", drawn, format="png", ppi=pixels_per_inch)


def _placed(
    drawings: Sequence[Drawing],
    theme: Theme,
    name: str,
    drawn: Sequence[bytes] = (),
    **options: Any,  # noqa: ANN401 - what typst takes
) -> list[bytes]:
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names=name), "report") from None
    first = drawings[0]
    inputs = {
        "title": first.title,
        "described": alt_text(first),
        "language": first.language,
        "width": f"{first.width:g}",
        "height": f"{first.height:g}",
        "count": str(len(drawings)),
    }
    pictures = drawn or [svg(drawing, theme) for drawing in drawings]
    inputs |= {str(index): picture.decode() for index, picture in enumerate(pictures)}
    pages = typst.compile(_PAGE.encode(), sys_inputs=inputs, ignore_system_fonts=True, **options)
    return [bytes(page) for page in pages] if isinstance(pages, list) else [bytes(pages)]


def dxf(drawing: Drawing, _: Theme = "print") -> bytes:
    """Return a drawing as DXF in model space, a drawing unit for a millimetre; layers have its colours."""
    try:
        import ezdxf  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names="DXF"), "report") from None
    # ezdxf does not declare all that it exports
    library: Any = ezdxf
    was_fixed = library.options.write_fixed_meta_data_for_testing
    try:
        # otherwise every file has its own time and number
        library.options.write_fixed_meta_data_for_testing = True
        return _written(library.new("R2010", setup=False, units=_MILLIMETRES), drawing)
    finally:
        library.options.write_fixed_meta_data_for_testing = was_fixed


def _written(document: Any, drawing: Drawing) -> bytes:  # noqa: ANN401 - a document of ezdxf
    _prepare(document, drawing)
    space = document.modelspace()
    for item in drawing.items:
        _add(space, item, drawing.width)
    width, height = drawing.width, drawing.height
    document.set_modelspace_vport(height, center=(width / 2, height / 2))
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (0, 0, 0), (width, height, 0)
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode("utf-8")


def _prepare(document: Any, drawing: Drawing) -> None:  # noqa: ANN401 - a document of ezdxf
    """Set units and limits, and add line types, layers and the text style."""
    document.header["$MEASUREMENT"], document.header["$LTSCALE"] = 1, 1.0
    document.header["$LIMMIN"], document.header["$LIMMAX"] = (0, 0), (drawing.width, drawing.height)
    document.styles.add(_STYLE, font=_FONT)
    for kind, pen in PENS.items():
        color = _BLACK if not pen.grey else _GREY if kind == "net" else _PALE
        kind_of_line = "CONTINUOUS"
        if pen.dashes:
            kind_of_line = _layer(kind)
            signed = [length if index % 2 == 0 else -length for index, length in enumerate(pen.dashes)]
            document.linetypes.add(kind_of_line, [sum(pen.dashes), *signed], description=kind.replace("_", " "))
        document.layers.add(_layer(kind), color=color, lineweight=_weight(pen.width), linetype=kind_of_line)
    document.layers.add("TEXT", color=_BLACK, lineweight=25)
    document.layers.add("HATCH", color=_BLACK, lineweight=25)
    document.layers.add("CLEARED", color=_BLACK)
    document.set_wipeout_variables(frame=0)


def _layer(kind: LineKind | Pen) -> str:
    """Return the layer of a kind of line; for a pen that of the most similar kind."""
    if not isinstance(kind, Pen):
        return kind.upper()
    if (shade := shade_of(kind)) > _LIGHT:
        return "GRID_BOLD" if shade > _PALER else "NET"
    if len(kind.dashes) == 2:
        return "DOTTED" if kind.dashes[0] < _DOT * kind.width else "DASHED"
    dashes, width = len(kind.dashes), kind.width
    name, _ = min(PENS.items(), key=lambda item: (len(item[1].dashes) != dashes, abs(item[1].width - width)))
    return name.upper()


def _weight(width: float) -> int:
    """Return the nearest line weight that the format has. [mm/100]"""
    return _WEIGHTS[int(np.argmin(np.abs(np.array(_WEIGHTS) - 100 * width)))]


def _as_drawn(kind: LineKind | Pen) -> dict[str, Any]:
    """Return layer and weight of a line."""
    attributes: dict[str, Any] = {"layer": _layer(kind)}
    return attributes | {"lineweight": _weight(kind.width)} if isinstance(kind, Pen) else attributes


def _add(space: Any, item: Item, edge: float) -> None:  # noqa: ANN401 - a layout of ezdxf
    match item:
        case Text():
            _add_text(space, item, edge)
        case Circle():
            around = arc_points(Arc(item.centre, item.radius, 0.0, 360.0))
            _add_fill(space, item.fill, around)
            if pen_of(item.kind).width:
                space.add_circle(item.centre, item.radius, dxfattribs=_as_drawn(item.kind))
        case Arc():
            space.add_arc(item.centre, item.radius, item.start, item.end, dxfattribs={"layer": _layer(item.kind)})
        case Hatch():
            for start, end in hatch_lines(item):
                space.add_line(tuple(start), tuple(end), dxfattribs={"layer": "HATCH"})
        case Polyline():
            _add_fill(space, item.fill, item.points)
            points = [(float(x), float(y)) for x, y in item.points]
            dashed = {"flags": _THROUGH_CORNERS if pen_of(item.kind).dashes else 0}
            if pen_of(item.kind).width:
                space.add_lwpolyline(points, close=item.closed, dxfattribs=_as_drawn(item.kind) | dashed)


def _add_fill(space: Any, fill: float | None, around: Array) -> None:  # noqa: ANN401 - a layout of ezdxf
    """Fill an area; white hides the items below it."""
    points = [(float(x), float(y)) for x, y in around]
    if fill is not None and fill < 1:
        filled = space.add_hatch(color=_BLACK if fill < 0.3 else _PALE, dxfattribs={"layer": "HATCH"})
        filled.paths.add_polyline_path(points, is_closed=True)
    elif fill is not None:
        space.add_wipeout(points, dxfattribs={"layer": "CLEARED"})


def _add_text(space: Any, item: Text, edge: float) -> None:  # noqa: ANN401 - a layout of ezdxf
    """Add a text: plain text as TEXT on its baseline, text with an index as MTEXT around its middle.

    `edge`: right edge of the paper, up to which other fonts get room [mm].
    """
    parts = runs(item.text)
    attributes = {"layer": "TEXT", "style": _STYLE, "rotation": item.angle}
    if not any(part.shift or part.is_slanted for part in parts):
        attributes |= {"insert": item.place, "align_point": item.place, "halign": _HALIGN[item.anchor]}
        attributes["width"] = item.wide
        # two per cent signs begin a code, and so does a caret without a space after it
        space.add_text(
            "".join(part.text for part in parts).replace("%%", "% %").replace("^", "^ "),
            height=item.height,
            dxfattribs=attributes,
        )
        return
    coded = "".join(_coded(part) for part in parts)
    place = (item.place[0], item.place[1] + item.height / 2)
    # readers break lines at the width, and without a width at every space
    width = text_width(item.text, item.height)
    beyond = {"start": edge - item.place[0], "middle": 2 * (edge - item.place[0]), "end": edge}[item.anchor]
    width = max(width, min(_WIDENING * width + 2.0 * item.height, beyond))
    attributes |= {"char_height": item.height, "attachment_point": _MTEXT_MIDDLE[item.anchor], "insert": place}
    attributes["width"] = width
    space.add_mtext(coded, dxfattribs=attributes)


def _coded(run: Run) -> str:
    r"""Return a run of text as MTEXT, an index as a fraction `\S^ index;` without numerator."""
    text = _CODES.sub(r"\\\g<0>", run.text).replace("%%", "% %")
    if not run.shift:
        text = text.replace("^", "^ ")
        return rf"{{\Q{_SLANT:g};{text}}}" if run.is_slanted else text
    text = text.replace("^", "\\^").replace(";", "\\;").replace("/", "\\/").replace("#", "\\#")
    return rf"{{\H{0.7:g}x;\S^ {text};}}" if run.shift < 0 else rf"{{\H{0.7:g}x;\S{text}^ ;}}"


FORMATS: dict[str, Callable[[Drawing, Theme], bytes]] = {"svg": svg, "pdf": pdf, "png": png, "dxf": dxf}
FILMS: dict[str, Callable[[Animation, Theme, Progress], bytes]] = {
    "svg": lambda film, theme, _: moving_svg(film, theme), "gif": gif, "mp4": mp4
}  # fmt: skip
# optional modules that each format needs, and the extra that has them
MODULES: dict[str, dict[str, str]] = {
    "svg": {}, "pdf": {"typst": "report"}, "png": {"typst": "report"}, "dxf": {"ezdxf": "report"},
    "gif": {"typst": "report", "PIL": "report"}, "mp4": {"typst": "report"},
}  # fmt: skip

"""All formats that a drawing can be written in: PDF and pictures by Typst, animations as GIF, or as MP4 by ffmpeg."""

from __future__ import annotations

import io
import shutil
import subprocess
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.locale import ErrorMessage
from crankwork.show.animation import Animation
from crankwork.show.dxf import dxf
from crankwork.show.scene import Drawing
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


FORMATS: dict[str, Callable[[Drawing, Theme], bytes]] = {"svg": svg, "pdf": pdf, "png": png, "dxf": dxf}
FILMS: dict[str, Callable[[Animation, Theme, Progress], bytes]] = {
    "svg": lambda film, theme, _: moving_svg(film, theme), "gif": gif, "mp4": mp4
}  # fmt: skip
# optional modules that each format needs, and the extra that has them
MODULES: dict[str, dict[str, str]] = {
    "svg": {}, "pdf": {"typst": "report"}, "png": {"typst": "report"}, "dxf": {"ezdxf": "report"},
    "gif": {"typst": "report", "PIL": "report"}, "mp4": {"typst": "report"},
}  # fmt: skip

"""A film as GIF, or as MP4 by the program ffmpeg, out of stills."""

from __future__ import annotations

import io
import shutil
import subprocess
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.locale import Refusal
from crankwork.show.moving import MovingDrawing
from crankwork.show.pdf import pngs
from crankwork.show.theme import Theme

# what is told the part that is done, from 0 to 1
Told = Callable[[float], None]
# how many frames are drawn at once, which is sooner than one by one
_AT_ONCE = 10
# pixels of a film across at most, and in an inch; colours of a GIF
_WIDEST, _DENSEST, _COLOURS = 760.0, 120.0, 28
_INCH = 25.4


def gif(film: MovingDrawing, theme: Theme = "colour", told: Told = lambda _: None) -> bytes:
    """Return a film as GIF that plays again and again."""
    try:
        from PIL import Image  # noqa: PLC0415 - an optional part
        from PIL.PngImagePlugin import PngImageFile  # noqa: PLC0415
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="GIF"), "report") from None
    frames = [PngImageFile(io.BytesIO(one)).convert("RGB") for one in _pictures(film, theme, told)]
    # colours of all frames: gas and flashes are not seen on each
    wide, tall = frames[0].size
    some = frames[:: max(len(frames) // 12, 1)]
    seen = Image.new("RGB", (wide, tall * len(some)))
    for at, one in enumerate(some):
        seen.paste(one, (0, at * tall))
    palette = seen.quantize(_COLOURS, dither=Image.Dither.NONE)
    shown: list[Any] = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
    # hundredths of a second, as the format counts, without a drift
    ends = [round(100 * film.seconds * at / len(shown)) for at in range(len(shown) + 1)]
    times = [10 * (end - start) for start, end in pairwise(ends)]
    stream = io.BytesIO()
    shown[0].save(
        stream, "GIF", save_all=True, append_images=shown[1:], duration=times, loop=0, disposal=1, optimize=True
    )
    return stream.getvalue()


def mp4(film: MovingDrawing, theme: Theme = "colour", told: Told = lambda _: None) -> bytes:
    """Return a film as MP4, one passage long."""
    program = shutil.which("ffmpeg")
    if program is None:
        raise CrankworkError(Refusal("ffmpeg_missing"))
    rate, even = f"{film.frames / film.seconds:.6g}", "pad=ceil(iw/2)*2:ceil(ih/2)*2"
    read = ["-f", "image2pipe", "-c:v", "png", "-framerate", rate, "-i", "-"]
    # what is written to a pipe cannot go back to its head
    write = [
        "-c:v",
        "libx264",
        "-pix_fmt",
        "yuv420p",
        "-vf",
        even,
        "-movflags",
        "frag_keyframe+empty_moov",
        "-f",
        "mp4",
    ]
    ran = subprocess.run(  # noqa: S603 - the program that the owner has on the path
        [program, "-loglevel", "error", *read, *write, "-"],
        input=b"".join(_pictures(film, theme, told)),
        capture_output=True,
        check=False,
    )
    if ran.returncode or not ran.stdout:
        said = ran.stderr.decode("utf-8", "replace").strip().splitlines()
        raise CrankworkError(Refusal("ffmpeg_failed", reason=(said or [str(ran.returncode)])[-1][:200]))
    return ran.stdout


def _pictures(film: MovingDrawing, theme: Theme, told: Told) -> list[bytes]:
    density, made = min(_DENSEST, _WIDEST / film.ground.width * _INCH), list[bytes]()
    for start in range(0, film.frames, _AT_ONCE):
        frames = range(start, min(start + _AT_ONCE, film.frames))
        made += pngs([film.still(at) for at in frames], theme, density)
        told(len(made) / film.frames)
    return made

"""The command that opens the studio."""

from __future__ import annotations

from pathlib import Path

import click

from crankwork.cli.options import LANG
from crankwork.cli.spoken import LocalizedCommand
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import Language, Refusal

_MODULES = {"starlette": "studio", "uvicorn": "studio", "websockets": "studio"}


@click.command(cls=LocalizedCommand)
@click.argument("file", required=False)
@click.option("--port", metavar="N", default="0")
@click.option("--no-browser", is_flag=True)
@LANG
def studio(file: str | None, port: str, language: Language, *, no_browser: bool) -> None:
    """Open the studio, with a machine file or a shared text."""
    if not (port.isascii() and port.isdecimal() and len(port) < 6 and int(port) < 1 << 16):
        raise CrankworkError(Refusal("option_wrong", option="--port", mistake=Refusal("port_range", port=port[:20])))
    if extras := missing_extras(_MODULES):
        raise MissingExtraError(Refusal("extra_studio"), *extras)
    from crankwork import files
    from crankwork.studio.answers import is_share, opened_share
    from crankwork.studio.server import StartupOptions, serve

    if file is None:
        opening = StartupOptions()
    elif is_share(file):
        opening = StartupOptions(opened_share(file, language))
    else:
        path = Path(file)
        text = files.read_text(path, advice=Refusal("check_path_or_new", path=path))
        # a text of another form is not saved in its place
        opening = (
            StartupOptions(opened_share(text, language)) if is_share(text) else StartupOptions(text, path.resolve())
        )
    serve(opening, language, int(port), opens=not no_browser, says=click.echo)

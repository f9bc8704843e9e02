"""The server of the studio, for this computer only: its page, recent files, answers; other requests are rejected."""

from __future__ import annotations

import asyncio
import hashlib
import html
import json
import logging
import secrets
import socket
import threading
import time
import webbrowser
from collections.abc import AsyncIterator, Callable, Mapping
from functools import partial
from http import HTTPStatus
from pathlib import Path
from typing import Any, NamedTuple

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import HTTPConnection, Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response, StreamingResponse
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from crankwork import files
from crankwork.browser import script, style
from crankwork.description.machine_file import template, template_names, template_title
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES, ErrorMessage, Language, capital, in_language, texts, translate
from crankwork.note.interactive import drawer, header, look
from crankwork.show.formats import FORMATS
from crankwork.studio.session import Session, StoppedError

_NAME = "recent.json"
_MAX_ENTRIES = 8
_MAX_LENGTH = 2 * _MAX_ENTRIES * files.MAX_MACHINE_FILE
# names of the languages in their own language
_OWN = {"en": "English", "ru": "Русский", "vi": "Tiếng Việt"}
# files that can be exported, by name
EXPORTS = ("note.pdf", "note.docx", "note.html", "page.html", "tables.xlsx", "sheets.zip", "machine.gif", "machine.svg")
HOST = "127.0.0.1"
# largest message: an escaped machine file and the request [bytes]
_MAX_MESSAGE = 1 << 20
_COOKIE = "crankwork"
_FIRST = "four-bar"
# time after the last page has closed until the server stops [s]
_IDLE_SECONDS = 3.0
# largest number of cached scripts
_SCRIPTS = 64
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_log = logging.getLogger(__name__)


class Recent(NamedTuple):
    """A machine that was opened: the path of its file, or a name and its text."""

    name: str
    text: str | None = None


def recent(opened: Recent | None = None) -> list[Recent]:
    """Return the recent machines, with the one just opened first."""

    def change(text: str) -> str:
        before = _recent_of(text)
        if opened is None or not _is_kept(opened):
            return text
        remaining = [entry for entry in before if entry.name != opened.name]
        return json.dumps([list(entry) for entry in [opened, *remaining][:_MAX_ENTRIES]])

    return _recent_of(files.update_user_file(_NAME, change, limit=_MAX_LENGTH))


def named(machines: list[Recent]) -> list[list[str]]:
    """Return the names of machines and the folders of existing files, for the page."""
    existing = [machine for machine in machines if machine.text is not None or Path(machine.name).is_file()]
    return [[machine.name, "" if machine.text is not None else str(Path(machine.name).parent)] for machine in existing]


def _is_kept(machine: Recent) -> bool:
    try:
        size = len(f"{machine.name}{machine.text or ''}".encode())
    except UnicodeEncodeError:
        return False
    return bool(machine.name) and size <= files.MAX_MACHINE_FILE


def _recent_of(text: str) -> list[Recent]:
    """Parse the list of recent machines; skip damaged entries."""
    try:
        entries = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    return [Recent(*entry) for entry in entries if _is_valid(entry)] if isinstance(entries, list) else []


def _is_valid(entry: object) -> bool:
    if not (isinstance(entry, list) and len(entry) == 2 and isinstance(entry[0], str)):
        return False
    is_text = isinstance(entry[1], str)
    return (is_text or (entry[1] is None and Path(entry[0]).is_absolute())) and _is_kept(Recent(*entry))


def styles() -> str:
    """Return the style sheet of the studio."""
    return look() + style("design", "studio")


def _escaped(key: str, language: Language) -> str:
    """Return a text as it may stand in an attribute."""
    return html.escape(capital(translate(key, language)))


def shell(language: Language) -> str:
    """Return the page of the studio in a language."""
    named = {**texts("studio", language), "text": capital(translate("help.value_text", language))}
    stored = json.dumps(named, ensure_ascii=False).replace("<", "\\u003c")
    return "\n".join([
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8"><title>crankwork</title>',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<link rel="stylesheet" href="studio.css"><link rel="icon" href="data:,"></head><body>',
        *_header(language),
        f'<p id="notice" role="alert" hidden></p><script type="application/json" id="words">{stored}</script>',
        "<main>",
        *_left(language),
        f'<section id="machine" aria-label="{_escaped("page.machine", language)}">',
        '<div id="film"></div><ul id="refusals"></ul><output id="chip" hidden></output>',
        '<p id="turn" hidden></p>',
        f'<div class="tools"><button id="draw" aria-pressed="false">{_text("draw", language)}</button>',
        f'<p class="hint" hidden>{_text("hint", language)}</p></div>',
        f'<nav><a href="#description">{_escaped("page.sliders", language)}</a>',
        f'<a href="#diagrams">{_escaped("page.results", language)}</a></nav></section>',
        f'<section id="diagrams" aria-label="{_escaped("page.diagrams", language)}"><div class="tools">',
        f'<h2>{_escaped("page.results", language)}</h2><span id="pins"></span>',
        f'<button id="pin">{_text("pin", language)}</button></div><div id="cards"></div><div class="figures"></div>',
        f'<select id="add" aria-label="{_text("add", language)}"></select>',
        f'<details id="trial"><summary>{_text("vary", language)}</summary></details></section>',
        f'<section id="results" aria-label="{_escaped("page.values", language)}"></section>',
        "</main>",
        *drawer(language),
        f'<dialog id="commands" aria-label="{_text("commands", language)}"><input role="combobox" aria-expanded="true"',
        f' aria-controls="found" aria-autocomplete="list" aria-label="{_text("commands", language)}">',
        f'<ul id="found" role="listbox" aria-label="{_text("commands", language)}"></ul></dialog>',
        '<p id="told" role="status" class="unseen"></p>',
        '<script src="studio.js"></script></body></html>\n',
    ])  # fmt: skip


def _text(key: str, language: Language) -> str:
    return _escaped("help.value_text" if key == "text" else f"studio.{key}", language)


def _header(language: Language) -> list[str]:
    templates = "".join(
        f'<option value="{name}">{html.escape(template_title(name, language))}' for name in template_names()
    )
    exports = "".join(f"<option>{name}" for name in EXPORTS)
    languages = "".join(
        f'<option value="{key}" lang="{key}"{" selected" if key == language else ""}>{_OWN[key]}' for key in LANGUAGES
    )
    menu = [
        f'<select id="template" aria-label="{_text("template", language)}">',
        f'<option value="">{_text("template", language)}</option><optgroup label="{_text("recent", language)}" hidden>',
        f'</optgroup><optgroup label="{_text("template", language)}">{templates}</optgroup></select>',
        f'<select id="export" aria-label="{_text("export", language)}" data-formats="{" ".join(FORMATS)}">',
        f'<option value="">{_text("export", language)}</option>{exports}</select>',
        f'<button id="all" aria-keyshortcuts="/">{_text("commands", language)} <kbd>/</kbd></button>',
        f'<label class="button" tabindex="-1">{_text("open", language)}',
        '<input id="open" type="file" accept=".toml,.txt,.pmks,text/plain"></label>',
        f'<button id="share">{_text("share", language)}</button>',
        f'<select id="language" aria-label="{_text("language", language)}">{languages}</select>',
    ]
    return header("crankwork", language, menu)


def _left(language: Language) -> list[str]:
    tabs = "".join(
        f'<button role="tab" id="{name}-tab" aria-controls="{name}" aria-selected="{chosen}">'
        f"{_text(name, language)}</button>"
        for name, chosen in (("form", "true"), ("text", "false"))
    )
    return [
        f'<section id="description" aria-label="{_escaped("page.sliders", language)}"><div class="tools">',
        f'<div role="tablist">{tabs}</div>',
        *(
            f'<button id="{name}" aria-label="{_text(name, language)}">{sign}</button>'
            for name, sign in (("undo", "↶"), ("redo", "↷"))
        ),
        f'<button id="save">{_text("save", language)}</button></div>',
        '<div id="form" role="tabpanel" aria-labelledby="form-tab"></div>',
        '<div id="text" role="tabpanel" aria-labelledby="text-tab" hidden><pre id="lines" aria-hidden="true"></pre>',
        f'<textarea id="source" spellcheck="false" wrap="off" aria-label="{_text("text", language)}"></textarea>',
        "</div></section>",
    ]


class StartupOptions(NamedTuple):
    """Text at the start, a template if it is empty, and its file."""

    text: str = ""
    path: Path | None = None


class ServerState:
    """State shared by the pages of a server: token, files opened, scripts, number of pages."""

    def __init__(self, opening: StartupOptions, language: Language, *, keeps_running: bool = False) -> None:
        self.opening, self.language, self.keeps_running = opening, language, keeps_running
        self.token, self.port = secrets.token_urlsafe(24), 0
        self.pages, self.left = 0, time.monotonic()
        # files opened in this server
        self.paths = {str(opening.path)} if opening.path else set()
        # scripts of live previews by digest; pages fetch them at once
        self.steps: dict[str, str] = {}

    def hosts(self) -> tuple[str, ...]:
        """Return the host names of the server."""
        return f"{HOST}:{self.port}", f"localhost:{self.port}"

    @property
    def is_idle(self) -> bool:
        """Whether no page has been open for some time."""
        return not self.keeps_running and self.pages == 0 and time.monotonic() - self.left > _IDLE_SECONDS

    def initial_page(self, language: Language) -> dict[str, Any]:
        """Return the initial data of a page."""
        text, path = self.opening
        if path is not None:
            # another page may have saved the file
            text = _on_disk(path) or text
        seen = recent(None if path is None else Recent(str(path)))
        return {"text": text or template(_FIRST, language), "path": str(path or ""), "recent": named(seen)}

    def place(self, request: Mapping[str, Any]) -> Path | None:
        """Return the file of a page's text, if it was opened here or before."""
        path = request.get("path")
        if not path or not isinstance(path, str):
            return None
        is_known = path in self.paths or any(entry == (path, None) for entry in recent())
        return Path(path) if is_known else None

    def reopen(self, name: str) -> dict[str, Any]:
        """Return a recent machine, with its file if it has one."""
        machine = next((entry for entry in recent() if entry.name == name), None)
        if machine is None:
            raise CrankworkError(ErrorMessage("recent_none", name=name[:200]))
        text, path = machine.text, ""
        if text is None:
            text, path = files.read_text(name, advice=ErrorMessage("check_recent")), name
            self.paths.add(path)
        return {"text": text, "path": path, "recent": named(recent(machine))}

    def save(self, request: dict[str, Any]) -> dict[str, Any]:
        """Write the text to its file unless the file has changed; add a text without a file to the recent machines."""
        path, text = self.place(request), request["text"]
        if path is None:
            return {"handed": True, "recent": named(recent(Recent(request["name"], text)))}
        if not request.get("anyway") and (on_disk := _on_disk(path)) != request["kept"]:
            return {"gone": True} if on_disk is None else {"conflict": str(path)}
        files.write_files({path: text.encode()}, save=True)
        return {"saved": str(path)}

    def script(self, steps: str) -> str:
        """Store a script for a page and return its name."""
        name = hashlib.sha256(steps.encode()).hexdigest()[:32]
        self.steps = dict([*self.steps.items(), (name, steps)][-_SCRIPTS:])
        return name

    def check_file(self, request: dict[str, Any]) -> dict[str, Any]:
        """Return whether the file has changed, or its text."""
        text = _on_disk(self.place(request))
        if text is None:
            return {"gone": True}
        return {"text": text} if request.get("take") else {"changed": text != request["kept"]}


def _on_disk(path: Path | None) -> str | None:
    """Return the text of a file, None if it cannot be read."""
    try:
        return None if path is None else files.read_text(path)
    except CrankworkError:
        return None


class _Guard:
    """Middleware that rejects requests of other hosts and other pages, or without the token."""

    def __init__(self, app: ASGIApp, state: ServerState) -> None:
        self._app, self._state = app, state

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request or reject it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        refused = self._rejection(HTTPConnection(scope))
        if refused is None:
            await self._app(scope, receive, send)
        else:
            # the status also rejects a web socket before it opens
            answer = PlainTextResponse(refused.phrase, refused)
            await answer(scope, receive, send)

    def _rejection(self, connection: HTTPConnection) -> HTTPStatus | None:
        state, headers = self._state, connection.headers
        if headers.get("host", "") not in state.hosts():
            return HTTPStatus.BAD_REQUEST
        is_reading = connection.scope["type"] == "http" and connection.scope["method"] in ("GET", "HEAD")
        if not is_reading and headers.get("origin", "") not in {f"http://{host}" for host in state.hosts()}:
            return HTTPStatus.FORBIDDEN
        # the cookie may be that of an earlier server
        tokens = connection.query_params.get("token", ""), connection.cookies.get(f"{_COOKIE}-{state.port}", "")
        is_known = any(secrets.compare_digest(token.encode(), state.token.encode()) for token in tokens)
        return None if is_known else HTTPStatus.UNAUTHORIZED


def application(state: ServerState) -> ASGIApp:
    """Return the studio as an ASGI application."""
    routes = [
        Route("/", partial(_shell, state)),
        Route("/studio.js", partial(_script, state)),
        Route("/steps/{name}.js", partial(_steps, state)),
        Route("/studio.css", _styles),
        Route("/export", partial(_export, state), methods=["POST"]),
        Route("/trial", partial(_trial, state), methods=["POST"]),
        WebSocketRoute("/talk", partial(_talk, state)),
    ]
    return _Guard(Starlette(routes=routes), state)


def _sealed(data: bytes | str, kind: str, **headers: str) -> Response:
    """Return a response with security headers."""
    fixed = {
        "Content-Security-Policy": _POLICY, "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
        "Cache-Control": "no-store", "Cross-Origin-Opener-Policy": "same-origin",
    }  # fmt: skip
    return Response(data, media_type=kind, headers=fixed | headers)


def _language(connection: HTTPConnection, usual: Language) -> Language:
    wanted = connection.query_params.get("lang", "")
    return next((language for language in LANGUAGES if language == wanted), usual)


async def _shell(state: ServerState, request: Request) -> Response:
    if "token" in request.query_params:
        # a token in the address is visible to others, in a cookie it is not
        answer: Response = RedirectResponse(f"/?lang={_language(request, state.language)}", 303)
        answer.set_cookie(f"{_COOKIE}-{state.port}", state.token, httponly=True, samesite="strict")
        return answer
    return _sealed(shell(_language(request, state.language)), "text/html")


async def _script(_: ServerState, __: Request) -> Response:
    return _sealed(script("studio"), "text/javascript")


async def _steps(state: ServerState, request: Request) -> Response:
    steps = state.steps.get(request.path_params["name"])
    return PlainTextResponse("", HTTPStatus.NOT_FOUND) if steps is None else _sealed(steps, "text/javascript")


async def _styles(_: Request) -> Response:
    return _sealed(styles(), "text/css")


async def _export(state: ServerState, request: Request) -> Response:
    """Answer with a machine as a file."""
    wanted = await _posted(request, {"text": str, "name": str})
    if isinstance(wanted, HTTPStatus):
        return PlainTextResponse("", wanted)
    language = _language(request, state.language)
    session = Session(language, state.place(wanted), reads=bool(wanted.get("reads")))
    try:
        data = await run_in_threadpool(session.export, wanted["text"], wanted["name"])
    except CrankworkError as error:
        return PlainTextResponse(in_language(error.args[0], language), HTTPStatus.UNPROCESSABLE_ENTITY)
    return _sealed(data, "application/octet-stream", **{"Content-Disposition": "attachment"})


async def _posted(request: Request, fields: Mapping[str, type]) -> dict[str, Any] | HTTPStatus:
    """Return the posted data, or the status of an invalid request."""
    data = b""
    async for part in request.stream():
        data += part
        if len(data) > _MAX_MESSAGE:
            return HTTPStatus.REQUEST_ENTITY_TOO_LARGE
    message = _read(data)
    is_valid = (
        isinstance(message, dict)
        and isinstance(message.get("objectives", {}), dict)
        and all(isinstance(message.get(name), kind) for name, kind in fields.items())
    )
    return message if is_valid else HTTPStatus.BAD_REQUEST


async def _trial(state: ServerState, request: Request) -> Response:
    """Stream the progress of a map or a sweep and its result as lines; it stops if the client disconnects."""
    wanted = await _posted(request, {"text": str, "over": dict})
    if isinstance(wanted, HTTPStatus):
        return PlainTextResponse("", wanted)
    session = Session(_language(request, state.language), state.place(wanted), reads=bool(wanted.get("reads")))
    return StreamingResponse(_lines(session, wanted), media_type="application/x-ndjson")


async def _lines(session: Session, request: dict[str, Any]) -> AsyncIterator[str]:
    loop, stopped = asyncio.get_running_loop(), threading.Event()
    waiting: asyncio.Queue[dict[str, Any]] = asyncio.Queue()

    def send(line: dict[str, Any]) -> None:
        loop.call_soon_threadsafe(waiting.put_nowait, line)

    def progress(share: float) -> None:
        if stopped.is_set():
            raise StoppedError
        send({"done": share})

    def work() -> None:
        try:
            send({"found": session.run_experiment(request, progress)})
        except StoppedError:
            pass
        except Exception:  # noqa: BLE001 - any failure of a calculation is reported, and the page goes on
            _log.exception("a trial failed")
            send(
                {"found": {"refusals": [{"text": translate("studio.failed", session.language), "key": "", "line": 0}]}}
            )

    working = asyncio.create_task(run_in_threadpool(work))
    try:
        line: dict[str, Any] = {}
        while "found" not in line:
            line = await waiting.get()
            yield f"{json.dumps(line, ensure_ascii=False)}\n"
        await working
    finally:
        stopped.set()


async def _talk(state: ServerState, socket_: WebSocket) -> None:
    """Answer the messages of one page in order."""
    await socket_.accept()
    state.pages += 1
    language = _language(socket_, state.language)
    session = Session(language)
    try:
        await _send(socket_, await run_in_threadpool(state.initial_page, language))
        while True:
            request = _request(await socket_.receive_text())
            if request is None:
                await socket_.close(1003)
                return
            await _send(socket_, {"n": request["n"], **await run_in_threadpool(_answer, state, session, request)})
    except (WebSocketDisconnect, RuntimeError):
        pass
    finally:
        state.pages -= 1
        state.left = time.monotonic()


async def _send(socket_: WebSocket, answer: dict[str, Any]) -> None:
    await socket_.send_text(json.dumps(answer, ensure_ascii=False, separators=(",", ":")))


_FIELDS: dict[str, dict[str, type]] = {
    "show": {"text": str}, "set": {"text": str, "fields": dict}, "without": {"text": str, "key": str},
    "explain": {"text": str, "key": str}, "add": {"text": str, "key": str}, "ahead": {"text": str, "key": str},
    "template": {"name": str}, "shared": {"word": str}, "sketch": {"pins": list, "links": list},
    "missing": {"pins": list, "links": list, "typed": list},
    "reach": {"text": str, "key": str}, "swap": {"text": str, "key": str},
    "save": {"text": str, "kept": str, "name": str}, "disk": {"kept": str}, "recent": {"name": str},
}  # fmt: skip


def _read(message: str | bytes) -> Any:  # noqa: ANN401 - whatever was sent
    """Parse a message, None if it is not JSON; an unpaired surrogate becomes `?`."""
    try:
        return json.loads(json.dumps(json.loads(message), ensure_ascii=False).encode("utf-8", "replace"))
    except (ValueError, RecursionError):
        return None


def _request(message: str) -> dict[str, Any] | None:
    """Return a valid request from a message, otherwise None."""
    data = _read(message)
    if not isinstance(data, dict) or not isinstance(data.get("n"), int):
        return None
    wanted = _FIELDS.get(data["do"]) if isinstance(data.get("do"), str) else None
    if wanted is None or not all(isinstance(data.get(name), kind) for name, kind in wanted.items()):
        return None
    listed = data.get("figures") or []
    fields = data.get("fields", {})
    is_valid = (
        isinstance(data.get("before", {}), dict)
        and isinstance(fields, dict)
        and isinstance(data.get("wide", 0), int | float)
        and isinstance(listed, list)
    )
    return data if is_valid and all(isinstance(text, str) for text in (*listed, *fields.values())) else None


def _answer(state: ServerState, session: Session, request: dict[str, Any]) -> dict[str, Any]:
    """Return the answer to a request; errors are reported, and the session goes on."""
    try:
        match request["do"]:
            case "save":
                return state.save(request)
            case "disk":
                return state.check_file(request)
            case "recent":
                return state.reopen(request["name"])
        session.set_file(state.place(request), reads=bool(request.get("reads")))
        answer = session.answer(request)
        return {**answer, "steps": state.script(answer["steps"])} if "steps" in answer else answer
    except CrankworkError as error:
        # a deleted file is removed from the recent ones
        offered = {"recent": named(recent())} if request["do"] == "recent" else {}
        return {"refusals": [{"text": in_language(error.args[0], session.language), "key": "", "line": 0}], **offered}
    except Exception:  # noqa: BLE001 - any failure of a calculation is reported, and the page goes on
        _log.exception("an answer failed")
        return {"refusals": [{"text": translate("studio.failed", session.language), "key": "", "line": 0}]}


def serve(opening: StartupOptions, language: Language, port: int, *, opens: bool, says: Callable[[str], None]) -> None:
    """Run the studio until its last page is closed, or until it is interrupted."""
    state = ServerState(opening, language, keeps_running=not opens)
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, port))
            # requests may arrive as soon as the address is printed
            listening.listen(64)
        except OSError as error:
            raise CrankworkError(
                ErrorMessage("port_taken", port=str(port), reason=(error.strerror or "unknown reason").lower())
            ) from None
        state.port = listening.getsockname()[1]
        address = f"http://{HOST}:{state.port}/?token={state.token}"
        says(address)
        asyncio.run(_run(state, listening, address if opens else ""))


async def _run(state: ServerState, listening: socket.socket, address: str) -> None:
    config = uvicorn.Config(
        application(state), log_level="critical", access_log=False, ws="websockets-sansio", ws_max_size=_MAX_MESSAGE,
        lifespan="off", server_header=False, date_header=False,
    )  # fmt: skip
    server = uvicorn.Server(config)
    if address:
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
        # time for the browser to start
        state.left = time.monotonic() + 60
    watching = asyncio.create_task(_watch(state, server))
    await server.serve([listening])
    watching.cancel()


async def _watch(state: ServerState, server: uvicorn.Server) -> None:
    while not state.is_idle:
        await asyncio.sleep(0.5)
    server.should_exit = True

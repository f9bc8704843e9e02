"""The server of the studio: this machine alone, one page at a time told what it asks, nobody else let in."""

from __future__ import annotations

import asyncio
import hashlib
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
from starlette.datastructures import Headers
from starlette.requests import HTTPConnection, Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response, StreamingResponse
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from crankwork import files
from crankwork.browser import script
from crankwork.description.machine_file import template
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES, Language, Refusal, say, told
from crankwork.studio.answers import Studio
from crankwork.studio.recent import Recent, named, recent
from crankwork.studio.shell import shell, styles
from crankwork.studio.trials import StoppedError

HOST = "127.0.0.1"
# what one message may hold: a machine file, escaped, and what is asked of it [bytes]
_LONGEST = 1 << 20
_COOKIE = "crankwork"
_FIRST = "four-bar"
# for how long after the last page has gone the server waits for one to come back [s]
_LINGERS = 3.0
# scripts of calculations that are kept at most
_SCRIPTS = 64
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_log = logging.getLogger(__name__)


class Opening(NamedTuple):
    """What the studio begins with: a text, or a template where there is none, and the file that it stands in."""

    text: str = ""
    path: Path | None = None


class Rooms:
    """What the pages of one server share: who may come in, the file on disk, how many pages there are."""

    def __init__(self, opening: Opening, language: Language, *, lingers: bool = False) -> None:
        self.opening, self.language, self.lingers = opening, language, lingers
        self.token, self.port = secrets.token_urlsafe(24), 0
        self.pages, self.left = 0, time.monotonic()
        # files that were opened here
        self.paths = {str(opening.path)} if opening.path else set()
        # what pages calculate with, by its digest; they fetch it at once
        self.steps: dict[str, str] = {}

    def hosts(self) -> tuple[str, ...]:
        """Return what a browser of this machine calls the server."""
        return f"{HOST}:{self.port}", f"localhost:{self.port}"

    @property
    def deserted(self) -> bool:
        """Whether the last page has been gone for a while."""
        return not self.lingers and self.pages == 0 and time.monotonic() - self.left > _LINGERS

    def first(self, language: Language) -> dict[str, Any]:
        """Return what a page begins with."""
        text, path = self.opening
        if path is not None:
            # another page may have saved it meanwhile
            text = _on_disk(path) or text
        seen = recent(None if path is None else Recent(str(path)))
        return {"text": text or template(_FIRST, language), "path": str(path or ""), "recent": named(seen)}

    def place(self, asked: Mapping[str, Any]) -> Path | None:
        """Return the file that a page says its text stands in, if it was opened here or before."""
        path = asked.get("path")
        if not path or not isinstance(path, str):
            return None
        is_known = path in self.paths or any(one == (path, None) for one in recent())
        return Path(path) if is_known else None

    def again(self, name: str) -> dict[str, Any]:
        """Return a machine that was opened before, with its file where it stands in one."""
        one = next((one for one in recent() if one.name == name), None)
        if one is None:
            raise CrankworkError(Refusal("recent_none", name=name[:200]))
        text, path = one.text, ""
        if text is None:
            text, path = files.read_text(name, advice=Refusal("check_recent")), name
            self.paths.add(path)
        return {"text": text, "path": path, "recent": named(recent(one))}

    def save(self, asked: dict[str, Any]) -> dict[str, Any]:
        """Write the text into its file, unless somebody else has changed that; keep one that stands in none."""
        path, text = self.place(asked), asked["text"]
        if path is None:
            return {"handed": True, "recent": named(recent(Recent(asked["name"], text)))}
        if not asked.get("anyway") and (found := _on_disk(path)) != asked["kept"]:
            return {"gone": True} if found is None else {"conflict": str(path)}
        files.write_files({path: text.encode()}, save=True)
        return {"saved": str(path)}

    def script(self, steps: str) -> str:
        """Keep a script for the page that was told of it, and return its name."""
        name = hashlib.sha256(steps.encode()).hexdigest()[:32]
        self.steps = dict([*self.steps.items(), (name, steps)][-_SCRIPTS:])
        return name

    def disk(self, asked: dict[str, Any]) -> dict[str, Any]:
        """Return whether somebody else has changed the file, or what stands in it."""
        text = _on_disk(self.place(asked))
        if text is None:
            return {"gone": True}
        return {"text": text} if asked.get("take") else {"changed": text != asked["kept"]}


def _on_disk(path: Path | None) -> str | None:
    """Return what stands in a file, None where it has gone."""
    try:
        return None if path is None else files.read_text(path)
    except CrankworkError:
        return None


class _Guard:
    """Lets in who asks this machine by its own name, from its own page, with the token."""

    def __init__(self, app: ASGIApp, rooms: Rooms) -> None:
        self._app, self._rooms = app, rooms

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        refused = self._refused(HTTPConnection(scope))
        if refused is None:
            await self._app(scope, receive, send)
        else:
            # a socket that is refused before it opens is told so by its status too
            answer = PlainTextResponse(refused.phrase, refused)
            await answer(scope, receive, send)

    def _refused(self, asked: HTTPConnection) -> HTTPStatus | None:
        rooms, headers = self._rooms, asked.headers
        if headers.get("host", "") not in rooms.hosts():
            return HTTPStatus.BAD_REQUEST
        is_reading = asked.scope["type"] == "http" and asked.scope["method"] in ("GET", "HEAD")
        if not is_reading and not self._from_own_page(headers):
            return HTTPStatus.FORBIDDEN
        # the cookie may be that of a server that was here before
        told = asked.query_params.get("token", ""), asked.cookies.get(f"{_COOKIE}-{rooms.port}", "")
        is_known = any(secrets.compare_digest(one.encode(), rooms.token.encode()) for one in told)
        return None if is_known else HTTPStatus.UNAUTHORIZED

    def _from_own_page(self, headers: Headers) -> bool:
        return headers.get("origin", "") in {f"http://{one}" for one in self._rooms.hosts()}


def application(rooms: Rooms) -> ASGIApp:
    """Return the studio as an application of a server."""
    routes = [
        Route("/", partial(_shell, rooms)),
        Route("/studio.js", partial(_script, rooms)),
        Route("/steps/{name}.js", partial(_steps, rooms)),
        Route("/studio.css", _styles),
        Route("/export", partial(_export, rooms), methods=["POST"]),
        Route("/trial", partial(_trial, rooms), methods=["POST"]),
        WebSocketRoute("/talk", partial(_talk, rooms)),
    ]
    return _Guard(Starlette(routes=routes), rooms)


def _sealed(data: bytes | str, kind: str, **headers: str) -> Response:
    """Return data with what a browser is allowed to do with it."""
    fixed = {
        "Content-Security-Policy": _POLICY, "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
        "Cache-Control": "no-store", "Cross-Origin-Opener-Policy": "same-origin",
    }  # fmt: skip
    return Response(data, media_type=kind, headers=fixed | headers)


def _language(asked: HTTPConnection, usual: Language) -> Language:
    wanted = asked.query_params.get("lang", "")
    return next((one for one in LANGUAGES if one == wanted), usual)


async def _shell(rooms: Rooms, asked: Request) -> Response:
    if "token" in asked.query_params:
        # what stands in the address is seen by others, what is kept in a cookie is not
        answer: Response = RedirectResponse(f"/?lang={_language(asked, rooms.language)}", 303)
        answer.set_cookie(f"{_COOKIE}-{rooms.port}", rooms.token, httponly=True, samesite="strict")
        return answer
    return _sealed(shell(_language(asked, rooms.language)), "text/html")


async def _script(_: Rooms, __: Request) -> Response:
    return _sealed(script("studio"), "text/javascript")


async def _steps(rooms: Rooms, asked: Request) -> Response:
    steps = rooms.steps.get(asked.path_params["name"])
    return PlainTextResponse("", HTTPStatus.NOT_FOUND) if steps is None else _sealed(steps, "text/javascript")


async def _styles(_: Request) -> Response:
    return _sealed(styles(), "text/css")


async def _export(rooms: Rooms, asked: Request) -> Response:
    """Answer with a machine as a file."""
    wanted = await _posted(asked, {"text": str, "name": str})
    if isinstance(wanted, HTTPStatus):
        return PlainTextResponse("", wanted)
    language = _language(asked, rooms.language)
    studio = Studio(language, rooms.place(wanted), reads=bool(wanted.get("reads")))
    try:
        found = await run_in_threadpool(studio.export, wanted["text"], wanted["name"])
    except CrankworkError as error:
        return PlainTextResponse(told(error.args[0], language), HTTPStatus.UNPROCESSABLE_ENTITY)
    return _sealed(found, "application/octet-stream", **{"Content-Disposition": "attachment"})


async def _posted(asked: Request, fields: Mapping[str, type]) -> dict[str, Any] | HTTPStatus:
    """Return what was sent, or what is answered where it makes no sense."""
    data = b""
    async for part in asked.stream():
        data += part
        if len(data) > _LONGEST:
            return HTTPStatus.REQUEST_ENTITY_TOO_LARGE
    found = _read(data)
    is_sound = (
        isinstance(found, dict)
        and isinstance(found.get("objectives", {}), dict)
        and all(isinstance(found.get(name), kind) for name, kind in fields.items())
    )
    return found if is_sound else HTTPStatus.BAD_REQUEST


async def _trial(rooms: Rooms, asked: Request) -> Response:
    """Answer with lines: how far a map or a sweep has come, and at last what it has found; it ends with who asked."""
    wanted = await _posted(asked, {"text": str, "over": dict})
    if isinstance(wanted, HTTPStatus):
        return PlainTextResponse("", wanted)
    studio = Studio(_language(asked, rooms.language), rooms.place(wanted), reads=bool(wanted.get("reads")))
    return StreamingResponse(_lines(studio, wanted), media_type="application/x-ndjson")


async def _lines(studio: Studio, asked: dict[str, Any]) -> AsyncIterator[str]:
    loop, stopped = asyncio.get_running_loop(), threading.Event()
    waiting: asyncio.Queue[dict[str, Any]] = asyncio.Queue()

    def tell(one: dict[str, Any]) -> None:
        loop.call_soon_threadsafe(waiting.put_nowait, one)

    def told(share: float) -> None:
        if stopped.is_set():
            raise StoppedError
        tell({"done": share})

    def work() -> None:
        try:
            tell({"found": studio.tried(asked, told)})
        except StoppedError:
            pass
        except Exception:  # noqa: BLE001 - whatever fails in one calculation is told, and the page lives on
            _log.exception("a trial failed")
            tell({"found": {"refusals": [{"text": say("studio.failed", studio.language), "key": "", "line": 0}]}})

    working = asyncio.create_task(run_in_threadpool(work))
    try:
        one: dict[str, Any] = {}
        while "found" not in one:
            one = await waiting.get()
            yield f"{json.dumps(one, ensure_ascii=False)}\n"
        await working
    finally:
        stopped.set()


async def _talk(rooms: Rooms, socket_: WebSocket) -> None:
    """Answer one page: each message once, in the order in which they come."""
    await socket_.accept()
    rooms.pages += 1
    language = _language(socket_, rooms.language)
    studio = Studio(language)
    try:
        await _send(socket_, await run_in_threadpool(rooms.first, language))
        while True:
            asked = _asked(await socket_.receive_text())
            if asked is None:
                await socket_.close(1003)
                return
            await _send(socket_, {"n": asked["n"], **await run_in_threadpool(_answer, rooms, studio, asked)})
    except (WebSocketDisconnect, RuntimeError):
        pass
    finally:
        rooms.pages -= 1
        rooms.left = time.monotonic()


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
    """Return what a message states, None where it makes no sense; half a letter, which nobody writes, becomes `?`."""
    try:
        return json.loads(json.dumps(json.loads(message), ensure_ascii=False).encode("utf-8", "replace"))
    except (ValueError, RecursionError):
        return None


def _asked(message: str) -> dict[str, Any] | None:
    """Return what a message asks for, None where it makes no sense."""
    found = _read(message)
    if not isinstance(found, dict) or not isinstance(found.get("n"), int):
        return None
    wanted = _FIELDS.get(found["do"]) if isinstance(found.get("do"), str) else None
    if wanted is None or not all(isinstance(found.get(name), kind) for name, kind in wanted.items()):
        return None
    listed = found.get("figures") or []
    fields = found.get("fields", {})
    is_sound = (
        isinstance(found.get("before", {}), dict)
        and isinstance(listed, list)
        and all(isinstance(one, str) for one in listed)
    )
    return found if is_sound and all(isinstance(one, str) for one in fields.values()) else None


def _answer(rooms: Rooms, studio: Studio, asked: dict[str, Any]) -> dict[str, Any]:
    """Return the answer to a message; what fails in it is told, and the next one is answered again."""
    try:
        match asked["do"]:
            case "save":
                return rooms.save(asked)
            case "disk":
                return rooms.disk(asked)
            case "recent":
                return rooms.again(asked["name"])
        studio.stand(rooms.place(asked), reads=bool(asked.get("reads")))
        found = studio.answer(asked)
        return {**found, "steps": rooms.script(found["steps"])} if "steps" in found else found
    except CrankworkError as error:
        # a file that has gone is offered no more
        offered = {"recent": named(recent())} if asked["do"] == "recent" else {}
        return {"refusals": [{"text": told(error.args[0], studio.language), "key": "", "line": 0}], **offered}
    except Exception:  # noqa: BLE001 - whatever fails in one calculation is told, and the page lives on
        _log.exception("an answer failed")
        return {"refusals": [{"text": say("studio.failed", studio.language), "key": "", "line": 0}]}


def serve(opening: Opening, language: Language, port: int, *, opens: bool, says: Callable[[str], None]) -> None:
    """Run the studio until its last page has gone, or until it is interrupted."""
    rooms = Rooms(opening, language, lingers=not opens)
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, port))
            # who reads the address may come at once
            listening.listen(64)
        except OSError as error:
            raise CrankworkError(
                Refusal("port_taken", port=str(port), reason=(error.strerror or "unknown reason").lower())
            ) from None
        rooms.port = listening.getsockname()[1]
        address = f"http://{HOST}:{rooms.port}/?token={rooms.token}"
        says(address)
        asyncio.run(_run(rooms, listening, address if opens else ""))


async def _run(rooms: Rooms, listening: socket.socket, address: str) -> None:
    server = uvicorn.Server(
        uvicorn.Config(
            application(rooms), log_level="critical", access_log=False, ws="websockets-sansio", ws_max_size=_LONGEST,
            lifespan="off", server_header=False, date_header=False,
        )
    )  # fmt: skip
    if address:
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
        # a browser takes its time
        rooms.left = time.monotonic() + 60
    watching = asyncio.create_task(_watch(rooms, server))
    await server.serve([listening])
    watching.cancel()


async def _watch(rooms: Rooms, server: uvicorn.Server) -> None:
    while not rooms.deserted:
        await asyncio.sleep(0.5)
    server.should_exit = True

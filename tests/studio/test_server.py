"""Who is let into the studio, and what comes of messages that make no sense."""

from __future__ import annotations

import http.client
import json
import random
import string
import time
from contextlib import closing, suppress

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from crankwork.browser import script
from crankwork.description.machine_file import template
from crankwork.studio.server import styles


def asked(started, path, method="GET", body=None, **headers):
    host = started.address.removeprefix("http://").rstrip("/")
    own = {"Host": host, "Cookie": f"crankwork-{host.rpartition(':')[2]}={started.token}"}
    headers = {name.replace("_", "-"): value for name, value in headers.items()}
    data = (body or "").encode()
    with closing(http.client.HTTPConnection(host, timeout=60)) as talk:
        talk.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in {**own, **headers, "Content-Length": str(len(data))}.items():
            if value:
                talk.putheader(name, value)
        talk.endheaders(data)
        answer = talk.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()


def talked(started, **changed):
    address = started.address
    own = {"Cookie": f"crankwork-{address.rpartition(':')[2].rstrip('/')}={started.token}"}
    origin = changed.pop("origin", address.rstrip("/"))
    return connect(f"ws{address.removeprefix('http')}talk", additional_headers={**own, **changed}, origin=origin,
                   max_size=None, open_timeout=60)  # fmt: skip


def test_who_asks_by_another_name_or_without_the_token_is_refused(started):
    own = started.address.rstrip("/")
    body = json.dumps({"text": template("four-bar"), "name": "tables.xlsx"})
    assert asked(started, "/")[0] == 200
    assert asked(started, "/", Host="crankwork.example")[0] == 400
    assert asked(started, "/", Cookie="")[0] == 401
    assert asked(started, "/", Cookie="crankwork-1=abc")[0] == 401
    assert asked(started, "/?token=wrong", Cookie="")[0] == 401
    # a cookie of a server that had this port before keeps nobody out
    port = started.address.rpartition(":")[2].rstrip("/")
    assert asked(started, f"/?token={started.token}", Cookie=f"crankwork-{port}=old")[0] == 303
    assert asked(started, "/export", "POST", body)[0] == 403
    assert asked(started, "/export", "POST", body, Origin="http://crankwork.example")[0] == 403
    assert asked(started, "/export", "POST", body, Origin=own)[0] == 200
    assert asked(started, "/export", "POST", "[1]", Origin=own)[0] == 400
    assert asked(started, "/export", "POST", "x" * (10 << 20), Origin=own)[0] == 413
    for path in ("/../pyproject.toml", "/%2e%2e/pyproject.toml", "/studio.js/../../x", "/static//etc/passwd"):
        assert asked(started, path)[0] == 404


def test_a_socket_is_opened_to_its_own_page_alone(started):
    for changed, status in (
        ({"origin": "http://crankwork.example"}, 403),
        ({"origin": None}, 403),
        ({"Cookie": ""}, 401),
    ):
        with pytest.raises(InvalidStatus) as refused, talked(started, **changed):
            pass
        assert refused.value.response.status_code == status
    with talked(started) as socket:
        assert "four-bar" in json.loads(socket.recv())["text"].lower()


def test_half_a_letter_is_answered_as_any_other(started):
    own, text = started.address.rstrip("/"), template("four-bar")
    with talked(started) as socket:
        socket.recv()
        for n, asks in enumerate(({"do": "explain", "key": "\ud800"}, {"do": "set", "fields": {"title": "\ud800"}})):
            socket.send(json.dumps({"n": n, "text": text, **asks}))
            assert json.loads(socket.recv())["n"] == n
    assert asked(started, "/export", "POST", json.dumps({"text": text, "name": "\ud800.svg"}), Origin=own)[0] == 422
    body = json.dumps({"text": text, "over": {"\ud800": "1..2"}})
    status, _, told = asked(started, "/trial", "POST", body, Origin=own)
    assert status == 200
    assert "refusals" in json.loads(told.splitlines()[-1])["found"]
    body = json.dumps({"text": text, "over": {}, "objectives": [1]})
    assert asked(started, "/trial", "POST", body, Origin=own)[0] == 400


def test_the_page_may_run_no_text_as_script_and_ask_nobody(started):
    _, headers, _ = asked(started, "/")
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "unsafe-eval" not in policy
    assert "script-src 'self'" in policy
    status, headers, _ = asked(started, f"/?token={started.token}", Cookie="")
    assert status == 303
    assert "HttpOnly" in headers["set-cookie"]
    assert "SameSite=strict" in headers["set-cookie"]
    assert started.token not in headers["location"]


@pytest.mark.slow
def test_messages_without_sense_end_a_talk_and_nothing_else(started):
    chance = random.Random(5)  # noqa: S311 - nothing is secret
    for _ in range(400):
        kind = chance.randrange(4)
        if kind == 0:
            message = "".join(chance.choices(string.printable, k=chance.randrange(200)))
        elif kind == 1:
            message = json.dumps({"n": chance.choice([1, "1", None]), "do": chance.choice(["show", "set", "x", 3])})
        elif kind == 2:
            message = json.dumps({"n": 1, "do": "set", "text": "", "fields": {"a..b[": 3, "[": []}})
        else:
            message = "[" * chance.randrange(1, 100_000)
        with talked(started) as socket:
            socket.recv()
            socket.send(message)
            with suppress(ConnectionClosed):
                assert json.loads(socket.recv(timeout=60))["refusals"]


def test_a_message_of_ten_megabytes_is_refused(started):
    with talked(started) as socket:
        socket.recv()
        with suppress(ConnectionClosed):
            socket.send("x" * (10 << 20))
        with pytest.raises(ConnectionClosed) as closed:
            socket.recv(timeout=60)
    assert closed.value.rcvd.code == 1009


def test_what_fails_in_a_calculation_is_told_and_the_next_one_is_answered(monkeypatch):
    from crankwork.studio import server
    from crankwork.studio.session import Session

    for wrong in ({"fields": []}, {"wide": "x"}):
        assert server._request(json.dumps({"n": 1, "do": "show", "text": "", **wrong})) is None
    rooms = server.ServerState(server.StartupOptions(""), "en")
    studio = Session("en")
    monkeypatch.setattr(studio, "_show", lambda _: 1 / 0)
    found = server._answer(rooms, studio, {"n": 1, "do": "show", "text": ""})
    assert "inside crankwork" in found["refusals"][0]["text"]
    monkeypatch.undo()
    assert "data" in server._answer(rooms, studio, {"n": 2, "do": "show", "text": template("four-bar")})


def test_a_file_is_saved_with_its_comments_and_never_over_what_somebody_wrote(tmp_path, start):
    path = tmp_path / "my machine.toml"
    text = template("four-bar")
    path.write_text(text, encoding="utf-8")
    with start(tmp_path, str(path)) as started, talked(started) as socket:
        assert json.loads(socket.recv())["path"] == str(path)

        def ask(**question):
            own = {"n": 1, "text": text, "path": str(path), "kept": text, "name": "mine"}
            socket.send(json.dumps({**own, **question}))
            return json.loads(socket.recv())

        changed = ask(do="set", fields={"crank.radius": "60 mm"})["text"]
        assert ask(do="save", text=changed) == {"n": 1, "saved": str(path)}
        assert path.read_text("utf-8") == changed
        assert changed == text.replace('"62.5 mm"', '"60 mm"')
        assert ask(do="disk", kept=changed) == {"n": 1, "changed": False}
        # another page has not seen that
        assert ask(do="save") == {"n": 1, "conflict": str(path)}
        path.write_text("# somebody else\n", encoding="utf-8")
        assert ask(do="disk", kept=changed) == {"n": 1, "changed": True}
        assert ask(do="save", kept=changed) == {"n": 1, "conflict": str(path)}
        assert path.read_text("utf-8") == "# somebody else\n"
        assert ask(do="disk", take=True)["text"] == "# somebody else\n"
        assert ask(do="save", anyway=True)["saved"]
        assert path.read_text("utf-8") == text
        path.unlink()
        assert ask(do="save") == {"n": 1, "gone": True}
        assert ask(do="save", anyway=True)["saved"]


def test_two_pages_do_not_disturb_each_other(started):
    with talked(started) as one, talked(started) as other:
        one.recv(), other.recv()
        for number, (socket, name) in enumerate([(one, "engine"), (other, "press"), (one, "engine"), (other, "press")]):
            socket.send(json.dumps({"n": number, "do": "template", "name": name}))
        titles = [json.loads(socket.recv())["title"] for socket in (one, one, other, other)]
    assert titles[0] == titles[1] != titles[2] == titles[3]


def test_the_studio_ends_after_its_last_page_has_gone():
    from crankwork.studio import server

    rooms = server.ServerState(server.StartupOptions(""), "en")
    assert not rooms.is_idle
    rooms.left = time.monotonic() - 60
    assert rooms.is_idle
    rooms.pages = 1
    assert not rooms.is_idle
    assert not server.ServerState(server.StartupOptions(""), "en", keeps_running=True).is_idle


def test_script_and_style_are_small() -> None:
    assert len(script("studio").encode()) + len(styles().encode()) <= 165_000

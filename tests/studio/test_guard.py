"""Who may ask: the server's own page under the server's own name, and nothing outside the web folder."""

from __future__ import annotations

import http.client

import pytest

UPGRADE = {
    "connection": "Upgrade",
    "upgrade": "websocket",
    "sec-websocket-version": "13",
    "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ==",
}


def asked(server, path, method="GET", headers=(), body=None):
    """Return status, headers and text of the answer to exactly these headers; OWN stands for the address."""
    connection = http.client.HTTPConnection(server.address, timeout=60)
    pairs = list(headers.items()) if isinstance(headers, dict) else list(headers)
    connection.putrequest(method, path, skip_host=any(name == "host" for name, _ in pairs))
    port = server.address.partition(":")[2]
    for name, value in pairs:
        connection.putheader(name, value.replace("PORT", port))
    if body is not None:
        connection.putheader("content-length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    found = answer.status, dict(answer.getheaders())
    text = "" if answer.status == 101 else answer.read().decode("utf-8", "replace")
    connection.close()
    return *found, text


REFUSED = [
    {"host": "evil.example"},
    {"host": "127.0.0.1.evil.example:PORT"},
    {"host": "evil.example:PORT", "origin": "http://evil.example:PORT"},
    {"origin": "http://evil.example"},
    {"origin": "null"},
    {"origin": "https://127.0.0.1:PORT"},
    {"origin": "http://127.0.0.1:9999"},
    {"origin": "http://localhost:PORT"},
    {"sec-fetch-site": "cross-site"},
    {"sec-fetch-site": "same-site"},
]
ALLOWED = [
    {},
    {"origin": "http://127.0.0.1:PORT"},
    {"host": "localhost:PORT", "origin": "http://localhost:PORT"},
    {"host": "[::1]:PORT"},
    {"sec-fetch-site": "none"},
    {"sec-fetch-site": "same-origin"},
]


@pytest.mark.parametrize("headers", REFUSED)
def test_others_are_refused(server, headers):
    assert asked(server, "/", headers=headers)[0] == 403
    assert asked(server, "/api/session/a/project", "POST", headers, b"{}")[0] == 403
    assert asked(server, "/ws/a", headers={**UPGRADE, **headers})[0] == 403


@pytest.mark.parametrize("headers", ALLOWED)
def test_the_page_is_let_in_and_may_load_nothing_from_elsewhere(server, headers):
    status, held, _ = asked(server, "/", headers=headers)
    assert status == 200
    assert "default-src 'none'" in held["content-security-policy"]
    assert "http" not in held["content-security-policy"]
    assert held["x-content-type-options"] == "nosniff"
    assert asked(server, "/ws/a", headers={**UPGRADE, **headers})[0] == 101


def test_two_hosts_or_origins_are_none(server):
    doubled = [("host", "127.0.0.1:PORT"), ("host", "evil.example")]
    assert asked(server, "/", headers=doubled)[0] in (400, 403)
    origins = [("origin", "http://127.0.0.1:PORT"), ("origin", "http://evil.example")]
    assert asked(server, "/", headers=origins)[0] == 403


OUTSIDE = [
    "/web/../api.py",
    "/web/%2e%2e/api.py",
    "/web/..%2fapi.py",
    "/web//etc/passwd",
    "/web/%2fetc%2fpasswd",
    "/web/..%5capi.py",
    "/web/%00",
    "/web/__init__.py",
    "/api/session/../take/1/sound.wav",
    "/api/session/%2e%2e/project",
    "/api/session/a/export/1/..%2f..%2fproject.json",
    "/api/session/a/export/1/%2fetc%2fpasswd",
    "/api/session/A_B/project",
    f"/api/session/{'a' * 41}/project",
]


@pytest.mark.parametrize("path", OUTSIDE)
def test_nothing_outside_can_be_fetched(server, path):
    status, _, text = asked(server, path)
    assert status in (400, 404)
    assert "import" not in text
    assert "root:" not in text


@pytest.mark.parametrize("name", ["..", "%2e%2e", "a%2fb", "A", "a%20b", "%c3%a9", "-a", "a" * 41])
def test_a_session_has_a_plain_name(server, name):
    assert asked(server, f"/ws/{name}", headers=UPGRADE)[0] in (403, 404)
    assert set(server.studio.sessions) <= {"a"}


def test_heads_are_named_not_opened(server):
    for name in ("/etc", "../heads", "nobody"):
        status, _, text = asked(server, f"/api/head?head={name}")
        assert status == 404
        assert "unknown head" in text
    assert "is not a number" in asked(server, "/api/stage?age=old")[2]

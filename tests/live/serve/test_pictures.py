"""Draft pictures for browsers without a graphics card: what can be asked for, and what is drawn."""

from __future__ import annotations

import io
from collections.abc import Iterator
from urllib.error import HTTPError
from urllib.parse import urlencode
from urllib.request import Request, urlopen

import numpy as np
import pytest
from PIL import Image

from risorius.core.arrays import Array
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.live.serve import pictures

from .running import Running, running

TOKEN = "a token of some length"
VALUES = ",".join(f"{value:g}" for value in NEUTRAL)
FRONT = {"eye": "0,0,980", "target": "0,0,30", "field": "18"}


@pytest.fixture(scope="module")
def server() -> Iterator[Running]:
    with running() as made:
        yield made


def asked(server: Running, headers: dict[str, str] | None = None, **query: object) -> tuple[int, bytes]:
    address = f"http://127.0.0.1:{server.port}/picture.webp?{urlencode({'values': VALUES} | query)}"
    try:
        with urlopen(Request(address, headers=headers or {})) as answer:
            return answer.status, answer.read()
    except HTTPError as error:
        with error:
            return error.code, error.read()


def picture(server: Running, **query: object) -> Array:
    status, data = asked(server, **query)
    assert status == 200, data
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA")).astype(float)


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ({"values": "1,2,3"}, "expected 46 numbers"),
        ({"values": VALUES.replace("0", "nan", 1)}, "expected 46 numbers"),
        ({"values": VALUES.replace("0", "x", 1)}, "expected 46 numbers"),
        ({"head": "../../etc/passwd"}, "unknown head"),
        ({"hair": "nothing known"}, "hair"),
        ({"age": "old"}, "age 'old'; expected 1 numbers"),
        ({"width": "1e99"}, "width"),
        (FRONT | {"eye": "0,980,30"}, "straight up or down"),
        (FRONT | {"field": "0"}, "field of view"),
    ],
)
def test_what_cannot_be_drawn_is_refused(server: Running, query: dict[str, object], said: str) -> None:
    status, text = asked(server, **query)
    assert status == 400
    assert said in text.decode()
    assert text.count(b"\n") == 1


def test_a_picture_shows_the_face_from_the_camera(server: Running) -> None:
    rest = picture(server, width=400, **FRONT)
    assert rest.shape == (360, 400, 4)
    assert rest[0, 0, 3] == 0
    assert rest[180, 200, 3] == 255
    wide = NEUTRAL.copy()
    wide[INDEX["masseter"]] = 1.0
    opened = picture(server, width=400, **FRONT, values=",".join(map(str, wide)))
    mouth, brow = slice(220, 300), slice(60, 110)
    apart = np.abs(opened - rest)[..., :3].mean(axis=(1, 2))
    assert apart[mouth].mean() > 10 * apart[brow].mean()
    side = picture(server, width=400, **FRONT | {"eye": "980,0,30"})
    assert np.abs(side - rest).mean() > 5.0


def test_sizes_are_bounded(server: Running) -> None:
    assert picture(server, width=100000).shape[:2] == (360, 1080)
    assert picture(server, width=1).shape[:2] == (360, 180)


def test_a_server_with_a_token_asks_for_it() -> None:
    with running(token=TOKEN) as made:
        assert asked(made)[0] == 403
        assert asked(made, {"authorization": "Bearer another token, as long"})[0] == 403
        assert asked(made, {"authorization": f"Bearer {TOKEN}"})[0] == 200


def test_no_more_than_a_few_wait(server: Running, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "WAITING", 0)
    assert asked(server)[0] == 503

"""From a page's message to a request: strict decoding by the table of requests."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from ..core.units import Seconds
from ..errors import InputError, RisoriusError, unknown
from ..reading.json_object import json_object, without_nulls
from ..reading.schema import build
from ..reading.source_text import SourceText, Syntax
from .request_table import EDITING, VERBS
from .wire.requests import EDITS, Preview

MOST_ID = 2**53
_BEGINNING = re.compile(r'\A\s{0,9}\{\s{0,9}"id"\s{0,9}:\s{0,9}(\d{1,16})\s{0,9},')


@dataclass(frozen=True, slots=True)
class Request:
    """A decoded request: its number, and its body as one of the dataclasses of `wire`."""

    id: int
    body: Any


class BadRequestError(RisoriusError):
    """A message that cannot be understood; `id` is its number if it has one."""

    id: int | None = None


@dataclass(frozen=True, slots=True)
class _Beside:
    """Fields of a preview beside its edit."""

    face: Seconds | None = None


def decode(text: str) -> Request:
    """Return the request that a message is; raise BadRequestError with one line on what is wrong."""
    number: int | None = None
    try:
        data = json_object(text)
        number = _number(data)
        return Request(number, _body(data))
    except RisoriusError as error:
        bad = BadRequestError(error.message)
        bad.id = _first_number(text) if number is None else number
        raise bad from None


def _first_number(text: str) -> int | None:
    """Return the number of a message that is not JSON but begins as the page's do: the page waits for it."""
    number = _BEGINNING.match(text)
    return int(number[1]) if number and int(number[1]) <= MOST_ID else None


def _number(data: dict[str, Any]) -> int:
    number = data.pop("id", None)
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number <= MOST_ID:
        raise InputError("the message has no number; expected e.g. 'id': 7")
    return number


def _body(data: dict[str, Any]) -> Any:
    done, kinds = data.pop("do", None), VERBS
    verb = done
    if done in EDITING:
        verb, kinds = data.pop("kind", None), EDITS
    if not isinstance(verb, str) or verb not in kinds:
        kind = "request" if kinds is VERBS else "edit"
        raise InputError(unknown(kind, str(verb)[:40], (*kinds, *EDITING) if kinds is VERBS else kinds))
    if done != "preview":
        return build(kinds[verb], without_nulls(data), _message(verb))
    beside = build(_Beside, without_nulls({"face": data.pop("face", None)}), _message("preview"))
    return Preview(build(kinds[verb], without_nulls(data), _message(verb)), beside.face)


def _message(verb: str) -> SourceText:
    return SourceText(verb, syntax=Syntax.JSON)

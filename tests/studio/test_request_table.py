"""The table of requests: one name for each, one row, and handlers that take what the row says."""

from __future__ import annotations

import inspect
import typing

from risorius.studio.request_table import REQUESTS, ROWS, VERBS
from risorius.studio.wire.requests import EDITS


def test_a_request_has_one_name() -> None:
    names = {row.verb: row.handler.__name__ for row in REQUESTS}
    assert names == {name: name for name in names}
    assert len(VERBS) == len(REQUESTS)
    assert not VERBS.keys() & {*EDITS, "edit", "preview"}


def test_a_handler_takes_the_message_of_its_row() -> None:
    wrong = []
    for row in REQUESTS:
        hints = typing.get_type_hints(row.handler)
        own = hints.get("request")
        if own not in (row.message, typing.Any) or inspect.iscoroutinefunction(row.handler) != row.of_page:
            wrong.append(f"{row.verb}: {own}")
    assert not wrong


def test_what_changes_the_take_is_saved() -> None:
    assert all(row.saves for row in ROWS.values() if row.changes)
    assert {row.verb for row in REQUESTS if row.saves and not row.changes} == {"save_draft", "save_view"}

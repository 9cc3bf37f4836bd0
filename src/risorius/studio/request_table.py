"""All requests of a page in one table: the message of each, its handler, and what it changes."""

from __future__ import annotations

import re
import typing
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from . import rules_fired
from .page_requests import PageRequests
from .session import queries
from .session.session import Session
from .wire import requests

_CAPITAL = re.compile(r"(?<=[a-z])(?=[A-Z])")


@dataclass(frozen=True, slots=True)
class RequestRow:
    """A request: its message, and the handler that answers it.

    The handler runs on the session's thread as `handler(session, request, progress)`; if it is `of_page`, in
    the page's event loop as `await handler(page, number, request)`. `changes`: the session has another take
    afterwards, which other pages are told; `saves`: the session is saved afterwards.
    """

    message: type
    handler: Callable[..., Any]
    of_page: bool = False
    changes: bool = False
    saves: bool = False

    @property
    def verb(self) -> str:
        """Its name in a message (`do`): that of the class, in small letters."""
        return _CAPITAL.sub("_", self.message.__name__).lower()

    @property
    def answer(self) -> type:
        """The type of the answer, which the handler returns."""
        answer: type = typing.get_type_hints(self.handler)["return"]
        return answer


def _asking(message: type, handler: Callable[..., Any]) -> RequestRow:
    return RequestRow(message, handler)


def _saving(message: type, handler: Callable[..., Any]) -> RequestRow:
    return RequestRow(message, handler, saves=True)


def _changing(message: type, handler: Callable[..., Any]) -> RequestRow:
    return RequestRow(message, handler, changes=True, saves=True)


def _of_page(message: type, handler: Callable[..., Any]) -> RequestRow:
    return RequestRow(message, handler, of_page=True)


REQUESTS = (
    _asking(requests.Open, Session.open),
    _changing(requests.Perform, Session.perform),
    _asking(requests.Prepare, Session.prepare),
    _saving(requests.SaveDraft, Session.save_draft),
    _of_page(requests.Stop, PageRequests.stop),
    _changing(requests.Choose, Session.choose),
    _changing(requests.Relabel, Session.relabel),
    _changing(requests.EditAll, Session.edit_all),
    _of_page(requests.PreviewAll, PageRequests.preview_all),
    _changing(requests.SetMarkers, Session.set_markers),
    _changing(requests.SetLanes, Session.set_lanes),
    _changing(requests.BringBack, Session.bring_back),
    _changing(requests.LetGo, Session.let_go),
    _changing(requests.Undo, Session.undo),
    _changing(requests.Redo, Session.redo),
    _of_page(requests.Faces, PageRequests.faces),
    _of_page(requests.FaceAt, PageRequests.face_at),
    _of_page(requests.Cancel, PageRequests.cancel),
    _of_page(requests.Dial, PageRequests.dial),
    _asking(requests.SavePose, queries.save_pose),
    _asking(requests.Explain, queries.explain),
    _asking(requests.ChannelCurves, queries.channel_curves),
    _asking(requests.Compare, Session.compare),
    _asking(rules_fired.RulesFired, rules_fired.rules_fired),
    _asking(requests.ProfileText, queries.profile_text),
    _of_page(requests.Export, PageRequests.export),
    _of_page(requests.CancelExport, PageRequests.cancel_export),
    _of_page(requests.Project, PageRequests.project),
    _saving(requests.SaveView, Session.save_view),
)
"""All requests except `edit` and `preview`, whose message EDITS names by its `kind`."""
VERBS: Mapping[str, type] = {row.verb: row.message for row in REQUESTS}
ROWS: Mapping[type, RequestRow] = {
    **{row.message: row for row in REQUESTS},
    **{message: _changing(message, Session.edit) for message in requests.EDITS.values()},
    requests.Preview: _of_page(requests.Preview, PageRequests.preview),
}
"""The row of each message."""
EDITING = ("edit", "preview")
"""The verbs that name their message by a `kind`."""

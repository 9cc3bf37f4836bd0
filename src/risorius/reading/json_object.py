"""A message of JSON as a dictionary, within bounds."""

from __future__ import annotations

import json
from typing import Any

from ..errors import InputError
from .depth import TOO_DEEP, is_too_deep
from .json_text import HALF_A_CHARACTER, is_unicode


def json_object(text: str) -> dict[str, Any]:
    """Return the object that a message is; raise InputError for any other, and for one that is too deep."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        raise InputError("the message is not JSON") from None
    if not isinstance(data, dict):
        raise InputError("the message is not an object {…}")
    if is_too_deep(data):
        raise InputError(f"the message {TOO_DEEP}")
    if not is_unicode(data, text):
        raise InputError(f"the message {HALF_A_CHARACTER}")
    return data


def without_nulls(data: Any) -> Any:
    """Leave out keys that hold null: they mean the default."""
    if isinstance(data, dict):
        return {key: without_nulls(value) for key, value in data.items() if value is not None}
    if isinstance(data, list):
        return [without_nulls(value) for value in data]
    return data

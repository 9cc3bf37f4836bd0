"""The beginning of an XML document before its root: declaration, comments, document type."""

from __future__ import annotations

import re

COMMENTS = r"(?:<!--(?:(?!-->).)*+-->\s*+)*+"
DECLARATION = r"(?:<\?xml\b[^>]*+>\s*+)?+"
# One that declares nothing: no entity, no element, and what stands in its file is not needed.
DOCUMENT_TYPE = r"<!DOCTYPE\s[^>\[\]]*+(?:\[\s*+\]\s*+)?+>"
_PROLOG = re.compile(rf"\s*+(?P<declaration>{DECLARATION}){COMMENTS}(?P<type>{DOCUMENT_TYPE})?+", re.DOTALL)


def without_document_type(text: str) -> str:
    """Return a document without a document type that declares nothing, each place as it was.

    Its file is not read. If all characters are ASCII, any declared encoding has them: it is left out, too.
    """
    match = _PROLOG.match(text)
    assert match is not None
    for name in ("type", *(("declaration",) if text.isascii() else ())):
        start, end = match.span(name)
        if start >= 0:
            text = text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]
    return text

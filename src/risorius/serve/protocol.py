"""The WebSocket of a client, as uvicorn speaks it; a text that is not UTF-8 comes to the client's face."""

from __future__ import annotations

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol


class LiveProtocol(WebSocketsSansIOProtocol):
    """Hands on texts that are not UTF-8, with their bytes as lone surrogates (PEP 383).

    uvicorn logs a traceback and closes without a word to the client.
    """

    def send_receive_event_to_app(self) -> None:
        """Hand on the message that has come."""
        if self.curr_msg_data_type == "text":
            self.frames = [_Text(b"".join(self.frames))]
        super().send_receive_event_to_app()


class _Text(bytes):
    def decode(self, encoding: str = "utf-8", errors: str = "surrogateescape") -> str:
        """Return it as text, whatever it is."""
        return super().decode(encoding, errors)


def is_utf8(text: str) -> bool:
    """Tell whether a text came as UTF-8."""
    return text.isascii() or not any("\udc80" <= character <= "\udcff" for character in text)

"""iFacialMocap: text of `name-value` pairs, 0 to 100, then head and eyes in degrees.

Names end in `_L` and `_R` but for jaw and mouth as a whole (the app's documentation). Lost: fractions of a
hundredth, what 52 shapes cannot show.

A receiver sends its greeting to the app's port 49983, and the app answers with a datagram per frame to the
receiver's port 49983, or, if the greeting says so, connects to its port 49986 by TCP and marks the end of
each frame (the app's page for developers). Some ask for version 2 by that, which writes `name&value` in place
of `name-value`.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ...core.arkit import SHAPES
from .protocols import ArkitMoment, Asked, Options, Packets

_SECRET = b"_sahuasouryya9218sauhuiayeta91555dy3719"
_ASKS = {b"iFacialMocap": "ifacialmocap", b"iFacialMocap_UDPTCP": "ifacialmocap-tcp"}
_VERSIONS = {b"": "v1", b"|sendDataVersion=v2": "v2"}
GREETINGS = {
    asks + _SECRET + version: Asked(protocol, dialect)
    for asks, protocol in _ASKS.items()
    for version, dialect in _VERSIONS.items()
}
"""The handshakes that receivers send before anything is sent to them."""

_END = b"___iFacialMocap"
"""Ends each frame in a stream."""

_WHOLE = ("jawLeft", "jawRight", "mouthLeft", "mouthRight")


def name_of(shape: str) -> str:
    """Return the protocol's name of an ARKit shape."""
    for side in ("Left", "Right"):
        if shape.endswith(side) and shape not in _WHOLE:
            return f"{shape.removesuffix(side)}_{side[0]}"
    return shape


def ifacialmocap_packets(fps: Fraction, options: Options) -> Packets:
    """Return one datagram per frame."""
    names = [name_of(shape) for shape in SHAPES]
    joint = "&" if options.dialect == "v2" else "-"

    def packets(frame: ArkitMoment) -> list[bytes]:
        values = np.round(100.0 * frame.weights).astype(int)
        pairs = "|".join(f"{name}{joint}{value}" for name, value in zip(names, values, strict=True))
        head = ",".join(_angles(frame.head)) + ",0,0,0"
        left, right = (",".join(_angles(eye)) for eye in frame.eyes)
        return [f"{pairs}|=head#{head}|rightEye#{right}|leftEye#{left}|".encode()]

    return packets


def ifacialmocap_pieces(fps: Fraction, options: Options) -> Packets:
    """Return the same as pieces of one stream, the end of each frame marked."""
    packets = ifacialmocap_packets(fps, options)
    return lambda frame: [packet + _END for packet in packets(frame)]


def _angles(angles: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[str]:
    """Return rotations about x (down), y (to the subject's left) and z (tilted right) of yaw, pitch, roll."""
    yaw, pitch, roll = (float(angle) for angle in angles)
    return [f"{value + 0.0:.4f}" for value in (-pitch, yaw, -roll)]

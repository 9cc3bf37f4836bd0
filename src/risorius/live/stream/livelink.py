"""Live Link Face: the datagrams that Epic's phone app sends to Unreal Engine.

Big-endian: version 6, the device's identity (36 characters), the subject's name, the frame with its rate, and
61 floats: the shapes in ARKit's order (left before right), then rotations of head, left and right eye in
radians. Layout as in the public library PyLiveLinkFace. Lost: what 52 shapes cannot show.
"""

from __future__ import annotations

import struct
import uuid
from fractions import Fraction

import numpy as np

from ...core.arkit import INDEX, PACKET_SHAPES, ROTATIONS
from .protocols import ArkitMoment, Options, Packets

VERSION = 6
COUNT = len(PACKET_SHAPES) + len(ROTATIONS)
_SPACE = uuid.UUID("6f9619ff-8b86-d011-b42d-00c04fc964ff")
_ORDER = [INDEX[name[0].lower() + name[1:]] for name in PACKET_SHAPES]


def livelink_packets(fps: Fraction, options: Options) -> Packets:
    """Return one datagram per frame; the device's identity follows from the subject's name."""
    name = options.subject.encode()
    device = str(uuid.uuid5(_SPACE, options.subject)).upper().encode("ascii")
    start = struct.pack(">Bi36si", VERSION, len(device), device, len(name)) + name

    def packets(frame: ArkitMoment) -> list[bytes]:
        clock = struct.pack(">ifiiB", frame.index, 0.0, fps.numerator, fps.denominator, COUNT)
        turns = np.radians([*frame.head, *frame.eyes.ravel()])
        values = np.concatenate([frame.weights[_ORDER], turns]).astype(">f4")
        return [start + clock + values.tobytes()]

    return packets

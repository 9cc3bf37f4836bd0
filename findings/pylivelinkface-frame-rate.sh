#!/bin/sh
# pylivelinkface writes packets of 24 or 30 frames per second with a frame rate of 24/0 or 30/0.
# Expected (found by reading the source before the run): a rate is written as the whole number over 1.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pylivelinkface==0.1 timecode==1.5.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import struct
import sys

from pylivelinkface import FaceBlendShape, PyLiveLinkFace


def packet(fps):
    face = PyLiveLinkFace(fps=fps)
    face.set_blendshape(FaceBlendShape.JawOpen, 0.5, True)
    return face.encode()


def rate(fps):
    """The rate of a packet: the two numbers before the count of shapes and its 61 floats."""
    return "%d/%d" % struct.unpack("!2i", packet(fps)[-253:-245])


rates = {fps: rate(fps) for fps in (24, 30, 60)}
print("version: pylivelinkface 0.1")
print("behaviour: rates", "; ".join(f"{fps}: {found}" for fps, found in rates.items()))
print("expected: 24/1, 30/1, 60/1")
sys.exit(0 if rates == {24: "24/0", 30: "30/0", 60: "60/1"} else "the behaviour has changed")
PY

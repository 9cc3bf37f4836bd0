#!/bin/sh
# pylivelinkface cannot decode its own packet where the subject's name has a letter outside ASCII: it writes the name's length in
# characters and the name in UTF-8.
# Guess before the run: each name survives encode and decode. Its source, read before the run, said otherwise.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pylivelinkface==0.1 timecode==1.5.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import sys

from pylivelinkface import FaceBlendShape, PyLiveLinkFace


def packet(name):
    face = PyLiveLinkFace(name=name)
    face.set_blendshape(FaceBlendShape.JawOpen, 0.5, True)
    return face.encode()


def name_read(name):
    try:
        return PyLiveLinkFace.decode(packet(name))[1].name
    except UnicodeDecodeError as error:
        return f"UnicodeDecodeError: {error.reason}"


names = {name: name_read(name) for name in ("Zoe", "Zoë", "花子")}
print("version: pylivelinkface 0.1")
print("behaviour:", "; ".join(f"{name}: {found}" for name, found in names.items()))
print("expected: each name as it was")
same = names["Zoe"] == "Zoe" and all("UnicodeDecodeError" in names[name] for name in ("Zoë", "花子"))
sys.exit(0 if same else "the behaviour has changed")
PY

#!/bin/sh
# libav loses the first frame (4,096 samples) of the second of two FLAC files joined byte after byte, if the files are short.
# Expected (that a frame can be lost was met by chance first; its place and the lengths were not guessed): nothing is lost at any
# length.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check soundfile==0.14.0 av==18.1.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import io
import sys

import av
import numpy as np
import soundfile


def flac(samples):
    whole = io.BytesIO()
    soundfile.write(whole, samples, 24000, format="FLAC", subtype="PCM_16")
    return whole.getvalue()


def missing(count):
    """The samples of a joined pair that libav leaves out: how many, and the first of them."""
    ramp = np.arange(2 * count).astype("<i2")
    content = io.BytesIO(flac(ramp[:count]) + flac(ramp[count:]))
    with av.open(content) as container:
        found = np.concatenate([frame.to_ndarray().ravel() for frame in container.decode(audio=0)])
    lost = 2 * count - len(found)
    first = int(np.argmax(found != ramp[: len(found)])) if lost else None
    return lost, first


EXPECTED = {n: (4096, n) for n in (5000, 12000, 16000)} | {24000: (0, None), 26400: (0, None)}
seen = {count: missing(count) for count in EXPECTED}
print("version: av 18.1.0, its libavformat", ".".join(map(str, av.library_versions["libavformat"])))
print("behaviour:", "; ".join(f"2 x {n}: {lost} lost" + (f" at {first}" if lost else "") for n, (lost, first) in seen.items()))
print("expected: nothing lost, or no second file at all; no error is raised")
sys.exit(0 if seen == EXPECTED else "the behaviour has changed")
PY

#!/bin/sh
# libsndfile refuses two WAV or AIFF files joined byte after byte, with a message that denies the RIFF chunk, and plays the second
# header of joined W64 files as sound. The other formats give the first file's sound.
# Expected (WAV met by chance first; the other formats put down after the run): the first file's sound in all, as Python's wave
# module and libav give it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check soundfile==0.14.0 av==18.1.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import io
import sys
import wave

import av
import numpy as np
import soundfile

COUNT = 26400
EXPECTED = {
    "WAV": "Error in WAV file. No 'RIFF' chunk marker.",
    "AIFF": "Error in AIFF file, bad 'FORM' marker.",
    "W64": 2 * COUNT + 52,
    "RF64": COUNT,
    "CAF": COUNT,
    "AU": COUNT,
}


def joined(kind):
    whole = io.BytesIO()
    soundfile.write(whole, 0.3 * np.sin(np.arange(COUNT) / 20), 24000, format=kind, subtype="PCM_16")
    return 2 * whole.getvalue()


def by_libsndfile(content):
    try:
        return len(soundfile.read(io.BytesIO(content))[0])
    except soundfile.LibsndfileError as error:
        return error.error_string


def by_libav(content):
    with av.open(io.BytesIO(content)) as container:
        return sum(frame.samples for frame in container.decode(audio=0))


seen = {kind: by_libsndfile(joined(kind)) for kind in EXPECTED}
others = {kind: by_libav(joined(kind)) for kind in ("WAV", "AIFF", "W64")}
with wave.open(io.BytesIO(joined("WAV"))) as file:
    others["WAV with Python's wave"] = file.getnframes()
print("version: libsndfile", soundfile.__libsndfile_version__, "(soundfile 0.14.0)")
print(f"behaviour: two files of {COUNT} samples give", "; ".join(f"{kind}: {found}" for kind, found in seen.items()))
print("expected:", COUNT, "in each, as others read it:", "; ".join(f"{kind}: {found}" for kind, found in others.items()))
sys.exit(0 if seen == EXPECTED and set(others.values()) == {COUNT} else "the behaviour has changed")
PY

#!/bin/sh
# openfacefx performs a text's words and leaves its numbers out without a warning: the lips of "25" stay closed, and all that follows
# comes at another time.
# Guess before the run: numbers are spoken as words. That at least the report would warn was put down after it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check openfacefx==0.24.0 numpy==2.4.6
"$folder/venv/bin/python" - "$folder" <<'PY'
import json
import subprocess
import sys
from pathlib import Path

folder = Path(sys.argv[1])


def performed(text):
    """The phones of a text, and the report's warnings."""
    command = [folder / "venv/bin/openfacefx", "naive", "--text", text, "--duration", "2", "--out", folder / "track.json"]
    command += ["--emit-segments", folder / "segments.json", "--report", folder / "report.json"]
    subprocess.run(command, check=True, capture_output=True)
    segments = json.loads((folder / "segments.json").read_text())
    phones = [segment["phoneme"] for segment in segments]
    return " ".join(phone for phone in phones if phone != "sil"), json.loads((folder / "report.json").read_text())["warnings"]


TEXTS = {"cats": "3 cats", "it costs": "it costs $5", "": "3.5", "it is": "it is 7:30"}
seen = {text: performed(text) for text in TEXTS.values()}
same = all(seen[text][0] == (performed(words)[0] if words else "") for words, text in TEXTS.items())
warned = any(digit in warning.partition(": ")[2] for _, warnings in seen.values() for warning in warnings for digit in "357")
print("version: openfacefx 0.24.0")
print("behaviour:", "; ".join(f"'{text}' has the phones [{phones}], warnings {warnings}" for text, (phones, warnings) in seen.items()))
print("expected: 'three' before 'cats', or a warning that a number is not performed")
sys.exit(0 if same and not warned else "the behaviour has changed")
PY

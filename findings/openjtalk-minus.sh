#!/bin/sh
# OpenJTalk (pyopenjtalk-plus) reads the signs + × ÷ of Japanese text, but no minus, and a clock time without its hour and minute.
# Expected (minus and clock met by chance first; the other signs put down after the run): all signs of arithmetic are read alike,
# minus as "mainasu", and 19:30 is "juukuji sanjuppun", as 19時30分 is.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyopenjtalk-plus==0.4.1.post10
"$folder/venv/bin/python" - <<'PY'
import sys

import pyopenjtalk

EXPECTED = {
    "3": "s a N",
    "-3": "s a N",
    "\u22123": "s a N",
    "\u22123℃": "s a N d o",
    "+3": "t a s u s a N",
    "3×4": "s a N k a k e r u y o N",
    "3÷4": "s a N w a r u y o N",
    "3\u22124": "s a N pau y o N",
    "19:30": "j u u ky u u pau s a N j u u",
    "19時30分": "j u u k u j i s a N j u cl p u N",
}
seen = {text: pyopenjtalk.g2p(text) for text in EXPECTED}
print("version: pyopenjtalk-plus 0.4.1.post10")
print("behaviour:", "; ".join(f"{text} is [{phones}]" for text, phones in seen.items()))
print("expected: [m a i n a s u s a N] for -3, as + is [t a s u], and 19:30 as 19時30分")
sys.exit(0 if seen == EXPECTED else "the behaviour has changed")
PY

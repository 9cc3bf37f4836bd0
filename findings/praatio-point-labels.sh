#!/bin/sh
# praatio doubles the quotation marks in the labels of a point tier each time that a long TextGrid is read and saved; interval tiers and
# the short format keep them.
# Guess before the run: labels of points survive as those of intervals do.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check praatio==6.2.2
"$folder/venv/bin/python" - "$folder/grid.TextGrid" <<'PY'
import sys

from praatio import textgrid

path, label = sys.argv[1], 'says "oh"'


def after(rounds, form):
    """The labels of an interval and of a point after some rounds of saving and reading."""
    grid = textgrid.Textgrid(0, 2)
    grid.addTier(textgrid.IntervalTier("intervals", [(0, 2, label)], 0, 2))
    grid.addTier(textgrid.PointTier("points", [(1, label)], 0, 2))
    for _ in range(rounds):
        grid.save(path, format=form, includeBlankSpaces=True)
        grid = textgrid.openTextgrid(path, includeEmptyIntervals=True)
    return [tier.entries[0].label for tier in grid.tiers]


long = [after(rounds, "long_textgrid") for rounds in (1, 2, 3)]
short = after(3, "short_textgrid")
print("version: praatio 6.2.2")
print(f"behaviour: {label} in a point of a long TextGrid after one, two and three rounds:", "  ".join(p for _, p in long))
print("           in an interval after three:", long[-1][0], " in a point of a short TextGrid after three:", short[1])
print("expected:", label, "in each (the file's doubled marks stand for one)")
expected = [[label, 'says ""oh""'], [label, 'says """"oh""""'], [label, 'says """"""""oh""""""""']]
sys.exit(0 if long == expected and short == [label, label] else "the behaviour has changed")
PY

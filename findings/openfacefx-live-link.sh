#!/bin/sh
# openfacefx keeps the time of day of a Live Link Face table, so that two seconds recorded at ten o'clock become a track of ten hours.
# Guess before the run: the time codes are read exactly. That the track begins at 0 and lasts two seconds is what one expects, put
# down after it.
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
PAIRS = "EyeBlink EyeLookDown EyeLookIn EyeLookOut EyeLookUp EyeSquint EyeWide"
MOUTH = "Smile Frown Dimple Stretch Press LowerDown UpperUp"
ANGLES = [part + angle for part in ("Head", "LeftEye", "RightEye") for angle in ("Yaw", "Pitch", "Roll")]
shapes = [name + side for side in ("Left", "Right") for name in PAIRS.split()]
shapes += "JawForward JawRight JawLeft JawOpen MouthClose MouthFunnel MouthPucker MouthRight MouthLeft".split()
for name in MOUTH.split():
    shapes += [f"Mouth{name}Left", f"Mouth{name}Right"]
shapes += "MouthRollLower MouthRollUpper MouthShrugLower MouthShrugUpper BrowDownLeft BrowDownRight BrowInnerUp".split()
shapes += "BrowOuterUpLeft BrowOuterUpRight CheekPuff CheekSquintLeft CheekSquintRight NoseSneerLeft NoseSneerRight TongueOut".split()
assert len(shapes) == 52
rows = [["Timecode", "BlendshapeCount", *shapes, *ANGLES]]
for frame in range(120):
    values = dict.fromkeys([*shapes, *ANGLES], 0.0) | {"JawOpen": frame / 240}
    rows.append([f"10:00:{frame // 60:02}:{frame % 60:02}.000", "61", *map(str, values.values())])
(folder / "take.csv").write_text("\n".join(map(",".join, rows)) + "\n")
command = [folder / "venv/bin/openfacefx", "from-csv", folder / "take.csv", "--fps", "60", "-o", folder / "track.json"]
subprocess.run(command, check=True, capture_output=True)
track = json.loads((folder / "track.json").read_text())
jaw = next(channel["keys"] for channel in track["channels"] if channel["name"] == "JawOpen")
print("version: openfacefx 0.24.0")
print(f"behaviour: 120 frames from 10:00:00:00 last {track['duration']:g} s, the jaw's keys go from {jaw[0]} to {jaw[-1]}")
print("expected: a track of 2 s, its keys from 0 to 1.983 s")
sys.exit(0 if jaw[0][0] == 36000 and track["duration"] > 36000 else "the behaviour has changed")
PY

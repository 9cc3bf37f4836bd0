"""Files written from a performance: one module per format, one line here for each."""

from .arkit_csv import write_arkit_csv
from .formats import OUTPUTS, Need, Output, output_for, register
from .glb import write_glb, write_rig_glb
from .landmarks_csv import write_landmarks_csv
from .mp4 import write_mp4
from .muscles_csv import write_muscles_csv
from .performance_json import write_performance_json
from .png import write_png
from .score_json import write_score_json
from .source import Material, WriteOptions
from .targets import Target, check_target, check_targets, write_targets
from .textgrid import write_textgrid
from .wav import write_wav

register(".mp4", "video with sound", {"pixels"}, write_mp4)
register(".png", "one frame, or a sheet of every n-th", {"pixels"}, write_png)
register(".wav", "the voice", {"speech"}, write_wav)
register(".muscles.csv", "curves of all muscles and parameters", {"curves"}, write_muscles_csv)
register(".landmarks.csv", "distances and 68 points measured on the face", {"vertices"}, write_landmarks_csv)
register(".arkit.csv", "52 ARKit weights as Live Link Face writes them", {"vertices"}, write_arkit_csv)
register(".glb", "the head in motion, by the clip's own shapes", {"vertices"}, write_glb)
register(".rig.glb", "the head with 52 ARKit shapes, driven by its weights", {"vertices"}, write_rig_glb)
register(".TextGrid", "words, phones and accents for Praat", {"speech"}, write_textgrid)
register(".score.json", "all movements with their causes", {"curves"}, write_score_json)
register(".performance.json", "curves with their score", {"curves"}, write_performance_json)

__all__ = [
    "OUTPUTS",
    "Need",
    "Output",
    "Material",
    "Target",
    "WriteOptions",
    "check_target",
    "check_targets",
    "output_for",
    "register",
    "write_targets",
]

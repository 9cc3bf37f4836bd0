"""Files written from a performance: one module per format, one line here for each."""

from .formats import OUTPUTS, Need, Output, output_for, register
from .landmarks_csv import write_landmarks_csv
from .mov import write_mov
from .mp4 import write_mp4
from .muscles_csv import write_muscles_csv
from .performance_json import write_performance_json
from .png import write_png
from .score_json import write_score_json
from .source import Material, WriteOptions
from .targets import Target, check_target, check_targets, write_targets
from .textgrid import write_textgrid
from .wav import write_wav
from .webm import write_webm

register(".mp4", "video with sound", {"pixels"}, write_mp4, opaque=True)
register(".webm", "video with sound for the web, with alpha if asked", {"pixels"}, write_webm)
register(".mov", "video with sound for editing, with alpha if asked", {"pixels"}, write_mov)
register(".png", "one frame, or a sheet of every n-th", {"pixels"}, write_png)
register(".wav", "the voice", {"speech"}, write_wav)
register(".muscles.csv", "curves of all muscles and parameters", {"curves"}, write_muscles_csv)
register(".landmarks.csv", "distances and 68 points measured on the face", {"vertices"}, write_landmarks_csv)
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

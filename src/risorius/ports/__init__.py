"""Files written from a performance: one module per format, one line here for each."""

from .azure_json import write_azure_json
from .bml_feedback import write_bml_feedback
from .channels_textgrid import write_channels_textgrid
from .formats import OUTPUTS, Need, Output, deferred, output_for, register
from .landmarks_csv import write_landmarks_csv
from .mov import write_mov
from .mp4 import write_mp4
from .muscles_csv import write_muscles_csv
from .oculus_csv import write_oculus_csv
from .performance_json import write_performance_json
from .png import write_png
from .rhubarb import write_moho_dat, write_rhubarb_json, write_rhubarb_tsv, write_rhubarb_xml
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
register(
    ".arkit.csv",
    "52 ARKit weights as Live Link Face writes them",
    {"head"},
    deferred("arkit_csv", "write_arkit_csv"),
)
register(".glb", "the head in motion, by the clip's own shapes", {"head"}, deferred("glb", "write_glb"))
register(
    ".rig.glb",
    "the head with 52 ARKit shapes, driven by their weights",
    {"head"},
    deferred("glb", "write_rig_glb"),
)
register(".vrma", "VRM animation: head, gaze, expressions", {"head"}, deferred("vrma", "write_vrma"))
register(".usda", "the head with 52 blend shapes as USD", {"head"}, deferred("usda", "write_usda"))
register(".obj", "one frame as a mesh", {"head"}, deferred("obj", "write_obj"))
register(
    ".au.csv",
    "action units, gaze and pose in OpenFace's columns",
    {"head"},
    deferred("au_csv", "write_au_csv"),
)
register(".fap", "MPEG-4 facial animation parameters", {"head"}, deferred("fap", "write_fap"))
register(".bvh", "rotations of head and eyes", {"head"}, deferred("bvh", "write_bvh"))
register(".visemes.json", "mouth shapes as Rhubarb Lip Sync writes them", {"speech"}, write_rhubarb_json)
register(".visemes.tsv", "the same as a table", {"speech"}, write_rhubarb_tsv)
register(".visemes.xml", "the same as XML", {"speech"}, write_rhubarb_xml)
register(".visemes.dat", "the same as Moho switch data", {"speech"}, write_moho_dat)
register(".azure.json", "viseme events as Azure Speech sends them", {"speech"}, write_azure_json)
register(".oculus.csv", "weights of the 15 visemes of OVRLipSync", {"speech"}, write_oculus_csv)
register(".channels.TextGrid", "every channel as a tier, for Praat", {"curves"}, write_channels_textgrid)
register(".feedback.xml", "the plan as BML feedback", {"curves"}, write_bml_feedback)
register(".npz", "the curves as numpy arrays", {"curves"}, deferred("npz", "write_npz"))
register(
    ".vertices.npz", "the curves and the skin of every frame", {"head"}, deferred("npz", "write_vertices_npz")
)
register(
    ".parquet", "curves and ARKit weights for data tools", {"head"}, deferred("parquet", "write_parquet")
)

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

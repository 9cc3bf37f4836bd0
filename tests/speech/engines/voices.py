"""Programs that speak, for the tests: one that gives phone times, and one that does not."""

BEEPER = """
import base64, json, struct, sys

request = json.loads(sys.stdin.readline())
rate, at, samples, phones, position = 16000, 0.0, [], [], 0
for word in request["text"].split():
    position = request["text"].index(word, position)
    for symbol, seconds in (("B", 0.1), ("AA1", 0.2)):
        phones.append([symbol, at, position])
        at += seconds
        samples += [100 if symbol == "B" else 8000 * (n // 40 % 2) for n in range(int(seconds * rate))]
audio = base64.b64encode(struct.pack(f"<{len(samples)}h", *samples)).decode()
print(json.dumps({"sample_rate": rate, "audio": audio, "phones": phones}))
"""

# espeak-ng with another rate and timbre, which keeps its phone times to itself.
MUTE_OF_TIMES = """
import base64, json, sys

from risorius.speech.engines.protocol import SpeechRequest
from risorius.speech.engines.registry import load_engine
from risorius.speech.engines.voices import find_voice

request = json.loads(sys.stdin.readline())
engine = load_engine()
said = engine.speak(SpeechRequest(request["text"], find_voice("en-us+m3", None, engine), 150))
audio = base64.b64encode(said.samples.tobytes()).decode()
print(json.dumps({"sample_rate": said.sample_rate, "audio": audio}))
"""

# What Piper's command line does, with espeak-ng's voice.
PIPER = """
import sys, wave

from risorius.speech.engines.protocol import SpeechRequest
from risorius.speech.engines.registry import load_engine
from risorius.speech.engines.voices import find_voice

options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
assert options["--model"].endswith(".onnx"), options
rate = round(175 / float(options["--length_scale"]))
engine = load_engine()
said = engine.speak(SpeechRequest(sys.stdin.readline().strip(), find_voice("en-us+m3", None, engine), rate))
with wave.open(options["--output_file"], "wb") as out:
    out.setparams((1, 2, said.sample_rate, 0, "NONE", ""))
    out.writeframes(said.samples.tobytes())
"""

"""Programs that speak, for the tests: one that gives phone times, and one that does not."""

from risorius.speech.engines import worker

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

# espeak-ng as its worker drives it, without Risorius and numpy, which take long to import.
_ESPEAK = f"""
import importlib.util

spec = importlib.util.spec_from_file_location("worker", {worker.__file__!r})
worker = importlib.util.module_from_spec(spec)
spec.loader.exec_module(worker)


def spoken(text, rate):
    answer, sound = worker.answer(
        {{"op": "speak", "text": text, "voice": "gmw/en-US+m3", "rate": rate}}
    )
    return answer["sample_rate"], sound
"""

# espeak-ng with another rate and timbre, which keeps its phone times to itself.
MUTE_OF_TIMES = f"""{_ESPEAK}
import base64, json, sys

rate, sound = spoken(json.loads(sys.stdin.readline())["text"], 150)
print(json.dumps({{"sample_rate": rate, "audio": base64.b64encode(sound).decode()}}))
"""

# What Piper's command line does, with espeak-ng's voice.
PIPER = f"""{_ESPEAK}
import sys, wave

options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
assert options["--model"].endswith(".onnx"), options
rate, sound = spoken(sys.stdin.readline().strip(), round(175 / float(options["--length_scale"])))
with wave.open(options["--output_file"], "wb") as out:
    out.setparams((1, 2, rate, 0, "NONE", ""))
    out.writeframes(sound)
"""

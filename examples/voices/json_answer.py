"""A voice that knows when each sound begins, and says so: a beep for every word, with its phones.

    risorius speak "Hello there." --voice examples/voices/json_answer.py -o hello.mp4

The answer is one object: samples in base64, and for each phone its symbol (ARPAbet or IPA), its start in
seconds, and where its word stands in the text.
"""

import base64
import json
import struct
import sys

request = json.loads(sys.stdin.readline())
rate, time, samples, phones, position = 16_000, 0.0, [], [], 0
for word in request["text"].split():
    position = request["text"].index(word, position)
    for symbol, seconds in (("M", 0.08), ("AA1", 0.18)):
        phones.append([symbol, round(time, 3), position])
        level = 3_000 if symbol == "M" else 9_000
        samples += [level if n // 50 % 2 else -level for n in range(int(seconds * rate))]
        time += seconds
audio = base64.b64encode(struct.pack(f"<{len(samples)}h", *samples)).decode()
print(json.dumps({"sample_rate": rate, "audio": audio, "phones": phones}))

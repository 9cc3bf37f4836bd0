"""A voice that speaks over HTTP: the service at VOICE_URL gets JSON and answers with WAV, MP3, OGG or FLAC.

Services differ in the names of the fields: change `body` to what yours wants. A key, if it needs one, stands
in VOICE_KEY and is never written into a file.

    export VOICE_URL=https://voice.example/v1/speech VOICE_KEY=…
    risorius speak "Hello there." --voice examples/voices/service.py -o hello.mp4
"""

import json
import os
import sys
import urllib.error
import urllib.request

request = json.loads(sys.stdin.readline())
url = os.environ.get("VOICE_URL")
if not url:
    sys.exit("VOICE_URL is not set; expected the address of a service that speaks")
body = {
    "text": request["text"],
    "language": request["language"],
    "speed": (request["rate"] or 175) / 175 * request["manner"]["rate"],
    "format": "wav",
}
headers = {"Content-Type": "application/json"}
if key := os.environ.get("VOICE_KEY"):
    headers["Authorization"] = f"Bearer {key}"
try:
    question = urllib.request.Request(url, json.dumps(body).encode(), headers)
    with urllib.request.urlopen(question, timeout=50) as answer:
        sys.stdout.buffer.write(answer.read())
except urllib.error.HTTPError as error:
    words = error.read(200)
    said = words.decode(errors="replace") if words.isascii() else error.reason
    sys.exit(f"{url} answered {error.code}: {said}")
except (OSError, ValueError) as error:
    sys.exit(f"{url} cannot be reached: {error}")

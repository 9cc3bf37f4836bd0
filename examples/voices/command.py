"""A voice that any command speaks which writes a WAV file, named by VOICE_COMMAND.

{text} and {file} in it are the text and the file to write; a command without {text} reads it from its input.

    export VOICE_COMMAND='espeak-ng -w {file} {text}'
    export VOICE_COMMAND='text2wave -o {file}'
    risorius speak "Hello there." --voice examples/voices/command.py -o hello.mp4
"""

import json
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

request = json.loads(sys.stdin.readline())
command = os.environ.get("VOICE_COMMAND")
if not command:
    sys.exit("VOICE_COMMAND is not set; expected e.g. 'espeak-ng -w {file} {text}'")
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "voice.wav"
    # Divided first: a text with spaces or quotes stays one word.
    words = [
        part.replace("{file}", str(file)).replace("{text}", request["text"]) for part in shlex.split(command)
    ]
    try:
        subprocess.run(words, input=request["text"].encode(), stdout=sys.stderr, check=True)
    except OSError as error:
        sys.exit(f"VOICE_COMMAND: {words[0]} cannot be started: {error.strerror}")
    except subprocess.CalledProcessError as error:
        sys.exit(f"VOICE_COMMAND: {words[0]} failed with exit code {error.returncode}")
    if not file.is_file():
        sys.exit(f"VOICE_COMMAND: {words[0]} wrote no sound to {{file}}")
    sys.stdout.buffer.write(file.read_bytes())

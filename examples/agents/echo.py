"""An agent without any service: it says back what it is told, word by word, as a language model would write.

Run it, open http://127.0.0.1:8766/ and type:

    python examples/agents/echo.py
"""

from __future__ import annotations

import random
import sys
import threading
import time
from contextlib import suppress
from typing import Any

from risorius import Live
from risorius.errors import InputError
from risorius.live.serve.server import ServeOptions, serve


class EchoFace(Live):
    """A face that answers, instead of saying what it is given."""

    def say(self, text: str = "", **voice: Any) -> None:
        """Take what the other says; the answer comes in its own time."""
        threading.Thread(target=self.answer, args=(text.strip(),), daemon=True).start()

    def answer(self, question: str) -> None:
        """Think, then say word by word what was asked."""
        with suppress(InputError):  # it was closed meanwhile
            self.look(random.choice(["up", "away"]))
            time.sleep(0.6)
            self.look(None)
            for word in f'You said: "{question}". What else?'.split():
                super().say(f"{word} ")
                time.sleep(0.05)
            self.flush()


if __name__ == "__main__":
    serve(ServeOptions(port=int(sys.argv[1]) if len(sys.argv) > 1 else 8766, face=EchoFace))

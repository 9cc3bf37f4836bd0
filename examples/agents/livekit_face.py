"""A face for agents made with LiveKit: it stands where the agent's sound goes, and passes it on with frames.

    session = AgentSession(...)
    await session.start(agent, room=room)
    session.output.audio = face = FaceOutput(show, next_in_chain=session.output.audio)
    ...
    await face.aclose()

The mouth follows the words' times if the speech service sends them, otherwise the text that the service is
given, which the agent shows to the face:

    class Speaker(Agent):
        def tts_node(self, text, model_settings):
            return Agent.default.tts_node(self, face.reading(text), model_settings)

Without either it follows what is heard, with errors.

`show` is called with each frame of the face (`risorius.live.frame.LiveFrame`), 30 a second: publish its ARKit
weights as data, or drive what draws the face. Tried with livekit-agents 1.8.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterable, AsyncIterator, Awaitable, Callable

from livekit import rtc
from livekit.agents.types import USERDATA_TIMED_TRANSCRIPT
from livekit.agents.voice.io import AudioOutput, AudioOutputCapabilities

from risorius import Live, Settings
from risorius.errors import RisoriusError
from risorius.live.frame import LiveFrame

Show = Callable[[LiveFrame], Awaitable[None]]


class FaceOutput(AudioOutput):
    """Performs the agent's sound, and passes it on in pieces that belong to the frames."""

    def __init__(
        self, show: Show, next_in_chain: AudioOutput, settings: Settings | None = None, fps: float = 30
    ) -> None:
        super().__init__(
            label="Risorius",
            capabilities=AudioOutputCapabilities(pause=False),
            next_in_chain=next_in_chain,
            sample_rate=next_in_chain.sample_rate,
        )
        assert self.next_in_chain is not None
        self._show, self._sink = show, self.next_in_chain
        self._face = Live(settings, fps=fps, arkit=True)
        # What the sound that comes next says.
        self._text = ""
        # Whether the agent's sound has ended, and sound was passed on whose end is still to come.
        self._ended = self._passed = False
        self._interruptions = 0
        self._playing = asyncio.create_task(self._play())

    async def reading(self, text: AsyncIterable[str]) -> AsyncIterator[str]:
        """Yield what the speech service is to say, and keep it for the sound that says it."""
        async for piece in text:
            self._text += piece
            yield piece

    async def capture_frame(self, frame: rtc.AudioFrame) -> None:
        """Take a piece of the agent's sound."""
        await super().capture_frame(frame)
        timed = frame.userdata.get(USERDATA_TIMED_TRANSCRIPT, ())
        words = [(word.strip(), word.start_time, word.end_time) for word in timed if word.strip()]
        self._face.say(self._text, audio=bytes(frame.data), rate=frame.sample_rate, words=words)
        self._text, self._ended = "", False

    def flush(self) -> None:
        """End what is being said."""
        super().flush()
        self._face.flush()
        self._ended = True

    def clear_buffer(self) -> None:
        """Fall silent: the agent was interrupted."""
        self._face.interrupt()
        self._text, self._interruptions = "", self._interruptions + 1
        if self._passed:
            self._sink.flush()
        self._ended = self._passed = False
        self._sink.clear_buffer()

    async def aclose(self) -> None:
        """Say what has arrived, and end."""
        self._face.close()
        await self._playing

    async def _play(self) -> None:
        frames = self._face.aframes()
        while True:
            before = self._interruptions
            try:
                frame = await anext(frames, None)
            except RisoriusError as error:
                print(error)
                frames = self._face.aframes()
                continue
            if frame is None:
                if self._passed:
                    self._sink.flush()
                return
            await self._show(frame)
            if before != self._interruptions:
                # It was made before the agent was interrupted.
                continue
            if frame.speaking:
                sound = frame.sound.astype("<i2").tobytes()
                self._passed = True
                await self._sink.capture_frame(rtc.AudioFrame(sound, frame.sample_rate, 1, len(frame.sound)))
            elif self._passed and self._ended and not self._face.waiting:
                self._passed = False
                self._sink.flush()

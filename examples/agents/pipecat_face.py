"""A face for agents made with Pipecat: put it behind the speech service in the pipeline.

    face = FaceProcessor(show)
    Pipeline([transport.input(), stt, llm, tts, face, transport.output()])

`show` is called with each frame of the face (`risorius.live.frame.LiveFrame`), 30 a second: send its ARKit
weights wherever the face is drawn. The sound passes through the face, so that both go together. Tried with
pipecat-ai 1.14.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

import numpy as np
from pipecat.frames.frames import (
    AggregatedTextFrame,
    CancelFrame,
    EndFrame,
    Frame,
    InputAudioRawFrame,
    InterruptionFrame,
    StartFrame,
    TTSAudioRawFrame,
    TTSStoppedFrame,
)
from pipecat.processors.frame_processor import FrameDirection, FrameProcessor

from risorius import Live, Settings
from risorius.errors import RisoriusError
from risorius.live.frame import LiveFrame

Show = Callable[[LiveFrame], Awaitable[None]]


class FaceProcessor(FrameProcessor):
    """Performs what the speech service says, listens to the other, and can be interrupted."""

    def __init__(self, show: Show, settings: Settings | None = None, fps: float = 30, **named: Any) -> None:
        super().__init__(**named)
        self._show = show
        self._face = Live(settings, fps=fps, arkit=True)
        # What the sound that comes next says.
        self._text = ""
        self._playing: asyncio.Task[None] | None = None

    async def process_frame(self, frame: Frame, direction: FrameDirection) -> None:
        """Give the face what concerns it, and pass everything on but the sound, which it plays itself."""
        await super().process_frame(frame, direction)
        if isinstance(frame, TTSAudioRawFrame):
            self._face.say(self._text, audio=frame.audio, rate=frame.sample_rate)
            self._text = ""
            return
        if isinstance(frame, AggregatedTextFrame) and frame.will_be_spoken:
            self._text += f"{frame.text} "
        if isinstance(frame, StartFrame):
            self._playing = self.create_task(self._play())
        elif isinstance(frame, InputAudioRawFrame):
            self._face.listen(np.frombuffer(frame.audio, "<i2"), frame.sample_rate)
        elif isinstance(frame, TTSStoppedFrame):
            self._face.flush()
        elif isinstance(frame, InterruptionFrame):
            self._text = ""
            await asyncio.to_thread(self._face.interrupt)
        elif isinstance(frame, EndFrame) and self._playing is not None:
            # What was said is heard to its end.
            self._face.close()
            await self._playing
        elif isinstance(frame, CancelFrame) and self._playing is not None:
            await self.cancel_task(self._playing)
        await self.push_frame(frame, direction)

    async def _play(self) -> None:
        frames = self._face.aframes()
        while True:
            try:
                frame = await anext(frames, None)
            except RisoriusError as error:
                await self.push_error(error_msg=str(error))
                frames = self._face.aframes()
                continue
            if frame is None:
                return
            await self._show(frame)
            if frame.speaking:
                sound = frame.sound.astype("<i2").tobytes()
                await self.push_frame(TTSAudioRawFrame(sound, frame.sample_rate, 1))

"""Suffixes of files that are spoken, and of recordings."""

from __future__ import annotations

SCRIPT_SUFFIXES = (".txt", ".md", ".markdown", ".xml", ".utt", ".ssml", ".bml", ".apml")
# A text with one of these suffixes is a file, never words to speak, even if no reader is registered for it.
INPUT_SUFFIXES = (*SCRIPT_SUFFIXES, ".textgrid", ".json")
RECORDING_SUFFIXES = (
    *(".wav", ".flac", ".ogg", ".opus", ".mp3", ".m4a", ".aac"),
    *(".mp4", ".m4v", ".mov", ".3gp", ".webm", ".mkv"),
)

"""Recorded speech: the sound, its labels, and words recognized from the sound alone."""

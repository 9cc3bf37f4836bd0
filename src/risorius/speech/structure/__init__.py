"""The structure of speech: syllables, pauses, accents and boundaries."""

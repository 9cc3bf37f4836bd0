"""Types of speech: sound, utterances, tones, and the adjustment of a voice."""

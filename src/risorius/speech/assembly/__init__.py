"""From spoken parts to one utterance: phones, silences and words at their times."""

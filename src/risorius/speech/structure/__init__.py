"""How speech is divided: syllables, pauses, accents and boundaries."""

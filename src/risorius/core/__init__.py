"""The types that all stages share: parameters, movements, scores, curves, speech."""

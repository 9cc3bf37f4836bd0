"""Scores as files: movements with their causes, and the speech that they belong to."""

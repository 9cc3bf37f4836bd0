"""Muscles, jaw and tongue, which move the skin."""

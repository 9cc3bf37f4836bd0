"""Risorius: from a script or a recorded line to a performing face."""

__version__ = "0.1.0"

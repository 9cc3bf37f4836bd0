"""Meshes and rigs as files."""

"""Curves as files: one column per parameter, shape, unit or point."""

"""Settings: how one is declared, the table of all, and presets, which keep some in a file."""

from .table import BY_VOICE, BlendChoices, Look, Settings, parse_size, settings_of

__all__ = ["BY_VOICE", "BlendChoices", "Look", "Settings", "parse_size", "settings_of"]

"""The renderers: one file each, which registers itself in `protocol.RENDERERS`."""

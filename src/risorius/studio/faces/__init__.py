"""Faces for a page: of takes, by windows, and of poses as they are dialled."""

"""Curves drawn by hand. They come from scores; nothing builds them."""

from .registry import register

register("manual", 70.0)

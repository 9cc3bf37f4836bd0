"""Kernels that the server needs, compiled before it runs in a thread of its own.

To compile, numba parses the kernel's source; where pytest parses a module at the same time (to rewrite its
asserts, or to show a failure), Python 3.11 confuses the two: "AST constructor recursion depth mismatch".
"""

from functools import cache

import risorius


@cache
def compile_faces() -> None:
    """Solve one face, with the skin in motion."""
    next(iter(risorius.pose({}).faces()))

"""Machinery below the package's work on faces: other processes, compiled kernels."""

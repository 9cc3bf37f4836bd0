"""What runs the package's work and is not about faces: other processes, compiled kernels."""

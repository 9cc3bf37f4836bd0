"""What compiled functions (kernels) of the face, the looks and the renderer have in common."""

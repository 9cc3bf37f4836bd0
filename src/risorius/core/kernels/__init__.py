"""Tools for compiled functions (kernels), shared by the face, the looks and the renderer."""

"""Functions that run as machine code: declared, compiled, found and called."""

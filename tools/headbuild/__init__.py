"""The builder of the standard head: from the CC0 MakeHuman geometry to ``heads/standard/head.npz``."""

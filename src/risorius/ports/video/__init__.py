"""The video encoder in a process of its own; nothing here loads more of the package than it needs."""

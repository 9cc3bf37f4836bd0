"""The tests, in folders as those of the sources."""

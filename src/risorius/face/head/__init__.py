"""A head as it is read: geometry, identity, the table of muscles, and places on it."""

"""A server of live faces: one for each client of its WebSocket."""

"""Small frozen results: curves, vertices and pictures that no change may move unless it says so."""

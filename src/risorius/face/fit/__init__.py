"""Fits to a solved face: measures, feature points, and weights of other rigs."""

"""What is read off a solved face: measures, feature points, and weights of other rigs."""

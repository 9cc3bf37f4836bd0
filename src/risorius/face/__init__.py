"""The face: from parameter curves to the vertices of the head."""

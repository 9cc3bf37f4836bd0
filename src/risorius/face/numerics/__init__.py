"""Linear algebra, least squares and geometry that know nothing of faces."""

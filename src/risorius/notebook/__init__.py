"""A take for those who look at it in a notebook: a page, a figure, a table."""

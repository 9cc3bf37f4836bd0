"""A take shown in a notebook: a page, a figure, a table."""

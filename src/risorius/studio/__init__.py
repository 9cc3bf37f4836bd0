"""The studio: a page in the browser to see, hear and shape a performance. Thin over the library."""

"""A session: its takes, the requests that change it, and the edits made on them."""

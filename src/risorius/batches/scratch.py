"""A table of a run, on disk where it grows, which is gone with the run."""

from __future__ import annotations

import sqlite3
from typing import Self


class Scratch:
    """Holds a table that is removed when it is left, or closed."""

    def __init__(self, table: str) -> None:
        self._database = sqlite3.connect("")
        self._database.execute(f"CREATE TABLE {table}")

    def close(self) -> None:
        """Remove the table."""
        self._database.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

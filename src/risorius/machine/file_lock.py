"""Locks on files that end with the process that holds them, as each system has them."""

from __future__ import annotations

import sys
from typing import IO

if sys.platform == "win32":
    import msvcrt

    _FAR = 2**31 - 2  # bytes beyond all that is written: Windows locks bytes against being read

    def lock(file: IO[bytes], *, shared: bool = False) -> None:
        """Lock an open file until it is closed; raise BlockingIOError if another process holds it.

        A shared lock keeps nobody out here: Windows has none that `msvcrt` reaches.
        """
        if shared:
            return
        file.seek(_FAR)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError as error:
            raise BlockingIOError(*error.args) from error
        finally:
            file.seek(0)
else:
    import fcntl

    def lock(file: IO[bytes], *, shared: bool = False) -> None:
        """Lock an open file until it is closed; raise BlockingIOError if another process holds it.

        Several may hold a shared lock.
        """
        fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)

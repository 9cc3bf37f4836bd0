"""A task that loads nothing itself."""

import sys


def modules() -> list[str]:
    return sorted(sys.modules)

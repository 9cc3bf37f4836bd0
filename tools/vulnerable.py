"""Name the pinned packages that are known to be vulnerable, with what mends them.

    python tools/vulnerable.py

The advisories are those that PyPI gives for each version (its JSON interface, which has them from OSV). Exits
with 1 if there are any. If the index cannot be reached, or lacks this interface, it says that nothing was
checked, and exits with 0, because a mirror does not make the pins wrong.
"""

from __future__ import annotations

import json
import re
import sys
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

REQUIREMENTS = Path(__file__).parents[1] / "requirements"
ADDRESS = "https://pypi.org/pypi/{}/{}/json"
_PIN = re.compile(r"^([a-z0-9-]+)==([\w.+!-]+)", re.MULTILINE)
_SECONDS, _MOST = 20.0, 20_000_000  # to wait for an answer; its bytes

Fetch = Callable[[str], bytes]


def pins(folder: Path = REQUIREMENTS) -> dict[str, str]:
    """Return the pinned version of each package in all files of requirements."""
    found: dict[str, str] = {}
    for path in sorted(folder.glob("*.txt")):
        found |= dict(_PIN.findall(path.read_text(encoding="utf-8")))
    return found


def advisories(name: str, version: str, fetch: Fetch) -> Iterator[str]:
    """Yield a line for each advisory that is in force; raises OSError or ValueError if it cannot be read."""
    answer: dict[str, Any] = json.loads(fetch(ADDRESS.format(name, version)))
    for known in answer["vulnerabilities"]:
        if known.get("withdrawn"):
            continue
        mended = ", ".join(known.get("fixed_in") or ()) or "no release"
        names = " ".join((known["id"], *known.get("aliases", ())))
        yield f"{name} {version}: {names}; mended by {mended}"


def main(fetch: Fetch | None = None, folder: Path = REQUIREMENTS) -> int:
    """Print all advisories; return the exit code."""
    count, unread = 0, list[str]()
    table = pins(folder)
    for name, version in table.items():
        try:
            for line in advisories(name, version, fetch or _fetched):
                print(line)
                count += 1
        except (OSError, ValueError, KeyError) as error:
            unread.append(f"{name} ({error})")
    if unread:
        print(f"not checked: {len(unread)} of {len(table)} packages, the first of them {unread[0]}")
    print(f"{count} known vulnerabilities in {len(table) - len(unread)} packages")
    return int(count > 0)


def _fetched(address: str) -> bytes:
    request = urllib.request.Request(address, headers={"Accept": "application/json"})
    with urllib.request.urlopen(request, timeout=_SECONDS) as answer:
        return bytes(answer.read(_MOST))


if __name__ == "__main__":
    sys.exit(main())

"""Count the files of Risorius that a line of seven words enters on its way to curves.

The body of a module counts; the second count leaves out files of which nothing else runs. `--list` names each
file with the number of its lines and of its functions that ran.
"""

import argparse
import collections
import sys
import tempfile
from pathlib import Path
from types import FrameType
from typing import Any

LINE = "Oh really? I like it very much."
ROOT = str(Path(__file__).resolve().parents[1] / "src" / "risorius")


def functions_by_file() -> dict[str, set[str]]:
    """Return the functions that run while the line is performed, by file; a module's body is `<module>`."""
    entered: dict[str, set[str]] = collections.defaultdict(set)

    def profile(frame: FrameType, event: str, _argument: Any) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(ROOT):
            entered[frame.f_code.co_filename].add(frame.f_code.co_qualname)

    with tempfile.TemporaryDirectory() as folder:
        sys.setprofile(profile)
        try:
            import risorius

            risorius.speak(LINE).write(Path(folder, "x.muscles.csv"))
        finally:
            sys.setprofile(None)
    return entered


def main() -> None:
    """Print the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--list", action="store_true", help="name each file")
    listed = parser.parse_args().list
    entered = functions_by_file()
    if listed:
        for name, functions in sorted(entered.items()):
            lines = len(Path(name).read_text(encoding="utf-8").splitlines())
            print(f"{Path(name).relative_to(ROOT)}: {lines} lines, {len(functions - {'<module>'})} functions")
    print(f"files entered: {len(entered)}")
    print(f"of these, more than the module's body: {sum(f != {'<module>'} for f in entered.values())}")


if __name__ == "__main__":
    main()

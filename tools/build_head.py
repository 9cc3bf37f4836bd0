"""Build heads from the CC0 MakeHuman geometry: `python tools/build_head.py [HEAD ...|--all] [--wheel PATH]`.

HEAD is the name of a head that comes with Risorius or a folder; its `identity.toml` says who it is. Written
are `head.npz`, `ages.npz` and the licence.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tools")]

from headbuild.ages import build_ages  # noqa: E402
from headbuild.build import Shape, build  # noqa: E402
from headbuild.pack import write_npz  # noqa: E402
from headbuild.source import Source, open_source  # noqa: E402

from risorius.errors import RisoriusError  # noqa: E402
from risorius.face.head.ages import FILE as AGES  # noqa: E402
from risorius.face.head.identity import FILE as IDENTITY  # noqa: E402
from risorius.face.head.identity import read_identity  # noqa: E402

HEADS = ROOT / "src" / "risorius" / "heads"
TEMPLATE = HEADS / "standard"  # the head that the builder's distances were drawn for
RECIPES = TEMPLATE / "muscles.toml"


def main(arguments: list[str] | None = None) -> None:
    """Build the heads named on the command line; `standard` if none is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*", metavar="HEAD", default=["standard"])
    parser.add_argument("--all", action="store_true", help="every head that comes with Risorius")
    parser.add_argument("--wheel", type=Path, help="the source wheel; fetched with pip if not given")
    parser.add_argument(
        "-o", "--output", type=Path, help="write each head to DIR/NAME, not where its identity is"
    )
    options = parser.parse_args(arguments)
    names = sorted(path.parent.name for path in HEADS.glob(f"*/{IDENTITY}")) if options.all else options.heads
    source = open_source(options.wheel)
    template = Shape.of(source, read_identity(TEMPLATE / IDENTITY))
    for name in names:
        folder = HEADS / name if (HEADS / name).is_dir() else Path(name)
        try:
            write_head(source, folder, template, options.output / folder.name if options.output else folder)
        except RisoriusError as error:
            parser.exit(1, f"{error}\n")


def write_head(source: Source, folder: Path, template: Shape, output: Path) -> None:
    """Build the identity in `folder` and write its files to `output`."""
    identity = read_identity(folder / IDENTITY)
    same = folder.resolve() == TEMPLATE.resolve()
    shape = template if same else Shape.of(source, identity, template)
    output.mkdir(parents=True, exist_ok=True)
    write_npz(output / "head.npz", build(shape, RECIPES))
    write_npz(output / AGES, build_ages(source, identity, shape))
    (output / "LICENSE").write_text(source.licence(), encoding="utf-8")


if __name__ == "__main__":
    main()

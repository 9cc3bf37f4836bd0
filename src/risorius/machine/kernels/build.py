"""Compile kernels in processes of their own: `python -m risorius.machine.kernels.build FOLDER [--installed]`.

That program runs when the package is built. It compiles all kernels whose files are missing in the folder;
with `--installed` it also writes their digests, for an installed package, whose sources do not change.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path

from .. import cache_folder
from ..processes import processors
from .declared import kernels
from .digest import digest, reached
from .files import file_name, of_packages

_DECLARES = re.compile(r"^@kernel\(", re.MULTILINE)
CodeFile = tuple[str, str, str]
"""A kernel's name, the processors that code is for, and the file that it is written to."""
_SETUP = 3000
"""Characters of source that take as long to compile as the entry of a kernel."""
_TWICE = 3
"""How much worse it is to compile something in two processes than to have one that works longer."""


def compile_into(folder: Path, files: Sequence[CodeFile]) -> None:
    """Compile kernels into files of a folder, in a process for each core.

    Raises ValueError of one line if one cannot be compiled.
    """
    folder.mkdir(parents=True, exist_ok=True)
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    variables.pop("RISORIUS_STRICT", None)
    running = [
        subprocess.Popen(
            [sys.executable, "-m", "risorius.machine.kernels.compile", str(folder), *share],
            env=variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for share in _shares(files, processors())
    ]
    said = [process.communicate()[1] for process in running]
    for process, text in zip(running, said, strict=True):
        if process.returncode:
            raise ValueError((text.strip().splitlines() or [f"exit code {process.returncode}"])[-1])


def _shares(files: Sequence[CodeFile], count: int) -> Iterator[list[str]]:
    """Yield arguments for at most `count` processes of about the same work.

    A process compiles each device function once, so kernels that reach the same ones go together.
    """
    texts = {name: reached(kernels[name]) for name, _, _ in files}
    shares: list[tuple[dict[str, str], list[str]]] = [({}, []) for _ in range(min(count, len(texts)))]

    def cost(share: tuple[dict[str, str], list[str]], texts: dict[str, str]) -> int:
        before, after = _work(share[0]), _work(share[0] | texts)
        return after + _SETUP * len(share[1]) + _TWICE * (after - before)

    for name in sorted(texts, key=lambda name: -_work(texts[name])):
        reached_texts, names = min(shares, key=lambda share: cost(share, texts[name]))
        reached_texts |= texts[name]
        names += ("=".join(file) for file in files if file[0] == name)
    return (names for _, names in shares if names)


def _work(texts: dict[str, str]) -> int:
    return sum(map(len, texts.values()))


def import_all() -> None:
    """Import all modules of the package that declare kernels."""
    for path in sorted(cache_folder.ROOT.rglob("*.py")):
        if _DECLARES.search(path.read_text(encoding="utf-8")):
            parts = path.relative_to(cache_folder.ROOT).with_suffix("").parts
            import_module(".".join(("risorius", *parts)))


def main(arguments: Sequence[str]) -> int:
    """Compile all kernels, except those that lie in the folder or the tree of sources already."""
    folder = Path(arguments[0]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    import_all()
    digests = {name: digest(kernel) for name, kernel in sorted(kernels.items())}
    files = [
        (name, processors, file_name(name, made_of, processors))
        for name, made_of in digests.items()
        for processors in of_packages(kernels[name].wide)
    ]
    _tidy(folder, {file for _, _, file in files})
    compile_into(folder, [file for file in files if not (folder / file[2]).exists()])
    if "--installed" in arguments:
        index = {"sources": {"all": cache_folder.source_digest()}, "kernels": digests}
        (folder / cache_folder.INDEX).write_text(json.dumps(index, indent=1), encoding="utf-8")
    return 0


def _tidy(folder: Path, files: set[str]) -> None:
    """Remove other files than some from a folder, and copy to it those that the tree of sources has."""
    for path in folder.glob("*.o"):
        if path.name not in files:
            path.unlink()
    for file in files:
        if not (folder / file).exists() and (cache_folder.PACKAGED / file).exists():
            shutil.copy(cache_folder.PACKAGED / file, folder / file)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

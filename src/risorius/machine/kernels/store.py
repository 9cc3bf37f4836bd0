"""Find the machine code of a kernel in the package or the user's cache, or else let numba compile it.

Files are named by a kernel, the digest of what it is made of and the processors that its code is for. An
installed package knows the digests; in a tree of sources they are computed, so that whatever was edited since
the last build is compiled at its next call.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path

from ...errors import RisoriusError
from .. import cache_folder
from .declared import Declaration, kernels
from .files import file_name, of_this_machine

EXTRA = "compile"
"""The extra of this package that brings numba."""


def find(kernel: Declaration) -> bytes:
    """Return a kernel's code; raise RisoriusError if it has to be compiled and cannot be."""
    file = _file(kernel)
    for folder in (cache_folder.PACKAGED, _cache()):
        try:
            return (folder / file).read_bytes()
        except OSError:
            continue
    _compile([kernel, *_others_missing(kernel)])
    return (_cache() / file).read_bytes()


def _file(kernel: Declaration) -> str:
    installed = cache_folder.built()
    if installed is not None and kernel.name in installed["kernels"]:
        return file_name(kernel.name, installed["kernels"][kernel.name], of_this_machine(kernel.wide))
    from .digest import digest

    return file_name(kernel.name, digest(kernel), of_this_machine(kernel.wide))


def _cache() -> Path:
    return cache_folder.in_use() / "kernels"


def _others_missing(kernel: Declaration) -> list[Declaration]:
    """Return the other kernels of the same file without code, which are likely to be called next."""
    module = kernel.function.__module__
    others = [one for one in kernels.values() if one.function.__module__ == module and one is not kernel]
    folders = cache_folder.PACKAGED, _cache()
    return [one for one in others if not any((folder / _file(one)).exists() for folder in folders)]


def _compile(missing: Sequence[Declaration]) -> None:
    """Let processes of their own compile kernels into the user's cache, and say so in one line."""
    names = ", ".join(kernel.name for kernel in missing)
    if importlib.util.find_spec("numba") is None:
        raise RisoriusError(
            f"there is no machine code of {names} for this source or this machine, and numba, which compiles "
            f"it, is not installed: pip install 'risorius[{EXTRA}]'"
        )
    from .build import compile_into

    print(f"risorius: compiling {names} (once) …", file=sys.stderr, flush=True)
    try:
        files = ((kernel.name, of_this_machine(kernel.wide), _file(kernel)) for kernel in missing)
        compile_into(_cache(), list(files))
    except ValueError as error:
        raise RisoriusError(f"a kernel cannot be compiled: {error}") from None

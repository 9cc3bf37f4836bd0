"""Compile kernels with numba: `python -m risorius.machine.kernels.compile FOLDER NAME=PROCESSORS=FILE ...`.

This program writes the machine code of each named kernel to a file of the folder. It runs by itself, because
device functions are declared to numba as they are imported. Only numba's published interface is used.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

# Colours in messages that nobody reads take time, and code is optimized again when it is whole.
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")
os.environ.setdefault("NUMBA_OPT", "1")

import numba

from .declared import Arithmetic, Declaration, Device, device_compilers, kernels
from .entry import KINDS, entry_of
from .object_code import symbol
from .optimize import object_file

_FLAGS: dict[Arithmetic, Any] = {
    "exact": False,
    "sums": {"contract", "reassoc"},
    # Not the whole of fastmath: nan and infinity keep their meaning, and sums their order, since short loops
    # over lamps would otherwise be turned into wide vector code that is three times as slow.
    "fast": {"contract", "arcp", "nsz", "afn"},
    "fast sums": {"contract", "arcp", "nsz", "afn", "reassoc"},
}


def compile_device(function: Any, described: Device) -> Any:
    """Return a function as numba compiles it into kernels."""
    return numba.njit(
        error_model="numpy",
        fastmath=_FLAGS[described.arithmetic],
        forceinline=described.inlined,
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
    )(function)


def llvm_texts(kernel: Declaration) -> dict[str, str]:
    """Return the LLVM texts of a kernel's entries by their symbols."""
    compiled = compile_device(kernel.function, Device(kernel.arithmetic, False))
    texts = {}
    for number, signature in enumerate(kernel.signatures):
        entry = numba.cfunc(KINDS, error_model="numpy")(entry_of(kernel, signature, compiled))
        texts[symbol(kernel.name, number)] = entry.inspect_llvm()
    return texts


def write(path: Path, content: bytes) -> None:
    """Write beside, then rename: another process may look for the same file."""
    beside = path.with_name(f"{path.name}.{os.getpid()}.part")
    beside.write_bytes(content)
    beside.replace(path)


def main(arguments: Sequence[str]) -> int:
    """Compile what the arguments name; say which kernel cannot be compiled, and why."""
    gc.disable()  # it would look through millions of live objects, for a twentieth of the time
    device_compilers.append(compile_device)
    folder = Path(arguments[0])
    texts: dict[str, dict[str, str]] = {}
    for argument in arguments[1:]:
        name, processors, file = argument.split("=")
        import_module(f"risorius.{name.rpartition('.')[0]}")
        try:
            if name not in texts:
                texts = {name: llvm_texts(kernels[name])}
            write(folder / file, object_file(texts[name], processors))
        except Exception as error:  # numba raises errors of many kinds
            print(f"{name}: {' '.join(str(error).split())}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

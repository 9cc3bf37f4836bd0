"""Write the kernels that come with the package, as optimized LLVM code (`core/kernels/kernels.zip`).

`python tools/build_kernels.py`, after a kernel was changed; half a minute. The outputs below are made with an
empty cache, and what numba compiles for them is kept. The same sources give the same bytes, whatever the
processor.
"""

from __future__ import annotations

import argparse
import io
import itertools
import json
import os
import pkgutil
import shlex
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numba.core.bytecode import FunctionIdentity

ROOT = Path(__file__).resolve().parent.parent
PICTURES = {
    "realistic": "speak Hi. --text -o x.png",
    "explaining": "speak Hi. --text --style muscles -o x.png",
}
"""First pictures, whose kernels are listed in the file."""
OUTPUTS = (
    *PICTURES.values(),
    *(f"speak Hi. --text --style {style} -o x.png" for style in ("clay", "wireframe")),
    *(f"speak Hi. --text --quality {quality} -o x.png" for quality in ("draft", "high")),
    "speak Hi. --text --size 96x96 --background transparent -o x.png",
    "speak 'My baby, oh!' --text --emotion surprise:1 --size 96x96 -o x.mp4 -o x.glb -o x.arkit.csv",
    "speak Hi. --text --size 96x96 --skin biphasic --muscles lines -o x.mp4",
)
FIXED = {
    "PYTHONHASHSEED": "0",
    "NUMBA_CPU_NAME": "znver4",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "PYTHONPATH": str(ROOT / "src"),
    "RISORIUS_STRICT": "1",
    "RISORIUS_THREADS": "1",
}


def main() -> None:
    """Write the file, or in the processes that this starts, make outputs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "src/risorius/core/kernels/kernels.zip")
    parser.add_argument("--picture", metavar="COMMAND", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.picture:
        print(json.dumps(_used(options.picture)))
    elif os.environ.get("PYTHONHASHSEED") != "0":
        # Other processors and other orders of names would give other bytes.
        with tempfile.TemporaryDirectory() as folder:
            variables = {**os.environ, **FIXED, "NUMBA_CACHE_DIR": folder}
            command = [sys.executable, __file__, "-o", str(options.output.resolve())]
            sys.exit(subprocess.run(command, env=variables, check=False).returncode)
    else:
        _write(options.output, *_compiled())


def _compiled() -> tuple[list[Any], dict[str, bytes]]:
    """Return an entry for each kernel that the outputs need, and their code."""
    shipped, code = _without_file(), {}
    # numba counts the functions of a process in their names: these shall not meet those that it compiles.
    FunctionIdentity._unique_ids = itertools.count(1_000_000)
    kept, store = {}, shipped.KernelCache.save_overload
    finish = shipped.JITCodeLibrary._finalize_final_module

    def keep_code(library: Any) -> None:
        code[library] = library._final_module.as_bitcode()
        finish(library)

    def keep(cache: Any, kinds: Any, result: Any) -> None:
        name = shipped.name_of(cache._py_func)
        kept[name, shipped.kernel_source.signature_text(kinds)] = result
        store(cache, kinds, result)

    shipped.JITCodeLibrary._finalize_final_module = keep_code
    shipped.KernelCache.save_overload = keep
    for output in OUTPUTS:
        _make(output)
    missing = sorted(set(kernels()) - {name for name, _ in kept})
    if missing:
        sys.exit(f"no output needs these kernels; add one that does: {', '.join(missing)}")
    entries: list[Any] = []
    codes: dict[str, bytes] = {}
    for (name, arguments), result in sorted(kept.items()):
        entry, data = _entry(shipped, name, arguments, result, code[result.library], len(entries))
        entries.append(entry)
        codes[entry.code] = data
    return entries, codes


def _entry(
    shipped: Any, name: str, arguments: str, result: Any, code: bytes, number: int
) -> tuple[Any, bytes]:
    descriptor, kernel = result.fndesc, getattr(import_module(name.split(":")[0]), name.split(":")[1])
    objects, returned = result.environment.consts, str(result.signature.return_type)
    if returned not in shipped.RESULTS or not all(isinstance(held, np.dtype) for held in objects):
        sys.exit(f"{name}: a result of this type, or an object of Python within a kernel, cannot be shipped")
    entry = shipped.ShippedKernel(
        kernel=name,
        arguments=arguments,
        source=shipped.kernel_source.digest(kernel),
        code=f"{number:03}-{kernel.__name__}.bc",
        symbol=descriptor.mangled_name,
        environment=descriptor.env_name,
        result=returned,
        dtypes=[held.str for held in objects],
    )
    entrances = {descriptor.llvm_func_name, descriptor.llvm_cpython_wrapper_name, descriptor.env_name}
    return entry, _alone(code, entrances, name)


def _alone(code: bytes, entrances: set[str], name: str) -> bytes:
    """Return a kernel's code without what nothing in it calls, and without names for others to find."""
    import llvmlite.binding as llvm

    module = llvm.parse_bitcode(code)
    for value in (*module.functions, *module.global_variables):
        if not value.is_declaration and value.name not in entrances:
            value.linkage = "internal"
    target = llvm.Target.from_default_triple().create_target_machine()
    builder = llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=0))
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder)
    _check(module, entrances, name)
    return bytes(module.as_bitcode())


def _check(module: Any, entrances: set[str], name: str) -> None:
    """End if code would not run, or not be the same, elsewhere."""
    for function in module.functions:
        # Counting down is the same instruction on each of them.
        if function.name.startswith("llvm.x86.") and not function.name.startswith("llvm.x86.atomic."):
            sys.exit(f"{name}: {function.name} is not an instruction of every processor")
    for variable in module.global_variables:
        if ".py\\" in str(variable):
            sys.exit(f"{name} names a file of this machine in an error; a loop raises none, a slice does")
        if variable.name.startswith("_ZN08NumbaEnv") and variable.name not in entrances:
            sys.exit(f"{name}: a function within it needs objects of Python")


def kernels() -> Iterator[str]:
    """Yield the names of all kernels of the package."""
    import risorius
    from risorius.core.kernels.shipped import KernelCache, name_of

    for package in ("core", "face", "looks", "render", "ports"):
        path = [str(Path(risorius.__path__[0], package))]
        for module in pkgutil.walk_packages(path, f"risorius.{package}."):
            for value in vars(import_module(module.name)).values():
                if isinstance(getattr(value, "_cache", None), KernelCache):
                    yield name_of(value.py_func)


def _used(output: str) -> list[list[str]]:
    """Return the kernels that an output needs, as keys of entries."""
    shipped = _without_file()
    keys, find = [], shipped.KernelCache.load_overload

    def keep(cache: Any, kinds: Any, context: Any) -> Any:
        keys.append([shipped.name_of(cache._py_func), shipped.kernel_source.signature_text(kinds)])
        return find(cache, kinds, context)

    shipped.KernelCache.load_overload = keep
    _make(output)
    return sorted(keys)


def _without_file() -> Any:
    from risorius.core.kernels import shipped

    shipped.load = lambda *_: None
    return shipped


def _make(output: str) -> None:
    from risorius.cli import run

    with tempfile.TemporaryDirectory() as folder:
        here = Path.cwd()
        os.chdir(folder)
        try:
            if run([*shlex.split(output), "--quiet"]):
                sys.exit(f"risorius {output} failed")
        finally:
            os.chdir(here)


def _write(path: Path, entries: list[Any], codes: dict[str, bytes]) -> None:
    from risorius.core.kernels import shipped

    pictures = {name: _in_a_process(output) for name, output in PICTURES.items()}
    index = {
        "fits": shipped.machine(),
        "pictures": pictures,
        "entries": [entry._asdict() for entry in entries],
    }
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in {shipped.INDEX: json.dumps(index, indent=1).encode(), **codes}.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    path.write_bytes(written.getvalue())
    print(f"{path}: {len(entries)} kernels, {len(written.getvalue()):,} bytes")


def _in_a_process(output: str) -> Any:
    ran = subprocess.run(
        [sys.executable, __file__, "--picture", output], capture_output=True, text=True, check=True
    )
    return json.loads(ran.stdout)


if __name__ == "__main__":
    main()

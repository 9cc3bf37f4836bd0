"""The files of kernels' machine code: what they are called, and for which processors they are."""

from __future__ import annotations

import platform
from functools import lru_cache

BASELINE, WIDE = "x86-64-v3", "x86-64-v4"
"""The processors that the package's code is for, as LLVM calls them.

The first have AVX2: those of 2013 (Intel) or 2015 (AMD) and later. The second have AVX-512.
"""
_NEEDED = {
    BASELINE: ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe"),
    WIDE: ("avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"),
}


def file_name(kernel: str, digest: str, processors: str) -> str:
    """Return what the file of a kernel's code is called."""
    return f"{kernel}-{digest}-{processors}.o"


def of_packages(wide: bool) -> list[str]:
    """Return the processors that a package is built for: on x86-64 the baseline, for `wide` kernels more."""
    if platform.machine().lower() not in ("x86_64", "amd64"):
        return [_own()]
    return [BASELINE, WIDE] if wide else [BASELINE]


@lru_cache(maxsize=2)
def of_this_machine(wide: bool) -> str:
    """Return those that this machine needs code for: the most that packages are built for, or its own."""
    from llvmlite import binding

    features = binding.get_host_cpu_features()
    suited = _own()
    for processors in of_packages(wide):
        if not all(features.get(feature) for feature in _NEEDED.get(processors, ())):
            break
        suited = processors
    return suited


def _own() -> str:
    from llvmlite import binding

    return str(binding.get_host_cpu_name())

"""Machine code is linked wherever the process has room for it."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it takes address space as Linux gives it")

# Sections of one object lie more than 2 GB apart if one finds a small hole in a full address space, and the
# next one does not. A relocation of 32 bits does not reach so far: LLVM ends the process.
CROWDED = """
import ctypes, random, sys
from risorius.machine.kernels import object_code
from risorius.machine.kernels.build import import_all
from risorius.machine.kernels.declared import kernels

c = ctypes.CDLL(None)
c.mmap.restype = ctypes.c_void_p
c.mmap.argtypes = (ctypes.c_void_p, ctypes.c_size_t, *[ctypes.c_int] * 3, ctypes.c_long)
c.munmap.argtypes = (ctypes.c_void_p, ctypes.c_size_t)
PRIVATE_UNRESERVED = 0x4022

def take(size):
    address = c.mmap(None, size, 0, PRIVATE_UNRESERVED, -1, 0)
    assert address not in (None, 2**64 - 1)
    return address, size

draw = random.Random(int(sys.argv[1]))
import_all()
order = sorted(kernels)
draw.shuffle(order)
taken = []
for name in order:
    object_code.load(kernels[name])
    take(4 << 30)
    taken += [take(4096 * draw.choice([1, 2, 4, 8, 16, 32])) for _ in range(8)]
    for _ in range(6):
        c.munmap(*taken.pop(draw.randrange(len(taken))))
print(len(order), "kernels")
"""


@pytest.mark.parametrize("seed", [1, 2])
def test_code_is_linked_in_a_crowded_address_space(seed: int) -> None:
    command = [sys.executable, "-c", CROWDED, str(seed)]
    done = subprocess.run(command, env=os.environ.copy(), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-500:]
    assert done.stdout.endswith("kernels\n")

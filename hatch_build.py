"""Compile the kernels when the package is built: into the wheel, or for an editable install into the sources.

The folder `src/risorius/machine/code` is no part of the repository. In an editable install kernels that were
edited since are compiled at their next call, so that nobody has to install again.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_CODE = "risorius/machine/code"


class KernelBuildHook(BuildHookInterface[Any]):  # type: ignore[misc]  # hatchling is no part of the types
    """Adds the kernels' machine code to a wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, and say which files belong to the wheel and for which machines it is."""
        sources = Path(self.root) / "src"
        if version == "editable":
            self._compile(sources, sources / _CODE)
            return
        folder = Path(self.root) / "build" / "kernels"
        self._compile(sources, folder, "--installed")
        build_data["force_include"][str(folder)] = _CODE
        build_data["pure_python"] = False
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["tag"] = f"py3-none-{platform}"

    def _compile(self, sources: Path, folder: Path, *options: str) -> None:
        """Compile in a process that finds the sources, and what this one finds."""
        paths = os.pathsep.join([str(sources), *filter(None, sys.path)])
        command = [sys.executable, "-m", "risorius.machine.kernels.build", str(folder), *options]
        subprocess.run(command, env={**os.environ, "PYTHONPATH": paths}, cwd=self.root, check=True)

"""Every module that the page imports is in the page."""

from __future__ import annotations

import base64
import json
import re

from risorius.ports.page.html import ENTRY
from risorius.ports.page.page_modules import import_map, name_of


def test_modules_import_each_other_by_names_of_the_map() -> None:
    imports = json.loads(import_map(ENTRY))["imports"]
    assert name_of(ENTRY) in imports
    for address in imports.values():
        text = base64.b64decode(address.partition(",")[2]).decode()
        assert not re.search(r"""(?:\bfrom|\bimport)\s*["']\.""", text)
        for name in re.findall(r"""(?:^|[;}\s])(?:from|import)\s*["'](risorius/[^"']+)""", text):
            assert name in imports

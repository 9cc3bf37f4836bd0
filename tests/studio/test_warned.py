"""Warnings are told to the thread that they come from."""

from __future__ import annotations

import threading
import warnings

import pytest

from risorius.errors import RisoriusWarning
from risorius.studio.warned import collected


def test_each_thread_hears_its_own():
    heard, together = {}, threading.Barrier(4)

    def work(name):
        with collected() as found:
            together.wait()
            warnings.warn(f"{name} is\n odd", RisoriusWarning, stacklevel=1)
            together.wait()
        heard[name] = found

    threads = [threading.Thread(target=work, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert heard == {name: [f"{name} is odd"] for name in "abcd"}


def test_other_warnings_and_those_outside_are_as_they_were():
    with collected() as found:
        pass
    with pytest.warns(RisoriusWarning, match="outside"):
        warnings.warn("outside", RisoriusWarning, stacklevel=1)
    assert found == []
    with pytest.warns(UserWarning, match="of another kind"), collected() as found:
        warnings.warn("of another kind", UserWarning, stacklevel=1)
    assert found == []

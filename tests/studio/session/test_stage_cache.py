from __future__ import annotations

import pytest

from risorius.errors import InputError
from risorius.studio.session.stage_cache import StageCache


def test_a_stage_that_fails_leaves_nothing() -> None:
    cache: StageCache[int] = StageCache(2)
    with pytest.raises(InputError):
        cache.get("a", _fail)
    assert cache.get("a", lambda: 1) == 1


def _fail() -> int:
    raise InputError("odd")


def test_a_stage_runs_once_for_what_it_reads_and_again_when_forgotten() -> None:
    cache: StageCache[str | None] = StageCache(2)
    runs: list[str] = []

    def get(key: str) -> str | None:
        return cache.get(key, lambda: runs.append(key))

    for key in "aabbacab":
        assert get(key) is None
    assert runs == ["a", "b", "c", "a", "b"]

"""Solvers are kept by all that they are made of, and by nothing else."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from risorius import solvers
from risorius.live import weights
from risorius.settings import Settings, settings_of
from risorius.settings.declare import Stage, rows
from risorius.solvers import SolverCache, solver_key
from risorius.studio.faces.solvers import Solvers
from risorius.take import HeadCache

from .setting_cases import BASE, CASES

SOLVED = (Stage.HEAD, Stage.SHAPE, Stage.SKIN)


class Solver:
    """Stands for a solver."""

    def __init__(self, settings: Settings) -> None:
        self.rows = solvers.links_of(settings)


@pytest.fixture
def unlinked(tmp_path: Path) -> Settings:
    """Return settings whose rules leave out a link of two muscles."""
    file = tmp_path / "unlinked.toml"
    file.write_text('delete = ["links.levator_labii_superioris"]\n')
    return Settings(rules=file)


@pytest.fixture(autouse=True)
def cheap(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solvers, "make_solver", Solver)


def test_a_solver_with_other_links_is_not_lent(unlinked: Settings) -> None:
    cache = Solvers()
    with cache.lent(Settings()) as usual:
        pass
    with cache.lent(unlinked) as other:
        assert len(other.rows) == len(usual.rows) - 1
    with cache.lent(Settings()) as again:
        assert again is usual


def test_takes_share_solvers_by_their_links(unlinked: Settings) -> None:
    cache = HeadCache()
    usual = cache.solver(Settings())
    assert cache.solver(unlinked) is not usual
    assert cache.solver(Settings(seed=7)) is usual


def test_live_faces_share_solvers_by_their_links(unlinked: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(weights, "LiveSolvers", Solver)
    heads = [Settings(age=91.0), replace(unlinked, age=91.0), Settings(age=91.0, seed=7)]
    usual, other, again = map(weights.solvers_of, heads)
    assert other is not usual
    assert again is usual


def test_rules_that_change_no_link_change_no_solver(tmp_path: Path) -> None:
    file = tmp_path / "plain.toml"
    file.write_text("")
    assert solver_key(Settings(rules=file)) == solver_key(Settings())


def test_a_file_of_rules_that_changes_gives_another_solver(unlinked: Settings) -> None:
    before = solver_key(unlinked)
    assert unlinked.rules is not None
    unlinked.rules.write_text("")
    assert solver_key(unlinked) != before


def test_a_key_changes_with_the_settings_of_head_shape_and_skin_alone() -> None:
    usual = solver_key(BASE)
    others = {name: row for name, row in rows(Settings).items() if name != "rules"}
    changed = {name for name in others if solver_key(settings_of({name: CASES[name]}, BASE)) != usual}
    assert changed == {name for name, row in others.items() if row.entry.stage in SOLVED}


def test_the_oldest_solver_goes_first() -> None:
    cache = SolverCache(2)
    first = cache.shared(Settings())
    second = cache.shared(Settings(age=40.0))
    assert cache.shared(Settings()) is first
    cache.shared(Settings(age=50.0))
    assert cache.shared(Settings()) is first
    assert cache.shared(Settings(age=40.0)) is not second


def test_a_lent_solver_is_lent_to_nobody_else() -> None:
    cache = SolverCache(4)
    with cache.lent(Settings()) as one, cache.lent(Settings()) as other:
        assert one is not other

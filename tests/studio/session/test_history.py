"""Undo: what is done and undone leaves the state before; what is undone and redone the state after."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.studio.session.history import History

MOST = 5
steps = st.lists(st.one_of(st.integers(), st.sampled_from(["undo", "redo"])), max_size=30)


def test_nothing_is_undone_before_there_is_something():
    history: History[int] = History(MOST)
    assert history.present is None
    for act in (history.undo, history.redo):
        with pytest.raises(InputError, match="there is nothing"):
            act()
    history.push(1, "one")
    with pytest.raises(InputError, match="there is nothing to undo"):
        history.undo()


@given(steps)
def test_it_is_a_line_of_states_with_one_present(done):
    history: History[int] = History(MOST)
    past, future = [], []
    for step in done:
        if step == "undo" and len(past) > 1:
            future.append(past.pop())
            assert history.undo() == past[-1]
        elif step == "redo" and future:
            past.append(future.pop())
            assert history.redo() == past[-1]
        elif isinstance(step, int):
            past, future = [*past, step][-MOST - 1 :], []
            history.push(step, str(step))
        assert history.present == (past[-1] if past else None)
        assert history.undoes == (str(past[-1]) if len(past) > 1 else "")
        assert history.redoes == (str(future[-1]) if future else "")

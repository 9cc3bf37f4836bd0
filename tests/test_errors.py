import threading
import warnings

import pytest

from risorius.errors import InputError, Place, RisoriusWarning, unknown, warn, warnings_to


def test_place_is_file_line_column() -> None:
    error = InputError("onset must be a number", Place("a.xml", 3, 14))
    assert str(error) == "a.xml:3:14: onset must be a number"


def test_a_place_once_given_is_kept() -> None:
    error = InputError("x", Place("a.xml", 1))
    assert error.at(Place("b.xml")) is error
    assert str(InputError("x").at(Place("b.xml"))) == "b.xml: x"


def test_the_nearest_name_is_suggested_whatever_the_case() -> None:
    assert "did you mean 'happiness'" in unknown("emotion", "HAPPINES", ["happiness", "anger"])
    assert "expected one of happiness, anger" in unknown("emotion", "zzz", ["happiness", "anger"])


def test_what_a_terminal_obeys_is_not_repeated() -> None:
    assert str(InputError("unknown word '\x1b[2J\0'")) == "unknown word '\ufffd[2J\ufffd'"


def test_long_names_are_cut() -> None:
    assert len(unknown("column", "x" * 10_000, ["Timecode"])) < 120


def test_each_of_two_runs_in_two_threads_receives_its_own_warnings() -> None:
    received: dict[str, list[str]] = {"a": [], "b": []}
    together = threading.Barrier(2, timeout=60)

    def run(name: str) -> None:
        with warnings_to(received[name].append):
            together.wait()
            warn(f"{name} is\n odd")
            together.wait()

    threads = [threading.Thread(target=run, args=(name,)) for name in received]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert received == {"a": ["a is odd"], "b": ["b is odd"]}


def test_the_inner_of_two_receivers_receives_and_python_before_and_after() -> None:
    outer: list[str] = []
    inner: list[str] = []

    def stopped() -> None:
        with warnings_to(inner.append):
            warn("first")
            raise InputError("stopped")

    with warnings_to(outer.append):
        with pytest.raises(InputError):
            stopped()
        warn("second")
    with pytest.warns(RisoriusWarning, match="^third$"):
        warn("third")
    assert (outer, inner) == (["second"], ["first"])


def test_other_warnings_go_python_s_way() -> None:
    received: list[str] = []
    with pytest.warns(UserWarning, match="of another kind"), warnings_to(received.append):
        warnings.warn("of another kind", UserWarning, stacklevel=1)
    assert received == []


def test_a_warning_stands_at_the_line_that_called_the_package() -> None:
    with pytest.warns(RisoriusWarning) as caught:
        warn("odd")
    assert caught[0].filename == __file__

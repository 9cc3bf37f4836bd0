from risorius.errors import InputError, Place, unknown


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

from hypothesis import given
from hypothesis import strategies as st

from risorius.script.quote import one_line, quoted


@given(st.text(max_size=80), st.integers(1, 50))
def test_whatever_is_shown_fits_on_a_line(text: str, longest: int) -> None:
    shown = one_line(text, longest)
    assert shown.isprintable()
    assert len(shown) <= longest
    assert text.isprintable() is False or shown == text or shown.endswith("…")


def test_quotation() -> None:
    assert quoted("a\nb") == "'a b'"
    assert quoted("x" * 50) == "'" + "x" * 39 + "…'"

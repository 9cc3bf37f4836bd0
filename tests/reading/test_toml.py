"""TOML that is written is read back as it was."""

from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from risorius.reading.toml import written

text = st.text('aB7-_. "\\\n\t\x00\x7f=#[]é𝄞', max_size=8)
scalar = st.one_of(
    text, st.booleans(), st.integers(-(2**60), 2**60), st.floats(allow_nan=False, allow_infinity=False)
)
value = st.one_of(scalar, st.lists(scalar, max_size=3))
tables = st.recursive(
    st.dictionaries(text, value, max_size=4),
    lambda inner: st.dictionaries(text, st.one_of(value, inner), max_size=4),
    max_leaves=8,
)


@given(tables)
def test_what_is_written_is_read_back(table):
    assert tomllib.loads(written(table)) == table

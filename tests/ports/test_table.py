from pathlib import Path

import pytest

from risorius.ports.table import table_lines, write_lines


def test_a_row_of_another_length_is_refused() -> None:
    with pytest.raises(ValueError, match="expected \\(2,\\)"):
        list(table_lines(["a", "b"], [[1.0]], [1, 1]))


def test_numbers_have_their_decimals_and_zero_no_sign(tmp_path: Path) -> None:
    rows = [[1 / 3, -1e-9], [0.0005, -0.06]]
    write_lines(tmp_path / "x.csv", table_lines(["a", "b"], rows, [3, 1]))
    assert (tmp_path / "x.csv").read_bytes() == b"a,b\n0.333,0.0\n0.000,-0.1\n"

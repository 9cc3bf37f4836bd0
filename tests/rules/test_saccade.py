import pytest

from risorius.errors import InputError
from risorius.rules.load import parse
from risorius.rules.saccade import Saccade, saccade_duration


@pytest.mark.parametrize("text", ["latency = 0.025\nper_degree = -0.1", "latency = 0.025"])
def test_a_table_out_of_range_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="per_degree"):
        parse(Saccade, text, "s.toml")


def test_saccades_follow_the_main_sequence() -> None:
    assert saccade_duration(0.0) == pytest.approx(0.025)
    assert saccade_duration(10.0) == pytest.approx(0.049)
    assert saccade_duration(-10.0) == saccade_duration(10.0)

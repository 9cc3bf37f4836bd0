"""`benchmarks/compare_takes.py` finds what was done to a take: delays, amplitudes, noise, missing curves."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.arkit import INDEX
from risorius.errors import InputError
from risorius.face.fit.arkit_track import ArkitTrack
from risorius.ports.curves.arkit_csv import ArkitTake, rows
from risorius.ports.table import write_lines
from tests.profiles import examples


@pytest.fixture(scope="module")
def tool() -> ModuleType:
    sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
    import compare_takes

    return compare_takes


def moving(seconds: float = 6.0, fps: float = 60.0, late: float = 0.0) -> ArkitTake:
    """A jaw and a smile that move at their own rates, everything else at rest."""
    times = np.arange(0.0, seconds, 1.0 / fps)
    weights = np.zeros((len(times), 52))
    at = times - late
    weights[:, INDEX["jawOpen"]] = 0.3 + 0.2 * np.sin(5.1 * at) * np.sin(1.3 * at) + 0.1 * np.sin(11.0 * at)
    weights[:, INDEX["mouthSmileLeft"]] = 0.4 + 0.3 * np.sin(1.7 * at) * np.sin(3.9 * at)
    return ArkitTake(times, weights, np.zeros((len(times), 9)))


def test_takes_that_share_no_time_are_refused(tool: ModuleType) -> None:
    with pytest.raises(InputError, match=r"the takes share 0.50 s; expected 1.5 s or more"):
        tool.compare(moving(), tool.started(moving(), 5.4833))


def test_a_take_is_like_itself(tool: ModuleType) -> None:
    found = tool.compare(moving(), moving())
    assert [row.name for row in found] == ["jawOpen", "mouthSmileLeft"]
    for row in found:
        assert (row.as_is, row.correlation, row.amplitude) == pytest.approx((1.0, 1.0, 1.0))
        assert row.lag == pytest.approx(0.0, abs=1e-6)
    assert tool.still(moving(), moving()) == ([], [])


@examples(25)
@given(st.floats(-0.3, 0.3), st.floats(0.3, 1.0), st.sampled_from([24.0, 30.0, 60.0]))
def test_delay_and_amplitude_are_found(tool: ModuleType, late: float, share: float, fps: float) -> None:
    other = moving(fps=fps, late=late)
    other = replace(other, weights=share * other.weights)
    for row in tool.compare(moving(), other):
        assert row.lag == pytest.approx(late, abs=0.006)
        assert row.correlation > 0.98
        assert row.amplitude == pytest.approx(share, rel=0.12)


def test_a_start_moves_the_capture(tool: ModuleType) -> None:
    """A capture that began 0.2 s before the sound is in time when that is said."""
    early = moving(late=0.2)
    late, right = (tool.compare(tool.started(early, start), moving()) for start in (0.0, 0.2))
    assert [row.lag for row in late] == pytest.approx([-0.2, -0.2], abs=0.005)
    assert [row.lag for row in right] == pytest.approx([0.0, 0.0], abs=0.005)


def test_noise_lowers_the_correlation_and_not_the_lag(tool: ModuleType) -> None:
    other = moving(late=0.1)
    noise = 0.15 * np.random.default_rng(1).standard_normal(other.weights.shape)
    for row in tool.compare(moving(), replace(other, weights=other.weights + noise)):
        assert 0.3 < row.correlation < 0.95
        assert row.lag == pytest.approx(0.1, abs=0.04)


def test_what_moves_in_one_only_is_named(tool: ModuleType) -> None:
    other = moving()
    other.weights[:, INDEX["jawOpen"]] = 0.0
    other.weights[:, INDEX["mouthPucker"]] = np.linspace(0.0, 1.0, len(other.times))
    assert [row.name for row in tool.compare(moving(), other)] == ["mouthSmileLeft"]
    assert tool.still(moving(), other) == (["jawOpen"], ["mouthPucker"])


def test_the_command_prints_and_draws(
    tool: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In a process of its own: what draws must not stay in this one."""
    one, other = tmp_path / "one.arkit.csv", tmp_path / "other.arkit.csv"
    for path, late in ((one, 0.0), (other, 0.1)):
        take = moving(late=late)
        still = np.zeros((len(take.times), 3, 3))
        track = ArkitTrack(take.weights, still[:, 0], still[:, 1:], still[:, 0, 0], still[:, 0, 0])
        write_lines(path, rows(track, Fraction(60)))
    command = [sys.executable, tool.__file__, str(one), "--against", str(other)]
    picture = tmp_path / "x.png"
    drawing = ["--picture", str(picture)] if find_spec("matplotlib") else []
    done = subprocess.run([*command, *drawing], capture_output=True, text=True, timeout=120, check=True)
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("jawOpen")]
    name, _, correlation, lag, amplitude = line.split()
    assert (name, float(correlation), float(lag)) == ("jawOpen", 1.0, pytest.approx(100, abs=3))
    assert float(amplitude) == pytest.approx(1.0, abs=0.1)
    assert not drawing or picture.stat().st_size > 5000
    other.write_text(one.read_text().replace("JawOpen", "JawOpne"))
    monkeypatch.setattr(sys, "argv", command[1:])
    with pytest.raises(SystemExit, match="2"):
        tool.main()
    assert "unknown column 'JawOpne'; did you mean 'JawOpen'" in capsys.readouterr().err

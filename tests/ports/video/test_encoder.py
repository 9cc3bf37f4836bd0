import os
import signal
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.core.arrays import ByteArray
from risorius.errors import OutputError, RisoriusWarning
from risorius.machine.atomic import replacing
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.output_files import check_targets, write_targets
from risorius.ports.video.encoder import VideoEncoder
from risorius.ports.video.film import write_film

SIZE = (320, 320)
NOISE = np.random.default_rng(0).integers(0, 256, (SIZE[1], SIZE[0], 3)).astype(np.uint8)
Action = Callable[[int, VideoEncoder], None]

posix = pytest.mark.skipif(os.name != "posix", reason="needs POSIX signals")
linux = pytest.mark.skipif(sys.platform != "linux", reason="needs Linux")


def _film(path: Path, frames: int, act: Action, patience: float = 30.0) -> None:
    with (
        replacing(path) as temporary,
        VideoEncoder(temporary, SIZE, Fraction(30), 22_050, patience) as encoder,
    ):
        for k in range(frames):
            act(k, encoder)
            encoder.picture(np.roll(NOISE, k, 0))
            encoder.sound(np.zeros(735, np.int16))


def _at(frame: int, number: int) -> Action:
    return lambda k, encoder: os.kill(encoder.pid, number) if k == frame else None


def _is_running(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_picture_of_another_size_or_kind_is_refused(tmp_path: Path) -> None:
    with (
        pytest.raises(ValueError, match=r"expected uint8\(320, 320, 3\)"),
        VideoEncoder(tmp_path / "x.mp4", SIZE, Fraction(30)) as encoder,
    ):
        encoder.picture(NOISE[:100])


def test_a_sound_may_be_longer_than_its_pictures(tmp_path: Path) -> None:
    """Answers are read meanwhile: more of them would not fit into the socket."""
    with VideoEncoder(tmp_path / "x.mp4", (64, 64), Fraction(30), 22_050, 30.0) as encoder:
        encoder.picture(np.zeros((64, 64, 3), np.uint8))
        for _ in range(1000):
            encoder.sound(np.zeros(735, np.int16))
    assert (tmp_path / "x.mp4").stat().st_size > 0


@posix
def test_a_killed_worker_is_an_error_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"the video encoder ended without an answer \(signal 9\)"):
        _film(tmp_path / "x.mp4", 500, _at(30, signal.SIGKILL))
    assert list(tmp_path.iterdir()) == []


@posix
@pytest.mark.parametrize("frames", [1, 500])
def test_a_hung_worker_is_given_up(tmp_path: Path, frames: int) -> None:
    with pytest.raises(OutputError, match=r"gave no answer within 0\.8 s"):
        _film(tmp_path / "x.mp4", frames, _at(0, signal.SIGSTOP), patience=0.8)
    assert list(tmp_path.iterdir()) == []


@posix
def test_a_fault_in_the_pictures_ends_the_worker(tmp_path: Path) -> None:
    pids = []

    def act(k: int, encoder: VideoEncoder) -> None:
        pids.append(encoder.pid)
        if k == 5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _film(tmp_path / "x.mp4", 10, act)
    assert not _is_running(pids[0])
    assert list(tmp_path.iterdir()) == []


@linux
def test_a_full_disk_is_told_from_other_faults() -> None:
    """/dev/full refuses every byte, as a full disk does."""
    with (
        pytest.raises(OSError, match="No space left"),
        VideoEncoder(Path("/dev/full"), SIZE, Fraction(30)) as encoder,
    ):
        encoder.picture(NOISE)


@linux
def test_a_disk_that_fills_up_half_way_is_one_line(tmp_path: Path) -> None:
    import resource

    def act(k: int, encoder: VideoEncoder) -> None:
        if k == 0:
            resource.prlimit(encoder.pid, resource.RLIMIT_FSIZE, (100_000, 100_000))

    with pytest.raises(OutputError, match=r"x\.mp4: cannot be written: File too large$"):
        _film(tmp_path / "x.mp4", 500, act)
    assert list(tmp_path.iterdir()) == []


def test_a_worker_that_cannot_start_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = tmp_path / "broken"
    broken.mkdir()
    (broken / "av.py").write_text("raise ImportError('the encoder is not installed')")
    monkeypatch.setattr(sys, "path", [str(broken), *sys.path])
    with pytest.raises(OutputError, match=r"exit code 1\): ImportError: the encoder is not installed"):
        _film(tmp_path / "x.mp4", 5, lambda k, encoder: None)


def test_modules_in_the_current_folder_do_not_reach_the_worker(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "av.py").write_text("raise ImportError('not mine')")
    monkeypatch.chdir(tmp_path)
    _film(Path("x.mp4"), 2, lambda k, encoder: None)
    assert (tmp_path / "x.mp4").stat().st_size > 0


@linux
def test_when_the_program_is_killed_the_worker_goes_and_cleans_up(tmp_path: Path) -> None:
    program = """
import os, signal, sys
from fractions import Fraction
from pathlib import Path
import numpy as np
from risorius.ports.video.encoder import VideoEncoder
from risorius.ports.video.film import write_film
with VideoEncoder(Path(sys.argv[1]), (64, 64), Fraction(30)) as encoder:
    for k in range(2000):
        encoder.picture(np.zeros((64, 64, 3), np.uint8))
        if Path(sys.argv[1]).exists():
            print("writing", flush=True)
            os.kill(os.getpid(), signal.SIGKILL)
"""
    paths = os.pathsep.join(sys.path)
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "x.part")],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "writing\n"
    while list(tmp_path.iterdir()):
        os.sched_yield()


def test_the_encoder_s_library_stays_out_of_the_program(tmp_path: Path) -> None:
    program = """
import sys
from fractions import Fraction
from pathlib import Path
import numpy as np
import risorius.ports.output_files
heavy = {"av", "PIL", "praatio"} & set(sys.modules)
from risorius.ports.video.encoder import VideoEncoder
from risorius.ports.video.film import write_film
with VideoEncoder(Path(sys.argv[1]), (64, 64), Fraction(30)) as encoder:
    encoder.picture(np.zeros((64, 64, 3), np.uint8))
print(sorted(heavy | ({"av"} & set(sys.modules))))
"""
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "x.mp4")],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == "[]"


def test_errors_of_the_worker_carry_the_output_s_name(
    tmp_path: Path, take_of: Callable[..., WritableTake], monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = tmp_path / "broken"
    broken.mkdir()
    (broken / "av.py").write_text("raise ImportError('gone')")
    monkeypatch.setattr(sys, "path", [str(broken), *sys.path])
    with (
        pytest.warns(RisoriusWarning, match="the video encoder ended .*; the film is begun again"),
        pytest.raises(OutputError, match=r"x\.mp4: the video encoder ended"),
    ):
        write_targets(take_of(), check_targets([tmp_path / "x.mp4"]), WriteOptions(size=(32, 32)))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["broken"]


@posix
def test_a_film_whose_encoder_is_lost_is_begun_again(
    tmp_path: Path, take_of: Callable[..., WritableTake], monkeypatch: pytest.MonkeyPatch
) -> None:
    path, take, options = tmp_path / "x.mp4", take_of(), WriteOptions(size=(32, 32))
    write_film(take, path, options, "mp4")
    whole = path.read_bytes()
    picture: Callable[..., None] = VideoEncoder.picture
    lost: list[int] = []

    def losing(self: VideoEncoder, rgb: ByteArray) -> None:
        if not lost:
            lost.append(self.pid)
            os.kill(self.pid, signal.SIGKILL)
        picture(self, rgb)

    monkeypatch.setattr(VideoEncoder, "picture", losing)
    with pytest.warns(RisoriusWarning, match=r"ended .* \(signal 9\); the film is begun again"):
        write_film(take, path, options, "mp4")
    assert path.read_bytes() == whole


def test_the_worker_loads_nothing_else_of_the_package() -> None:
    program = """
import sys
import risorius.ports.video.worker
print(*sorted(name for name in sys.modules if name.split(".")[0] in ("risorius", "numba", "scipy")))
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=True,
    )
    video = [f"risorius.ports.video.{name}" for name in ("codecs", "setup", "slots", "worker")]
    assert done.stdout.split() == ["risorius", "risorius.ports", "risorius.ports.video", *video]

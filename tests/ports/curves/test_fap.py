from pathlib import Path

import numpy as np
import pytest

from risorius.errors import InputError
from risorius.face.fit.feature_points import SHOWN, FeaturePoints
from risorius.face.solve import FaceSolver
from risorius.ports.curves.fap import read_fap
from risorius.take import Take


@pytest.fixture(scope="module")
def written(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fap") / "x.fap"
    clip.write(path)
    return path


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: [], ":1: is not a header"),
        (lambda t: ["2.1 x 0 9", *t[1:]], ":1: is not a header"),
        (lambda t: ["2.1 x 25 0", *t[1:]], ":1: is not a header"),
        (lambda t: ["2.1 x 0.001 100", *t[1:]], ":1: the capture lasts 100000 s"),
        (lambda t: t[:-1], "is a mask without values"),
        (lambda t: t[:-2], r"holds \d+ frames; expected \d+, as its header says"),
        (lambda t: [*t[:3], t[3], t[2]], ":5: frame 0 does not come after frame 0"),
        (
            lambda t: [*t[:2], t[2].replace(" ", f" {'9' * 5000} ", 1), *t[3:]],
            ":3: '9{30}' cannot be used; expected a whole number",
        ),
        (lambda t: [t[0], t[1][2:], *t[2:]], ":2: is not a mask: it has 67 words; expected 68 or 69 flags"),
        (lambda t: [t[0], t[1].replace("1", "2", 1), *t[2:]], ":2: is not a mask"),
        (lambda t: [*t[:2], t[2] + " 7", *t[3:]], r":3: has \d+ values; expected \d+"),
        (
            lambda t: [*t[:2], t[2].replace(" ", " nan ", 1), *t[3:]],
            ":3: 'nan' cannot be used; expected a whole number from -1000000 to 1000000",
        ),
    ],
)
def test_bad_files_are_one_line(written: Path, tmp_path: Path, change, message: str) -> None:
    (tmp_path / "y.fap").write_text("\n".join(change(written.read_text().splitlines())))
    with pytest.raises(InputError, match=message):
        read_fap(tmp_path / "y.fap")


def test_masks_have_68_flags_and_what_is_written_is_read_again(written: Path, clip: Take) -> None:
    lines = written.read_text().splitlines()
    assert lines[0] == f"2.1 risorius 10 {len(clip.times)}"
    assert len(lines[1].split()) == 68
    assert lines[2].split()[0] == "0"
    take = read_fap(written)
    assert tuple(np.flatnonzero(take.used) + 1) == SHOWN
    points = FeaturePoints(clip.head)
    for row, frame in zip(take.values, clip.faces(), strict=True):
        assert np.abs(row - points.values(frame)).max() <= 0.5


def test_greta_s_69_flags_are_read(written: Path, tmp_path: Path) -> None:
    lines = written.read_text().splitlines()
    lines[1::2] = [line + " 0" for line in lines[1::2]]
    (tmp_path / "y.fap").write_text("\n".join(lines))
    assert np.array_equal(read_fap(tmp_path / "y.fap").values, read_fap(written).values)


def test_signs_are_those_of_the_standard(clip: Take) -> None:
    from risorius.core.parameters import INDEX, NEUTRAL

    points, solver = FeaturePoints(clip.head), FaceSolver(clip.head)

    def faps(**targets: float) -> np.ndarray:
        values = np.array(NEUTRAL)
        for name, value in targets.items():
            values[INDEX[name.replace("__", ".")]] = value
        return np.concatenate([[0.0], points.values(solver.solve(values))])

    jaw = faps(masseter=0.6)
    assert jaw[3] > 100
    assert jaw[5] < -100  # the lower lip goes down: raise_b_midlip is negative
    smile = faps(zygomatic_major__left=1.0)
    assert smile[12] > 50
    assert smile[6] > 20
    assert abs(smile[13]) < 15
    assert faps(orbicularis_oculi_palpebralis__left=1.0)[19] > 400
    assert faps(frontalis_medialis__right=1.0)[32] > 50
    turned = faps(head_pitch=10.0, head_yaw=20.0, head_roll=5.0, gaze_yaw=10.0, gaze_pitch=5.0)
    assert turned[48:51] == pytest.approx(np.radians([-10.0, 20.0, -5.0]) / 1e-5, rel=1e-6)
    assert turned[23] > 0.0
    assert turned[25] < 0.0
    assert faps(tongue_out=1.0)[45] > 100


def test_frames_that_are_left_out_take_their_time(written: Path, tmp_path: Path) -> None:
    first, *lines = written.read_text().splitlines()
    (tmp_path / "y.fap").write_text("\n".join([first.rsplit(" ", 1)[0] + " 3", *lines[:4], *lines[6:8]]))
    assert read_fap(tmp_path / "y.fap").times == pytest.approx([0.0, 0.1, 0.3])

import csv
import tracemalloc
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.core.arkit import CSV_SHAPES, SHAPES
from risorius.errors import InputError, RisoriusWarning
from risorius.ports.curves.arkit_csv import COLUMNS, read_arkit_csv, timecode
from risorius.take import Take


@pytest.fixture(scope="module")
def written(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("arkit") / "x.arkit.csv"
    clip.write(path)
    return path


def changed(path: Path, folder: Path, change) -> Path:
    lines = path.read_text().splitlines()
    result = folder / "y.arkit.csv"
    result.write_text("\n".join(change(lines)) + "\n", encoding="utf-8")
    return result


def renamed(header: str, name: str, other: str) -> str:
    return ",".join(other if cell == name else cell for cell in header.split(","))


def cell(row: str, index: int, text: str) -> str:
    cells = row.split(",")
    return ",".join([*cells[:index], text, *cells[index + 1 :]])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: [], "is empty"),
        (lambda t: t[:1], "has a header and no rows"),
        (
            lambda t: [renamed(t[0], "JawOpen", "JawOpne"), *t[1:]],
            ":1:257: unknown column 'JawOpne'; did you mean",
        ),
        (lambda t: [renamed(t[0], "MouthLeft", "MouthRight"), *t[1:]], "column 'MouthRight' is given twice"),
        (lambda t: [renamed(t[0], "JawOpen", "jawleft"), *t[1:]], "column 'JawLeft' is given twice"),
        (
            lambda t: [t[0].replace("JawOpen,", ""), *t[1:]],
            ":1: column 'JawOpen' of a Live Link Face take is missing",
        ),
        (lambda t: t[1:], ":1:1: '00:00:00:00.000' is not a column's name; expected a header"),
        (lambda t: [row.replace(",", ";") for row in t], ":1:1: columns are separated by ';'; expected ','"),
        (lambda t: [cell(t[0], 3, ""), *t[1:]], ":1:39: a column has no name"),
        (lambda t: [t[0], cell(t[1], 2, "١")], ":2:20: EyeBlinkLeft is '١'; expected a number"),
        (lambda t: [*t[:2], t[2][: len(t[2]) // 2]], r":3: has \d+ values; expected 63"),
        (lambda t: [t[0], f"{t[1]},0.5"], ":2: has 64 values; expected 63"),
        (lambda t: [t[0], "a,b"], ":2: has 2 values; expected 63"),
        (lambda t: [t[0], '"' + t[1]], ":2: has a quoted cell that is not closed; expected a quotation mark"),
        (lambda t: [t[0], cell(t[1], 2, "nan")], ":2:20: EyeBlinkLeft is 'nan'; expected a number"),
        (lambda t: [t[0], cell(t[1], 2, "-inf")], ":2:20: EyeBlinkLeft is '-inf'; expected a number"),
        (lambda t: [t[0], cell(t[1], 3, "1_0")], "EyeLookDownLeft is '1_0'; expected a number"),
        (lambda t: [t[0], cell(t[1], 3, "9" * 400)], "EyeLookDownLeft is '9{30}'; expected a number"),
        (lambda t: [t[0], cell(t[1], 54, "35.2")], "HeadYaw is '35.2'; expected radians from -6"),
        (lambda t: [t[0], cell(t[1], 0, "now")], ":2:1: Timecode is 'now'; expected a time code HH:MM:SS"),
        (lambda t: [*t[:2], cell(t[2], 1, "60")], ":3:17: BlendshapeCount is '60'; expected 61"),
        (lambda t: [*t[:2], cell(t[2], 1, "")], ":3:17: BlendshapeCount is ''; expected 61"),
        (lambda t: [t[0], t[2], t[1]], ":3: its time does not come after the row before"),
        (
            lambda t: [t[0], t[1], cell(t[2], 0, "99:00:00:00.000")],
            ":3: the capture lasts 356400 s; expected",
        ),
        (lambda t: [t[0], "\0".join(t[1])], ":2: is not a line of text"),
        (lambda t: [t[0], "x" * 1_000_001], ":2: is not a line of text"),
    ],
)
def test_bad_files_are_one_line(written: Path, tmp_path: Path, change, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_arkit_csv(changed(written, tmp_path, change))


def test_what_is_missing_or_no_text_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_arkit_csv(tmp_path / "none.csv")
    (tmp_path / "x.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="not UTF-8"):
        read_arkit_csv(tmp_path / "x.csv")


def test_header_and_order_are_the_app_s(written: Path, clip: Take) -> None:
    """The columns as the app writes them, read by an independent reader."""
    with written.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:4] == ["Timecode", "BlendshapeCount", "EyeBlinkLeft", "EyeLookDownLeft"]
    assert tuple(rows[0]) == COLUMNS
    assert len(rows[0]) == 63
    assert rows[3]["BlendshapeCount"] == "61"
    assert rows[3]["Timecode"] == "00:00:00:03.000"
    for shape, column in (("jawLeft", "JawLeft"), ("mouthSmileRight", "MouthSmileRight")):
        assert float(rows[5][column]) == pytest.approx(clip.arkit.weights[5, SHAPES.index(shape)], abs=1e-9)
    assert float(rows[5]["HeadYaw"]) == pytest.approx(np.radians(clip.curves["head_yaw"][5]), abs=1e-9)


def test_what_is_written_is_read_again_whatever_the_order(written: Path, tmp_path: Path, clip: Take) -> None:
    def turned(lines: list[str]) -> list[str]:
        return [",".join(reversed(line.split(","))) for line in lines]

    def shouted(lines: list[str]) -> list[str]:
        return ["\ufeff" + lines[0].upper(), "", *(f"{row.replace(',', ' , ')}\r" for row in lines[1:]), " "]

    for change in (list, turned, shouted):
        path = changed(written, tmp_path, change)
        take = read_arkit_csv(path)
        assert np.abs(take.weights - clip.arkit.weights).max() < 1e-9
        assert np.abs(take.rotations[:, :3] - np.radians(clip.arkit.head)).max() < 1e-9


@pytest.mark.parametrize(
    ("frame", "fps", "code"),
    [
        (0, Fraction(60), "00:00:00:00.000"),
        (59, Fraction(60), "00:00:00:59.000"),
        (60, Fraction(60), "00:00:01:00.000"),
        (3661 * 30 + 5, Fraction(30), "01:01:01:05.000"),
        (30, Fraction(30000, 1001), "00:00:01:00.030"),
    ],
)
def test_time_codes(frame: int, fps: Fraction, code: str) -> None:
    assert timecode(frame, fps) == code


def test_all_52_columns_stand_in_the_header() -> None:
    assert COLUMNS[2:54] == CSV_SHAPES


@pytest.mark.parametrize("fps", [Fraction(10), Fraction(24), Fraction(30000, 1001), Fraction(60)])
def test_times_come_back_at_every_rate(written: Path, tmp_path: Path, fps: Fraction) -> None:
    header, row, *_ = written.read_text().splitlines()
    count = int(2.5 * fps)
    rows = [",".join([timecode(k, fps), *row.split(",")[1:]]) for k in range(count)]
    (tmp_path / "y.csv").write_text("\n".join([header, *rows]))
    times = read_arkit_csv(tmp_path / "y.csv").times
    assert np.abs(times - np.arange(count) / float(fps)).max() < 1e-3


def test_a_take_shorter_than_a_second_has_the_app_s_rate(written: Path, tmp_path: Path) -> None:
    lines = written.read_text().splitlines()
    (tmp_path / "y.csv").write_text("\n".join(lines[:4]))
    assert read_arkit_csv(tmp_path / "y.csv").times == pytest.approx([0.0, 1 / 60, 2 / 60])


def test_a_take_goes_on_past_midnight(written: Path, tmp_path: Path) -> None:
    header, row, *_ = written.read_text().splitlines()
    codes = ("23:59:59:58.000", "23:59:59:59.000", "00:00:00:00.000", "00:00:00:01.000")
    (tmp_path / "y.csv").write_text("\n".join([header, *(cell(row, 0, code) for code in codes)]))
    assert read_arkit_csv(tmp_path / "y.csv").times == pytest.approx(np.arange(4) / 60)


def test_memory_is_that_of_the_numbers(written: Path, tmp_path: Path) -> None:
    """A long take is read row by row: neither its text nor its cells are held."""
    header, row, *_ = written.read_text().splitlines()
    rows = 3000
    with (tmp_path / "long.csv").open("w") as file:
        file.write(f"{header}\n")
        file.writelines(f"{cell(row, 0, timecode(k, Fraction(60)))}\n" for k in range(rows))
    tracemalloc.start()
    take = read_arkit_csv(tmp_path / "long.csv")
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    numbers = rows * (len(CSV_SHAPES) + 9) * 8
    assert take.weights.nbytes + take.rotations.nbytes == numbers
    assert most < 2 * numbers
    assert (tmp_path / "long.csv").stat().st_size > 1.5 * numbers


def table(folder: Path, names: list[str], rows: list[list[str]], name: str = "x.csv") -> Path:
    path = folder / name
    path.write_text("\n".join(",".join(row) for row in [names, *rows]) + "\n")
    return path


def audio2face(folder: Path, more: tuple[str, ...] = ()) -> Path:
    names = ["", "timeCode", *(f"blendShapes.{shape}" for shape in (*CSV_SHAPES, *more))]
    rows = [
        [str(k), f"{k / 30:.6f}", *("0.5" if shape == "JawOpen" else "0.1" for shape in (*CSV_SHAPES, *more))]
        for k in range(3)
    ]
    return table(folder, names, rows, "animation_frames.csv")


def test_a_table_of_audio2face_is_read(tmp_path: Path) -> None:
    take = read_arkit_csv(audio2face(tmp_path))
    assert take.times == pytest.approx([0.0, 1 / 30, 2 / 30], abs=1e-6)
    assert take.weights[:, SHAPES.index("jawOpen")] == pytest.approx(0.5)
    assert take.weights[:, SHAPES.index("mouthLeft")] == pytest.approx(0.1)


def test_shapes_that_arkit_lacks_are_left_out_with_one_warning(tmp_path: Path) -> None:
    with pytest.warns(RisoriusWarning, match="TongueTipUp, blendShapes.TongueIn left out") as caught:
        take = read_arkit_csv(audio2face(tmp_path, ("TongueTipUp", "TongueIn")))
    assert len(caught) == 1
    assert take.weights.shape == (3, 52)


@pytest.mark.parametrize(
    ("time", "written"),
    [
        (["Timecode", "BlendshapeCount"], [["00:00:01:00.000", "52"], ["00:00:01:30.000", "52"]]),
        (["timestamp"], [["0"], ["0.5"]]),
        (["frame", "timestamp_ms"], [["0", "0"], ["1", "500"]]),
        (["time"], [["0.0"], ["0.5"]]),
    ],
)
def test_mediapipes_names_are_read_without_the_tongue(
    tmp_path: Path, time: list[str], written: list[list[str]]
) -> None:
    names = ["_neutral", *sorted(name for name in SHAPES if name != "tongueOut")]
    rows = [[*row, *("0.7" if name == "jawOpen" else "0.2" for name in names)] for row in written]
    with pytest.warns(RisoriusWarning, match="_neutral left out.*no column TongueOut") as caught:
        take = read_arkit_csv(table(tmp_path, [*time, *names], rows))
    assert len(caught) == 1
    assert take.times == pytest.approx([0.0, 0.5])
    assert take.weights[0, SHAPES.index("jawOpen")] == 0.7
    assert take.weights[0, SHAPES.index("tongueOut")] == 0.0
    assert take.weights[0, SHAPES.index("noseSneerRight")] == 0.2
    assert take.weights[0, SHAPES.index("mouthUpperUpRight")] == 0.2


def test_seconds_are_those_of_the_film(tmp_path: Path) -> None:
    rows = [[time, *["0"] * 52] for time in ("0.4", "0.5")]
    take = read_arkit_csv(table(tmp_path, ["timestamp", *CSV_SHAPES], rows))
    assert take.times.tolist() == [0.4, 0.5]


def test_a_table_without_times_is_refused(tmp_path: Path) -> None:
    path = table(tmp_path, ["frame", *CSV_SHAPES], [["0", *["0"] * 52]])
    with pytest.raises(InputError, match="column 'Timecode' of a Live Link Face take is missing"):
        read_arkit_csv(path)

import io
import threading
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from risorius.machine.npz import read_arrays


def test_what_is_no_archive_is_an_error(tmp_path):
    path = tmp_path / "a.npz"
    with pytest.raises(FileNotFoundError):
        read_arrays(path)
    path.write_bytes(b"nothing")
    with pytest.raises(ValueError, match="not a zip file"):
        read_arrays(path)


def spoilt(where: bytes, offset: int, value: int) -> Callable[[Path], None]:
    """Return what sets a byte of each of an archive's records that begin with `where`."""

    def spoil(path: Path) -> None:
        np.savez(path, one=np.arange(3))
        data = bytearray(path.read_bytes())
        at = data.find(where)
        data[at + offset] = value
        path.write_bytes(data)

    return spoil


def promising(shape: tuple[int, ...]) -> Callable[[Path], None]:
    """Return what writes an archive of one array whose header says more than it holds."""

    def write(path: Path) -> None:
        header = io.BytesIO()
        about = {"descr": "<f8", "fortran_order": False, "shape": shape}
        np.lib.format.write_array_header_1_0(header, about)
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("one.npy", header.getvalue())

    return write


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [
        (lambda path: path.write_bytes(b""), "not a zip file"),
        (spoilt(b"PK\1\2", 10, 99), "compression method"),
        (spoilt(b"PK\1\2", 8, 1), "encrypted"),
        (spoilt(b"PK\1\2", 6, 99), "version"),
        (promising((10**15,)), "does not hold as many numbers as its header says"),
        (promising((-1,)), "numbers"),
        (lambda path: np.savez(path, one=np.array([{}], object)), "objects"),
    ],
)
def test_damage_is_one_kind_of_error(spoil: Callable[[Path], None], problem: str, tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    spoil(path)
    with pytest.raises(ValueError, match=problem):
        read_arrays(path)


def test_what_unpacks_to_more_than_the_limit_is_refused_unread(tmp_path, monkeypatch):
    path = tmp_path / "a.npz"
    np.savez_compressed(path, one=np.zeros(3_000_000))
    monkeypatch.setattr(np.lib.format, "read_array", None)
    with pytest.raises(ValueError, match="holds 24 MB; expected at most 20 MB"):
        read_arrays(path, 20_000_000)


def test_all_arrays_come_back_by_name(tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, one=np.arange(3), two=np.zeros((2, 2), np.float32))
    found = read_arrays(path)
    assert set(found) == {"one", "two"}
    assert found["one"].tolist() == [0, 1, 2]
    assert found["two"].dtype == np.float32


def test_one_thread_reads_at_a_time(tmp_path, monkeypatch):
    path, load, inside = tmp_path / "a.npz", np.lib.format.read_array, []
    np.savez(path, one=np.arange(3))
    together = []

    def slow(file, **options):
        inside.append(file)
        together.append(len(inside))
        time.sleep(0.02)
        inside.pop()
        return load(file, **options)

    monkeypatch.setattr(np.lib.format, "read_array", slow)
    threads = [threading.Thread(target=read_arrays, args=[path]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == [1, 1, 1, 1]

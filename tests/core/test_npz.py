import threading
import time

import numpy as np
import pytest

from risorius.core.npz import read_arrays


def test_what_is_no_archive_is_an_error(tmp_path):
    path = tmp_path / "a.npz"
    with pytest.raises(FileNotFoundError):
        read_arrays(path)
    path.write_bytes(b"nothing")
    with pytest.raises(ValueError, match="pickle"):
        read_arrays(path)


def test_all_arrays_come_back_by_name(tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, one=np.arange(3), two=np.zeros((2, 2), np.float32))
    found = read_arrays(path)
    assert set(found) == {"one", "two"}
    assert found["one"].tolist() == [0, 1, 2]
    assert found["two"].dtype == np.float32


def test_one_thread_reads_at_a_time(tmp_path, monkeypatch):
    path, load, inside = tmp_path / "a.npz", np.load, []
    np.savez(path, one=np.arange(3))
    together = []

    def slow(file, **options):
        inside.append(file)
        together.append(len(inside))
        time.sleep(0.02)
        inside.pop()
        return load(file, **options)

    monkeypatch.setattr(np, "load", slow)
    threads = [threading.Thread(target=read_arrays, args=[path]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == [1, 1, 1, 1]

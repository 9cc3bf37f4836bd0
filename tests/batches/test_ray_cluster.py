"""A real cluster of Ray on this machine, with two processors.

`scripts/check --full` installs Ray and what belongs to it, which takes over a minute: too long for
`scripts/test`.
"""

import sys
from pathlib import Path

import pytest

import risorius
from risorius.errors import InputError

from .test_executors import SILENT

ENDS_A_WORKER_OF_RAY = """
import os, pathlib, signal
mark = pathlib.Path("mark")
if not mark.exists():
    mark.touch()
    stat = pathlib.Path(f"/proc/{os.getppid()}/stat").read_text()
    os.kill(int(stat.rpartition(")")[2].split()[1]), signal.SIGKILL)
"""


@pytest.mark.full
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_makes_all_lines_though_a_worker_is_killed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("ray")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ends.py").write_text(ENDS_A_WORKER_OF_RAY + SILENT)
    rows: list[dict[str, object]] = [{"id": f"{n}/x", "text": f"Line {n}."} for n in range(20)]
    rows.append({"id": "bad", "text": "…"})
    lines: list[dict[str, object]] = [
        *rows,
        {"id": "ends", "text": "Ah.", "voice": str(tmp_path / "ends.py")},
    ]
    outputs = str(tmp_path / "out/{id}.muscles.csv")
    results = {r.id: r for r in risorius.batch(lines, outputs, ray="local", jobs=2)}
    assert (tmp_path / "mark").exists()
    assert [name for name, result in results.items() if result.error] == ["bad"]
    assert len(results) == 22
    risorius.speak("Line 7.", text=True).write("7.muscles.csv")
    assert Path("out/7/x.muscles.csv").read_bytes() == Path("7.muscles.csv").read_bytes()
    assert not list(tmp_path.rglob("*.part"))
    again = [result.state for result in risorius.batch(rows, outputs, jobs=0)]
    assert sorted(again) == ["failed"] + ["whole"] * 20


def test_without_ray_or_its_cluster_there_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(InputError, match=r"--ray needs Ray; run pip install ray"):
        list(risorius.batch([{"id": "a", "text": "Hi."}], "{id}.wav", ray="local"))

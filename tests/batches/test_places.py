"""Inputs and outputs elsewhere, by fsspec: in memory, and in a store of objects that runs here."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fsspec
import pytest

import risorius
from risorius.batches.places import read_bytes, size_of, state_of, upload
from risorius.errors import InputError, OutputError

MARKED = b"<PHONEME time='0' text='Oh.'/><EMOTIONDISPLAY time='0' duration='2' Surprise='0.7'/>"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def check_a_store(base: str, options: dict[str, Any]) -> None:
    """Perform a script and a text from `base` into `base`: the bytes are those of local files."""
    system, path = fsspec.core.url_to_fs(base, **options)
    system.pipe_file(f"{path}/in/x.xml", MARKED)
    rows = [{"id": "a/x", "script": f"{base}/in/x.xml"}, {"id": "b", "text": "Hi."}]
    outputs = (base + "/out/{id}.score.json", base + "/out/{id}.TextGrid")

    def states() -> list[str]:
        return sorted(result.state for result in risorius.batch(rows, outputs, jobs=0, journal="here"))

    assert states() == ["made", "made"]
    assert states() == ["whole", "whole"]
    risorius.speak("Hi.", text=True).write("b.score.json", "b.TextGrid")
    for name in ("b.score.json", "b.TextGrid"):
        assert read_bytes(f"{base}/out/{name}") == Path(name).read_bytes()
    assert f"{base}/in/x.xml:1".encode() in read_bytes(f"{base}/out/a/x.score.json")
    system.pipe_file(f"{path}/in/x.xml", MARKED.replace(b"Oh", b"No"))
    assert states() == ["made", "whole"]


def test_a_missing_file_elsewhere_is_one_line() -> None:
    (result,) = risorius.batch([{"id": "a", "script": "memory://gone.xml"}], "{id}.TextGrid", jobs=0)
    assert result.error == "row:1: memory://gone.xml: there is no such file"
    with pytest.raises(InputError, match="there is no such file"):
        read_bytes("memory://gone.xml")


def test_a_protocol_that_nobody_knows_is_one_line() -> None:
    for call in (state_of, size_of, read_bytes):
        with pytest.raises(InputError, match="nowhere"):
            call("nowhere://x")
    with pytest.raises(OutputError, match="nowhere"):
        upload(Path("x"), "nowhere://x")


def test_files_in_memory() -> None:
    check_a_store("memory://batch", {})


@pytest.fixture
def bucket(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A bucket of a server of moto's."""
    pytest.importorskip("s3fs")
    server = pytest.importorskip("moto.server").ThreadedMotoServer(port=0)
    server.start()
    host, port = server.get_host_and_port()
    for name, value in {
        "AWS_ENDPOINT_URL": f"http://{host}:{port}", "AWS_ACCESS_KEY_ID": "x",
        "AWS_SECRET_ACCESS_KEY": "x", "AWS_DEFAULT_REGION": "us-east-1",
    }.items():  # fmt: skip
        monkeypatch.setenv(name, value)
    fsspec.filesystem("s3", skip_instance_cache=True).mkdir("lines")
    yield "s3://lines"
    server.stop()


@pytest.mark.full
@pytest.mark.filterwarnings("ignore")
def test_files_in_a_store_of_objects(bucket: str) -> None:
    check_a_store(bucket, {})

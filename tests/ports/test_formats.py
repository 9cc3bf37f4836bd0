import subprocess
import sys
from pathlib import Path

import pytest

from risorius.errors import InputError, OutputError
from risorius.ports import formats
from risorius.ports.formats import FORMATS, Need, format_for, format_read

SMALL = """
def write_small(take, path, options):
    path.write_text("small")


register(".small", "a small file", {"curves"}, write_small, order=3)
"""


def test_a_name_without_suffix_is_refused_with_the_list() -> None:
    with pytest.raises(OutputError, match=r"^clip: the name has no suffix; expected one of \.mp4, "):
        format_for(Path("clip"))


@pytest.mark.parametrize(
    ("name", "nearest"),
    [
        ("x.mp5", ".mp4"),
        ("x.muscle.csv", ".muscles.csv"),
        ("x.csv", ".muscles.csv"),
        ("x.textgird", ".TextGrid"),
        ("material.1.scores.json", ".score.json"),
    ],
)
def test_an_unknown_suffix_names_the_nearest_and_where_all_stand(name: str, nearest: str) -> None:
    with pytest.raises(OutputError) as caught:
        format_for(Path("out") / name)
    assert f"did you mean '{nearest}'?" in str(caught.value)
    assert str(caught.value).endswith("'risorius list outputs' shows all")


def test_a_suffix_near_to_none_gets_the_list() -> None:
    with pytest.raises(OutputError, match=r"unknown suffix '\.qqqqqq'; expected one of"):
        format_for(Path("x.qqqqqq"))


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x.bvh", "unknown kind of capture"),
        ("x.TextGrid", "holds labels; expected risorius speak"),
        ("x", "unknown kind of capture"),
    ],
)
def test_a_file_that_is_only_written_is_not_read(name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        format_read(Path(name))


def test_only_literals_and_functions_stand_in_the_lines_that_register(tmp_path: Path) -> None:
    (tmp_path / "small.py").write_text(SMALL.replace('"a small file"', "DESCRIPTION"))
    with pytest.raises(ValueError, match="malformed"):
        list(formats.declared(tmp_path))
    (tmp_path / "small.py").write_text(f"{SMALL}print()\n")
    with pytest.raises(ValueError, match="expected nothing but register"):
        list(formats.declared(tmp_path))


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        ("x.csv", ".arkit.csv"),
        ("X.AU.CSV", ".au.csv"),
        ("x.json", ".score.json"),
        ("x.performance.json", ".performance.json"),
    ],
)
def test_a_file_is_read_by_its_longest_suffix(name: str, suffix: str) -> None:
    assert format_read(Path(name)).suffix == suffix


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        ("x.png", ".png"),
        ("x.score.json", ".score.json"),
        ("X.MP4", ".mp4"),
        ("x.textgrid", ".TextGrid"),
        ("a.b.muscles.csv", ".muscles.csv"),
    ],
)
def test_the_longest_suffix_wins_in_any_case(name: str, suffix: str) -> None:
    assert format_for(Path(name)).suffix == suffix


def test_every_format_says_what_it_holds_and_needs() -> None:
    outputs = [FORMATS.get(suffix) for suffix in FORMATS]
    assert all(o.description and o.needs <= set(Need) and o.needs for o in outputs)


def test_the_table_is_what_the_files_register_when_they_are_imported() -> None:
    program = """
import importlib, pkgutil
import risorius.ports
from risorius.ports import formats
declared = {suffix: formats.FORMATS.get(suffix) for suffix in formats.FORMATS}
called = []
formats.register = lambda *columns, **options: called.append((columns, options))
for module in pkgutil.walk_packages(risorius.ports.__path__, "risorius.ports."):
    importlib.import_module(module.name)
for columns, options in called:
    row = formats._format(columns[3].__module__, columns[:3], options, readable=len(columns) > 4)
    assert row == declared.pop(row.suffix), row
print(len(called), declared)
"""
    assert _run(program) == f"{len(FORMATS.names())} {{}}"


def test_checking_and_listing_import_no_writer() -> None:
    program = """
import sys
from risorius.cli.listing import outputs
from risorius.ports.output_files import check_targets
outputs()
check_targets(["x.mp4", "x.glb", "x.arkit.csv"])
writers = [name for name in sys.modules if name.startswith("risorius.ports.")]
print(*sorted({"numpy", "numba", "scipy", "PIL"} & set(sys.modules)), *sorted(writers))
"""
    expected = [f"risorius.ports.{name}" for name in ("export_source", "formats", "output_files")]
    assert _run(program).split() == expected


def test_a_format_is_one_file(tmp_path: Path) -> None:
    (tmp_path / "small.py").write_text(SMALL)
    (found,) = formats.declared(tmp_path)
    assert (found.suffix, found.description, found.needs, found.order) == (
        ".small",
        "a small file",
        {Need.CURVES},
        3,
    )
    assert (found.module, found.read_suffixes, found.opaque) == ("risorius.ports.small", (), False)


def test_a_format_of_another_package_is_known_once_it_is_imported(tmp_path: Path) -> None:
    (tmp_path / "small.py").write_text(f"from risorius.ports.formats import register\n{SMALL}")
    program = f"""
import sys
from pathlib import Path
sys.path.append({str(tmp_path)!r})
import small
from risorius.ports.output_files import check_targets, write_targets
path = Path({str(tmp_path)!r}) / "x.small"
write_targets(None, check_targets([path]))
print(path.read_text())
"""
    assert _run(program) == "small"


def _run(program: str) -> str:
    """Return what a Python of its own prints."""
    command = [sys.executable, "-c", program]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

"""`risorius batch`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..settings.declare import Stage
from .batch_progress import BatchProgress
from .console import EXIT_INTERRUPTED, Console
from .options import SHOWN, Command, NumberIn, emotion_option, option, setting_options, settings_from

if TYPE_CHECKING:
    from ..batches.library import BatchPlan

EXIT_FAILED = 1


@click.command(cls=Command, short_help="Perform many lines, from a table or a folder of recordings.")
@click.argument("manifest")
@option(
    "-o",
    "--output",
    "outputs",
    group="Output",
    multiple=True,
    metavar="PATTERN",
    help="Files to write, with columns in braces: 'out/{id}.mp4'. May be given several times.  [required]",
)
@option(
    "--jobs",
    group="Batch",
    type=NumberIn(0),
    metavar="N",
    help="Number of processes; 0 performs in this one.  [default: one a core]",
)
@option(
    "--timeout",
    group="Batch",
    type=NumberIn(0.001, kind=float),
    default=600.0,
    metavar="S",
    help="Seconds after which a line is given up.  [default: 600]",
)
@option(
    "--ray",
    group="Batch",
    metavar="ADDRESS",
    help="Perform on a Ray cluster: auto, local or HOST:PORT (pip install ray).",
)
@option("--shard", group="Batch", metavar="I/N", help="Make only the I-th of N parts, I from 1 to N.")
@option("--dry-run", group="Batch", is_flag=True, help="Check all rows and make nothing.")
@option(
    "--ignore",
    group="Batch",
    multiple=True,
    metavar="COLUMN",
    help="A column that Risorius does not read. May be given several times.",
)
@option(
    "--journal",
    group="Batch",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="Where journal, errors and report are written.  [default: the folder that outputs share]",
)
@option(
    "--contact-sheet", "sheets", group="Batch", is_flag=True, help="Show pictures of each line in the report."
)
@emotion_option
@setting_options((Stage.VOICE, Stage.PLAN, Stage.COMBINE, *SHOWN))
def batch(
    manifest: str,
    outputs: tuple[str, ...],
    jobs: int | None,
    timeout: float,
    ray: str | None,
    shard: str | None,
    dry_run: bool,
    ignore: tuple[str, ...],
    journal: Path | None,
    sheets: bool,
    emotions: tuple[str, ...],
    **chosen: Any,
) -> None:
    """Perform all lines of MANIFEST: a .csv or .jsonl file, or a folder of recordings.

    \b
    Columns: id, and text, script (a file), or audio with transcript; every option of
    `speak` may be a column, or an option for all lines.

    To continue a run that was interrupted, start it again: lines that are complete and unchanged are not made
    again. The exit code is 1 if a line failed; errors.jsonl lists these lines.
    """
    from ..batches.library import BatchPlan, usual_processes
    from ..batches.run import Shard

    plan = BatchPlan(
        manifest, outputs, settings_from(chosen), emotions,
        usual_processes() if jobs is None else jobs, timeout, ray,
        Shard() if shard is None else Shard.parse(shard), journal, ignore, sheets,
    )  # fmt: skip
    with Console() as console:
        failed = _check(plan, console) if dry_run else _perform(plan, console)
    if failed:
        raise click.exceptions.Exit(EXIT_FAILED)


def _check(plan: BatchPlan, console: Console) -> int:
    from ..batches.run import check_rows

    maker, good, bad = plan.maker(), 0, 0
    plan.folder()
    for error in check_rows(plan.read(), maker, plan.shard):
        if error is None:
            good += 1
        else:
            bad += 1
            console.fail(str(error))
    console.say(f"{good + bad:,} rows: {good:,} can be performed, {bad:,} cannot")
    return bad


def _perform(plan: BatchPlan, console: Console) -> int:
    plan.maker()
    total = sum(1 for _ in plan.read()) // plan.shard.count
    progress = BatchProgress(console, total)
    results = plan.run()
    try:
        for result in results:
            progress.add(result)
    except KeyboardInterrupt:
        results.close()
        console.fail(f"interrupted; {progress.made:,} lines were made, start again to go on")
        raise click.exceptions.Exit(EXIT_INTERRUPTED) from None
    progress.finish(plan.folder())
    return progress.failed

"""The command line: thin over the library, and the only place that exits."""

from __future__ import annotations

import errno
import signal
import sys

import click

from .. import __version__
from ..errors import RisoriusError, UnreadError
from .align import align
from .console import interrupt, say
from .explain import explain
from .listing import list_
from .mix import mix
from .options import flag
from .play import play
from .pose import pose
from .rig import rig
from .rules import rules
from .speak import speak
from .stream import stream
from .studio import studio

EXIT_FAULT, EXIT_INTERRUPTED = 2, 130


def main() -> None:
    """Run the command line: exit code 0, or 2 with one line on what is wrong, or 130 when interrupted."""
    # Asked to end, we end as when interrupted: what is half-written goes.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """Run the command line with `arguments`; return the exit code."""
    try:
        commands.main(arguments, prog_name="risorius", standalone_mode=False)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except (click.Abort, KeyboardInterrupt):
        say("risorius: interrupted; nothing was written")
        return EXIT_INTERRUPTED
    except click.ClickException as error:
        return _fault(error.format_message())
    except UnreadError as error:
        return _fault(str(error.spelled(flag)))
    except RisoriusError as error:
        return _fault(str(error))
    except BrokenPipeError:
        sys.stdout = None  # the reader has gone: nothing more can be said to it
        return 0
    except MemoryError:
        return _fault("out of memory; expected a smaller --size or a shorter text")
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        return _fault("no space left on the disk")
    return 0


def _fault(message: str) -> int:
    say(f"risorius: {' '.join(message.split())}")
    return EXIT_FAULT


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="risorius")
def commands() -> None:
    """Turn a script into a performing face.

    \b
    risorius speak "Hello there!" -o hello.mp4
    risorius speak "I told you so." --emotion anger:0.6 -o told.mp4
    risorius speak scene.xml -o scene.mp4 -o scene.muscles.csv
    risorius pose AU12=0.8 AU6=0.6 -o smile.png
    """


for _command in (speak, align, mix, pose, play, stream, rig, explain, list_, studio, rules):
    commands.add_command(_command)

"""The command line: thin over the library, and the only place that exits."""

from __future__ import annotations

import errno
import os
import signal
import sys
import traceback
from dataclasses import asdict
from pathlib import Path

import click

from .. import __version__
from ..errors import LONGEST_LINE, Place, RisoriusError, UnusedSettingError, nearest, printable, shortened
from ..machine.garbage import collect_no_more, collect_seldom
from ..machine.paths import is_file
from .align import align
from .batch import batch
from .console import EXIT_INTERRUPTED, interrupt
from .explain import explain
from .figures import figures
from .listing import list_
from .messages import choose_form, send
from .mix import mix
from .options import CommandGroup, flag
from .play import play
from .pose import pose
from .rig import rig
from .rules import rules
from .serve import serve
from .speak import speak
from .stream import stream
from .studio import studio

EXIT_FAULT = 2
DEBUG = "--debug"
STRICT = "RISORIUS_STRICT"
"""The environment's variable under which unforeseen errors are raised: the tests set it."""


def main() -> None:
    """Run the command line: exit code 0, or 2 with one line on what is wrong, or 130 when interrupted."""
    # Read by numpy when it is loaded: our products are small, and threads only take time from each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    collect_seldom()
    # Asked to end, we end as when interrupted: what is half-written goes.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    code = run(sys.argv[1:])
    collect_no_more()
    sys.exit(code)


def run(arguments: list[str]) -> int:
    """Run the command line with `arguments`; return the exit code."""
    end = arguments.index("--") if "--" in arguments else len(arguments)
    debug = DEBUG in arguments[:end]
    arguments = [argument for argument in arguments[:end] if argument != DEBUG] + arguments[end:]
    choose_form(arguments[:end])
    try:
        code = commands.main(arguments, prog_name="risorius", standalone_mode=False)
    except (click.Abort, KeyboardInterrupt):
        send("risorius: interrupted; nothing was written", error="interrupted; nothing was written")
        return EXIT_INTERRUPTED
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.ctx.get_help())  # what a newcomer types first
        return 0
    except click.NoSuchOption as error:
        return _fault(_unknown_option(error))
    except click.ClickException as error:
        return _fault(error.format_message())
    except UnusedSettingError as error:
        return _fault(str(error.spelled(flag)), error.place)
    except RisoriusError as error:
        return _fault(str(error), error.place)
    except BrokenPipeError:
        sys.stdout = None  # the reader has gone: nothing more can be said to it
        return 0
    except MemoryError:
        return _fault("out of memory; expected a smaller file, a shorter text or a smaller --size")
    except Exception as error:
        return _unforeseen(error, arguments, debug)
    return code if isinstance(code, int) else 0  # what a command exits with


def _unknown_option(error: click.NoSuchOption) -> str:
    context, name = error.ctx, error.option_name
    options = [] if context is None else [o for p in context.command.get_params(context) for o in p.opts]
    near = nearest(name, [option for option in options if option.startswith("--")])
    command = "risorius" if context is None else context.command_path
    help = f"did you mean '{near}'?" if near else f"'{command} --help' shows all"
    return f"unknown option '{name}'; {help}"


def _fault(message: str, place: Place | None = None) -> int:
    line = shortened(f"risorius: {printable(message)}", LONGEST_LINE)
    where = {} if place is None else asdict(place)
    send(line, error=line.removeprefix("risorius: "), **where)
    return EXIT_FAULT


def _unforeseen(error: Exception, arguments: list[str], debug: bool) -> int:
    """Report an unforeseen error in one line: the system's fault, or ours with a file."""
    if debug:
        traceback.print_exception(error)
    if isinstance(error, OSError) and error.errno is not None:
        if error.errno == errno.ENOSPC:
            return _fault("no space left on the disk")
        where = f"{error.filename}: " if error.filename else ""
        return _fault(f"{where}{os.strerror(error.errno)}; expected a file and a disk that can be used")
    if os.environ.get(STRICT):
        raise error
    files = ", ".join(argument for argument in arguments[1:] if is_file(Path(argument)))
    where = f"{files}: cannot be used" if files else "an error that was not foreseen"
    return _fault(f"{where} ({type(error).__name__}: {error}); please report it with what {DEBUG} prints")


SECTIONS = {
    "Perform": (speak, batch, pose, play, mix),
    "Perform live": (stream, serve),
    "Recordings and characters": (align, rig),
    "Examine and edit": (studio, explain, figures, rules, list_),
}


class Commands(CommandGroup):
    """All commands; help lists them in sections, those that are wanted first before the others."""

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write each section with its commands and their descriptions."""
        for title, section in SECTIONS.items():
            with formatter.section(title):
                formatter.write_dl([(str(it.name), it.get_short_help_str(formatter.width)) for it in section])


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="risorius")
@click.option(DEBUG, is_flag=True, expose_value=False, help="Print where in the program an error arose.")
def commands() -> None:
    """Turn a script into a performing face.

    \b
    risorius speak "Hello there!" -o hello.mp4
    risorius speak "I told you so." --emotion anger:0.6 -o told.mp4
    risorius speak scene.xml -o scene.mp4 -o scene.muscles.csv
    risorius pose AU12=0.8 AU6=0.6 -o smile.png
    """


for _section in SECTIONS.values():
    for _command in _section:
        commands.add_command(_command)

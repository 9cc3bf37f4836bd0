"""`risorius serve`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ..errors import InputError, Place
from .console import Console
from .options import Command, NumberIn, option
from .studio import leave

_LARGEST_TOKEN = 4_096
_VARIABLE = "RISORIUS_TOKEN"


@click.command(cls=Command, short_help="Serve live faces to other programs and pages, over WebSocket.")
@option("--host", group="Server", metavar="ADDRESS", help="Address to listen at.  [default: 127.0.0.1]")
@option(
    "--port",
    group="Server",
    type=NumberIn(0, 65535),
    metavar="N",
    help="Port; 0 chooses a free one.  [default: 8766]",
)
@option(
    "--token-file",
    group="Clients",
    type=click.Path(path_type=Path),
    help=f"File with the token that clients must send; {_VARIABLE} may hold it instead.",
)
@option(
    "--origin",
    "origins",
    group="Clients",
    multiple=True,
    metavar="URL",
    help="A site whose pages may connect, e.g. https://example.org; may be repeated.",
)
@option(
    "--clients",
    group="Clients",
    type=NumberIn(1, 256),
    metavar="N",
    help="How many clients may be connected at once.  [default: 16]",
)
@option(
    "--rig",
    group="Character",
    type=click.Path(path_type=Path),
    help="A character (.glb with blend shapes) whose weights clients may ask for.",
)
@option(
    "--map",
    "map_file",
    group="Character",
    type=click.Path(path_type=Path),
    help="TOML file that names the morph target of each ARKit shape, as for rig.",
)
def serve(
    host: str | None,
    port: int | None,
    token_file: Path | None,
    origins: tuple[str, ...],
    clients: int | None,
    rig: Path | None,
    map_file: Path | None,
) -> None:
    """Serve live faces over WebSocket: text in, frames with sound out, one face for each client."""
    from ..live.serve.server import ServeOptions
    from ..live.serve.server import serve as run
    from ..ports.mesh.rig import check_performable, read_rig

    if map_file is not None and rig is None:
        raise InputError("--map belongs to a character; expected --rig as well")
    character = None if rig is None else read_rig(rig, map_file)
    if character is not None:
        check_performable(character)
    given = {"host": host, "port": port, "clients": clients}
    options = ServeOptions(
        token=_token(token_file),
        origins=tuple(map(_checked_origin, origins)),
        rig=character,
        **{name: value for name, value in given.items() if value is not None},  # type: ignore[arg-type]
    )
    run(options, say=Console().say)
    leave()


def _token(file: Path | None) -> str | None:
    """Return the token, from a file or the environment; it is never seen in the list of processes."""
    if file is None:
        return os.environ.get(_VARIABLE) or None
    try:
        with file.open("rb") as opened:
            text = opened.read(_LARGEST_TOKEN).decode("utf-8").strip()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not a text"
        raise InputError(f"cannot be read: {reason}; expected a token", Place(str(file))) from None
    if not text:
        raise InputError("is empty; expected a token", Place(str(file)))
    return text


def _checked_origin(text: str) -> str:
    """Return a site as browsers name it; raise InputError if the text is not a site."""
    from urllib.parse import urlsplit

    try:
        parts = urlsplit(text.rstrip("/"))
        site = f"{parts.scheme}://{parts.netloc}"
    except ValueError:
        site = ""
    if site != text.rstrip("/") or parts.scheme not in ("http", "https") or not parts.netloc:
        raise InputError(f"--origin '{text}' is not a site; expected e.g. https://example.org")
    return site

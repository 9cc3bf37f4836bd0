"""`risorius rules`."""

from __future__ import annotations

from pathlib import Path

import click

from ..core.names import Names
from ..errors import InputError
from .messages import print_table
from .options import Command, CommandGroup, Named, rules_option

RULE = Named(Names(path="rules.rule_set:rule_names"))


@click.group(cls=CommandGroup, short_help="List, show and check the rules.")
def rules() -> None:
    """List, show and check the rules that turn speech into movements, with those of your file."""


@rules.command(name="list", cls=Command, no_args_is_help=False)
@click.argument("prefix", required=False, type=RULE)
@rules_option
def list_rules(prefix: str | None, rules: Path | None) -> None:
    """List all rules, or those below PREFIX, e.g. signals.brows."""
    from .listing import rule_rows

    print_table(*rule_rows(rules, prefix))


@rules.command(cls=Command)
@click.argument("name", type=RULE)
@rules_option
def show(name: str, rules: Path | None) -> None:
    """Show the rule NAME as it stands in its file, and where."""
    from .listing import rule_lines

    for line in rule_lines(name, rules):
        click.echo(line)


@rules.command(cls=Command)
@rules_option
def doctor(rules: Path | None) -> None:
    """Find unknown names, rules that can never fire or conflict, and tables that lack a phone."""
    from ..rules.doctor import examine
    from ..rules.rule_set import rule_set_of

    _check_phones()
    rule_set = rule_set_of(rules)
    findings = examine(rule_set)
    for finding in findings:
        click.echo(str(finding))
    if findings:
        count = "1 problem" if len(findings) == 1 else f"{len(findings)} problems"
        raise InputError(f"{count} in {len(rule_set.entries)} rules")
    click.echo(f"{len(rule_set.entries)} rules, no problem")


def _check_phones() -> None:
    """Raise InputError for the first table that lacks a phone of the inventory."""
    from ..languages import language_of
    from ..ports.speech.visemes import viseme_table
    from ..rules.articulation import articulation

    articulation()
    viseme_table()
    language_of("en")

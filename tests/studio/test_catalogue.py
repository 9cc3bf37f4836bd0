"""The catalogue: all that the page shows is the library's."""

from __future__ import annotations

import json
from dataclasses import fields

from risorius.cli.listing import LISTINGS
from risorius.core.channels import CHANNELS
from risorius.core.parameters import PARAMETERS
from risorius.ports.formats import FORMATS
from risorius.rules.rule_set import shipped
from risorius.settings import Settings
from risorius.studio.catalogue import catalogue, catalogue_json
from risorius.studio.session.choices import settings_of
from risorius.studio.wire.requests import Export
from risorius.studio.wire.shared import Choices


def test_it_is_json_with_every_table_whole():
    held = json.loads(catalogue_json())
    assert [row["name"] for row in held["parameters"]] == [p.name for p in PARAMETERS]
    assert [row["name"] for row in held["channels"]] == list(CHANNELS)
    assert [row["suffix"] for row in held["outputs"]] == list(FORMATS)
    assert {row["id"] for row in held["rules"]} == set(shipped().entries)
    for table in ("emotions", "profiles", "attitudes", "voices", "heads"):
        assert [row["name"] for row in held[table]] == [row[0] for row in LISTINGS[table]()[1]]
    assert all(row["name"] and row["description"] for row in held["onset_functions"])


def test_its_defaults_are_the_library_s(tmp_path):
    assert settings_of(Choices(**json.loads(catalogue_json())["choices"] | _tuples()), tmp_path) == Settings()
    exported = {row.key: row.default for row in catalogue().settings if row.exported}
    assert exported["size"] == "720x720"
    assert Export(take=1, suffixes=(), **exported) == Export(take=1, suffixes=())


def test_every_setting_of_a_message_is_a_control_of_the_page():
    keys = [row.key for row in catalogue().settings]
    sent = [*(f.name for f in fields(Choices)), *(f.name for f in fields(Export))]
    assert sorted(keys) == sorted(set(sent) - {"profile_text", "rules_off", "take", "suffixes", "name"})


def test_models_and_speakers_are_described():
    described = {row.key: row.choices for row in catalogue().settings}
    for key in ("conflict", "lips", "onset_function", "profile", "attitudes", "head"):
        assert described[key]
        assert all(choice.description for choice in described[key]), key
    assert [choice.value for choice in described["complexion"]] == [0.0, 0.25, 0.5, 0.75, 1.0]


def _tuples():
    return {"without": (), "attitudes": (), "rules_off": ()}


def test_onset_functions_rise_from_0_to_1():
    for row in catalogue().onset_functions:
        assert (row.samples[0], row.samples[-1]) == (0.0, 1.0)
        assert list(row.samples) == sorted(row.samples)


def test_languages_have_names():
    (languages,) = (it for it in catalogue().settings if it.key == "language")
    assert ("de", "German") in {(it.name, it.description) for it in languages.choices}

"""The catalogue: all that the page shows is the library's."""

from __future__ import annotations

import json

from risorius.core.movement import CHANNELS
from risorius.core.parameters import PARAMETERS
from risorius.listing import LISTINGS
from risorius.ports.formats import FORMATS
from risorius.rules.book import shipped
from risorius.settings import Settings
from risorius.studio.catalogue import catalogue, catalogue_json
from risorius.studio.choices import settings_of
from risorius.studio.wire import Choices


def test_it_is_json_with_every_table_whole():
    held = json.loads(catalogue_json())
    assert [row["name"] for row in held["parameters"]] == [p.name for p in PARAMETERS]
    assert [row["name"] for row in held["channels"]] == list(CHANNELS)
    assert [row["suffix"] for row in held["outputs"]] == list(FORMATS)
    assert {row["id"] for row in held["rules"]} == set(shipped().entries)
    for table in ("emotions", "profiles", "attitudes", "voices", "heads"):
        assert [row["name"] for row in held[table]] == [row[0] for row in LISTINGS[table]()[1]]
    for table in ("policies", "lip_models", "onset_functions"):
        assert all(row["name"] and row["description"] for row in held[table]), table


def test_its_defaults_are_the_library_s(tmp_path):
    assert settings_of(Choices(**json.loads(catalogue_json())["choices"] | _tuples()), tmp_path) == Settings()
    assert catalogue().size == "720x720"


def _tuples():
    return {"without": (), "attitudes": (), "rules_off": ()}


def test_onset_functions_rise_from_0_to_1():
    for row in catalogue().onset_functions:
        assert (row.samples[0], row.samples[-1]) == (0.0, 1.0)
        assert list(row.samples) == sorted(row.samples)

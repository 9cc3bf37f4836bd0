"""Policy `sum`: activities are added and clipped, as in other systems; for comparison."""

from __future__ import annotations

from ...core.arrays import Array
from ..channels import Channel
from ..conflict import POLICIES, Join, PolicyInputs, Resolver, Suppressor


@POLICIES.register("sum")
class Sum:
    """Adds all activities and resolves no conflict."""

    join = Join.SUM

    def __init__(self, inputs: PolicyInputs) -> None:
        pass

    def at(self, times: Array) -> Resolver:
        """Return the function that leaves every activity as it is."""
        return _unchanged

    def suppressor(self, channel: Channel, parameter: str, time: float) -> Suppressor | None:
        """Return None: no rival suppresses anything."""
        return None


def _unchanged(channel: Channel, parameter: str, times: Array, values: Array) -> Array:
    return values

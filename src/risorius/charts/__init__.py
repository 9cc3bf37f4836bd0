"""Charts of activities before and after they are combined, as paper A's Figures 4 to 7 show them."""

from __future__ import annotations

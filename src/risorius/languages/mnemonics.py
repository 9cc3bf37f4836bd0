"""espeak-ng's mnemonics of a language as ARPAbet, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Mnemonics:
    """The file `mnemonics.toml`.

    `voice`: the language of the voice whose mnemonics these are. `simple`: their ARPAbet phones. `compound`:
    those that are two phones, each with its share of the time. `before_r`: what some lose their second part
    for before another r. `dictated`: the mnemonic of every ARPAbet phone, and `unstressed`: of vowels that
    have another one without stress; without them no phones can be dictated.
    """

    voice: str = ""
    simple: Mapping[str, str] = field(default_factory=dict)
    compound: Mapping[str, tuple[tuple[str, float], ...]] = field(default_factory=dict)
    before_r: Mapping[str, str] = field(default_factory=dict)
    dictated: Mapping[str, str] = field(default_factory=dict)
    unstressed: Mapping[str, str] = field(default_factory=dict)

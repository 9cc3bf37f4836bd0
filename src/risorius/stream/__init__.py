"""Performances sent to other programs as they happen: one module per protocol, one line here for each."""

from .greeting import wait_for_greeting
from .ifacialmocap import GREETINGS, ifacialmocap_packets
from .livelink import livelink_packets
from .protocols import PROTOCOLS, Options, Packets, Protocol, register
from .send import Address, parse_address, send
from .vmc import vmc_packets

register("livelink", 11111, "Live Link Face, as Unreal Engine receives it", livelink_packets)
register("vmc", 39539, "Virtual Motion Capture (OSC), as VRM avatars receive it", vmc_packets)
register("ifacialmocap", 49983, "iFacialMocap", ifacialmocap_packets, GREETINGS)

__all__ = [
    "PROTOCOLS",
    "Address",
    "Options",
    "Packets",
    "Protocol",
    "parse_address",
    "send",
    "wait_for_greeting",
]

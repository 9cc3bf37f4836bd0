"""Performances sent to other programs as they happen: one module per protocol, one line here for each."""

from .handshake import wait_for_greeting
from .ifacialmocap import GREETINGS, ifacialmocap_packets, ifacialmocap_pieces
from .live import send_live
from .livelink import livelink_packets
from .protocols import PROTOCOLS, ArkitMoment, Options, Packets, Protocol, check_options, register
from .receiver import PATIENCE
from .receiver_socket import Address, parse_address
from .send import SendCounts, send
from .take import send_take
from .vmc import vmc_packets

register(
    "livelink", 11111, "Live Link Face, as Unreal Engine receives it", livelink_packets, reads=("subject",)
)
register(
    "vmc", 39539, "Virtual Motion Capture (OSC), as VRM avatars receive it", vmc_packets, reads=("names",)
)
register(
    "ifacialmocap", 49983, "iFacialMocap, by datagrams", ifacialmocap_packets, GREETINGS, reads=("dialect",)
)
register("ifacialmocap-tcp", 49986, "iFacialMocap, as one stream", ifacialmocap_pieces, tcp=True)

__all__ = [
    "PATIENCE",
    "PROTOCOLS",
    "Address",
    "ArkitMoment",
    "Options",
    "Packets",
    "Protocol",
    "SendCounts",
    "check_options",
    "parse_address",
    "send",
    "send_live",
    "send_take",
    "wait_for_greeting",
]

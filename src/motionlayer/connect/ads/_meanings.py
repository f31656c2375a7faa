"""What ADS return codes mean, for a reader: those that the server sends, and those that clients make themselves."""

from typing import Final, NamedTuple


class Meaning(NamedTuple):
    """An ADS return code in words.

    Attributes:
        text: what happened.
        advice: the way out.
    """

    text: str
    advice: str


MEANINGS: Final[dict[int, Meaning]] = {
    0x0006: Meaning("target port not found", "851 for symbols, 500 or 501 for axes, 10000 for the run as a whole"),
    0x0007: Meaning("target machine not found", "give the NetId of the server; in [ads], net_ids lets clients in"),
    0x0008: Meaning("unknown command", "the server knows the commands of ADS, 1 to 9"),
    0x000D: Meaning("port not connected", "open the port of the client first"),
    0x000E: Meaning("wrong AMS length", "the frame is damaged; frames are at most 4 MiB"),
    0x0019: Meaning("no memory", "ask for less in one request"),
    0x001B: Meaning("host unreachable", "look at the address, and that the server runs"),
    0x0502: Meaning("mailbox full", "more requests wait than [ads.limits] lets one client have; wait for answers"),
    0x0506: Meaning("port in use", "register another port, or none"),
    0x0508: Meaning("no more ports", "as many are registered as [ads.limits] allows"),
    0x0700: Meaning("device error", "see the messages of the run"),
    0x0701: Meaning("service not supported", "see what each port and group offers in docs/ads.md"),
    0x0702: Meaning("wrong index group", "see the groups of the port in docs/ads.md"),
    0x0703: Meaning("wrong index offset", "what is not simulated has no offset; see docs/ads.md"),
    0x0704: Meaning("not permitted", "the run alone writes this, or the client may only read; the log names both"),
    0x0705: Meaning("wrong size", "`motionlayer symbols` tells the bytes of a symbol"),
    0x0706: Meaning("wrong data", "the log names the symbol and what it takes"),
    0x0707: Meaning("device not ready", "wait until the run has begun"),
    0x070B: Meaning("wrong parameter", "see the request in docs/ads.md"),
    0x070C: Meaning("not found", "look at name and handle; handles end with their connection"),
    0x070D: Meaning("syntax error", "write the name as `motionlayer symbols --all` does"),
    0x0710: Meaning("symbol not found", "`motionlayer symbols --all` lists the names"),
    0x0711: Meaning("symbol version changed", "the run has begun anew: read the symbols again and take new handles"),
    0x0712: Meaning("wrong state", "the run cannot do this now; the log says why"),
    0x0713: Meaning("transmission mode not supported", "take cyclic or on change"),
    0x0714: Meaning("wrong notification handle", "it was deleted, or belongs to another connection"),
    0x0716: Meaning("no more handles", "release some, or raise them in [ads.limits]"),
    0x0717: Meaning("notifications too large", "take fewer or smaller ones, or raise them in [ads.limits]"),
    0x0719: Meaning("the device took too long", "the run is not stepped, or busy"),
    0x0721: Meaning("array index outside its bounds", "arrays of axes begin at 1; `motionlayer symbols` tells bounds"),
    0x0723: Meaning("access denied", "in [ads], read_only and net_ids say who may"),
    0x0740: Meaning("client error", "see the log of the client"),
    0x0741: Meaning("wrong parameter in the client", "look at the call of the client"),
    0x0745: Meaning("time-out", "nobody listens there, or the run is not stepped: motionlayer run … --realtime --ads"),
    0x0748: Meaning("the port of the client is not open", "open the connection first"),
    0x0749: Meaning("no AMS address in the client", "give NetId and port of the target"),
    0x0754: Meaning("the client has not understood the answer", "look at NetId and versions on both sides"),
    0x0755: Meaning("the port of the client is locked", "one request at a time per port of the client"),
}

"""Peers: what they are asked, and their values."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final, NamedTuple

from motionlayer.bench import _load
from motionlayer.bench._environment import PeersMissing
from motionlayer.bench._row import Effort, Peer

SCRIPT: Final = Path(__file__).with_name("_peer_script.py")

SLOW: Final = 10
"""A cycle of a thousand Python objects is measured so many times less often."""


class PeerValues(NamedTuple):
    """Values by job, and why the others are missing."""

    values: dict[str, float]
    notes: list[str]


def measure(peers: Iterable[Peer], effort: Effort) -> PeerValues:
    """Measure the peers, as far as they can be had; never raises for one that cannot."""
    values: dict[str, float] = {}
    notes: dict[str, str] = {}
    for peer in {peer.job: peer for peer in peers}.values():
        try:
            values[peer.job] = float(ask(peer.job, peer.work(effort), effort))
        except PeersMissing as missing:
            notes.setdefault(f"no {peer.package}: {missing}", peer.job)
    return PeerValues(values, list(notes))


def ask(job: str, work: dict[str, Any], effort: Effort) -> Any:  # noqa: ANN401 - JSON
    """Return the answer of `_peer_script` to a job.

    Raises:
        PeersMissing: there is none.
    """
    return effort.peers.run(SCRIPT, {"job": job, **work})


def axes(effort: Effort) -> dict[str, Any]:
    """Return the work of a thousand axes in Python."""
    return {"axes": 1000, "cycles": max(1, effort.samples // SLOW)}


def moves(effort: Effort) -> dict[str, Any]:
    """Return the work of one axis that is sent about."""
    return {
        "targets": _load.targets(effort.samples),
        "velocity": _load.VELOCITY,
        "acceleration": _load.ACCELERATION,
        "jerk": _load.JERK,
        "pause": _load.MOVE_TICKS * _load.BASE_CYCLE,
    }

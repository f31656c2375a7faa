"""The campaign `contract`: whatever clients write, the motion layer keeps what its interface promises.

A case is a machine with some axes; each has clients that come one after the other, each from a state of the axis. What
is counted is clients, that is sequences of commands.
"""

import pprint
from typing import Any, Final

import numpy as np

from motionlayer.bench.campaign._campaign import Campaign, Failure, judged, stream
from motionlayer.bench.campaign._contract_acts import selector, sequence
from motionlayer.bench.campaign._contract_oracle import judge
from motionlayer.bench.campaign._contract_play import PATIENCE, Contract, play
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.bench.campaign._contract_watch import Fault
from motionlayer.verify import verify

STREAM: Final = 5

AXES: Final = 10
EACH: Final = 5
"""Sequences of each axis."""

SIZE: Final = AXES * EACH
SELECTIONS: Final = 100
MOST_TOLD: Final = 5

LIMITS: Final = {
    "max_velocity": 600.0,
    "max_acceleration": 60_000.0,
    "max_deceleration": 80_000.0,
    "max_jerk": 1e7,
}
SERVO: Final = {"drive": {"kind": "servo", "position_gain": 100.0}}
HOMINGS: Final[tuple[dict[str, Any], ...]] = (
    {},
    {"home": {"mode": "direct", "velocity": 200.0, "sync_velocity": 20.0, "direction": "negative"}},
    {"home": {"mode": "switch", "switch": -50.0, "velocity": 200.0, "position": 7.0}},
)
RANGE: Final = {"software_limit_min": -70.0, "software_limit_max": 70.0}


def contract(seed: int, case: int) -> Contract:
    """Return a case."""
    rng = stream(seed, case, STREAM)
    axes = {f"A{number}": _axis(rng) for number in range(1, AXES + 1)}
    timeout = PATIENCE * 1e-3
    machine = {"format": 1, "name": "contract", "axis": axes, "layer": {"timeout": timeout}}
    lives = [[sequence(rng) for _ in range(EACH)] for _ in axes]
    return Contract(machine, lives, selector(rng, AXES, SELECTIONS))


def _axis(rng: np.random.Generator) -> dict[str, Any]:
    """Return an axis: most have a drive that can fail, some have software limits."""
    home = HOMINGS[int(rng.integers(len(HOMINGS)))]
    return LIMITS | home | (SERVO if rng.random() < 0.7 else {}) | (RANGE if rng.random() < 0.3 else {})


def violations(case: Contract, recording: Recording) -> list[str]:
    """Return every broken rule, with the clients of the axis on which it was broken."""
    faults = judge(recording)
    found = [_quoted(fault, case, recording) for fault in faults[:MOST_TOLD]]
    report = verify(recording.trace)
    found += [str(finding) for finding in report.findings[:MOST_TOLD]]
    return found + [f"cannot be judged: {reason}" for reason in report.refused]


def _quoted(fault: Fault, case: Contract, recording: Recording) -> str:
    if fault.axis not in recording.axes:
        return str(fault)
    place = recording.axes.index(fault.axis)
    states = recording.state["state"][max(fault.tick - 5, 0) : fault.tick + 3, place].tolist()
    axis = case.machine["axis"][fault.axis]
    life = pprint.pformat([tuple(one) for one in case.lives[place]], width=118, compact=True)
    return f"{fault}\nState around it: {states}\naxis: {axis}\nits clients: {life}"


def run(seed: int, cases: range) -> list[Failure]:
    """Run and judge cases."""

    def one(seed: int, case: int) -> list[str]:
        made = contract(seed, case)
        return violations(made, play(made))

    return judged(one, seed, cases)


def describe(seed: int, case: int) -> str:
    """Return machine and clients of a case."""
    return pprint.pformat(contract(seed, case)._asdict(), width=118, sort_dicts=False)


CONTRACT: Final = Campaign("contract", "sequences", SIZE, 1, 100_000, run, describe)
"""Its full count is that of the figure `layer.contract`."""

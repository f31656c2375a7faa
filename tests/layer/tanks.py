"""A namespace that a control program could declare: a tank that is filled and emptied."""

import enum
from typing import Any

from motionlayer import Simulation
from motionlayer.event import Level
from motionlayer.iec import LREAL, UDINT, UINT, Enumeration, Field, Struct
from motionlayer.layer import (
    JobTable,
    Namespace,
    NamespaceJob,
    NamespaceObject,
    Progress,
    Transition,
    a_call_later,
    after,
    always,
    nothing,
)
from tests.layer.message_runs import opened

P = Progress


class Command(enum.IntEnum):
    NULL = 0
    FILL = 30
    EMPTY = 31
    FAIL = 32
    BROKEN = 33
    UNPREPARED = 39
    LATER = 40


E_TANK_CTRL = Enumeration("E_TANK_CTRL", UINT, Command, prefix="TANK_")


class TankCtrl(Struct, iec="ST_TANK_CTRL", pack=2):
    cmd = Field("eCmd", E_TANK_CTRL)
    level = Field("rLevel", LREAL)


class TankState(Struct, iec="ST_TANK_STATE", pack=2):
    state = Field("eState", UINT)
    error_id = Field("nErrorId", UDINT)


Tank = NamespaceJob[TankCtrl, TankState]


def is_full(job: Tank) -> bool:
    return job.ctrl.level >= 1.0


def overflow(job: Tank) -> None:
    job.error = 7


def divide(job: Tank) -> bool:
    return 1.0 / job.ctrl.level > 0.0


JOBS: dict[int, JobTable[Any]] = {
    Command.FILL: JobTable[Tank](
        "FILL",
        [
            Transition(P.INIT, always, nothing, P.BUSY),
            Transition(P.BUSY, is_full, nothing, P.CHECK),
            Transition(P.CHECK, after(0.005), nothing, P.DONE),
        ],
    ),
    Command.EMPTY: JobTable[Tank]("EMPTY", [Transition(P.INIT, a_call_later, nothing, P.DONE)]),
    Command.BROKEN: JobTable[Tank]("BROKEN", [Transition(P.INIT, divide, nothing, P.DONE)]),
    Command.UNPREPARED: JobTable[Tank]("UNPREPARED", [Transition(P.INIT, always, nothing, P.DONE)], prepare=divide),
    Command.FAIL: JobTable[Tank]("FAIL", [Transition(P.INIT, always, overflow, P.ERROR)]),
}
TANK = Namespace("GVL_TANK", TankCtrl, TankState, JOBS, source="Brewery")


def tank(**changes: Any) -> tuple[Simulation, NamespaceObject[TankCtrl, TankState]]:
    run = opened(layer={"test": True})
    return run, run.namespaces.add(TANK, **changes)


def codes(run: Simulation, one: NamespaceObject[TankCtrl, TankState], ticks: int) -> list[int]:
    """Return the state at the end of each of the next cycles."""
    found = []
    for _ in range(ticks):
        run.step()
        found.append(one.state.code)
    return found


def told(run: Simulation) -> list[tuple[Level, int, str]]:
    return [(event.level, event.code, event.text) for event in run.events.last() if event.source == "Brewery"]

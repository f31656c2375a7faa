"""A namespace of one's own: clear the transport, so that no carrier is left on the belt.

What a library of motion blocks would hide in a function block is a command here, like those of the axes: it is dropped
into `GVL_TRANSPORT.Ctrl.eCmd`, and `GVL_TRANSPORT.State.eState` tells how far it is.
"""

import enum

from motionlayer import Simulation
from motionlayer.iec import UDINT, UINT, Enumeration, Field, Struct
from motionlayer.layer import (
    AxisCommand,
    AxisObject,
    JobTable,
    Namespace,
    NamespaceJob,
    Progress,
    Schedule,
    Site,
    Transition,
    a_call_later,
    after,
    nothing,
)

DOWN = -37.0  # mm, where the stopper lets carriers pass
GROUP = 53.0  # mm, length of a group of carriers
TASK = Schedule(divisor=10, phase=8)  # the transport is looked at every 10 ms


class TransportCommand(enum.IntEnum):
    """What the transport can be told."""

    NULL = 0
    GROUP_CLEAR = 30
    GROUP_ENABLE = 31  # not built yet: it is answered with PROGRESS_NOT_EXIST


E_TRANSPORT_CTRL = Enumeration("E_TRANSPORT_CTRL", UINT, TransportCommand, prefix="TRANSPORT_")


class TransportCtrl(Struct, iec="ST_TRANSPORT_CTRL", pack=2):
    """Command of the transport."""

    cmd = Field("eCmd", E_TRANSPORT_CTRL, "command")


class TransportState(Struct, iec="ST_TRANSPORT_STATE", pack=2):
    """Answer of the transport."""

    state = Field("eState", UINT, "command + progress")
    error_id = Field("nErrorId", UDINT, "number of the error, 0 without one")


class Transport(NamespaceJob[TransportCtrl, TransportState]):
    """What the steps of a command see: the axes, by their own Ctrl and State."""

    def __init__(self, site: Site[TransportCtrl, TransportState], run: Simulation) -> None:
        super().__init__(site)
        self.belt, self.stopper = run.layer.axis["Belt"], run.layer.axis["Stopper"]


def drop(axis: AxisObject, command: AxisCommand) -> None:
    """Drop a command."""
    axis.ctrl.cmd = command


def has_done(axis: AxisObject, command: AxisCommand) -> bool:
    """Tell whether a command that was dropped is done."""
    return axis.state.code == command + Progress.DONE


# -- conditions --------------------------------------------------------------------------------------------------------


def axis_failed(job: Transport) -> bool:
    """Tell whether an axis has not done what it was told."""
    return any(axis.state.split().progress == Progress.ERROR for axis in (job.belt, job.stopper))


def belt_stands(job: Transport) -> bool:
    """Tell whether the belt has come to rest."""
    return has_done(job.belt, AxisCommand.HALT)


def stopper_is_down(job: Transport) -> bool:
    """Tell whether carriers can pass."""
    return has_done(job.stopper, AxisCommand.MOVE_POS)


def group_is_out(job: Transport) -> bool:
    """Tell whether the belt has carried the group out."""
    return has_done(job.belt, AxisCommand.MOVE_POS)


# -- actions -----------------------------------------------------------------------------------------------------------


def halt_belt(job: Transport) -> None:
    """Bring the belt to rest."""
    drop(job.belt, AxisCommand.HALT)


def lower_stopper(job: Transport) -> None:
    """Open the way."""
    job.stopper.data.position, job.stopper.data.velocity = DOWN, 300.0
    drop(job.stopper, AxisCommand.MOVE_POS)


def carry_out(job: Transport) -> None:
    """Move by the length of a group."""
    job.belt.data.position, job.belt.data.velocity = job.belt.info.position + GROUP, 400.0
    drop(job.belt, AxisCommand.MOVE_POS)


def switch_off(job: Transport) -> None:
    """Switch the belt off."""
    drop(job.belt, AxisCommand.DISABLE)


def take_over(job: Transport) -> None:
    """Show the error of the axis as one of the transport."""
    job.error = job.belt.info.error_id or job.stopper.info.error_id


P = Progress
GROUP_CLEAR = JobTable[Transport](
    "TRANSPORT_GROUP_CLEAR",
    [
        Transition(P.INIT, a_call_later, halt_belt, P.BUSY),
        Transition(P.BUSY, axis_failed, take_over, P.ERROR),
        Transition(P.BUSY, belt_stands, lower_stopper, P.PREPARE),
        Transition(P.PREPARE, axis_failed, take_over, P.ERROR),
        Transition(P.PREPARE, stopper_is_down, carry_out, P.STARTUP),
        Transition(P.STARTUP, axis_failed, take_over, P.ERROR),
        Transition(P.STARTUP, group_is_out, nothing, P.CHECK),
        Transition(P.CHECK, after(0.030), switch_off, P.OCCUPIED),  # so long the light barrier has to be free
        Transition(P.OCCUPIED, after(0.020), nothing, P.DONE),
    ],
)

TRANSPORT = Namespace(
    "GVL_TRANSPORT",
    TransportCtrl,
    TransportState,
    {TransportCommand.GROUP_CLEAR: GROUP_CLEAR},
    source="ExampleEvalMachine",
)


async def main(run: Simulation) -> None:
    """Let the belt run, and clear it."""
    transport = run.namespaces.add(TRANSPORT, lambda site: Transport(site, run), schedule=TASK)
    belt, stopper = run.layer.axis["Belt"], run.layer.axis["Stopper"]
    await run.layer.started()
    for axis in (belt, stopper):
        drop(axis, AxisCommand.ENABLE)
        await axis.state.done(AxisCommand.ENABLE)
    belt.data.velocity = 200.0
    drop(belt, AxisCommand.MOVE_VELO)
    await run.until(lambda: run.time >= 0.408)
    transport.ctrl.cmd = TransportCommand.GROUP_CLEAR
    await transport.state.done(TransportCommand.GROUP_CLEAR)
    print(f"{run.time:.3f} s: the transport is clear, its state is {transport.state.code}")

"""`stopping`: the one way in which leaving a block stops motion (rule 4)."""

import pytest

from motionlayer import AxisState, Simulation, stopping
from motionlayer.nc import Axis
from motionlayer.runtime import Cancelled
from tests.machines import SWITCH, machine, play, ready


def at_rest(axis: Axis) -> bool:
    return axis.set_velocity == 0.0 and axis.set_acceleration == 0.0 and axis.state is AxisState.STANDSTILL


def test_leaving_the_block_halts_and_waits_until_the_axes_rest() -> None:
    run = Simulation(machine(3))
    x, y, z = run.axes.values()

    async def program() -> None:
        for axis in (x, y, z):
            await axis.enable()
        async with stopping(x, y):
            x.move_velocity(300.0)
            y.move_absolute(300.0)
            z.move_velocity(100.0)
            await run.sleep(0.1)
        assert at_rest(x)
        assert at_rest(y)
        assert z.set_velocity == 100.0

    play(run, program)


def test_an_exception_passes_after_the_axes_rest() -> None:
    run, x = ready()

    async def program() -> None:
        with pytest.raises(LookupError):  # noqa: PT012 - the block is what is tested
            async with stopping(x):
                x.move_velocity(300.0)
                await run.sleep(0.1)
                raise LookupError
        assert at_rest(x)

    play(run, program)


def test_cancelling_stops_the_axes() -> None:
    run, x = ready()
    rested: list[bool] = []

    async def victim() -> None:
        try:
            async with stopping(x):
                await x.move_velocity(300.0)
        except Cancelled:
            rested.append(at_rest(x))
            raise

    async def program() -> None:
        child = run.start(victim())
        await run.sleep(0.1)
        child.cancel()
        await child.settled()
        assert child.aborted
        assert rested == [True]

    play(run, program)


def test_an_axis_at_rest_costs_nothing() -> None:
    run, x = ready()

    async def program() -> None:
        tick = run.tick
        async with stopping(x):
            pass
        assert run.tick == tick
        assert x.state is AxisState.STANDSTILL

    play(run, program)


def test_a_homing_axis_is_stopped_too() -> None:
    run, x = ready(home=SWITCH)

    async def program() -> None:
        async with stopping(x):
            x.home()
            await run.sleep(0.1)
        assert at_rest(x)
        assert not x.homed

    play(run, program)


@pytest.mark.parametrize("how", ["stop", "disable"])
def test_an_axis_that_brakes_already_is_waited_for(how: str) -> None:
    run, x = ready()

    async def program() -> None:
        async with stopping(x):
            x.move_velocity(300.0)
            await run.sleep(0.1)
            x.stop() if how == "stop" else x.disable()
        assert x.set_velocity == 0.0
        assert x.set_acceleration == 0.0

    play(run, program)

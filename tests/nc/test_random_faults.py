"""Random faults on servo axes that move, are reset and go on: whatever happens, the trace is valid."""

import contextlib

import numpy as np
import pytest

from motionlayer import AxisState, CommandAborted, CommandError, Fault, Simulation
from motionlayer.drive import FaultKind
from motionlayer.nc import Axis
from motionlayer.verify import assert_valid
from tests.nc.servos import servo_machine

DRIVE = {"noise": 0.002, "encoder_resolution": 0.001, "backlash": 0.01, "ready_delay": 0.01, "patience": 4}
MONITOR = {
    "lag": 12.0,
    "lag_time": 0.005,
    "range_window": 1.0,
    "target_window": 0.1,
    "target_time": 0.003,
    "target_timeout": 0.4,
    "software_limits": True,
}
TIME = 4.0


async def life(run: Simulation, x: Axis, random: np.random.Generator) -> None:
    """Move at random; reset and switch on again after every error."""
    while True:
        with contextlib.suppress(CommandError, CommandAborted, TimeoutError), run.fail_after(0.8):
            if x.state is AxisState.ERRORSTOP:
                await x.reset()
            if x.state is AxisState.DISABLED:
                await x.enable()
            call = random.integers(6)
            if call < 3:
                await x.move_absolute(float(random.uniform(-100.0, 400.0)))
            elif call == 3:
                x.move_velocity(float(random.uniform(1.0, 500.0)))
            elif call == 4:
                x.set_override(float(random.uniform(0.1, 1.0)))
            else:
                await x.stop()
        await run.sleep(float(random.uniform(0.0, 0.1)))


async def trouble(run: Simulation, names: str, random: np.random.Generator) -> None:
    """Let something go wrong every now and then."""
    kinds = list(FaultKind)
    while True:
        await run.sleep(float(random.uniform(0.0, 0.5)))
        name, kind = names[random.integers(len(names))], kinds[random.integers(len(kinds))]
        if kind is FaultKind.ENCODER_JUMP:
            run.inject(name, Fault(kind, float(random.normal(0.0, 1.0))))
        else:
            run.inject(name, Fault(kind, duration=float(random.uniform(0.0005, 0.2))))
        if random.random() < 0.1:
            run.emergency_stop()


def perform(seed: int) -> Simulation:
    groups = {"all": {"axes": ["X", "Y"], "reaction": ("none", "halt", "stop")[seed % 3]}}
    run = Simulation(servo_machine("XYZ", drive=DRIVE, monitor=MONITOR, top={"group": groups}), seed=seed)
    for name, axis in run.axes.items():
        run.start(life(run, axis, run.random(name)), name)
    run.start(trouble(run, "XYZ", run.random("trouble")), "trouble")
    run.run(time=TIME)
    assert not run.failures
    return run


@pytest.mark.parametrize("seed", range(6))
def test_random_faults(seed: int) -> None:
    run = perform(seed)
    trace = run.trace
    for name in "XYZ":
        assert np.abs(np.diff(trace[f"{name}.set_acceleration"])).max() <= 1e5 * 0.001 * (1.0 + 1e-9)
    assert len({event.code for event in trace.events if event.code}) >= 3
    assert_valid(trace)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 160))
def test_many_random_faults(seed: int) -> None:
    assert_valid(perform(seed).trace)


def test_the_same_faults_give_the_same_trace() -> None:
    assert perform(1).trace.hash == perform(1).trace.hash

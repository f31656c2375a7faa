"""One control program over every communication: what its axes do is the same, only the delay differs.

The program of examples/control_layer runs beside the motion layer, and over images in the same process. Then it
commands a motion machine in another process, in real time, by ADS over TCP, and over MQTT if there is a broker. A step
of the program lets a drive fail, so it fails at the same place each time. In the root of the repository:
`python -m examples.communications.compare [SPEED] [BROKER_PORT]`
"""

import contextlib
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pyads
from examples.communications.ads_mqtt import MqttAds
from examples.communications.ads_tcp import read_write_of

from motionlayer import Loopback, Machine, MachineRun, RealTime, Simulation, Trace
from motionlayer.event import Subdevice
from motionlayer.layer import AxisCommand, Progress
from motionlayer.machine import AdsLink, ReadWrite

HERE = Path(__file__).parent
NET_ID, OWN = "127.0.0.1.7.1", "127.0.0.1.7.2"
POSITION = ".set_position"
FINISHED = (AxisCommand.DISABLE, Progress.DONE)


class Outcome(NamedTuple):
    """What has become of the program.

    Attributes:
        trace: of the motion machine.
        delays: of the communication: cycles from a command written to its first state seen, in order.
    """

    trace: Trace
    delays: list[int]

    @property
    def axes(self) -> list[str]:
        """The names of the axes."""
        return [name.removesuffix(POSITION) for name in self.trace if name.endswith(POSITION)]

    @property
    def states(self) -> dict[str, list[str]]:
        """The commands and states of each axis, in order, as the motion layer has told them."""
        told = [event for event in self.trace.events if event.subdevice == Subdevice.AxisControl]
        sources = {axis: f"GVL_AXIS.Ctrl[{index}]" for index, axis in enumerate(self.axes, 1)}
        return {axis: [event.text for event in told if event.source == source] for axis, source in sources.items()}

    @property
    def ends(self) -> dict[str, float]:
        """Where the axes have ended."""
        return {axis: float(self.trace[axis + POSITION][-1]) for axis in self.axes}


async def measure(run: MachineRun, delays: list[int]) -> None:
    """Note how long each command takes to be answered, until all axes are switched off."""
    await run.layer.started()
    axes = list(run.layer.axis)
    written = [int(axis.ctrl.cmd) for axis in axes]
    since: dict[int, int] = {}
    while not all((axis.ctrl.cmd, axis.state.split().progress) == FINISHED for axis in axes):
        for index, axis in enumerate(axes):
            if axis.ctrl.cmd != written[index]:
                written[index], since[index] = int(axis.ctrl.cmd), run.tick
            if index in since and axis.state.split().command == axis.ctrl.cmd:
                delays.append(run.tick - since.pop(index))
        await run.sleep(0)


def in_process() -> Outcome:
    """The program runs in the motion machine itself."""
    delays: list[int] = []
    with Simulation(Machine.load(HERE.parent / "control_layer" / "machine.toml"), log=False) as run:
        run.run(measure(run, delays))
        return Outcome(run.trace, delays)


def by_images() -> Outcome:
    """Two machines in one process, wired as by a fieldbus."""
    delays: list[int] = []
    motion, control = Machine.load(HERE / "mapped.toml"), Machine.load(HERE / "control.toml")
    with Simulation(motion) as axes, Simulation(control) as controller:
        Loopback(axes, controller).run(measure(controller, delays))
        return Outcome(axes.trace, delays)


@contextlib.contextmanager
def motion_process(trace: Path, speed: float, *broker: int) -> Iterator[int]:
    """Let the motion machine run in a process of its own; yields its TCP port."""
    arguments = [sys.executable, str(HERE / "motion.py"), str(trace), str(speed), *map(str, broker)]
    with subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:  # noqa: S603 - our own script
        assert process.stdout is not None
        yield int(process.stdout.readline())
        process.communicate()


def linked(read_write: ReadWrite, speed: float) -> list[int]:
    """Run the control machine with a motion machine at the other end of an ADS client; return the delays."""
    delays: list[int] = []
    with RealTime(Machine.load(HERE / "control.toml"), speed=speed) as run, AdsLink(run, read_write):
        run.run(measure(run, delays))
    return delays


def by_ads(speed: float) -> Outcome:
    """Over TCP, with pyads."""
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "motion.trace"
        with motion_process(trace, speed) as port, pyads.Connection(NET_ID, 851, f"127.0.0.1:{port}") as plc:
            delays = linked(read_write_of(plc), speed)
        return Outcome(Trace.load(trace), delays)


def by_mqtt(speed: float, broker: int) -> Outcome:
    """Over an MQTT broker on this computer, with the client of `ads_mqtt`."""
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "motion.trace"
        with motion_process(trace, speed, broker):
            client = MqttAds(("127.0.0.1", broker), NET_ID, OWN)
            try:
                client.online.wait(10.0)
                delays = linked(client.read_write, speed)
            finally:
                client.close()
        return Outcome(Trace.load(trace), delays)


def show(outcomes: dict[str, Outcome]) -> None:
    """Print what each communication costs, and whether it has changed anything."""
    first = next(iter(outcomes.values()))
    print(f"{'communication':<16}{'states':>8}{'delay, cycles: least':>24}{'median':>8}{'most':>6}  the same")
    for name, one in outcomes.items():
        delays, count = sorted(one.delays), sum(map(len, one.states.values()))
        same = "yes" if (one.states, one.ends) == (first.states, first.ends) else "NO"
        print(f"{name:<16}{count:>8}{delays[0]:>24}{delays[len(delays) // 2]:>8}{delays[-1]:>6}  {same}")


def main() -> None:
    """Run the program over each communication, and compare: `python compare.py [SPEED [BROKER_PORT]]`."""
    speed = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    outcomes = {"in process": in_process(), "images": by_images(), "ADS": by_ads(speed)}
    if len(sys.argv) > 2:
        outcomes["ADS over MQTT"] = by_mqtt(speed, int(sys.argv[2]))
    show(outcomes)


if __name__ == "__main__":
    main()

"""A machine on which everything happens, led by cyclic programs: random commands, faults, waits and areas."""

from types import SimpleNamespace
from typing import Any

from motionlayer import AxisState, Command, Fault, Machine, Simulation, all_of, any_of
from motionlayer.drive import FaultKind
from motionlayer.nc import Axis, BufferMode, Direction
from tests.machines import LINEAR, SWITCH
from tests.nc.servos import SERVO

DRIVE: dict[str, Any] = {
    "noise": 0.002,
    "encoder_resolution": 0.001,
    "backlash": 0.01,
    "ready_delay": 0.005,
    "patience": 4,
}
MONITOR: dict[str, Any] = {
    "lag": 12.0,
    "lag_time": 0.005,
    "range_window": 1.0,
    "target_window": 0.1,
    "target_time": 0.003,
    "target_timeout": 0.4,
}
SERVO_AXIS = LINEAR | {"drive": SERVO | DRIVE, "monitor": MONITOR}
MACHINE = Machine.from_dict(
    {
        "format": 1,
        "name": "lives",
        "axis": {"X": SERVO_AXIS, "Y": SERVO_AXIS, "Z": LINEAR | {"home": SWITCH}},
        "group": {"all": {"axes": ["X", "Y"], "reaction": "halt"}},
        "task": {"slow": {"every": 7, "phase": 3}},
    }
)


def lively(seed: int = 0, *, trace: bool = True) -> Simulation:
    """Return a run with its programs, before the first tick."""
    run = Simulation(MACHINE, seed=seed, trace=trace)
    run.areas.add("shown", 8 * len(MACHINE.description.axis))
    run.areas.add("asked", 1, outside=True)
    for name in run.axes:
        run.cyclic(life, name=name, task="slow" if name == "Y" else "main")
    run.cyclic(trouble)
    run.cyclic(show)
    return run


def life(run: Simulation, memory: SimpleNamespace) -> None:
    """Lead the axis that is called as the program is, at random; switch on and reset it where it has to be."""
    axis = run.axes[run.program.name]
    if not hasattr(memory, "random"):
        memory.random = run.random(axis.name)
        memory.commands = list[Command[Any]]()
        memory.ended = 0
    memory.commands[:] = [command for command in memory.commands if command.busy]
    if axis.state is AxisState.ERRORSTOP:
        memory.commands.append(axis.reset())
    elif axis.state is AxisState.DISABLED:
        memory.commands.append(axis.enable())
    elif memory.random.random() < 0.04:
        command(axis, memory)


def command(axis: Axis, memory: SimpleNamespace) -> None:
    """Give a random command, and now and then wait for several at once."""
    random = memory.random
    where = float(random.uniform(-90.0, 390.0))
    mode = list(BufferMode)[random.integers(len(BufferMode) if axis.name == "Z" else 2)]
    calls = [
        lambda: axis.move_absolute(where, velocity=float(random.uniform(20.0, 500.0)), buffer_mode=mode),
        lambda: axis.move_relative(where / 10.0, buffer_mode=mode),
        lambda: axis.move_velocity(float(random.uniform(1.0, 400.0)), Direction.NEGATIVE),
        lambda: axis.stop(hold=bool(random.integers(2))),
        axis.halt,
        lambda: axis.home(where / 50.0),
        lambda: axis.passes(where),
        axis.disable,
    ]
    memory.commands.append(calls[random.integers(len(calls))]())
    axis.set_override(float(random.uniform(0.2, 1.0)) if random.random() < 0.3 else 1.0)
    if len(memory.commands) > 1:
        both = all_of(*memory.commands[-2:])
        memory.either = any_of(both, *memory.commands[-3:-2])

        def ended() -> None:
            memory.ended += 1

        memory.either.on_end(ended)


def trouble(run: Simulation, memory: SimpleNamespace) -> None:
    """Let something go wrong every now and then."""
    if not hasattr(memory, "random"):
        memory.random = run.random("trouble")
    random, kinds = memory.random, list(FaultKind)
    if random.random() > 0.006:
        return
    name, kind = "XY"[random.integers(2)], kinds[random.integers(len(kinds))]
    jump = kind is FaultKind.ENCODER_JUMP
    fault = Fault(kind, float(random.normal())) if jump else Fault(kind, duration=float(random.uniform(0.001, 0.1)))
    run.inject(name, fault, run.tick + int(random.integers(1, 40)))


def show(run: Simulation, memory: SimpleNamespace) -> None:
    """Show the actual positions in an area."""
    if not hasattr(memory, "out"):
        memory.out = run.areas["shown"].claim().cast("d")
    for index, axis in enumerate(run.axes.values()):
        memory.out[index] = axis.actual_position


def state(run: Simulation) -> tuple[Any, ...]:
    """Return all that the next ticks depend on, and what can be seen, as values."""
    store = run._stage._store
    memories = [vars(program.memory) for program in run._scheduler.programs]  # type: ignore[attr-defined]
    return (
        run.tick,
        [getattr(store, name).tobytes() for name in ("table", "pieces", "counts", "current", "appended")],
        run._servos.states.tobytes(),
        run._servos._ring_p.tobytes(),
        {name: area.read_with_tick() for name, area in run.areas.items()},
        run.events.last(),
        run._ledger._last,
        [[(key, repr(value)) for key, value in memory.items() if key not in ("random", "out")] for memory in memories],
        [repr(memory["random"].bit_generator.state) for memory in memories if "random" in memory],
        [(axis.state, axis.error, repr(axis.command), repr(axis.buffered)) for axis in run.axes.values()],
    )

"""Playing clients against a motion layer, and recording what it shows them."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from motionlayer.bench.campaign import _contract_recording as layouts
from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_acts import DURATION, DURATIONS, STARTS, Act, Sequence
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.event import Event
from motionlayer.machine import Machine, Simulation

Writes = list[tuple[str, Any]]

PATIENCE: Final = 30
"""Ticks that the layer lets switching take."""

SETTLING: Final = 25
"""Ticks after the last act of a sequence, in which its end is watched."""

MOST_TICKS: Final = 20_000
"""A case that takes longer hangs."""

START_UP: Final = "MAIN_AXIS.eInit"
STARTED: Final = (words.DONE, words.ERROR)
"""Ends of the start-up; the second one lasts where no client initialises the axis that has failed (D63)."""

WRITER: Final = "client"

VARIABLES: Final[dict[str, tuple[str, np.dtype[Any]]]] = {
    "ctrl": ("GVL_AXIS.Ctrl", layouts.CTRL),
    "options": ("GVL_AXIS.MotionOptions", layouts.OPTIONS),
    "data": ("GVL_AXIS.Data", layouts.DATA),
    "state": ("GVL_AXIS.State", layouts.STATE),
    "info": ("GVL_AXIS.Info", layouts.INFO),
    "selector_ctrl": ("GVL_AXIS.SelectorCtrl", layouts.SELECTOR_CTRL),
    "selector_state": ("GVL_AXIS.SelectorState", layouts.SELECTOR_STATE),
}
"""What is read at the end of every cycle."""


class Contract(NamedTuple):
    """A case.

    Attributes:
        machine: as data.
        lives: sequences of every axis, one after the other.
        selector: what is done to the parameter selector meanwhile.
    """

    machine: dict[str, Any]
    lives: list[list[Sequence]]
    selector: list[Act]


class _Recorder:
    """Reads the variables of a run as bytes."""

    def __init__(self, run: Simulation) -> None:
        self._sources = {key: run.symbols.find(name).symbol.source for key, (name, _) in VARIABLES.items()}
        self._rows: dict[str, list[bytes]] = {key: [] for key in (*VARIABLES, "asked")}
        self._axes = list(run.axes.values())
        self._errors: list[list[int]] = []
        self.events: list[Event] = []
        run.events.listen(self._listen)

    def _listen(self, event: Event) -> None:
        if event.command:
            self.events.append(event)

    def _read(self, key: str) -> bytes:
        source = self._sources[key]
        return bytes(source.read(0, len(source.memory)))

    def before(self) -> None:
        """Read what only shows what clients have written before a cycle makes it safe."""
        self._rows["asked"].append(self._read("data"))

    def after(self) -> None:
        """Read all the others."""
        for key in VARIABLES:
            self._rows[key].append(self._read(key))
        self._errors.append([0 if axis.error is None else int(axis.error.id) for axis in self._axes])

    def state(self, place: int) -> int:
        """Return State of an axis."""
        return int.from_bytes(self._read("state")[6 * place : 6 * place + 2], "little")

    def recording(self, run: Simulation) -> Recording:
        """Return everything."""
        kinds = {key: dtype for key, (_, dtype) in VARIABLES.items()} | {"asked": layouts.DATA}
        count = len(self._errors)
        arrays: dict[str, Any] = {
            key: np.frombuffer(b"".join(self._rows[key]), dtype).reshape(count, -1) for key, dtype in kinds.items()
        }
        for key in ("selector_ctrl", "selector_state"):
            arrays[key] = arrays[key][:, 0]
        return Recording(
            axes=tuple(run.axes),
            patience=PATIENCE,
            errors=np.array(self._errors),
            events=tuple(self.events),
            trace=run.trace,
            **arrays,
        )


def play(case: Contract) -> Recording:
    """Run a case.

    Raises:
        AssertionError: it does not come to its end.
    """
    with tempfile.TemporaryDirectory() as folder:
        kept = {"persistent_file": str(Path(folder) / "kept.toml")}
        return _play(case, Simulation(Machine.from_dict(case.machine | kept)))


def _play(case: Contract, run: Simulation) -> Recording:
    recorder = _Recorder(run)
    clients = [_client(life, place, recorder.state) for place, life in enumerate(case.lives)]
    others = _acts(case.selector, 0, lambda: 0)
    for _ in range(MOST_TICKS):
        writes, clients = _turn(clients)
        if not clients and run.symbols.read(START_UP) in STARTED:
            return recorder.recording(run)
        for name, value in [*writes, *(next(others, []) if run.layer.ready else [])]:
            run.symbols.write(name, value, WRITER)
        recorder.before()
        run.step()
        recorder.after()
    raise AssertionError(f"the clients are not done after {MOST_TICKS} cycles")


def _turn(clients: list[Iterator[Writes]]) -> tuple[Writes, list[Iterator[Writes]]]:
    """Return what all clients write now, and those that go on."""
    writes, going = [], []
    for client in clients:
        mine = next(client, None)
        if mine is not None:
            writes += mine
            going.append(client)
    return writes, going


def _client(life: list[Sequence], place: int, state: Callable[[int], int]) -> Iterator[Writes]:
    """Yield what the clients of an axis write, cycle by cycle."""
    index = place + 1
    yield [(DURATION.format(index), DURATIONS[0])]
    for one in life:
        yield from _reach(one, index, lambda: state(place))
        yield from _acts(one.acts, index, lambda: state(place))
        for _ in range(SETTLING):
            yield []


def _reach(one: Sequence, index: int, state: Callable[[], int]) -> Iterator[Writes]:
    """Bring the axis to the state from which a sequence begins; where that does not come about, from another one."""
    for phase in STARTS[one.start]:
        writes = [(name.format(index), value) for name, value in phase.writes]
        yield [*writes[:-1], (f"GVL_AXIS.Data[{index}].rSetPos", one.place), writes[-1]]
        for _ in range(phase.ticks - 1):
            if phase.state is not None and state() == phase.state:
                break
            yield []


def _acts(acts: list[Act], index: int, state: Callable[[], int]) -> Iterator[Writes]:
    """Yield what is written in each cycle; the last one is there even if nothing is."""
    writes: Writes = []
    for act in acts:
        for waited in range(abs(act.ticks)):
            yield writes
            writes = []
            if act.ticks < 0 < waited and _is_final(state()):
                break
        writes = [*writes, (act.symbol.format(index), act.value)]
    yield writes


def _is_final(state: int) -> bool:
    """Tell whether State shows an end."""
    return state < words.INIT or state >= words.ERROR

"""The simulated servo drive: all of a machine in one kernel call per cycle.

**Model.** In every cycle n the drive takes the set position s and the set velocity w of tick n - d, where d is its dead
time in whole cycles, and holds for one cycle the velocity that its position loop wants::

    u = Kv (s - x) + f w

with the position gain Kv and the velocity feed-forward f. The velocity loop is of first order with time constant T,
v' = (u - v)/T, and exact at the end of the cycle, with e = exp(-dt/T) computed at load::

    v(n+1) = u + (v - u) e
    x(n+1) = x + u dt + (v - u) T (1 - e)

If that asks for more than the torque allows, the acceleration is constant at its limit for the cycle. At constant
velocity the motor trails by (1 - f) v / Kv, whatever T is. The load trails the motor by half of the backlash, and
follows only when the motor presses against it. The encoder sits at the load; it shows its position quantised and with
noise, while the loop is closed at the motor, so that neither makes the drive itself restless.

**Stability.** The loop is linear with the determinant D = e - Kv (e dt - T(1 - e)) and the trace
1 + e - Kv (dt - T(1 - e)); it settles if |D| < 1 and 1 + trace + D > 0, which bounds Kv: `highest_gain`.

**Power.** Asked for power, the drive waits until the motor rests, then for its ready delay; it then holds the position
that its encoder shows, which the control adopts as set position in the same tick. Without power its brake slows the
motor with a constant deceleration and holds it.

**Communication.** Without it the drive goes on with the last velocity it was given, for a number of cycles; then it
latches an error and brakes. The control sees the actual values of before, and the status bit that says so.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from motionlayer.drive._fault import Agenda, Fault, FaultKind
from motionlayer.drive._layout import Par, State
from motionlayer.drive._noise import key_of
from motionlayer.drive._servo_kernels import Floats, cycle
from motionlayer.drive._switch import ReferenceSwitch, is_on
from motionlayer.store import Q, Status, Store


class Servo(NamedTuple):
    """Parameters of a servo drive; u is the unit of the axis.

    Attributes:
        name: keys the stream of its noise.
        position_gain: Kv, 1/s, below `highest_gain`.
        feed_forward: share of the set velocity that is fed forward, 0 to 1.
        time_constant: T of the velocity loop, s; 0 follows at once.
        dead_time: whole cycles.
        max_acceleration: torque limit, u/s²; may be infinite.
        backlash: whole play between motor and load, u.
        resolution: of the encoder, u; 0 without.
        noise: standard deviation of the encoder, u; 0 without.
        brake: deceleration without power, u/s².
        ready_delay: cycles between request and readiness beyond the first.
        patience: cycles without communication that are borne.
        leap: largest plausible change of the encoder in a cycle, u.
        switch: reference switch, None without.
    """

    name: str
    position_gain: float
    feed_forward: float = 0.0
    time_constant: float = 0.0
    dead_time: int = 0
    max_acceleration: float = math.inf
    backlash: float = 0.0
    resolution: float = 0.0
    noise: float = 0.0
    brake: float = math.inf
    ready_delay: int = 0
    patience: int = 3
    leap: float = math.inf
    switch: ReferenceSwitch | None = None


def _parameters(servo: Servo, dt: float) -> list[float]:
    """Return the rows of `Par` of one drive."""
    constant = servo.time_constant
    rise = -math.expm1(-dt / constant) if constant > 0.0 else 1.0
    edge, side, width = servo.switch or ReferenceSwitch(math.inf, 1.0)
    return [
        servo.position_gain, servo.feed_forward, rise, constant * rise, servo.max_acceleration * dt,
        servo.brake, 0.5 * servo.backlash, servo.resolution, servo.noise, edge, side, servo.leap,
        float(servo.ready_delay), float(servo.patience), width,
    ]  # fmt: skip


class ServoDrives:
    """All servo drives of a machine.

    Args:
        store: setpoints are read and actual values written here; the drives stand where its actual positions are.
        columns: the coordinates they move.
        servos: one per column.
        seed: of the run; every drive draws from its own stream.
    """

    def __init__(self, store: Store, columns: Sequence[int], servos: Sequence[Servo], seed: int) -> None:
        self._store = store
        self._columns = np.array(columns, dtype=np.int64)
        self._index = {column: k for k, column in enumerate(columns)}
        rows = np.array([_parameters(servo, store.dt) for servo in servos]).reshape(-1, Par.COUNT)
        self.parameters: Floats = np.ascontiguousarray(rows.T)
        self.states: Floats = np.zeros((State.COUNT, len(servos)))
        here = store.table[Q.ACTUAL_P, self._columns]
        self.states[[State.X, State.LOAD, State.REPORTED, State.DELAYED_P]] = here
        self._delays = np.array([servo.dead_time for servo in servos], dtype=np.int64)
        self._names = [servo.name for servo in servos]
        self._keys = np.zeros((2, len(servos)), dtype=np.int64)
        self.reseed(seed)
        slots = 1 + max((servo.dead_time for servo in servos), default=0)
        self._ring_p: Floats = np.tile(here, (slots, 1))
        self._ring_v: Floats = np.zeros((slots, len(servos)))
        self._wanting = np.zeros(len(servos), dtype=np.int64)
        self._changed = np.zeros(2 * len(servos), dtype=np.int64)
        self._agenda = Agenda()
        for column, servo in zip(columns, servos, strict=True):
            _set_switch(store, column, servo.switch)

    def reseed(self, seed: int) -> None:
        """Let every drive draw from its stream of another seed from now on."""
        if self._names:
            self._keys.T[...] = [key_of(seed, name) for name in self._names]

    def inputs(self, tick: int) -> None:
        """Write actual values, status and inputs of this tick."""
        if tick >= self._agenda.next:
            for drive, fault in self._agenda.take(tick):
                self._apply(drive, fault, tick)
        count = cycle(
            self._store.table, self._columns, self.parameters, self.states, self._delays, self._keys,
            self._ring_p, self._ring_v, tick, self._store.dt, self._wanting, self._changed,
        )  # fmt: skip
        if count:
            self._store.status_changed.extend(dict.fromkeys(self._changed[:count].tolist()))

    def inject(self, column: int, fault: Fault, tick: int) -> None:
        """Let a drive have a fault, visible in the inputs of `tick`; of a tick that has passed, of the next one.

        Raises:
            KeyError: the column has no servo drive.
        """
        self._agenda.add(tick, self._index[column], fault)

    def _apply(self, drive: int, fault: Fault, tick: int) -> None:
        until = tick + fault.ticks(self._store.dt)
        state = self.states[:, drive]
        match fault.kind:
            case FaultKind.DRIVE_ERROR:
                state[State.ERRORS] = int(state[State.ERRORS]) | Status.DRIVE_ERROR
                state[State.FAILS_UNTIL] = max(state[State.FAILS_UNTIL], until)
            case FaultKind.ENCODER_JUMP:
                state[State.OFFSET] += fault.value
            case FaultKind.LOST_ENABLE:
                state[State.DISABLED_UNTIL] = max(state[State.DISABLED_UNTIL], until)
            case FaultKind.LOST_COMMUNICATION:
                state[State.SILENT_UNTIL] = max(state[State.SILENT_UNTIL], until)
            case FaultKind.BLOCKED:
                state[State.BLOCKED_UNTIL] = max(state[State.BLOCKED_UNTIL], until)


def _set_switch(store: Store, column: int, switch: ReferenceSwitch | None) -> None:
    """Show the reference switch as it is before the first tick."""
    if switch is not None:
        d = switch.side * (float(store.table[Q.ACTUAL_P, column]) - switch.position)
        store.table[Q.HOME_INPUT, column] = is_on(d, switch.width)
        store.table[Q.HOME_LATCH, column] = switch.position

"""`Bench`: one ideal axis after the contract of the trace, without any part of the product but the trace itself."""

import copy
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from motionlayer.event import Event, Kind, Level
from motionlayer.record import Plan, Trace, TraceWriter

from .planner import Floats, Limits, to_position, to_stop, to_velocity

SIGNALS = (
    "set_position",
    "set_velocity",
    "set_acceleration",
    "set_jerk",
    "actual_position",
    "lag",
    "max_velocity",
    "max_acceleration",
    "max_deceleration",
    "max_jerk",
    "software_limit_min",
    "software_limit_max",
    "state",
    "override",
    "enable",
    "ready",
)
DISABLED, STANDSTILL, ERRORSTOP, STOPPING, HOMING, DISCRETE, CONTINUOUS = 1, 2, 3, 4, 5, 6, 7
SEARCH = 50.0
"""Velocity of the search of a homing, u/s."""

DEFAULT = Limits(1000.0, 10_000.0, 12_000.0, 200_000.0)


@dataclass
class Bench:
    """One axis; every method that commands acts in the present tick, `run` lets time pass."""

    name: str = "X"
    unit: str = "mm"
    maxima: Limits = DEFAULT
    start: float = 0.0
    soft: tuple[float | None, float | None] = (None, None)
    dt_ns: int = 1_000_000
    first_command: int = 1
    plans: list[Plan] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    rows: list[list[float]] = field(default_factory=list)
    state: int = DISABLED
    override: float = 1.0
    asked: bool = False
    ready: bool = False
    tick: int = 0
    open: int = 0

    def __post_init__(self) -> None:
        self.limits, self.dt, self.number = self.maxima, self.dt_ns / 1e9, self.first_command - 1
        self.now, self.before = (self.start, 0.0, 0.0), 0.0
        self._plan("set", self.start, np.array([[0.0, self.start, 0.0, 0.0, 0.0]]), tick=0)

    def _plan(self, kind: Any, target: float, pieces: Floats, tick: int | None = None) -> None:
        tick = self.tick if tick is None else tick
        self._tell(kind, target)
        limits = self.maxima if kind == "set" else self.limits
        self.plans = [plan for plan in self.plans if plan.tick < tick or (plan.kind == "set" != kind)]
        self.plans.append(
            Plan(
                self.name,
                tick,
                0.0,
                self.open,
                kind,
                target,
                limits.velocity,
                limits.acceleration,
                limits.deceleration,
                limits.jerk,
                pieces,
            )
        )

    def _tell(self, kind: Any, target: float) -> None:
        """Let the message of the command tell of its plan, if it has not told anything yet."""
        if not self.open or self.events[-1].kind != Kind.ACCEPTED or self.events[-1].text:
            return
        on = f"move_continuous_relative(distance=0.0, end_velocity={abs(target)})"
        calls = {"position": f"move_absolute(position={target})", "velocity": on, "stop": "stop()"}
        self.events[-1] = self.events[-1]._replace(text=self._call(calls.get(kind, "home()")))

    def event(self, kind: Kind, text: str = "") -> None:
        self.events.append(Event(self.tick, Level.INFO, kind, self.name, text, 0, self.open))

    def accept(self, text: str = "", **dynamics: float) -> None:
        """Accept a command; its text is the call, with the dynamics given and those that are not the maxima."""
        if self.open:
            self.event(Kind.ABORTED)
        self.number += 1
        self.open = self.number
        self.event(Kind.ACCEPTED, self._call(text, **dynamics) if text else "")

    def _call(self, text: str, **dynamics: float) -> str:
        unusual = {name: value for name, value in asdict(self.limits).items() if value != getattr(self.maxima, name)}
        name, _, arguments = text.partition("(")
        given = [f"{one}={value}" for one, value in (unusual | dynamics).items()]
        return f"{name}({', '.join([*filter(None, [arguments[:-1]]), *given])})"

    def limit(self, **limits: float) -> None:
        """Change limits from the next command on."""
        self.limits = replace(self.limits, **limits)

    def finish(self) -> None:
        if self.open:
            self.event(Kind.DONE)
        self.open = 0

    def enable(self) -> None:
        self.accept("enable()")
        self.asked = True
        self.run(1)
        self.state, self.ready = STANDSTILL, True
        self.run(1)

    def move(self, target: float) -> None:
        self.accept(f"move_absolute(position={target})")
        self.state = DISCRETE
        self._plan("position", target, to_position(self.now, target, self.limits))

    def move_velocity(self, target: float) -> None:
        way = "NEGATIVE" if target < 0.0 else "POSITIVE"
        self.accept(f"move_velocity(direction={way})", velocity=abs(target))
        self.state, usual = CONTINUOUS, self.limits
        self.limit(velocity=abs(target))
        self._plan("velocity", target, to_velocity(self.now, target, usual))
        self.limits = usual

    def stop(self, state: int = STOPPING) -> None:
        usual, before = self.limits, self.plans[-1]
        if self.now[1:] != (0.0, 0.0):  # no weaker than what it brakes
            deceleration, jerk = max(usual.deceleration, before.deceleration), max(usual.jerk, before.jerk)
            self.limit(deceleration=deceleration, jerk=jerk)
        self.accept("stop()" if state == STOPPING else "halt()")
        self.state = state
        self._plan("stop", math.nan, to_stop(self.now, self.limits))
        self.limits = usual

    def fault(self) -> None:
        self.events.append(Event(self.tick, Level.ERROR, Kind.MESSAGE, self.name, "", 0x4550, 0))
        if self.open:
            self.event(Kind.ERROR)
        self.open, self.state, self.limits = 0, ERRORSTOP, self.maxima
        self._plan("stop", math.nan, to_stop(self.now, self.limits))

    def home(self, position: float) -> None:
        self.accept(f"home(position={position})")
        self.state = HOMING
        self._plan("set", position, np.array([[0.0, position, 0.0, 0.0, 0.0]]))
        self.now = (position, 0.0, 0.0)

    def run(self, ticks: int | None = None) -> None:
        """Go on for some ticks, or until the axis has come to its target or velocity."""
        end = math.inf if ticks is None else self.tick + ticks
        while self.tick < end and (ticks is not None or (self.open and not self.in_velocity)):
            self._step()

    @property
    def in_velocity(self) -> bool:
        plan = self.plans[-1]
        return plan.kind == "velocity" and (self.tick - plan.tick) * self.dt > plan.pieces[-1, 0]

    def _step(self) -> None:
        plan = self.plans[-1]
        p, v, a = self.now
        low, high = self.soft
        limits = (plan.velocity, plan.acceleration, plan.deceleration, plan.jerk)
        soft = (-math.inf if low is None else low, math.inf if high is None else high)
        jerk = (a - self.before) / self.dt
        power = (float(self.asked), float(self.ready))
        self.rows.append([p, v, a, jerk, p, 0.0, *limits, *soft, float(self.state), self.override, *power])
        self.before = a
        time = (self.tick + 1 - plan.tick) * self.dt
        k = int(np.searchsorted(plan.pieces[:, 0], time, side="right")) - 1
        t, p, v, a, j = plan.pieces[k].tolist()
        s = time - t
        self.now = (
            p + s * (v + s * (0.5 * a + s * (j / 6.0))),
            v + s * (a + s * (0.5 * j)),
            a + s * j,
        )
        over = plan.command in {0, self.open} and k == len(plan.pieces) - 1 and plan.kind != "velocity"
        if over and self.state != DISABLED:
            self.finish()
            if self.state in {DISCRETE, STOPPING, HOMING}:
                self.state = STANDSTILL
        self.tick += 1

    def trace(self, **resolution: float) -> Trace:
        return join([self], resolution)

    def description(self) -> dict[str, Any]:
        return {
            "unit": self.unit,
            "max_velocity": self.maxima.velocity,
            "max_acceleration": self.maxima.acceleration,
            "max_deceleration": self.maxima.deceleration,
            "max_jerk": self.maxima.jerk,
            **asdict(self.maxima),
            "software_limit_min": self.soft[0],
            "software_limit_max": self.soft[1],
            "drive": {"kind": "ideal"},
            "home": {"mode": "switch", "direction": "positive", "velocity": SEARCH},
        }


def join(benches: Sequence[Bench], resolution: dict[str, float] | None = None, *, whole: bool = True) -> Trace:
    """Make one trace of axes that ran equally long."""
    resolution = resolution or {}
    signals = [
        {"name": f"{bench.name}.{signal}", "unit": "", "resolution": resolution.get(signal, 0.0)}
        for bench in benches
        for signal in SIGNALS
    ]
    machine = {"axis": {bench.name: bench.description() for bench in benches}}
    writer = TraceWriter(None, {"base_cycle_ns": benches[0].dt_ns, "machine": machine, "signals": signals})
    for plan in (plan for bench in benches for plan in bench.plans):
        writer.plan(plan)
    for event in sorted((event for bench in benches for event in bench.events), key=lambda e: e.tick):
        writer.event(event)
    writer.rows(0, np.concatenate([np.array(bench.rows) for bench in benches], axis=1))
    if whole:
        writer.close(len(benches[0].rows), "")
    return Trace.from_chunks(writer.chunks)


def changed(trace: Trace, **attributes: Any) -> Trace:
    """Return the trace with other plans, events, header or signals."""
    other = copy.copy(trace)
    other.__dict__.update(attributes)
    return other

"""One axis of a trace: its samples, its plans, its limits, and how a finding about it is made."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from motionlayer.verify._curves import Curves, Flags, Floats, Integers, Point
from motionlayer.verify._report import Finding
from motionlayer.verify._wellformed import malformed

if TYPE_CHECKING:
    from motionlayer.record import Trace

SET_SIGNALS: Final = ("set_position", "set_velocity", "set_acceleration")
LIMITS: Final = ("max_velocity", "max_acceleration", "max_deceleration", "max_jerk")
OTHER_SIGNALS: Final = (
    "set_jerk",
    "actual_position",
    "lag",
    *LIMITS,
    "software_limit_min",
    "software_limit_max",
    "state",
    "override",
    "enable",
    "ready",
)
ORDER: Final = ("", "/s", "/s²", "/s³")
"""What follows the unit of the axis in the unit of position, velocity, acceleration, jerk."""

WRITTEN: Final = "write_parameter("
"""How the message begins that an axis has taken a parameter."""

MOST_FINDINGS: Final = 10
"""Findings per rule and axis; one mistake in a planner would else bury all the rest."""


@dataclass(frozen=True)
class Axis:
    """One axis of a trace that is complete enough to be judged.

    Attributes:
        name: as in the machine description.
        machine: its section of the machine description.
        dt: base cycle in s.
        ticks: of the rows, without gaps.
        signals: the recorded ones, names without the axis.
        resolution: of the recorded signals, 0 = lossless.
        curves: its plans.
        written: ticks in which a parameter of it was written.
    """

    name: str
    machine: Mapping[str, Any]
    dt: float
    ticks: Integers
    signals: Mapping[str, Floats]
    resolution: Mapping[str, float]
    curves: Curves
    written: Integers

    @classmethod
    def of(cls, trace: "Trace", name: str) -> "Axis":
        """Take an axis out of a trace; ValueError if its plans cannot be evaluated."""
        plans = [plan for plan in trace.plans if plan.axis == name]
        if not plans or any(malformed(plan) for plan in plans):
            raise ValueError(f"{name}: the plans are missing or malformed, see the report of verify")
        own = {s.name.rpartition(".")[2]: s for s in trace.signals if s.name.rpartition(".")[0] == name}
        dt = float(trace.base_cycle)
        written = [event.tick for event in trace.events if event.source == name and event.text.startswith(WRITTEN)]
        return cls(
            name=name,
            machine=trace.header["machine"]["axis"][name],
            dt=dt,
            ticks=np.asarray(trace.ticks, np.int64),
            signals={key: trace[signal.name] for key, signal in own.items()},
            resolution={key: float(signal.resolution) for key, signal in own.items()},
            curves=Curves(plans, dt),
            written=np.array(written, np.int64),
        )

    @cached_property
    def serving(self) -> Integers:
        """Plan that the set values of each row belong to."""
        return self.curves.serving(self.ticks)

    @cached_property
    def in_force(self) -> Integers:
        """Plan whose limits are in force from each row on."""
        return self.curves.in_force(self.ticks)

    @cached_property
    def reference(self) -> Point:
        """What the plans say for each row."""
        return self.curves.at(self.serving, self.curves.time(self.serving, self.ticks))

    @cached_property
    def reference_before(self) -> Point:
        """What the plans say one tick before each row."""
        plan = np.maximum(self.curves.serving(self.ticks - 1), 0)
        return self.curves.at(plan, self.curves.time(plan, self.ticks - 1))

    @cached_property
    def recorded(self) -> Flags:
        """Plans that were taken over in a tick that has a row, and not before the first or after the last one."""
        return np.asarray((self.curves.tick >= self.ticks[0]) & (self.curves.tick <= self.ticks[-1]))

    @cached_property
    def row_taken(self) -> Integers:
        """Row in which each plan was taken over; of one that is not `recorded`, the nearest."""
        return np.asarray(np.clip(self.curves.tick - self.ticks[0], 0, len(self.ticks) - 1), np.int64)

    @cached_property
    def redefined(self) -> Flags:
        """Rows at which the coordinate was redefined: the first ones of `set` plans."""
        first = self.curves.tick[self.serving] == self.ticks
        return np.asarray(first & self.curves.redefines[self.serving])

    def maximum(self, of: str) -> float:
        """Return the machine's maximum of `velocity`, `acceleration`, `deceleration` or `jerk`."""
        return float(self.machine[f"max_{of}"])

    def limit(self, signal: str) -> Floats:
        """Return what the plans say for a limit signal (`max_velocity`, …), row by row."""
        of_plans: Floats = getattr(self.curves, signal.removeprefix("max_"))
        return of_plans[self.in_force]

    def machine_limit(self, side: str) -> float:
        """Return the software limit `min` or `max` of the machine; infinite where there is none."""
        limit = self.machine.get(f"software_limit_{side}")
        return (-math.inf if side == "min" else math.inf) if limit is None else float(limit)

    def software_limit(self, side: str) -> Floats:
        """Return the software limit `min` or `max` of each row: the machine's, or a narrower one written since."""
        machine = np.full(len(self.ticks), self.machine_limit(side))
        if not len(self.written) or f"software_limit_{side}" not in self.signals:
            return machine
        recorded = self.signals[f"software_limit_{side}"]
        return np.asarray(np.maximum(recorded, machine) if side == "min" else np.minimum(recorded, machine))

    def unit(self, order: int) -> str:
        """Return the unit of the `order`-th derivative of the position."""
        return f"{self.machine.get('unit', 'u')}{ORDER[order]}"

    def finding(
        self,
        rule: str,
        tick: int,
        message: str,
        *,
        value: float = math.nan,
        limit: float = math.nan,
        unit: str = "",
    ) -> Finding:
        """Make a finding about this axis."""
        return Finding(self.name, int(tick), int(tick) * self.dt, rule, message, float(value), float(limit), unit)

    def findings(
        self,
        rule: str,
        bad: Flags,
        ticks: Integers,
        message: str,
        *,
        value: Floats,
        limit: Floats,
        order: int | None = None,
    ) -> list[Finding]:
        """Make a finding of the first of each run of entries that are `bad`, `MOST_FINDINGS` at most."""
        if not bad.any():
            return []
        starts = np.flatnonzero(bad & ~np.concatenate([[False], bad[:-1]]))
        unit = "" if order is None else self.unit(order)
        some = [
            self.finding(rule, ticks[i], message, value=value[i], limit=limit[i], unit=unit)
            for i in starts[:MOST_FINDINGS]
        ]
        if len(starts) > MOST_FINDINGS:
            rest = f"and {len(starts) - MOST_FINDINGS} times more"
            some.append(self.finding(rule, int(ticks[starts[MOST_FINDINGS]]), rest))
        return some

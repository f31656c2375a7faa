"""Draw servo.svg, blending.svg and homing.svg in docs/images/, from runs.

`--check` writes nothing and fails if a picture is not what its run shows.
"""

import sys
from collections.abc import Callable
from itertools import pairwise
from typing import Any, Final

from _generated import ROOT, current
from _timing import Band, Curve, Lane, diagram

from motionlayer import Machine, Simulation
from motionlayer.nc import Axis, AxisCommand, BufferMode

CYCLE: Final = 0.001
"""Base cycle of all runs, s."""

DYNAMICS: Final[dict[str, Any]] = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 100_000.0}

SERVO: Final[dict[str, Any]] = {
    "kind": "servo",
    "position_gain": 50.0,
    "velocity_feed_forward": 0.5,
    "time_constant": 0.002,
    "dead_time": 0.002,
}

HOME: Final[dict[str, Any]] = {"switch": -5.0, "position": 0.0, "velocity": 60.0, "sync_velocity": 20.0}

PHASES: Final = {0: "", 2: "search", 3: "cam", 4: "leave", 5: "latch", 6: "brake"}
"""Names of `HomingState`."""


def ready(axes: dict[str, dict[str, Any]]) -> Simulation:
    """Return a run whose axes are in StandStill."""
    described = {name: DYNAMICS | axis for name, axis in axes.items()}
    run = Simulation(Machine.from_dict({"format": 1, "name": "picture", "axis": described}), trace=None)
    for axis in run.axes.values():
        axis.enable()
    run.step(2)
    return run


class Seen(dict[str, list[float]]):
    """What was looked at in every cycle, by name."""

    def look(self, **values: float) -> None:
        """Note what there is in this cycle."""
        for name, value in values.items():
            self.setdefault(name, []).append(value)

    def rate(self, name: str) -> list[float]:
        """Return how fast something changes, per s."""
        values = self[name]
        return [0.0, *((after - before) / CYCLE for before, after in pairwise(values))]


def servo() -> str:
    """Draw the same move, with up to 5000 mm/s², of a drive with enough torque and of one without."""
    weak = SERVO | {"max_acceleration": 3600.0}
    run, seen = ready({"X": {"drive": SERVO}, "Y": {"drive": weak}}), Seen()
    for axis in run.axes.values():
        axis.move_absolute(150.0)
    for _ in range(700):
        for name, axis in run.axes.items():
            seen.look(**{f"{name} set": axis.set_velocity, f"{name} p": axis.actual_position, f"{name} lag": axis.lag})
        run.step()
    curves = []
    for name, torque in (("X", "enough torque"), ("Y", "3600 mm/s²")):
        curves += [
            Curve(f"{torque}: set", seen[f"{name} set"], "actual, mm/s", seen.rate(f"{name} p")),
            Curve("lag, mm", seen[f"{name} lag"]),
        ]
    return diagram("A servo follows a move, and one whose torque is too weak for it", [], curves, CYCLE * 1e3)


MOVES: Final = ((60.0, 400.0), (120.0, 150.0), (180.0, 300.0))
"""Target in mm and velocity in mm/s of moves one behind the other."""


class Chain:
    """The moves of one axis in one mode; one runs and one waits."""

    def __init__(self, axis: Axis, mode: BufferMode) -> None:
        self._axis = axis
        self._mode = mode
        self._given = [self._move(*one) for one in MOVES[:2]]

    def _move(self, position: float, velocity: float) -> AxisCommand:
        return self._axis.move_absolute(position, velocity=velocity, buffer_mode=self._mode)

    def running(self) -> str:
        """Return which move runs, "" for none; the next one is given as soon as there is room for it."""
        if len(self._given) < len(MOVES) and self._given[-1].active:
            self._given.append(self._move(*MOVES[len(self._given)]))
        names = (name for name, one in zip(("first", "second", "third"), self._given, strict=False) if one.active)
        return next(names, "")


def blending() -> str:
    """Draw the velocities of three moves, one behind the other, in every mode."""
    modes = [mode for mode in BufferMode if mode is not BufferMode.ABORTING]
    run, seen = ready({mode.name: {} for mode in modes}), Seen()
    chains = [Chain(run.axes[mode.name], mode) for mode in modes]
    running: list[list[str]] = [[] for _ in modes]
    while any(axis.command is not None for axis in run.axes.values()):
        run.step()
        seen.look(**{name: axis.set_velocity for name, axis in run.axes.items()})
        for values, chain in zip(running, chains, strict=True):
            values.append(chain.running())
    names = [mode.name.removeprefix("BLENDING_") for mode in modes]
    title = "moves to 60, 120, 180 mm with 400, 150, 300 mm/s"
    bands = [Band(title, name, "out", values) for name, values in zip(names, running, strict=True)]
    curves = [Curve(f"{name}, mm/s", seen[mode.name]) for name, mode in zip(names, modes, strict=True)]
    return diagram("Three moves one behind the other, in every mode", bands, curves, CYCLE * 1e3)


def homing() -> str:
    """Draw the ways of three modes to the reference, in the position of the drive."""
    homes = {
        "switch": HOME | {"mode": "switch"},
        "cam": HOME | {"mode": "cam"},
        "index": HOME | {"mode": "index", "pulse": 1.0, "pulse_period": 10.0},
    }
    run, seen = ready({name: {"home": home, "start_position": 12.0} for name, home in homes.items()}), Seen()
    places = {name: Place(axis) for name, axis in run.axes.items()}
    for axis in run.axes.values():
        axis.home()
    while not all(axis.homed for axis in run.axes.values()):
        run.step()
        for name, place in places.items():
            phase = int(run.axis_refs[name].NcToPlc.HomingState)
            seen.look(**{f"{name} p": place(), f"{name} phase": float(phase)})
    lanes: list[Lane | Band] = []
    curves = []
    for name in homes:
        on = [p <= HOME["switch"] for p in seen[f"{name} p"]]
        phases = [PHASES[int(phase)] for phase in seen[f"{name} phase"]]
        lanes += [Band(f'mode = "{name}"', "phase", "out", phases), Lane(f'mode = "{name}"', "switch", "in", on)]
        curves.append(Curve(f"{name}: drive, mm", seen[f"{name} p"]))
    return diagram("Homing to a switch, off a cam and on to a zero pulse", lanes, curves, CYCLE * 1e3)


class Place:
    """Where the drive of an axis stands, whatever coordinate homing gives that place, u."""

    def __init__(self, axis: Axis) -> None:
        self._axis = axis
        self._shift = 0.0
        self._before = axis.set_position

    def __call__(self) -> float:
        """Return it; called in every cycle."""
        here = self._axis.set_position
        if self._axis.homed and not self._shift:
            self._shift = self._before - here
        self._before = here
        return here + self._shift


PICTURES: Final[dict[str, Callable[[], str]]] = {"servo.svg": servo, "blending.svg": blending, "homing.svg": homing}


def pages() -> dict[str, str]:
    """Return the pictures by their names below docs/images/."""
    return {name: draw() for name, draw in PICTURES.items()}


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/motion_pictures.py", ROOT / "docs" / "images", pages()))

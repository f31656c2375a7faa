"""Loading the kernels before the first tick of a real-time run.

A kernel is compiled, or loaded from its cache, when it is first called: some ten milliseconds in the middle of a tick.
So a real-time run is preceded by a simulation of the same axes, without programs, in which one axis of each kind is
given every kind of command.
"""

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Final

from motionlayer.machine._machine import Machine
from motionlayer.machine._simulation import Simulation
from motionlayer.nc import Axis, BufferMode, Direction

_TICKS: Final = 20
"""Ticks after each command: the drive becomes ready, a motion gets under way."""


def rehearse(machine: Machine) -> None:
    """Give every kind of command once, in a simulation of its own."""
    plain = {"axis", "base_cycle_ns", "format", "group", "name"}
    whole = machine.description
    fields = {name: getattr(whole, name) for name in plain}
    with Simulation(Machine(type(whole)(**fields), machine.folder), programs=(), log=False, ads=False) as run:
        kinds = {(entry.drive.kind, entry.home.mode): run.axes[name] for name, entry in whole.axis.items()}
        for axis in kinds.values():
            for command in _commands(axis):
                command()
                run.step(_TICKS)


def _commands(axis: Axis) -> Iterator[Callable[[], object]]:
    """Yield the commands, each of which finds the axis as the one before has left it."""
    velocity = axis.config.default.velocity
    yield axis.enable
    yield lambda: axis.move_relative(_way(axis))
    yield lambda: axis.set_override(0.5)
    yield lambda: axis.move_velocity(velocity / 2)
    yield lambda: axis.set_override(1.0)
    yield lambda: axis.passes(axis.set_position + math.copysign(velocity * 0.001, axis.set_velocity))
    yield lambda: axis.move_continuous_relative(_way(axis), velocity / 4)
    yield lambda: axis.move_relative(_way(axis))
    yield lambda: axis.move_relative(_way(axis), buffer_mode=BufferMode.BLENDING_LOW)
    yield lambda: axis.move_absolute(axis.set_position)
    yield lambda: axis.jog(Direction.POSITIVE)
    yield lambda: axis.define_position(0.0, relative=True)
    yield axis.halt
    yield axis.home
    yield axis.halt
    for method in axis.config.home.latches:
        yield partial(axis.home, method=method)
        yield axis.stop
    yield lambda: axis.define_position(axis.set_position, clear_lag=True)
    yield axis.stop
    yield lambda: axis.move_velocity(velocity)
    yield axis.emergency_stop
    yield axis.disable
    yield axis.reset


def _way(axis: Axis) -> float:
    """Return a short way that leads away from the nearer software limit."""
    config = axis.config
    short = config.default.velocity * 0.01
    return short if axis.set_position - config.limit_min < config.limit_max - axis.set_position else -short

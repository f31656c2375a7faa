"""The rule over where a homing finds the reference.

The drive has a coordinate of its own, which no command redefines. The reference lies in it at an edge of the switch or
at a zero pulse of the machine description, or where the axis was in a tick: there a program told the signal of a
cam. So what the homing leaves behind must fit: the place in the new coordinate that was asked for is one of these.

An ideal drive alone is judged, in a trace from the beginning: there the actual position tells how far the coordinate of
the axis and that of the drive are apart.
"""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._asked import Lives, served
from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Floats
from motionlayer.verify._lives import Life
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import request
from motionlayer.verify._tolerance import EPS, Slack

SEARCHES: Final = ("switch", "cam", "index")
"""Modes that look for an edge of the switch or a zero pulse."""


def homing_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over the reference of a homing that moves the axis."""
    drive, home = axis.machine.get("drive", {}), axis.machine.get("home")
    known = drive.get("kind") == "ideal" and not len(axis.written) and axis.ticks[0] == 0
    if home is None or not known or any(name not in axis.signals for name in ("actual_position", "ready")):
        return []
    done = [life for life in served(axis, lives).values() if life.kind == Kind.DONE and _searched(life, home)]
    shift = _shift(axis) if done else np.zeros(0)
    others = frozenset(one.accepted for one in lives.values() if one.source == axis.name and _redefines(one))
    return [found for life in done for found in _reference(axis, life, home, shift, others)]


def _redefines(life: Life) -> bool:
    """Tell whether a command gives a place another position at once."""
    return life.kind != Kind.REFUSED and request(life.text).name == "define_position"


def _searched(life: Life, home: Mapping[str, Any]) -> bool:
    """Tell whether a command is a homing that looked for the reference."""
    asked = request(life.text)
    mode = asked.values.get("method", home["mode"]).lower()
    return asked.name == "home" and math.isfinite(asked.number("position")) and mode in SEARCHES


def _shift(axis: Axis) -> Floats:
    """Return how far the coordinate of the axis is from that of its drive in each row, u."""
    actual, curves, n = axis.signals["actual_position"], axis.curves, axis.ticks
    old = np.maximum(axis.serving - 1, 0)
    follows = np.concatenate([[False], axis.signals["ready"][:-1] == 1.0])
    expected = np.where(follows, curves.at(old, curves.time(old, n)).p, np.concatenate([actual[:1], actual[:-1]]))
    return np.cumsum(np.where(axis.redefined & (n > 0), actual - expected, 0.0))


def _reference(axis: Axis, life: Life, home: Mapping[str, Any], shift: Floats, others: frozenset[int]) -> list[Finding]:
    """The reference is one of the places where the drive can have told it.

    A trace keeps one redefinition of a tick. Where a command in `others` made another one, that of the homing is gone.
    """
    curves = axis.curves
    own = np.flatnonzero((curves.kind == "set") & (curves.tick >= life.ended) & (curves.tick <= life.ended + 1))
    if not len(own) or int(curves.tick[own[0]]) > axis.ticks[-1]:
        return []
    plan, tick, reference = int(own[0]), int(curves.tick[own[0]]), request(life.text).number("position")
    if tick in others:
        return []
    place = reference - shift[tick]
    drive = axis.signals["actual_position"] - shift
    redefining = np.flatnonzero(curves.redefines[: plan + 1])
    wide = float(np.abs(axis.signals["actual_position"]).max() + np.abs(shift).max() + abs(reference))
    allowed = 64.0 * EPS * wide + float(Slack.of(curves).p[np.maximum(redefining - 1, 0)].sum())
    near = _nearest(place, home, drive[life.accepted : life.ended + 1])
    if abs(near - place) <= allowed:
        return []
    text = f"command {life.number} has found its reference where there is none, {life.text}"
    limit = near + shift[tick]
    return [axis.finding("homing", tick, text, value=reference, limit=limit, unit=axis.unit(0))]


def _nearest(place: float, home: Mapping[str, Any], been: Floats) -> float:
    """Return the nearest place, in the coordinate of the drive, where a reference can be."""
    places = been.tolist()
    for name in ("switch", "latch"):
        edge, width = home.get(name), home.get(f"{name}_width") or 0.0
        places += [] if edge is None else [edge - width, edge, edge + width]
    period, first = home.get("pulse_period"), home.get("pulse", 0.0)
    if period is not None:
        places.append(first + math.floor((place - first) / period + 0.5) * period)
    return float(min(places, key=lambda one: abs(one - place)))

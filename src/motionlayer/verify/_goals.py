"""Where a positioning was to lead, worked out from what it asked for and from what was before it.

A relative move counts from the set position at which it begins, an additive one from the last commanded target, and a
coordinate that is shifted in motion takes all of them with it. What cannot be told apart within one tick is allowed
either way.
"""

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Floats
from motionlayer.verify._lives import Life
from motionlayer.verify._requests import BRAKES, Request, request
from motionlayer.verify._tolerance import TOLERANCES, Slack

FULL_TURN: Final = {"period": 360.0, "tolerance": 0.0}
"""The modulo view of an axis whose description has none."""


class Goal(NamedTuple):
    """A position that a motion leads to.

    Attributes:
        place: u, in the coordinate before the plan `since`.
        since: first plan whose shift of the coordinate it takes part in.
        exact: whether it was told as a number, and not worked out from a curve.
    """

    place: float
    since: int
    exact: bool


class Goals:
    """The goals of the commands of an axis.

    Args:
        axis: whose plans can be evaluated.
        lives: of all commands.
    """

    def __init__(self, axis: Axis, lives: Mapping[int, Life]) -> None:
        self._axis, self._lives = axis, lives
        self._slack = Slack.of(axis.curves).p
        self._own = [one for one in lives.values() if one.source == axis.name and one.kind != Kind.REFUSED]
        self._known: dict[int, tuple[Goal, ...] | None] = {}

    @cached_property
    def _shift(self) -> Floats:
        """How far the coordinate has been shifted in motion, by each plan and all before it, u; one 0 in front."""
        curves, plan = self._axis.curves, np.arange(len(self._axis.curves), dtype=np.int64)
        before = np.maximum(plan - 1, 0)
        jump = curves.pieces[curves.first[:-1], 1] - curves.at(before, curves.time(before, curves.tick)).p
        return np.concatenate([[0.0], np.cumsum(np.where(curves.kind == "shift", jump, 0.0))])

    def at(self, goal: Goal, plan: int) -> tuple[float, float]:
        """Return where a goal is in the coordinate of a plan, and the tolerance of that."""
        way = float(self._shift[plan + 1] - self._shift[min(goal.since, plan + 1)])
        place = goal.place + way
        blur = 2.0 * TOLERANCES["limits"].relative * abs(place)
        if goal.exact and way == 0.0:
            return place, blur
        first = min(max(goal.since - 1, 0), plan)
        return place, blur + float(self._slack[plan] + self._slack[first])

    def of(self, life: Life) -> tuple[Goal, ...] | None:
        """Return the goals that a positioning may have; None if nothing tells them."""
        if life.number not in self._known:
            self._known[life.number] = self._work_out(life, request(life.text))
        return self._known[life.number]

    def told(self, place: float, accepted: int) -> tuple[Goal, ...]:
        """Return the goals of a position that was told as a number in a tick."""
        before, after = np.searchsorted(self._axis.curves.tick, [accepted, accepted + 1]).tolist()
        shifted = (self._axis.curves.kind[before:after] == "shift").any()
        return tuple(Goal(place, since, exact=True) for since in ((before, after) if shifted else (after,)))

    def first(self, life: Life) -> int | None:
        """Return the first plan that serves a command; None without."""
        own = np.flatnonzero(self._axis.curves.command == life.number)
        own = own[self._axis.curves.kind[own] != "shift"]
        return int(own[0]) if len(own) else None

    def start(self, life: Life) -> Goal | None:
        """Return the set position at which a command began; None if it is not in the trace."""
        plan, curves = self.first(life), self._axis.curves
        if plan is not None:
            one = np.array([plan], np.int64)
            return Goal(float(curves.at(one, np.maximum(curves.offset[one], 0.0)).p[0]), plan + 1, exact=False)
        row = life.accepted - int(self._axis.ticks[0])
        if not 0 <= row < len(self._axis.ticks):
            return None
        since = int(np.searchsorted(curves.tick, life.accepted + 1))
        return Goal(float(self._axis.signals["set_position"][row]), since, exact=False)

    def _work_out(self, life: Life, asked: Request) -> tuple[Goal, ...] | None:
        if asked.name == "move_absolute":
            return self.told(asked.number("position"), life.accepted)
        start = self.start(life)
        if start is None:
            return None
        if asked.name == "move_relative":
            return (_beside(start, asked.number("distance")),)
        if asked.name == "move_additive":
            bases = self._commanded(life, start)
            return None if bases is None else tuple(_beside(base, asked.number("distance")) for base in bases)
        if asked.steps:
            return _stepped(start, asked)
        return self._oriented(life, start, asked) if asked.name == "move_modulo" else None

    def _commanded(self, life: Life, start: Goal) -> tuple[Goal, ...] | None:
        """Return the last commanded target that an additive move counts from; its own start where there is none.

        What was commanded in one tick is taken in any order, and what may have waited in vain is taken as commanded
        and as not.
        """
        ticks: dict[int, list[tuple[Life | None, bool]]] = {}
        for tick, one, sure in (*self._moved(life), *self._replaced(life)):
            ticks.setdefault(tick, []).append((one, sure))
        found: list[Goal] = []
        for tick in sorted(ticks, reverse=True):
            for one, _ in ticks[tick]:
                goals = (start,) if one is None else self.of(one)
                if goals is None:
                    return None
                found += goals
            if tick < life.accepted and any(sure for _, sure in ticks[tick]):
                return tuple(found)
        return (*found, start)

    def _moved(self, life: Life) -> Iterator[tuple[int, Life | None, bool]]:
        """Yield when plans before a command have changed what was commanded last, and to which command; None: to none.

        A halt does not, nor does a written parameter.
        """
        curves, written = self._axis.curves, set(self._axis.written.tolist())
        for plan in np.flatnonzero(curves.tick + curves.inside <= life.accepted).tolist():
            tick, one = int(curves.tick[plan]), self._lives.get(int(curves.command[plan]))
            if curves.kind[plan] == "set" and tick not in written:
                yield tick, None, True
            if curves.redefines[plan] or one is None or one.number >= life.number:
                continue
            asked = request(one.text)
            if asked.name not in BRAKES:
                yield tick, one if asked.to_position else None, True

    def _replaced(self, life: Life) -> Iterator[tuple[int, Life | None, bool]]:
        """Yield the same for commands before it that no plan serves: they were replaced in their own tick."""
        for one in self._own:
            asked = request(one.text)
            if one.number < life.number and self.first(one) is None and (asked.to_position or asked.endless):
                yield one.accepted, one if asked.to_position else None, asked.mode == "ABORTING"

    def _oriented(self, life: Life, start: Goal, asked: Request) -> tuple[Goal, ...] | None:
        """Return the orientations that a modulo move from rest or behind another one may lead to.

        They are those of the coordinate in which it was accepted. In motion it depends on the dynamics of the motion
        before it, and is not judged.
        """
        plan, curves = self.first(life), self._axis.curves
        modulo = self._axis.machine.get("modulo") or FULL_TURN
        if plan is None or (self._axis.written <= life.accepted).any():
            return None
        if curves.pieces[curves.first[plan], 2:4].any() and not curves.inside[plan]:
            return None
        found: list[Goal] = []
        for _, since, _ in self.told(0.0, life.accepted):
            here = start.place - float(self._shift[plan + 1] - self._shift[min(since, plan + 1)])
            found += [Goal(place, since, exact=False) for place in _orientations(here, asked, modulo)]
        return tuple(found)


def _orientations(here: float, asked: Request, modulo: Mapping[str, float]) -> list[float]:
    """Return the places near `here` with the orientation asked for that its direction allows to go to."""
    period, position, direction = modulo["period"], asked.number("position"), asked.values.get("direction", "")
    turns = math.floor(position / period)
    rest = position - turns * period
    nearest = math.floor((here - rest) / period + 0.5)
    signs = {"POSITIVE": (1,), "NEGATIVE": (-1,), "SHORTEST_WAY": (0,)}.get(direction, (1, -1))
    counts = (nearest + sign * turns + one for sign in signs for one in (-1, 0, 1))
    places = [count * period + rest for count in counts]
    return [place for place in places if _in_reach(place - here, direction, turns * period, modulo)]


def _in_reach(way: float, direction: str, turns: float, modulo: Mapping[str, float]) -> bool:
    """Tell whether the way of a modulo move from rest is one that its direction allows."""
    period, window = modulo["period"], modulo["tolerance"]
    blur = 1e-9 * (period + abs(way))
    if direction == "SHORTEST_WAY":
        return abs(way) <= 0.5 * period + blur
    forward = -window - blur <= way - turns <= period + blur
    backward = -window - blur <= -way - turns <= period + blur
    return (forward and direction != "NEGATIVE") or (backward and direction != "POSITIVE")


def _beside(goal: Goal, distance: float) -> Goal:
    return Goal(goal.place + distance, goal.since, exact=False)


def _stepped(start: Goal, asked: Request) -> tuple[Goal, ...]:
    """Return where a jog by a step leads: that far, or to a multiple of it."""
    sign = -1.0 if asked.values.get("direction") == "NEGATIVE" else 1.0
    step = asked.number("step")
    if asked.values.get("mode") == "INCHING":
        return (_beside(start, sign * step),)
    count = start.place / step
    near = {math.floor(count * (1.0 + side * 1e-12)) for side in (-1.0, 1.0)} if sign > 0.0 else set()
    near |= {math.ceil(count * (1.0 + side * 1e-12)) for side in (-1.0, 1.0)} if sign < 0.0 else set()
    return tuple(Goal((one + sign) * step, start.since, exact=False) for one in sorted(near))

"""Where a positioning was to lead, worked out from what it asked for and from what was before it.

A relative move counts from the set position at which it begins, an additive one from the last commanded target, and a
coordinate that is shifted in motion takes all of them with it. What cannot be told apart within one tick is allowed
either way.
"""

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import NamedTuple

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Floats
from motionlayer.verify._lives import Life
from motionlayer.verify._orientations import FULL_TURN, ahead, orientations
from motionlayer.verify._requests import BRAKES, MOTIONS, Request, request
from motionlayer.verify._shifts import Shifts
from motionlayer.verify._stops import stops
from motionlayer.verify._tolerance import TOLERANCES, Slack


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
        self._redefined = Shifts(axis, self._own)
        self._shift = self._redefined.ways
        self._known: dict[int, tuple[Goal, ...] | None] = {}

    @cached_property
    def _rest(self) -> Floats:
        """Where each plan could come to rest with the dynamics of the motion before it, u."""
        curves, plan = self._axis.curves, np.arange(len(self._axis.curves), dtype=np.int64)
        moving = np.maximum.accumulate(np.where(curves.kind == "shift", 0, plan))
        before = moving[np.maximum(plan - 1, 0)]
        return stops(curves, curves.deceleration[before], curves.jerk[before]).rest

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
        """Return the set position at which a command began; None if it is not in the trace.

        One without a plan was replaced in the tick in which it began.
        """
        plan, curves = self.first(life), self._axis.curves
        if plan is not None:
            one = np.array([plan], np.int64)
            return Goal(float(curves.at(one, np.maximum(curves.offset[one], 0.0)).p[0]), plan + 1, exact=False)
        row = life.ended - int(self._axis.ticks[0])
        if not 0 <= row < len(self._axis.ticks):
            return None
        since = int(np.searchsorted(curves.tick, life.ended + 1))
        return Goal(float(self._axis.signals["set_position"][row]), since, exact=False)

    def _work_out(self, life: Life, asked: Request) -> tuple[Goal, ...] | None:
        if asked.name == "move_absolute":
            return self.told(asked.number("position"), life.accepted)
        start = self.start(life)
        if start is None:
            return None
        if asked.name == "move_relative":
            return tuple(_beside(one, asked.number("distance")) for one in (start, *self._joints(life, asked)))
        if asked.name == "move_additive":
            bases = self._commanded(life, start)
            return None if bases is None else tuple(_beside(base, asked.number("distance")) for base in bases)
        if asked.steps:
            return tuple(goal for begin in self._begins(life, start) for goal in _stepped(begin, asked))
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
        earlier = (one for one in self._own if one.number < life.number)
        if any(self._redefined.at_rest(one, life.accepted) for one in earlier):
            yield life.accepted, None, True  # a shift in the same tick leaves no plan of it

    def _replaced(self, life: Life) -> Iterator[tuple[int, Life | None, bool]]:
        """Yield the same for commands before it that no plan serves: they were replaced in the tick they began in.

        One that waited began if what it waited for was done by then; it has been active, and counts.
        """
        for one in self._own:
            asked = request(one.text)
            if one.number >= life.number or self.first(one) is not None or not (asked.to_position or asked.endless):
                continue
            at_once = one.accepted == one.ended
            if at_once or self._done_before(one):
                yield one.ended, one if asked.to_position else None, at_once and asked.mode == "ABORTING"

    def _replaces_unseen(self, life: Life) -> bool:
        """Tell whether a command before it in its tick was the motion before it, and no plan shows that."""
        beside = (one for one in self._own if one.accepted == life.accepted and one.number < life.number)
        return any(request(one.text).name in MOTIONS and self.first(one) is None for one in beside)

    def _done_before(self, waiting: Life) -> bool:
        """Tell whether a command that was given before one that waited was done just before that ended."""
        done = (one for one in self._own if one.kind == Kind.DONE and one.number < waiting.number)
        return any(waiting.ended - 1 <= one.ended <= waiting.ended for one in done)

    def _joints(self, life: Life, asked: Request) -> tuple[Goal, ...]:
        """Return where a blended command was to begin; a hold may have carried the axis past that (see `Carried`)."""
        plan, place = self.first(life), asked.number("blending_position")
        if plan is None or not asked.blends:
            return ()
        if math.isfinite(place):
            return self.told(place, life.accepted)
        numbers = self._axis.curves.command[:plan]
        running = self._lives.get(int(numbers[numbers != life.number][-1])) if (numbers != life.number).any() else None
        return () if running is None else self.of(running) or ()

    def _begins(self, life: Life, start: Goal) -> Iterator[Goal]:
        """Yield where a command began in the coordinate it was accepted in: before or after the shifts of that tick."""
        for _, since, _ in self.told(0.0, life.accepted):
            way = float(self._shift[start.since] - self._shift[min(since, start.since)])
            yield Goal(start.place - way, since, exact=False)

    def _oriented(self, life: Life, start: Goal, asked: Request) -> tuple[Goal, ...] | None:
        """Return the orientations that a modulo move may lead to; None if what was before it in its tick is not known.

        They are those of the coordinate in which it was accepted. In motion it is the first one at or behind the place
        where the axis could come to rest with the dynamics of the motion before it.
        """
        plan, curves = self.first(life), self._axis.curves
        modulo = self._axis.machine.get("modulo") or FULL_TURN
        if plan is None or (self._axis.written <= life.accepted).any():
            return None
        moves = bool(curves.pieces[curves.first[plan], 2:4].any() and not curves.inside[plan])
        if moves and (int(curves.tick[plan]) != life.accepted or self._replaces_unseen(life)):
            return None
        found: list[Goal] = []
        joints = () if moves else self._joints(life, asked)
        for here, since, _ in (*self._begins(life, start), *joints):
            rest = float(self._rest[plan]) + here - start.place
            places = ahead(rest, asked, modulo) if moves else orientations(here, asked, modulo)
            found += [Goal(place, since, exact=False) for place in places]
        return tuple(found)


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

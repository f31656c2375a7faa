"""The group `numerics`: what plans, overrides, drives and the life of axes hold."""

import gc
import statistics
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from motionlayer.bench import _load
from motionlayer.bench._environment import PINS, PeersMissing
from motionlayer.bench._optimum import Case, asymmetric_cases, rest_to_rest
from motionlayer.bench._row import MICRO, Effort, Failed, Figure, Goal, Peer, Row, Skipped
from motionlayer.bench._timing import median_us
from motionlayer.bench.campaign import CAMPAIGNS, Failure
from motionlayer.machine import Machine, MachineError, Simulation
from motionlayer.profile import Limits, plan_position

Floats = NDArray[np.float64]

SEED: Final = 1
STATES: Final = 150
MOVES: Final = 50
SPREADS: Final = 10
CYCLES: Final = 200
"""Per sample of the effort: a full campaign holds more than a bench has time for."""

PEER_MOVES: Final = 10_000
CASES: Final = 150
STEPS: Final = 300
"""Of the linear program."""

UNITS: Final = (1e3, 1e-3, 72.0, 25.4)
"""Lengths of a millimetre in µm, m, degrees of a spindle, and something odd."""

OPTIMUM: Final = Path(__file__).with_name("_peer_optimum.py")
AXES: Final = 64
FAR: Final = 1e7
"""mm; none of the axes comes there."""

SERVO: Final = {
    "drive": {
        "kind": "servo",
        "position_gain": 50.0,
        "velocity_feed_forward": 0.9,
        "time_constant": 0.002,
        "dead_time": 0.002,
        "max_acceleration": 3e4,
        "backlash": 0.005,
        "encoder_resolution": 0.001,
        "noise": 0.0005,
    }
}
"""A drive with everything that can be had; mm and s."""

TURNS: Final = 5


def _campaign(name: str, count: int) -> tuple[int, int, list[Failure]]:
    """Run a short form of a campaign; return how much of what it counts, how many cases, and the failures."""
    campaign = CAMPAIGNS[name]
    cases = max(1, count // campaign.size)
    failures = [
        failure
        for start in range(0, cases, campaign.batch)
        for failure in campaign.run(SEED, range(start, min(start + campaign.batch, cases)))
    ]
    return cases * campaign.size, cases, failures


def _first(name: str, failures: list[Failure]) -> str:
    return f"; the first: make campaign NAME={name} SEED={SEED} CASE={failures[0].case}" if failures else ""


def failed(effort: Effort) -> Figure:
    """Count plans of random states that are refused or wrong, per million."""
    count, _, failures = _campaign("planning", STATES * effort.samples)
    return Figure(len(failures) * 1e6 / count, f"{count} states, seed {SEED}{_first('planning', failures)}")


def unit_spread(effort: Effort) -> Figure:
    """Compare the duration of the same move in several units."""
    rng, worst = np.random.default_rng(SEED), 0.0
    count = SPREADS * effort.samples
    for distance, *limits in zip(*_moves(rng, count), strict=True):
        plain = plan_position(0.0, 0.0, 0.0, distance, Limits(*limits)).duration
        for unit in UNITS:
            scaled = Limits(*(value * unit for value in limits))
            other = plan_position(0.0, 0.0, 0.0, distance * unit, scaled).duration
            worst = max(worst, abs(other / plain - 1.0))
    return Figure(worst, f"{count} moves from rest to rest in {1 + len(UNITS)} units")


def longest(effort: Effort) -> Figure:
    """Compare durations from rest to rest with the closed form."""
    count = MOVES * effort.samples
    columns = _moves(np.random.default_rng(SEED), count)
    optimum = rest_to_rest(*(np.array(column) for column in columns))
    planned = [plan_position(0.0, 0.0, 0.0, d, Limits(*limits)).duration for d, *limits in zip(*columns, strict=True)]
    excess = np.array(planned).astype(np.longdouble) / optimum - 1
    return Figure(float(excess.max()), f"{count} moves; the shortest is {float(excess.min()):.1e} of the closed form")


def _moves(rng: np.random.Generator, count: int) -> tuple[list[float], ...]:
    """Return distances and limits from rest to rest: mm, velocities to 10 m/s, jerk to 1e9."""
    vel, acc = 10.0 ** rng.uniform(0.0, 4.0, count), 10.0 ** rng.uniform(1.0, 5.0, count)
    dec, jerk = acc * 10.0 ** rng.uniform(-1.0, 1.0, count), 10.0 ** rng.uniform(2.0, 9.0, count)
    distance = vel * vel / acc * 10.0 ** rng.uniform(-4.0, 4.0, count)
    return tuple(column.tolist() for column in (distance, vel, acc, dec, jerk))


def peer_moves(effort: Effort) -> dict[str, Any]:
    """Return the same moves in units of their limits' V and A, with their optima."""
    d, vel, acc, dec, jerk = (
        np.array(column) for column in _moves(np.random.default_rng(SEED), MOVES * effort.samples)
    )
    optimum = rest_to_rest(d, vel, acc, dec, jerk).astype(float)
    columns = d * acc / (vel * vel), dec / acc, jerk * vel / (acc * acc), optimum * acc / vel
    return {"cases": np.stack(columns, axis=1)[:PEER_MOVES].tolist()}


def asymmetric(effort: Effort) -> Figure:
    """Compare durations with those of a linear program that knows nothing of profiles."""
    cases = asymmetric_cases(min(CASES, effort.samples))
    try:
        optima = effort.peers.run(OPTIMUM, {"cases": [case._asdict() for case in cases], "steps": STEPS})
    except PeersMissing as missing:
        raise Skipped(f"no linear program: {missing}") from missing
    ratios = [case.guess / optimum for case, optimum in zip(cases, optima, strict=True)]
    coarse = max((_coarseness(case, optimum) for case, optimum in zip(cases, optima, strict=True)), default=0.0)
    return Figure(
        max(ratios),
        f"{len(cases)} cases from rest, moving and moving away; scipy {PINS['scipy']}, {STEPS} steps, whose own "
        f"optimum is up to {coarse:.1e} over the closed form",
    )


def _coarseness(case: Case, optimum: float) -> float:
    """Return what the steps cost, relative, where the closed form knows better; else 0."""
    if case.v or case.a:
        return 0.0
    one = np.ones(1)
    exact = rest_to_rest(one * case.distance, one, one, one * case.deceleration, one * case.jerk)
    return optimum / float(exact[0]) - 1.0


def override(effort: Effort) -> Figure:
    """Time a cycle in which every axis is given another override; half of them move to a position."""
    with _load.enabled(_load.machine(AXES)) as run:
        axes = list(run.axes.values())
        for number, axis in enumerate(axes):
            if number % 2:
                axis.move_velocity(_load.VELOCITY)
            else:
                axis.move_absolute(FAR)
        run.step(500)
        factors = np.random.default_rng(SEED).uniform(0.2, 1.0, 997).tolist()

        def turn() -> None:
            tick = run.tick
            for number, axis in enumerate(axes):
                axis.set_override(factors[(tick + number) % 997])
            run.step()

        figure = Figure(median_us(turn, effort.samples), "set_override() of every axis and the complete cycle")
        if any(axis.set_velocity == 0.0 for axis in axes):
            raise Failed("not all axes move")
        return figure


def drives(effort: Effort) -> Figure:
    """Compare a cycle of axes that move with servo drives and with ideal ones."""
    try:
        servo = _load.machine(1000, settings=SERVO)
    except MachineError as error:
        raise Skipped("this version has no servo drives") from error
    times: dict[bool, list[float]] = {False: [], True: []}
    samples = max(1, effort.samples // TURNS)
    with _moving(_load.machine(1000)) as ideal, _moving(servo) as lagging:
        for _ in range(TURNS):  # in turns, so that a change of the processor's clock meets both
            for lags, run in ((False, ideal), (True, lagging)):
                times[lags].append(median_us(run.step, samples))
    plain, with_lag = (statistics.median(times[lags]) for lags in (False, True))
    return Figure(with_lag - plain, f"{plain:.3g} µs with ideal drives, {with_lag:.3g} µs with servo drives")


def _moving(machine: Machine) -> Simulation:
    run = _load.moving(machine)
    gc.collect()
    return run


def life(effort: Effort) -> Figure:
    """Count cases of random axis life in which a rule is broken."""
    count, cases, failures = _campaign("life", CYCLES * effort.samples)
    note = f"{count} cycles of {cases} machines, seed {SEED}; a campaign runs 10^7"
    return Figure(len(failures), note + _first("life", failures))


ROWS: Final = (
    Row("plan.failed", "per 10^6", Goal(0), failed),
    Row("plan.unit_spread", "relative", Goal(1e-12), unit_spread),
    Row(
        "plan.rest_to_rest", "relative", Goal(1e-12), longest,
        Peer("ruckig", "calculate(), the same moves", "rest to rest", peer_moves),
    ),
    Row("plan.asymmetric", "ratio", Goal(1.01), asymmetric),
    Row("override.axes_64", MICRO, Goal(150), override),
    Row("drive.axes_1000", MICRO, Goal(30), drives),
    Row("life.violations", "cases", Goal(0), life),
)  # fmt: skip

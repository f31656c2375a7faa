"""Running a campaign to a count, with a state file that lets it be stopped and continued."""

import hashlib
import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Final, Self

import motionlayer
from motionlayer.bench.campaign._campaign import Campaign, Failure

FORMAT: Final = 1
PERIOD: Final = 2.0
"""Seconds of wall time between two savings: what an interruption loses at most, and a batch."""

SOURCES: Final = Path(motionlayer.__file__).resolve().parent


class StateError(Exception):
    """The state file cannot be read or written."""


def digest() -> str:
    """Return a hash of all sources: what was found with others does not count."""
    found = hashlib.sha256()
    for file in sorted(SOURCES.rglob("*.py")):
        found.update(file.relative_to(SOURCES).as_posix().encode() + b"\0" + file.read_bytes())
    return found.hexdigest()


@dataclass
class State:
    """How far a campaign is.

    Attributes:
        name: of the campaign.
        seed: of all cases.
        sources: hash of the sources it runs with.
        cases: that are judged; the next one has this number.
        failures: in order.
    """

    name: str
    seed: int
    sources: str
    cases: int = 0
    failures: list[Failure] = field(default_factory=list)

    @classmethod
    def load(cls, file: Path) -> Self | None:
        """Return a saved state; None without a file, or for one of another format.

        Raises:
            StateError: it cannot be read.
        """
        try:
            data = json.loads(file.read_text(encoding="utf-8"))
            if data.pop("format") != FORMAT:
                return None
            failures = [Failure(**failure) for failure in data.pop("failures")]
            return cls(**data, failures=failures)
        except FileNotFoundError:
            return None
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise StateError(f"{file}: no state of a campaign: {error}; delete it to start anew") from error

    def save(self, file: Path) -> None:
        """Write the state; a crash leaves the old one.

        Raises:
            StateError: it cannot be written.
        """
        data = {"format": FORMAT, **vars(self), "failures": [failure._asdict() for failure in self.failures]}
        fresh = file.with_suffix(".new")
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            fresh.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
            os.replace(fresh, file)  # noqa: PTH105 - over an existing file, on every system
        except OSError as error:
            raise StateError(f"{file}: cannot be written: {error.strerror}") from error


def resume(campaign: Campaign, seed: int, file: Path) -> tuple[State, str]:
    """Return where a campaign goes on, and why it starts anew where it does; "" where it goes on.

    Raises:
        StateError: the file cannot be read.
    """
    sources = digest()
    fresh = State(campaign.name, seed, sources)
    saved = State.load(file)
    if saved is None:
        return fresh, "no earlier state"
    if (saved.name, saved.seed) != (campaign.name, seed):
        return fresh, "the earlier state is of another campaign"
    return (saved, "") if saved.sources == sources else (fresh, "the sources have changed since the earlier state")


def pursue(
    campaign: Campaign,
    state: State,
    count: int,
    file: Path,
    progress: Callable[[int], None],
    clock: Callable[[], float] = monotonic,
) -> None:
    """Judge cases until `count` of what the campaign counts is reached; the state is saved on any way out.

    Args:
        campaign: what is run.
        state: where it goes on; kept up to date.
        count: in the unit of the campaign, rounded up to whole cases.
        file: of the state.
        progress: called after every batch with the cases judged.
        clock: wall time in seconds.

    Raises:
        StateError: the state cannot be written.
    """
    saved = clock()
    try:
        for cases in batches(campaign, state.cases, -(-count // campaign.size)):
            found = campaign.run(state.seed, cases)
            state.failures += found
            state.cases = cases.stop
            progress(state.cases)
            if clock() - saved >= PERIOD:
                state.save(file)
                saved = clock()
    finally:
        state.save(file)


def batches(campaign: Campaign, start: int, stop: int) -> Iterator[range]:
    """Yield numbers of cases, none across the border of a batch."""
    while start < stop:
        end = min((start // campaign.batch + 1) * campaign.batch, stop)
        yield range(start, end)
        start = end


def repeat(campaign: Campaign, seed: int, case: int) -> list[Failure]:
    """Judge one case alone."""
    return campaign.run(seed, range(case, case + 1))

"""`Ads`: the ADS server of a run, what it publishes, and what clients ask of the run as a whole."""

import time
from collections import deque
from collections.abc import Callable
from typing import Final, NamedTuple, Protocol

from motionlayer.connect.ads import (
    Bridge,
    Code,
    Contents,
    Hooks,
    Inside,
    Outcome,
    Plan,
    State,
    Status,
    Write,
    net_id,
    tree_of,
)
from motionlayer.machine._ads_axes import nc_contents
from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._outside import REFUSED
from motionlayer.runtime import Mailbox, MailboxFull

EPOCH: Final = 116_444_736_000_000_000
"""FILETIME of 1970-01-01."""

_UP: Final = frozenset({State.RUN, State.START})
_CONFIG: Final = frozenset({State.CONFIG, State.RECONFIG})


class Controlled(Protocol):
    """What a client can do to a run as a whole."""

    @property
    def machine(self) -> Machine:
        """What runs."""

    @property
    def paused(self) -> bool:
        """It is held up."""

    def pause(self) -> None:
        """Hold it up."""

    def resume(self) -> None:
        """Let it go on."""


Reply = Callable[[Outcome], None]
"""Takes what a client is answered."""


class _Answer(NamedTuple):
    reply: Reply
    code: Code


class TickTime:
    """The time of day of ticks, which only goes on.

    Args:
        cycle_ns: of the run.
        wall_clock_ns: the time of day, ns since 1970 UTC.
    """

    def __init__(self, cycle_ns: int, wall_clock_ns: Callable[[], int] = time.time_ns) -> None:
        self._cycle = cycle_ns
        self._wall_clock = wall_clock_ns
        self._epoch = wall_clock_ns()

    def filetime(self, tick: int) -> int:
        """Return the time of a tick: 100 ns since 1601, UTC."""
        return EPOCH + (self._epoch + tick * self._cycle) // 100

    def slip(self, ns: int) -> None:
        """Let the ticks from now on be later."""
        self._epoch += ns

    def align(self, tick: int) -> None:
        """Let a tick that begins now be at the time of day; never earlier than the one before it."""
        self._epoch += max(0, self._wall_clock() - (self._epoch + tick * self._cycle))


class Ads:
    """The ADS server of a run.

    Args:
        description: what the machine file says.
        run: what clients hold up and let go on.
        inside: publishes and applies.
        mailbox: of the run.
        cycle_ns: of the run.
        own_process: the server runs in a process of its own.

    Attributes:
        time: of ticks, for notifications.
        begun: clients have been let in.
        source: of the mailbox, what clients ask for.

    Raises:
        ServerFailed: it cannot begin.
    """

    def __init__(
        self,
        description: AdsDescription,
        run: Controlled,
        inside: Inside,
        mailbox: Mailbox,
        cycle_ns: int,
        *,
        own_process: bool,
    ) -> None:
        self.time = TickTime(cycle_ns)
        self._description = description
        self._run = run
        self._inside = inside
        self._mailbox = mailbox
        self._beginnings = 1
        self._asked: deque[Reply] = deque()
        self._answers: deque[_Answer] = deque()
        self._config = False
        self._cycle_ns = cycle_ns
        self.begun = False
        hooks = Hooks(self._tell, self._control)
        plan = _plan(description, run.machine.name, cycle_ns)
        self.source = Bridge(plan, mailbox, hooks, own_process=own_process)
        self._bridge: Bridge | None = self.source

    @property
    def port(self) -> int:
        """TCP port that the server listens on."""
        return self._description.port if self._bridge is None else self._bridge.port

    @property
    def host(self) -> str:
        """Address that the server listens on."""
        return self._description.host

    @property
    def net_id(self) -> str:
        """AMS NetId of the server."""
        return self._description.net_id

    @property
    def pid(self) -> int | None:
        """Number of the server's process; None where it runs in a thread, or has ended."""
        return None if self._bridge is None else self._bridge.pid

    def begin(self, tick: int) -> None:
        """Let clients in: all symbols are known, the first tick has ended."""
        self.begun = True
        if self._bridge is None:
            return
        inside, bridge = self._inside, self._bridge
        inside.begin(bridge.share(inside.size, self._cycle_ns), self._status)
        self.publish(tick)
        bridge.begin(Contents(tree_of(inside.places), inside.size, nc_contents(inside.places)))

    def publish(self, tick: int) -> None:
        """Let clients see this tick, and answer those that have changed the state which they see now."""
        if self._bridge is None:
            return
        answers = [self._answers.popleft() for _ in range(len(self._answers))]
        self._inside.publish(tick)
        for answer in answers:
            answer.reply(Outcome(answer.code))

    def restart_asked(self) -> bool:
        """Tell whether a client wants the run to begin anew."""
        return bool(self._asked)

    def restarted(self, problem: str) -> None:
        """Answer who has asked for it.

        Args:
            problem: why the run could not begin anew; "" if it has.
        """
        if not problem:
            self._beginnings += 1
        while self._asked:
            self._answers.append(_Answer(self._asked.popleft(), Code.INVALID_STATE if problem else Code.NO_ERROR))
        if problem:
            self._tell("restart", problem)

    def close(self) -> None:
        """Stop the server; the mailbox has been closed."""
        for reply in (*self._asked, *(answer.reply for answer in self._answers)):
            reply(Outcome(Code.NOT_READY))
        self._inside.end()
        if self._bridge is not None:
            self._bridge.close()
            self._bridge = None

    def _status(self, tick: int) -> Status:
        paused = self._run.paused
        plc = State.STOP if paused else State.RUN
        system = State.CONFIG if paused and self._config else State.RUN
        return Status(self.time.filetime(tick), plc, 0, system, 0, self._beginnings)

    def _control(self, write: Write, reply: Reply) -> None:
        """Do what a client asks of the whole run."""
        self._config = write.place in _CONFIG
        if write.place == State.RESET:
            self._asked.append(reply)
            self._run.resume()
            return
        if write.place in _UP:
            self._run.resume()
        else:
            self._run.pause()
        self._answers.append(_Answer(reply, Code.NO_ERROR))

    def _tell(self, who: str, why: str) -> None:
        """Let the log of the run say who was refused, in the next tick."""
        try:
            self._mailbox.post(REFUSED, f"{who}: {why}".encode())
        except MailboxFull:  # the mailbox counts it
            return


def _plan(description: AdsDescription, name: str, cycle_ns: int) -> Plan:
    return Plan(
        description.host,
        description.port,
        net_id(description.net_id),
        cycle_ns,
        description.access,
        description.limits.limits,
        description.mqtt.mqtt(name) if description.mqtt is not None else None,
    )

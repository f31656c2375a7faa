"""What a run of a machine does for ADS: it lets clients in, publishes for them, and begins anew when they ask.

A run without a server imports nothing of `connect.ads`, and starts sooner.
"""

import abc
import functools
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from motionlayer.connect import ADS
from motionlayer.machine._layering import LayeredRun
from motionlayer.machine._outside import REFUSED, Told
from motionlayer.record import TraceError
from motionlayer.runtime import NotCopyable, Snapshot, Stage, Step

if TYPE_CHECKING:
    from motionlayer.connect.ads import Inside, Tree
    from motionlayer.machine._ads import Ads
    from motionlayer.machine._ads_axes import AdsAxes
    from motionlayer.machine._ads_description import AdsDescription


class ServedRun(LayeredRun):
    """A run of a machine that ADS clients may reach."""

    _server: "Ads | None" = None

    @property
    def serves_ads(self) -> bool:
        """ADS clients can reach it; they could, once it has been closed."""
        return self._server is not None

    @property
    def ads(self) -> "Ads":
        """The ADS server.

        Raises:
            ValueError: the run has none.
        """
        if self._server is None:
            raise ValueError("this run has no ADS server: add [ads] to the machine file")
        return self._server

    @property
    def ads_tree(self) -> "Tree":
        """All symbols and types, as ADS clients see them or would; complete when the first tick has ended."""
        from motionlayer.connect.ads import tree_of  # noqa: PLC0415 - see above

        return tree_of(self._inside.places)

    @functools.cached_property
    def _inside(self) -> "Inside":
        """What clients change and see."""
        from motionlayer.connect.ads import Inside  # noqa: PLC0415 - see above

        axes = self._ads_axes()
        return Inside(lambda: axes.places, axes.acts())

    def _apply(self, payload: bytes) -> bytes:
        return self._inside.apply(payload)

    @abc.abstractmethod
    def _ads_axes(self) -> "AdsAxes":
        """Return what clients reach of the axes."""

    def _add_ads(self, choice: "AdsDescription | bool", *, own_process: bool) -> Sequence[Stage]:
        """Make the server that is asked for, and return what a tick does for it.

        Args:
            choice: the table `[ads]`; True takes that of the machine, False makes no server.
            own_process: the server runs in a process of its own.

        Raises:
            ServerFailed: it cannot begin.
        """
        # Also without a server: a replay applies what clients wrote, and tells whom the server refused.
        self.mailbox.register(REFUSED, Told(self.events, self._ledger, "ADS"))
        self.mailbox.register(ADS, self._apply)
        asked = self.machine.description.ads if choice is True else choice
        if not asked:
            return []
        from motionlayer.machine._ads import Ads  # noqa: PLC0415 - see above

        self._server = Ads(asked, self, self._inside, self.mailbox, self.base_cycle_ns, own_process=own_process)
        self._attach(self._server.source)
        return [Stage(Step.OUTPUTS, "ads", self._server.publish)]

    def restore(self, snapshot: Snapshot) -> None:
        """Go back as `ResettableRun.restore`; for clients the time of day goes on."""
        ahead = self.tick - snapshot.tick
        super().restore(snapshot)
        if self._server is not None:
            self._server.time.slip(max(0, ahead) * self.base_cycle_ns)

    def _advance(self, ticks: int) -> None:
        """Run ticks; between two of them clients are let in, or the run begins anew."""
        server = self._server
        if server is not None and not server.begun and ticks:
            super()._advance(1)
            ticks -= 1
            server.begin(self.tick - 1)
            self._set_off()
        if server is not None and server.restart_asked():
            self._restart(server)
        if ticks:
            super()._advance(ticks)

    def _restart(self, server: "Ads") -> None:
        """Begin anew, as a client asks; what cannot be taken back goes on as it is."""
        problem = ""
        try:
            self.reset()
        except (NotCopyable, RuntimeError, TraceError) as error:
            problem = f"the run cannot begin anew: {error}"
        server.restarted(problem)
        self._set_off()

    def _show(self, tick: int) -> None:
        super()._show(tick)
        if self._server is not None:
            self._server.publish(tick)

    def _close_ads(self) -> None:
        """Stop the server, if there is one; the mailbox has been closed."""
        if self._server is not None:
            self._server.close()

    def _pinned(self) -> Iterable[object]:
        return *super()._pinned(), self._server

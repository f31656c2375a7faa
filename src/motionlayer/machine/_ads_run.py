"""What a run of a machine does for ADS: it lets clients in, publishes for them, and begins anew when they ask."""

from collections.abc import Iterable

from motionlayer.connect.ads import Inside
from motionlayer.machine._ads import REFUSED, Ads
from motionlayer.machine._ads_axes import AdsAxes
from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._layering import LayeredRun
from motionlayer.machine._outside import Told
from motionlayer.record import TraceError
from motionlayer.runtime import NotCopyable, Snapshot, Stage, Step


class ServedRun(LayeredRun):
    """A run of a machine that ADS clients may reach.

    Attributes:
        ads: its server.
    """

    ads: Ads
    _inside: Inside

    def _add_ads(self, choice: AdsDescription | bool, axes: AdsAxes, *, own_process: bool) -> Stage:
        """Make the server that is asked for, and return what a tick does for it.

        Args:
            choice: the table `[ads]`; True takes that of the machine, False makes no server.
            axes: what clients reach of the axes.
            own_process: the server runs in a process of its own.

        Raises:
            ServerFailed: it cannot begin.
        """
        asked = self.machine.description.ads if choice is True else choice
        self._inside = Inside(lambda: axes.places, axes.acts())
        # Also without a server: a replay applies what clients wrote, and tells whom the server refused.
        self.mailbox.register(REFUSED, Told(self.events, self._ledger, "ADS"))
        self.ads = Ads(asked or None, self, self._inside, self.mailbox, self.base_cycle_ns, own_process=own_process)
        return Stage(Step.OUTPUTS, "ads", self.ads.publish)

    def restore(self, snapshot: Snapshot) -> None:
        """Go back as `ResettableRun.restore`; for clients the time of day goes on."""
        ahead = self.tick - snapshot.tick
        super().restore(snapshot)
        self.ads.time.slip(max(0, ahead) * self.base_cycle_ns)

    def _advance(self, ticks: int) -> None:
        """Run ticks; between two of them clients are let in, or the run begins anew."""
        if not self.ads.begun and ticks:
            super()._advance(1)
            ticks -= 1
            self.ads.begin(self.tick - 1)
            self._set_off()
        if self.ads.restart_asked():
            self._restart()
        if ticks:
            super()._advance(ticks)

    def _restart(self) -> None:
        """Begin anew, as a client asks; what cannot be taken back goes on as it is."""
        problem = ""
        try:
            self.reset()
        except (NotCopyable, RuntimeError, TraceError) as error:
            problem = f"the run cannot begin anew: {error}"
        self.ads.restarted(problem)
        self._set_off()

    def _show(self, tick: int) -> None:
        super()._show(tick)
        self.ads.publish(tick)

    def _pinned(self) -> Iterable[object]:
        return *super()._pinned(), self.ads, self._inside

"""The group `runtime`: what a run that goes on for hours costs."""

from typing import Final

from motionlayer.bench import _endurance, _messages, _recording, _resetting
from motionlayer.bench._row import MICRO, Goal, Row

ROWS: Final = (
    Row("event.record", MICRO, Goal(1), _messages.record),
    Row("event.per_second", "1/s", Goal(200_000, at_least=True), _messages.per_second),
    Row("trace.core_share", "cores", Goal(0.03), _recording.core_share),
    Row("realtime.late_p99", MICRO, Goal(300), _endurance.late_p99),
    Row("soak.growth", "MiB", Goal(1), _endurance.growth),
    Row("reset.time", "ms", Goal(1), _resetting.reset),
)

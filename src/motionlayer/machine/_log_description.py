"""The table `[log]`: the message files of a run."""

from datetime import datetime
from typing import Literal

from pydantic import Field, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Table, Text

EPOCH = datetime(1970, 1, 1)  # noqa: DTZ001 - a local time, like those that are measured from it


class LogDescription(Table):
    """The message files: `[log]`. Without this table no files are written."""

    folder: Text = Field(
        description="Root folder, relative to the folder of the machine file; made if there is none. One run at a "
        "time writes there."
    )
    level: Literal["error", "warning", "info", "verbose", "sentient"] = Field(
        default="info",
        description="What is written beside errors: nothing, warnings and information, these of touch probes too, "
        "every step of a command, everything.",
    )
    port: int = Field(
        default=851, ge=1, le=65_535, description="ADS port of the runtime; the names of files begin with it."
    )
    size: int = Field(
        default=100_000_000,
        ge=10_000,
        description="Bytes of a file, at most; the day goes on in the next one.",
        json_schema_extra={"x-unit": "bytes"},
    )
    start: str | None = Field(
        default=None,
        description='Local time of tick 0, "YYYY-MM-DDThh:mm:ss", for files that can be compared; default: the time '
        "of day at which the run begins.",
    )

    @field_validator("start")
    @classmethod
    def _is_a_local_time(cls, start: str | None) -> str | None:
        if start is not None and _parsed(start) is None:
            allowed = 'a local time from 1970 on without a zone, as "2025-10-24T13:00:00"'
            raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return start

    @property
    def start_ns(self) -> int | None:
        """Local time of tick 0 in ns since 1970; None for the time of day."""
        local = _parsed(self.start) if self.start is not None else None
        if local is None:
            return None
        since = local - EPOCH
        return ((since.days * 86_400 + since.seconds) * 1_000_000 + since.microseconds) * 1000


def _parsed(text: str) -> datetime | None:
    try:
        local = datetime.fromisoformat(text)
    except ValueError:
        return None
    return local if local.tzinfo is None and local >= EPOCH else None

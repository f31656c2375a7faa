"""What the judge says: `Finding` and `Report`."""

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is wrong in a trace.

    Attributes:
        axis: name of the axis, empty for the trace as a whole.
        tick: where it shows first.
        time: the same in seconds.
        rule: name of the rule that was broken.
        message: what is wrong, for a person.
        value: the number found, in `unit`; nan where the rule is not about a number.
        limit: the number it was held against, in `unit`, tolerance not included; nan as above.
        unit: of `value` and `limit`.
    """

    axis: str
    tick: int
    time: float
    rule: str
    message: str
    value: float = math.nan
    limit: float = math.nan
    unit: str = ""

    def __str__(self) -> str:
        who = self.axis or "trace"
        text = f"{who} at tick {self.tick} ({self.time:.6f} s): {self.rule}: {self.message}"
        if math.isnan(self.value) and math.isnan(self.limit):
            return text
        return f"{text}: {self.value:.17g} against {self.limit:.17g} {self.unit}".rstrip()


@dataclass(frozen=True, slots=True)
class Report:
    """The judgement of one trace.

    Attributes:
        findings: what is wrong, axis by axis in the order of the rules.
        refused: what could not be judged at all, and why; a trace with refusals is not `ok`.
        notes: what was left out because the trace does not contain it, and where a trace that is not whole ends.
        axes: names of the axes that were judged.
        ticks: number of rows.
        plans: number of plans of the judged axes.
        commands: number of commands seen in the events.
        complete: whether the trace is whole, neither incomplete nor damaged nor with gaps; `ok` speaks of what was
            judged of it.
    """

    findings: tuple[Finding, ...]
    refused: tuple[str, ...]
    notes: tuple[str, ...]
    axes: tuple[str, ...]
    ticks: int
    plans: int
    commands: int
    complete: bool = True

    @property
    def ok(self) -> bool:
        """Whether everything was judged and nothing is wrong."""
        return not self.findings and not self.refused

    def __str__(self) -> str:
        judged = f"{len(self.axes)} axes ({', '.join(self.axes) or 'none'}), {self.ticks} ticks"
        counts = f"{self.plans} plans, {self.commands} commands"
        result = f"{len(self.findings)} findings, {len(self.refused)} refusals"
        lines = [f"{self._verdict()}: {judged}, {counts}; {result}"]
        lines += [f"  {finding}" for finding in self.findings]
        lines += [f"  cannot judge: {reason}" for reason in self.refused]
        lines += [f"  note: {note}" for note in self.notes]
        return "\n".join(lines)

    def _verdict(self) -> str:
        if self.findings:
            return "NOT VALID"
        if self.refused:
            return "REFUSED"
        return "valid" if self.complete else "INCOMPLETE"

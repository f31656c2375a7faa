"""What a reader is told of errors and warnings: nothing twice, nothing hidden."""

from hypothesis import given
from hypothesis import strategies as st

from motionlayer.event import Digest, Event, Kind, Level, told

AXIS = 14_001


def said(tick: int, text: str, code: int = 0, source: str = "X", device: int = AXIS) -> Event:
    return Event(tick, Level.ERROR, Kind.MESSAGE, source, text, code, 0, device, 1003)


def lines(*events: Event, most: int | None = None) -> list[str]:
    digest = Digest(most)
    for event in events:
        digest(event)
    return [entry.line(0.001) for entry in digest.entries()]


def test_one_fault_of_one_axis_is_one_line() -> None:
    found = lines(
        said(326, "X: the drive is not ready", 0x4650),
        said(326, "X.move_absolute: the drive is not ready", 0x4650),
        said(326, " : PROGRESS_ERROR", 0x4650, "GVL_AXIS.Ctrl[1]"),
        said(326, "the drive is not ready", 0x4650, "Y", AXIS + 1),
        said(326, "lag too large", 0x4550),
        said(327, "lag too large", 0x4550, "Y", AXIS + 1),
    )
    assert found == [
        "X: the drive is not ready (and 2 more of the same)",
        "Y: the drive is not ready",
        "X: lag too large",
        "Y: lag too large",
    ]


def test_what_has_no_number_is_never_taken_for_the_same_fault() -> None:
    assert lines(said(1, "one"), said(1, "other")) == ["X: one", "X: other"]


def test_what_is_said_again_is_counted() -> None:
    found = lines(said(1, "hot"), said(2, "cold"), said(7, "hot"))
    assert found == ["X: cold", "X: hot (2 times, the last at 0.007000 s)"]


def test_numbers_tell_messages_apart_but_for_those_of_the_runtime() -> None:
    late = [said(n, f"{n} ticks late, to be caught up; programs, {n}.125 ms", source="runtime") for n in (3, 4)]
    assert lines(said(1, "part 1"), said(2, "part 2"), *late) == [
        "X: part 1",
        "X: part 2",
        "runtime: 3 ticks late, to be caught up; programs, 3.125 ms (2 times, the last at 0.004000 s)",
    ]


def test_the_layer_says_subdevice_and_number_in_columns_of_their_own() -> None:
    assert told(said(1, " : PROGRESS_ERROR", 0x4650)) == "X: AxisCycle PROGRESS_ERROR [0x4650]"


EVENTS = st.builds(
    Event,
    tick=st.integers(0, 5),
    level=st.sampled_from(Level),
    kind=st.just(Kind.MESSAGE),
    source=st.sampled_from(["X", "runtime"]),
    text=st.sampled_from(["hot", "2 late", "3 late"]),
    code=st.sampled_from([0, 0x4650, 0x4550]),
    command=st.just(0),
    device=st.sampled_from([AXIS, AXIS + 1]),
)


@given(st.lists(EVENTS, max_size=40))
def test_every_error_and_warning_is_counted_in_one_entry(events: list[Event]) -> None:
    digest = Digest()
    for event in events:
        digest(event)
    entries = digest.entries()
    for level in (Level.ERROR, Level.WARNING):
        assert digest.counts[level] == sum(event.level is level for event in events)
        of_level = [entry for entry in entries if entry.event.level is level]
        assert sum(entry.times + entry.others for entry in of_level) == digest.counts[level]
    levels = [entry.event.level for entry in entries]
    assert levels == sorted(levels)


@given(st.lists(EVENTS, max_size=60), st.integers(1, 4))
def test_no_more_is_kept_than_was_asked_for(events: list[Event], most: int) -> None:
    digest = Digest(most)
    for event in events:
        digest(event)
    for level in (Level.ERROR, Level.WARNING):
        assert sum(entry.event.level is level for entry in digest.entries()) <= most

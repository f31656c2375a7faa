"""One control program over every communication: the same states in the same order, and the axes end where they did."""

import pytest
from examples.communications.compare import Outcome, by_ads, by_images, by_mqtt, in_process, show

from motionlayer.verify import assert_valid
from tests.connect.broker import broker, free_port

SPEED = 0.25
"""Of the real-time runs: a computer that is busy with other tests is late by some milliseconds now and then."""


@pytest.fixture(scope="module")
def outcomes() -> dict[str, Outcome]:
    """What the program does over each communication."""
    port = free_port()
    found = {"in process": in_process(), "images": by_images(), "ADS": by_ads(SPEED)}
    with broker(port):
        found["ADS over MQTT"] = by_mqtt(SPEED, port)
    return found


@pytest.mark.slow
def test_states_and_ends_are_the_same_over_every_communication(outcomes: dict[str, Outcome]) -> None:
    first = outcomes["in process"]
    assert sum(map(len, first.states.values())) == 188
    assert "E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_ERROR" in first.states["Lift"]
    assert set(first.ends.values()) == {0.0}
    for name, one in outcomes.items():
        assert_valid(one.trace)
        assert one.states == first.states, name
        assert one.ends == first.ends, name


@pytest.mark.slow
def test_the_delay_of_each_is_told(outcomes: dict[str, Outcome], capsys: pytest.CaptureFixture[str]) -> None:
    show(outcomes)
    lines = capsys.readouterr().out.splitlines()
    assert [line[:16].strip() for line in lines[1:]] == list(outcomes)
    assert all(line.endswith("yes") for line in lines[1:])
    for name in ("in process", "images"):
        assert set(outcomes[name].delays) == {1}
    assert min(outcomes["ADS"].delays) >= 1
    assert len({len(one.delays) for one in outcomes.values()}) == 1
    print("\n".join(lines))

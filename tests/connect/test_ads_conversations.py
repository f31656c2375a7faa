"""Recorded conversations of real clients: the same answers, however the stream is cut; no harm where it ends."""

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.bench.campaign._ads_device import Device
from tests.effort import examples

FOLDER = Path(__file__).parent / "conversations"
NAMES = sorted(file.stem for file in FOLDER.glob("*.json"))


def conversation(name: str) -> list[tuple[bytes, bytes]]:
    """Return requests, and what each was followed by."""
    said = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    return [(bytes.fromhex(request), bytes.fromhex(answer)) for request, answer in said]


def test_there_are_conversations() -> None:
    assert set(NAMES) == {"pyads", "watch", "node", "cpp"}


@pytest.mark.parametrize("name", NAMES)
def test_a_conversation_is_answered_as_it_was_byte_by_byte(name: str) -> None:
    device = Device()
    peer = device.connect()
    for request, answer in conversation(name):
        for byte in request:
            peer.connection.receive(bytes((byte,)))
        device.tick()
        got, peer.received = peer.received, b""
        assert got == answer


@settings(max_examples=examples(40), deadline=None)
@given(st.sampled_from(NAMES), st.lists(st.integers(1, 300), min_size=1, max_size=30))
def test_a_conversation_is_answered_as_it_was_in_any_pieces(name: str, sizes: list[int]) -> None:
    device = Device()
    peer = device.connect()
    turn = 0
    for request, answer in conversation(name):
        at = 0
        while at < len(request):
            size = sizes[turn % len(sizes)]
            peer.connection.receive(request[at : at + size])
            at += size
            turn += 1
        device.tick()
        got, peer.received = peer.received, b""
        assert got == answer


@pytest.mark.parametrize("name", NAMES)
def test_a_conversation_that_ends_anywhere_leaves_nothing(name: str) -> None:
    whole = b"".join(request for request, _ in conversation(name))
    device = Device()
    for end in range(0, len(whole), 7):
        peer = device.connect()
        peer.connection.receive(whole[:end])
        device.tick()
        peer.connection.closed()
        assert device.router.held() == len(device.notifications) == 0

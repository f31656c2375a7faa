"""Messages between a run and its server: whole, in order, and never waited for."""

import itertools
import socket

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.connect.ads._channel import PIECE, Channel, Received
from motionlayer.connect.ads._wire import Message
from tests.effort import examples

MESSAGES = st.lists(
    st.tuples(st.sampled_from(Message), st.integers(0, 2**32 - 1), st.binary(max_size=300)), max_size=30
)


def pair() -> tuple[Channel, Channel]:
    one, two = socket.socketpair()
    return Channel(one), Channel(two)


def closed(*channels: Channel) -> None:
    for channel in channels:
        channel.close()


@settings(max_examples=examples(100), deadline=None)
@given(MESSAGES, st.lists(st.integers(1, 700), min_size=1, max_size=10))
def test_messages_arrive_whole_and_in_order_however_they_are_cut(
    messages: list[tuple[Message, int, bytes]], sizes: list[int]
) -> None:
    (one, cut_in), (cut_out, two) = socket.socketpair(), socket.socketpair()
    sender, receiver = Channel(one), Channel(two)
    for message, number, data in messages:
        sender.send(message, data, number)
    stream = cut_in.recv(1 << 20) if messages else b""
    found: list[Received] = []
    for size in itertools.cycle(sizes):
        cut_out.sendall(stream[:size])
        stream = stream[size:]
        found += receiver.receive()
        if not stream:
            break
    assert found == [Received(int(message), number, data) for message, number, data in messages]
    closed(sender, receiver)
    cut_in.close()
    cut_out.close()


def test_nothing_is_no_message_and_an_end_is_one_clear_error() -> None:
    one, two = pair()
    assert two.receive() == []
    one.close()
    with pytest.raises(EOFError):
        two.receive()
    two.send(Message.STOP)  # nobody is there, and nobody waits
    assert two.unsent == 0
    two.close()


def test_who_takes_nothing_holds_nobody_up_and_loses_nothing() -> None:
    one, two = pair()
    data = bytes(range(256)) * (PIECE // 64)
    one.send(Message.REQUEST, data, 7)
    one.send_all(Message.OUTCOMES, [(8, b"eight"), (9, b"")])
    assert one.unsent > PIECE
    found: list[Received] = []
    while one.unsent:
        found += two.receive()
        one.flush()
    while more := two.receive():
        found += more
    assert found == [Received(Message.REQUEST, 7, data), Received(5, 8, b"eight"), Received(5, 9, b"")]
    closed(one, two)


def test_waiting_ends_in_time() -> None:
    one, two = pair()
    with pytest.raises(TimeoutError, match=r"no message within 0\.01 s"):
        two.wait(0.01)
    one.send(Message.PORT, b"4711")
    assert two.wait(60.0).data == b"4711"
    assert two.receive() == []
    closed(one, two)


def test_after_a_full_piece_more_is_expected_until_nothing_is_left() -> None:
    one, two = pair()
    head = 9
    size = PIECE - head
    one._socket.setblocking(True)
    one._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4 * PIECE)
    one.send(Message.TOLD, bytes(size))
    assert [len(message.data) for message in two.receive()] == [size]
    assert (two.more, two.receive(), two.more) == (True, [], False)
    closed(one, two)


def test_what_comes_with_a_message_that_is_waited_for_is_not_lost() -> None:
    one, two = pair()
    one.send_all(Message.OUTCOMES, [(1, b"one"), (2, b"two"), (3, b"three")])
    assert [two.wait(1.0).data, two.wait(1.0).data] == [b"one", b"two"]
    assert [message.data for message in two.receive()] == [b"three"]
    assert two.receive() == []
    closed(one, two)

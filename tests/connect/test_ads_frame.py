"""AMS/TCP frames out of streams that are cut anywhere."""

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.connect.ads._frame import MAX_FRAME, Address, FrameError, Packet, Splitter, framed, net_id
from tests.effort import examples

ADDRESS = st.builds(Address, st.binary(min_size=6, max_size=6), st.integers(0, 65535))
PACKETS = st.builds(
    Packet,
    ADDRESS,
    ADDRESS,
    st.integers(0, 65535),
    st.integers(0, 65535),
    st.integers(0, 2**32 - 1),
    st.integers(0, 2**32 - 1),
    st.binary(max_size=100),
)


@settings(max_examples=examples(100))
@given(st.lists(PACKETS, max_size=8), st.lists(st.integers(0, 1000), max_size=20))
def test_a_stream_gives_the_same_packets_wherever_it_is_cut(packets: list[Packet], cuts: list[int]) -> None:
    stream = b"".join(framed(packet.pack()) for packet in packets)
    splitter, got = Splitter(), []
    ends = sorted(cut % (len(stream) + 1) for cut in cuts)
    for start, stop in zip([0, *ends], [*ends, len(stream)], strict=True):
        got += splitter.feed(stream[start:stop])
    assert [Packet.parse(frame.data) for frame in got] == packets


def test_a_header_has_the_fields_of_the_manual_in_their_places() -> None:
    packet = Packet(Address(bytes(range(6)), 851), Address(bytes(range(10, 16)), 30000), 2, 4, 0, 77, b"\x01\x02")
    raw = packet.pack()
    assert raw[:8] == bytes(range(6)) + struct.pack("<H", 851)
    assert raw[8:16] == bytes(range(10, 16)) + struct.pack("<H", 30000)
    assert raw[16:32] == struct.pack("<HHIII", 2, 4, 2, 0, 77)
    assert raw[32:] == b"\x01\x02"
    assert framed(raw)[:6] == struct.pack("<HI", 0, 34)


def test_an_answer_goes_back_to_who_asked() -> None:
    packet = Packet(Address(bytes(6), 851), Address(bytes(range(6)), 30000), 2, 4, 0, 77, b"")
    answer = packet.answer(b"\0" * 4)
    assert (answer.target, answer.source, answer.flags, answer.invoke_id) == (packet.source, packet.target, 5, 77)


@pytest.mark.parametrize("raw", [b"", bytes(31), bytes(33), bytes(31) + b"\x01" * 20])
def test_what_is_no_packet_is_none(raw: bytes) -> None:
    assert Packet.parse(raw) is None


def test_a_frame_that_is_too_long_ends_the_stream() -> None:
    with pytest.raises(FrameError, match=f"{MAX_FRAME + 1} bytes"):
        Splitter().feed(struct.pack("<HI", 0, MAX_FRAME + 1))


@pytest.mark.parametrize("text", ["", "1.2.3.4.5", "1.2.3.4.5.256", "a.b.c.d.e.f", "1.2.3.4.5.6.7", "-1.2.3.4.5.6"])
def test_a_net_id_is_six_numbers(text: str) -> None:
    with pytest.raises(ValueError, match="six numbers"):
        net_id(text)


def test_a_net_id_reads_back() -> None:
    assert str(Address(net_id("5.132.118.239.1.1"), 851)) == "5.132.118.239.1.1:851"

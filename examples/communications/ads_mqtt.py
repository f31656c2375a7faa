"""A small ADS client over MQTT: an AMS packet in a message to the server's topic, the answer in one to ours.

Requests wait for their answers one by one; notifications come in a thread of the MQTT library.
"""

import queue
import struct
import threading
from collections.abc import Callable

from paho.mqtt.client import Client, MQTTMessage
from paho.mqtt.enums import CallbackAPIVersion

AMS = struct.Struct("<6sH6sHHHIII")
REQUEST, RESPONSE = 0x0004, 0x0005
READ_WRITE, ADD_NOTIFICATION, DELETE_NOTIFICATION, NOTIFICATION = 9, 6, 7, 8
ON_CHANGE = 4

Sample = Callable[[int, bytes], None]
"""Takes time stamp (FILETIME) and value of a notification."""


class AdsError(Exception):
    """The server refuses; its code is the argument."""


def raw(net_id: str) -> bytes:
    return bytes(map(int, net_id.split(".")))


class MqttAds:
    """An ADS client.

    Args:
        broker: host and port.
        target: NetId of the server.
        own: NetId of this client, one that nobody else in the network has.
        network: what all topics begin with.
        port: AMS port of the server.
        timeout: for an answer, s.
        login: user and password, for a broker that asks.
    """

    def __init__(
        self,
        broker: tuple[str, int],
        target: str,
        own: str,
        network: str = "VirtualAmsNetwork1",
        *,
        port: int = 851,
        timeout: float = 5.0,
        login: tuple[str, str] | None = None,
    ) -> None:
        self.online = threading.Event()
        """The server is there, as its info says."""
        self._target, self._own = (raw(target), port), (raw(own), 40_000)
        self._to, self._from = f"{network}/{target}/ams", f"{network}/{own}/ams/res"
        self._info, self._partner = f"{network}/{own}/info", f"{network}/{target}/info"
        self._timeout = timeout
        self._last = 0
        self._answers: queue.SimpleQueue[tuple[int, int, bytes]] = queue.SimpleQueue()
        self._samples: dict[int, Sample] = {}
        client = self._client = Client(CallbackAPIVersion.VERSION2)
        client.reconnect_delay_set(1, 2)
        if login is not None:
            client.username_pw_set(*login)
        client.will_set(self._info, self._state(online=False), qos=1, retain=True)
        client.on_connect = lambda *_: self._connected()
        client.on_message = lambda _client, _data, message: self._received(message)
        client.connect(*broker)
        client.loop_start()

    def close(self) -> None:
        """Say good-bye; the server releases what it held for this client."""
        self._client.publish(self._info, self._state(online=False), qos=1, retain=True).wait_for_publish(1.0)
        self._client.disconnect()
        self._client.loop_stop()

    def read_write(self, group: int, offset: int, length: int, data: bytes) -> bytes:
        """Return the answer to a ReadWrite, at most `length` bytes."""
        answer = self.request(READ_WRITE, struct.pack("<4I", group, offset, length, len(data)) + data)
        return answer[8:]

    def watch(self, group: int, offset: int, length: int, sample: Sample) -> int:
        """Call `sample` with every change; return the handle."""
        order = struct.pack("<6I16x", group, offset, length, ON_CHANGE, 0, 0)
        (handle,) = struct.unpack_from("<I", self.request(ADD_NOTIFICATION, order), 4)
        self._samples[handle] = sample
        return int(handle)

    def forget(self, handle: int) -> None:
        """End a notification."""
        self.request(DELETE_NOTIFICATION, struct.pack("<I", handle))
        del self._samples[handle]

    def request(self, command: int, data: bytes) -> bytes:
        """Return the data of the answer, whose first four bytes are the result.

        Raises:
            AdsError: the server refuses.
            TimeoutError: no answer.
        """
        self._last += 1
        header = AMS.pack(*self._target, *self._own, command, REQUEST, len(data), 0, self._last)
        self._client.publish(self._to, header + data)
        while True:
            try:
                number, error, answer = self._answers.get(timeout=self._timeout)
            except queue.Empty:
                raise TimeoutError(f"no answer to command {command} within {self._timeout:g} s") from None
            if number == self._last:  # else the answer to one that was given up
                break
        error = error or struct.unpack_from("<I", answer)[0]
        if error:
            raise AdsError(f"0x{error:X}")
        return answer

    def _connected(self) -> None:
        self._client.subscribe([(self._from, 0), (self._partner, 1)])
        self._client.publish(self._info, self._state(online=True), qos=1, retain=True)

    def _received(self, message: MQTTMessage) -> None:
        if message.topic == self._partner:
            (self.online.set if b">true<" in message.payload else self.online.clear)()
            return
        *_, command, _flags, length, error, number = AMS.unpack_from(message.payload)
        data = bytes(message.payload[AMS.size :][:length])
        if command == NOTIFICATION:
            self._notified(data)
        else:
            self._answers.put((number, error, data))

    def _notified(self, data: bytes) -> None:
        _, stamps = struct.unpack_from("<II", data)
        at = 8
        for _ in range(stamps):
            stamp, samples = struct.unpack_from("<QI", data, at)
            at += 12
            for _ in range(samples):
                handle, size = struct.unpack_from("<II", data, at)
                at += 8
                if handle in self._samples:
                    self._samples[handle](stamp, data[at : at + size])
                at += size

    @staticmethod
    def _state(*, online: bool) -> str:
        return f'<info><online name="client">{str(online).lower()}</online></info>'

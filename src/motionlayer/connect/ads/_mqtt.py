"""`joined`: the connection to an MQTT broker, a thin shell around `Network`.

Requests and answers go with quality of service 0: what a broken connection swallows runs into the time-out of the
client, as on TCP, and nothing is ever carried out twice. What tells who is there goes with 2, as with TwinCAT.
"""

import asyncio
import contextlib
import logging
import os
import socket
from collections import deque
from collections.abc import AsyncIterator
from typing import Final

import aiomqtt

from motionlayer.connect.ads._mqtt_network import Network, info
from motionlayer.connect.ads._plan import Mqtt
from motionlayer.connect.ads._router import Router

USER: Final = "MOTIONLAYER_MQTT_USER"
PASSWORD: Final = "MOTIONLAYER_MQTT_PASSWORD"  # noqa: S105 - the name of a variable
"""Variables of the environment, for a broker that asks; machine files are copied and printed."""

KEEPALIVE: Final = 15
"""Seconds of silence after which broker and server ask each other whether they are there."""

RETRY: Final = (1.0, 2.0, 5.0)
"""Seconds until the next attempts to reach the broker; the last one holds from then on."""

LAST_WORD: Final = 2.0
"""Seconds that saying good-bye may take."""

INCOMING: Final = 10_000
"""Messages that wait to be looked at; what comes beyond them is lost."""

_EXACTLY_ONCE: Final = 2
_AT_MOST_ONCE: Final = 0


class Membership:
    """The connection of a server to its broker, which comes back when it breaks.

    Args:
        mqtt: the broker.
        router: what all ways to the server share.
    """

    def __init__(self, mqtt: Mqtt, router: Router) -> None:
        self._mqtt = mqtt
        self._router = router
        self._network = Network(mqtt.network, router, self._put)
        self._connected = False
        self._outgoing: deque[tuple[str, bytes]] = deque()
        self._unsent = 0
        self._something = asyncio.Event()
        self._logger = logging.getLogger(__name__)
        self._logger.disabled = True  # trouble is told to the run

    async def run(self) -> None:
        """Be a member until cancelled."""
        attempts = 0
        try:
            while True:
                try:
                    await self._session()
                except aiomqtt.MqttError as error:
                    if self._connected or not attempts:
                        self._tell(f"{error}; trying again")
                    attempts = 0 if self._connected else attempts
                    self._connected = False
                await asyncio.sleep(RETRY[min(attempts, len(RETRY) - 1)])
                attempts += 1
        finally:
            self._network.close()

    async def _session(self) -> None:
        """Connect, tell the others, and serve until the connection breaks."""
        network = self._network
        will = aiomqtt.Will(network.info, info(self._mqtt.name, online=False), _EXACTLY_ONCE, retain=True)
        async with aiomqtt.Client(
            self._mqtt.host,
            self._mqtt.port,
            username=os.environ.get(USER),
            password=os.environ.get(PASSWORD),
            will=will,
            keepalive=KEEPALIVE,
            logger=self._logger,
            max_queued_incoming_messages=INCOMING,
            socket_options=[(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)],
        ) as client:
            await client.subscribe([(network.requests, _AT_MOST_ONCE), (network.infos, _EXACTLY_ONCE)])
            await self._announce(client, online=True)
            self._forget()
            self._connected = True
            await self._serve(client)

    async def _serve(self, client: aiomqtt.Client) -> None:
        """Listen and answer until one of both breaks; say good-bye where the server ends."""
        tasks = [asyncio.create_task(self._listen(client)), asyncio.create_task(self._send(client))]
        try:
            ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in ended:
                task.result()
        except asyncio.CancelledError:
            with contextlib.suppress(aiomqtt.MqttError):
                await self._announce(client, online=False)
            raise
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _listen(self, client: aiomqtt.Client) -> None:
        async for message in client.messages:
            if not self._network.take(str(message.topic), message.payload):
                await self._announce(client, online=True)

    async def _announce(self, client: aiomqtt.Client, *, online: bool) -> None:
        payload = info(self._mqtt.name, online=online)
        await client.publish(self._network.info, payload, _EXACTLY_ONCE, retain=True, timeout=LAST_WORD)

    async def _send(self, client: aiomqtt.Client) -> None:
        """Publish what is put; a broker that takes nothing holds up nobody else."""
        while True:
            await self._something.wait()
            self._something.clear()
            while self._outgoing:
                topic, payload = self._outgoing.popleft()
                self._unsent -= len(payload)
                await client.publish(topic, payload, _AT_MOST_ONCE)

    def _put(self, topic: str, payload: bytes) -> None:
        """Send an answer, or lose it: without a connection, or where the broker takes nothing any more."""
        if not self._connected:
            return
        if self._unsent + len(payload) > self._router.limits.unsent:
            self._tell(f"takes nothing that is sent to it; {len(payload)} bytes for {topic} are lost")
            return
        self._outgoing.append((topic, payload))
        self._unsent += len(payload)
        self._something.set()

    def _forget(self) -> None:
        self._outgoing.clear()
        self._unsent = 0

    def _tell(self, what: str) -> None:
        self._router.tell(f"MQTT broker {self._mqtt.host}:{self._mqtt.port}", what)


@contextlib.asynccontextmanager
async def joined(mqtt: Mqtt, router: Router) -> AsyncIterator[None]:
    """Let a server be a member of an MQTT network meanwhile.

    Args:
        mqtt: the broker.
        router: what all ways to the server share.
    """
    task = asyncio.create_task(Membership(mqtt, router).run())
    try:
        yield
    finally:
        task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await task

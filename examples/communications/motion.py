"""The motion machine in a process of its own: in real time, reached by ADS over TCP, and over MQTT with a broker.

`python motion.py TRACE SPEED [BROKER_PORT]` writes its TCP port, and runs until its input ends.
"""

import sys
import threading
from pathlib import Path

from motionlayer import Machine, RealTime
from motionlayer.machine import AdsDescription, MqttDescription

HERE = Path(__file__).parent
NET_ID = "127.0.0.1.7.1"


async def until_told(run: RealTime) -> None:
    """Wait for the end of the input, which a thread reads."""
    told = threading.Event()

    def listen() -> None:
        sys.stdin.read()
        told.set()

    threading.Thread(target=listen, daemon=True).start()
    await run.until(told.is_set)


def main() -> None:
    """Run the motion machine for the clients of its servers."""
    trace, speed, *broker = sys.argv[1:]
    mqtt = MqttDescription(port=int(broker[0])) if broker else None
    ads = AdsDescription(port=0, net_id=NET_ID, mqtt=mqtt)
    with RealTime(Machine.load(HERE / "motion.toml"), ads=ads, speed=float(speed), trace=trace) as run:
        print(run.ads.port, flush=True)
        run.run(until_told(run))


if __name__ == "__main__":
    main()

"""An ADS client in Python: it homes an axis and moves it, by Ctrl and State of the motion layer.

    pip install pyads
    python client.py [host:port]

Every reaction is to a notification of the axis' state, which is its command plus how far that is: 10000 is done.
"""

import queue
import sys
import time

import pyads

NULL, ENABLE, HOME, MOVE_POS = 0, 3, 11, 12
DONE, ERROR = 10_000, 9_000
TIMEOUT = 20.0


class Axis:
    """An axis of the motion layer, by its index."""

    def __init__(self, plc: pyads.Connection, index: int) -> None:
        self._plc = plc
        self._index = index
        self._states: queue.Queue[int] = queue.Queue()
        state, size = f"GVL_AXIS.State[{index}].eState", pyads.NotificationAttrib(2)
        self._handles = plc.add_device_notification(state, size, self._told)

    def _told(self, notification: object, _name: str) -> None:
        _, _, state = self._plc.parse_notification(notification, pyads.PLCTYPE_UINT)
        self._states.put(state)

    def command(self, command: int) -> None:
        """Give a command and wait until it is done."""
        self._plc.write_by_name(f"GVL_AXIS.Ctrl[{self._index}].eCmd", command, pyads.PLCTYPE_UINT)
        while (state := self._states.get(timeout=TIMEOUT)) != command + DONE:
            if state == command + ERROR:
                raise RuntimeError(f"axis {self._index}: command {command} ended in error")

    def move(self, position: float, velocity: float) -> None:
        """Move to a position; the data of the move are written together, so they hold from one tick on."""
        data = f"GVL_AXIS.Data[{self._index}]"
        self._plc.write_list_by_name({f"{data}.rSetPos": position, f"{data}.rSetVelo": velocity})
        self.command(MOVE_POS)
        self.command(NULL)

    def position(self) -> float:
        """Return the actual position."""
        return float(self._plc.read_by_name(f"GVL_AXIS.Info[{self._index}].rActPos", pyads.PLCTYPE_LREAL))

    def close(self) -> None:
        """End the notification; before the connection is closed."""
        self._plc.del_device_notification(*self._handles)


def main() -> None:
    """Move the first axis."""
    address = sys.argv[1] if len(sys.argv) > 1 else "127.0.0.1"
    with pyads.Connection("127.0.0.1.1.1", pyads.PORT_TC3PLC1, address) as plc:
        while plc.read_by_name("MAIN_AXIS.eInit", pyads.PLCTYPE_UINT) != DONE:
            time.sleep(0.01)
        print("device", plc.read_device_info()[0], "state", plc.read_state()[0])
        axis = Axis(plc, 1)
        for command in (ENABLE, HOME, NULL):
            axis.command(command)
        for target in (100.0, 250.0, 0.0):
            axis.move(target, 400.0)
            print(f"position {axis.position():.2f}")
        axis.close()


if __name__ == "__main__":
    main()

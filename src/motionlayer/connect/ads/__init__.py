"""An ADS device: real ADS clients reach the symbols of a run.

The protocol is code without input and output: `Connection` takes bytes of a stream and returns what they are answered
with. Around it stands a thin server in a process of its own, which shares with the run an image of all symbols, as of
the last finished tick, and a socket. Reads and notifications are answered from the image, without the run; what changes
something is fetched by the cycle out of the socket, takes effect in the next tick, and is acknowledged when that tick
has been published.
"""

from motionlayer.connect.ads._bridge import Bridge, Hooks
from motionlayer.connect.ads._client import Limits
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._describe import Placed, placed, tree_of
from motionlayer.connect.ads._frame import net_id
from motionlayer.connect.ads._image import Status
from motionlayer.connect.ads._inside import Act, Inside
from motionlayer.connect.ads._meanings import MEANINGS, Meaning
from motionlayer.connect.ads._nc import (
    CYCLIC,
    FUNCTIONS,
    MOST_AXES,
    PARAMETERS,
    STATE,
    Area,
    Item,
    NcContents,
    axis_address,
    function,
    with_parts,
)
from motionlayer.connect.ads._nodes import TypeNode
from motionlayer.connect.ads._numbers import INFO_BY_NAME, SUM_READ, SUM_READ_WRITE, SUM_WRITE, VERSION
from motionlayer.connect.ads._plan import Contents, Mqtt, Plan
from motionlayer.connect.ads._router import Access
from motionlayer.connect.ads._rpc import Calls
from motionlayer.connect.ads._service import Kind, Outcome, State, Write
from motionlayer.connect.ads._tree import Tree
from motionlayer.connect.ads._watch import Sample, Watcher
from motionlayer.connect.ads._watch_errors import Absent, Lost, WatchError

__all__ = [
    "CYCLIC",
    "FUNCTIONS",
    "INFO_BY_NAME",
    "MEANINGS",
    "MOST_AXES",
    "PARAMETERS",
    "STATE",
    "SUM_READ",
    "SUM_READ_WRITE",
    "SUM_WRITE",
    "VERSION",
    "Absent",
    "Access",
    "Act",
    "AdsError",
    "Area",
    "Bridge",
    "Calls",
    "Code",
    "Contents",
    "Hooks",
    "Inside",
    "Item",
    "Kind",
    "Limits",
    "Lost",
    "Meaning",
    "Mqtt",
    "NcContents",
    "Outcome",
    "Placed",
    "Plan",
    "Sample",
    "State",
    "Status",
    "Tree",
    "TypeNode",
    "WatchError",
    "Watcher",
    "Write",
    "axis_address",
    "function",
    "net_id",
    "placed",
    "tree_of",
    "with_parts",
]

"""The motion layer: Ctrl and State structures for axes, and what carries their commands out (motion-layer).

A client drops a command into the command field of an object; the state field answers in the same cycle, and goes on to
show how far the command is: state = command + progress.
"""

from motionlayer.layer._answer import Answer, LayerError, ObjectState, StateWait, Waits, split
from motionlayer.layer._axis_jobs import AXIS_JOBS
from motionlayer.layer._constants import Features, Sizes
from motionlayer.layer._control import ControlSide
from motionlayer.layer._controller import Choice, Controller
from motionlayer.layer._declarations import control_side
from motionlayer.layer._diagram import mermaid
from motionlayer.layer._globals import Globals
from motionlayer.layer._interfaces import (
    Absent,
    AbsentChannel,
    I_Cam_Ctrl,
    I_Fly_Ctrl,
    I_McAxis,
    I_Nci_Ctrl,
    I_NciChannel,
    I_TouchProbe,
    I_TriggerBox,
)
from motionlayer.layer._job import Job, JobTable, Transition, a_call_later, always, nothing
from motionlayer.layer._layer import MotionLayer
from motionlayer.layer._mapping import ORIGINAL, ImageMapping, MapOptions
from motionlayer.layer._mapping_build import START, Outside, control_mapping, layer_mapping, map_variables
from motionlayer.layer._mapping_table import SIMULATED
from motionlayer.layer._messages import Messages
from motionlayer.layer._namespace import Namespace, NamespaceJob, NamespaceObject, Site, after
from motionlayer.layer._namespaces import Namespaces
from motionlayer.layer._objects import AxisObject, Objects
from motionlayer.layer._options import NAMESPACES, LayerOptions, Schedule
from motionlayer.layer._startup import START_UP
from motionlayer.layer.types import AxisCommand, Progress

__all__ = [
    "AXIS_JOBS",
    "NAMESPACES",
    "ORIGINAL",
    "SIMULATED",
    "START",
    "START_UP",
    "Absent",
    "AbsentChannel",
    "Answer",
    "AxisCommand",
    "AxisObject",
    "Choice",
    "ControlSide",
    "Controller",
    "Features",
    "Globals",
    "I_Cam_Ctrl",
    "I_Fly_Ctrl",
    "I_McAxis",
    "I_NciChannel",
    "I_Nci_Ctrl",
    "I_TouchProbe",
    "I_TriggerBox",
    "ImageMapping",
    "Job",
    "JobTable",
    "LayerError",
    "LayerOptions",
    "MapOptions",
    "Messages",
    "MotionLayer",
    "Namespace",
    "NamespaceJob",
    "NamespaceObject",
    "Namespaces",
    "ObjectState",
    "Objects",
    "Outside",
    "Progress",
    "Schedule",
    "Site",
    "Sizes",
    "StateWait",
    "Transition",
    "Waits",
    "a_call_later",
    "after",
    "always",
    "control_mapping",
    "control_side",
    "layer_mapping",
    "map_variables",
    "mermaid",
    "nothing",
    "split",
]

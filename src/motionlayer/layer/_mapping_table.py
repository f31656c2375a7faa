"""Which images there are, and what they are copied from and to (motion-layer 7), with D49 corrected.

In the order of the rows images are checked and copied: axis, NCI, CAM, trigger, saw; within a group in the order of the
original. Each group may be mapped for some of its objects alone; an image then holds these, one behind the other.
"""

from typing import Final, NamedTuple

GROUPS: Final = ("axis", "nci", "cam", "trigger", "saw")
"""AXIS_MAP, NCI_MAP, CAM_MAP, TRIGGER_MAP, SAW_MAP."""

SELECTOR: Final = "selector"
"""The parameter selector: a single object, mapped with one of the maps of axes."""

SWITCHES: Final = "switches"
"""Limit switches of the axes of a map that asks for them; the original has no image of them (D51)."""


class Row(NamedTuple):
    """An image and its partner.

    Attributes:
        group: of the map that holds it.
        image: name of the image.
        symbol: what it is copied to or from.
        written: the layer writes this input too, INIT at start-up: the image is compared with what stands there, and
            not with what was last copied, so that the client's command comes back in the next cycle.
    """

    group: str
    image: str
    symbol: str
    written: bool = False


INPUTS: Final = (
    Row("axis", "AxisCtrl", "GVL_AXIS.Ctrl", written=True),
    Row("axis", "AxisMoveData", "GVL_AXIS.Data"),
    Row("axis", "AxisMotionOptions", "GVL_AXIS.MotionOptions"),
    Row("axis", "AxisGearInData", "GVL_AXIS.GearInParameter"),
    Row("axis", "AxisHoming", "GVL_AXIS.HomeParameter"),
    Row("axis", "AxisParameterIn", "GVL_AXIS.NcParameterIn"),
    Row(SELECTOR, "SelectorCtrl", "GVL_AXIS.SelectorCtrl"),
    Row("nci", "NciControl", "GVL_NCI.ChannelCtrl", written=True),
    Row("nci", "NciAxisGroup", "GVL_NCI.AxisConfig"),
    Row("nci", "NciRparameters", "GVL_NCI.R_ParameterWrite"),
    Row("cam", "CamControl", "GVL_CAM.Ctrl", written=True),
    Row("cam", "CamData", "GVL_CAM.Data"),
    Row("trigger", "TriggerControl", "GVL_FUNCTIONS.CtrlTrigger"),
    Row("trigger", "TouchProbeControl", "GVL_FUNCTIONS.CtrlTouchProbe"),
    Row("saw", "FlyControl", "GVL_FLYING_SAW.Ctrl", written=True),
    Row("saw", "FlyData", "GVL_FLYING_SAW.Data"),
    Row("saw", "FlyOptions", "GVL_FLYING_SAW.Options"),
)
"""Images that controllers write, as in the original."""

SIMULATED: Final = (Row("axis", "DriveFault", "GVL_SIMULATION.DriveFault"),)
"""Images behind these that the original has not: they reach what only a simulated machine has."""

WRITTEN: Final = (*INPUTS, Row(SWITCHES, "AxisLimitSwitches", "GVL_AXIS.LimitSwitches"), *SIMULATED)
"""All images that controllers write."""

OUTPUTS: Final = (
    Row("axis", "AxisState", "GVL_AXIS.State"),
    Row("axis", "AxisInfo", "GVL_AXIS.Info"),
    Row("axis", "AxisParameterOut", "GVL_AXIS.NcParameterOut"),
    Row(SELECTOR, "SelectorState", "GVL_AXIS.SelectorState"),
    Row("nci", "NciState", "GVL_NCI.ChannelState"),
    Row("nci", "NciRparameters", "GVL_NCI.R_ParameterRead"),
    Row("cam", "CamInfo", "GVL_CAM.Info"),
    Row("cam", "CamState", "GVL_CAM.State"),
    Row("trigger", "TriggerState", "GVL_FUNCTIONS.StateTrigger"),
    Row("trigger", "TouchProbeState", "GVL_FUNCTIONS.StateTouchProbe"),
    Row("saw", "FlyState", "GVL_FLYING_SAW.State"),
)
"""Images that controllers read."""

"""Touch probes and their terminals (motion-layer 3.7). u is the unit of the axis."""

from motionlayer.iec import BIT, INT, LREAL, UDINT, UINT, USINT, Field, Struct


class TouchProbeCtrl(Struct, iec="ST_CTRL_TOUCH_PROBE"):
    """Command of a touch probe."""

    enable = Field("Enable", BIT, "a rising edge starts, FALSE resets")
    axis_id = Field("AxisId", UDINT, "id of the axis in the NC")
    sensor_index = Field("SensorIndex", UDINT, "1 upper, 2 lower, 0 default")
    direction = Field("Direction", INT, "1 positive, 3 negative", default=1)
    start = Field("PositionStart", LREAL, "where the window begins (u)")
    end = Field("PositionEnd", LREAL, "where it ends (u)")


class TouchProbeState(Struct, iec="ST_STATE_TOUCH_PROBE"):
    """Answer of a touch probe."""

    state = Field("State", UINT, "E_PROGRESS; an error is 9000 and its code")
    rising = Field("LatchPositive", LREAL, "position of the rising edge (u)")
    falling = Field("LatchNegative", LREAL, "position of the falling edge (u)")


class ProbeInput(Struct, iec="ST_MTI_INPUT"):
    """Input of a terminal that stamps events."""

    state = Field("EventState", BIT, "signal after the event")
    time = Field("EventTime", UDINT, "low 32 bits of the DC time (ns)")


class TwoBits(Struct, iec="ST_2BIT"):
    """Two bits of their own byte."""

    b1 = Field("b1", BIT, "bit 0")
    b2 = Field("b2", BIT, "bit 1")


class ProbeStatus(Struct, iec="ST_MTI_STATUS"):
    """Status of a terminal that stamps events."""

    event_count = Field("EventCount", USINT, "events so far")
    input_state = Field("InputState", BIT, "signal now")
    overflow = Field("InputBufferOverflow", BIT, "events were lost")
    cycle_counter = Field("InputCycleCounter", TwoBits, "counts with every cycle of the terminal")
    buffered = Field("CountsInBuffer", USINT, "events that wait in the terminal")
    order_feedback = Field("InputOrderFeedback", USINT, "order that the terminal has carried out")

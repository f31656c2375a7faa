"""Tables of cams, 0x4A00 to 0x4AFF."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

TABLES: Final = {
    E.CAM_TABLE_ID: ErrorText("id of the table not valid or in use"),
    E.CAM_TABLE_TYPE: ErrorText("type of the table not valid"),
    E.CAM_ROWS: ErrorText("number of rows not valid"),
    E.CAM_COLUMNS: ErrorText("number of columns not valid"),
    E.CAM_STEP: ErrorText("step size not valid"),
    E.CAM_PERIOD: ErrorText("period not valid"),
    E.CAM_NOT_MONOTONIC: ErrorText("table not monotonic in the master"),
    E.CAM_INTERPOLATION: ErrorText("interpolation type not valid"),
    E.CAM_FUNCTION: ErrorText("function not available for this type of table"),
    E.CAM_ROW_INDEX: ErrorText("index of the row not valid"),
    E.MULTI_TABLE_MASTER: ErrorText("multiple tables: master outside the table"),
    E.MASTER_BELOW_TABLE: ErrorText("master below the table"),
    E.MASTER_ABOVE_TABLE: ErrorText("master above the table"),
    E.FIFO_EMPTY: ErrorText("FIFO empty"),
    E.FIFO_FULL: ErrorText("FIFO full"),
    E.MOTION_POINT_INDEX: ErrorText("index of a point of the motion function not valid"),
    E.SPLINE: ErrorText("spline cannot be computed, master positions wrong"),
    E.TOO_FEW_SPLINE_POINTS: ErrorText("too few points for a spline, 3 at least"),
    E.TOO_FEW_MOTION_POINTS: ErrorText("too few points for a motion function, 2 at least"),
    E.PERIODIC_START: ErrorText("periodic table: first master position not valid"),
}

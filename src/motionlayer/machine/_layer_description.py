"""The tables `[layer]` and `[control]`: the motion layer, and the side that commands one in another machine.

Groups, objects and names are those of motion-layer 1.4, 1.5 and 7. `_layer_relations` checks what needs other
tables: how many axes there are, and that no object belongs to two maps.
"""

from typing import Annotated, Final, Literal, TypeAlias, TypeVar

from pydantic import (
    AfterValidator,
    Field,
    PlainValidator,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Duration, Table, Text

T = TypeVar("T")

Group: TypeAlias = Literal["axis", "nci", "cam", "trigger", "saw"]
"""What is mapped together: AXIS_MAP, NCI_MAP, CAM_MAP, TRIGGER_MAP, SAW_MAP."""

LATER: Final = {
    "nci": "channels (GVL_NCI)",
    "cam": "cams (GVL_CAM)",
    "xfc": "touch probes and trigger boxes (GVL_FUNCTIONS)",
    "saw": "flying saws (GVL_FLYING_SAW)",
}
"""What the layer cannot switch on yet, and what it would be."""


def _object(value: object) -> int | str:
    """Take the name of an axis or an index, which TOML tells apart."""
    if type(value) is int or (type(value) is str and value):
        return value
    raise PydanticCustomError("relation", "relation", {"allowed": "an index, or the name of an axis"})


Object: TypeAlias = Annotated[
    int | str, PlainValidator(_object), WithJsonSchema({"anyOf": [{"type": "integer"}, {"type": "string"}]})
]


def _with_an_entry(entries: tuple[T, ...] | None) -> tuple[T, ...] | None:
    """Refuse an empty list; the models would call one with a wrong entry empty too."""
    if entries == ():
        raise PydanticCustomError("relation", "relation", {"allowed": "a list with at least one entry"})
    return entries


NotEmpty: Final = AfterValidator(_with_an_entry)

Count: TypeAlias = Annotated[int, Field(ge=1, le=999)]  # ids of a block of messages (motion-layer 2.6)


class SizesDescription(Table):
    """How many objects of each kind there are, beside axes: constants of PLC_CONSTANT."""

    max_nci_channels: Count = Field(default=1, description="MAX_NCI_CH: channels, 1 to 999.")
    max_trigger_box: Count = Field(default=12, description="MAX_TRIGGER_BOX: trigger boxes, 1 to 999.")
    max_touch_probe: Count = Field(default=12, description="MAX_TOUCH_PROBE: touch probes, 1 to 999.")
    max_trigger_count: Count = Field(default=4, description="MAX_TRIGGER_COUNT: positions of a trigger box, 1 to 999.")
    max_r_para: Count = Field(
        default=10, description="MAX_R_PARA: the last index of the R parameters, which begin at 0; 1 to 999."
    )
    max_motion_function_points: Count = Field(
        default=10, description="MAX_MOTION_FUNCTION_POINTS: points of a motion function, 1 to 999."
    )
    max_message: int = Field(
        default=200, ge=1, le=10_000, description="MAX_MESSAGE: messages in a list of GVL_MSG_AXIS, 1 to 10 000."
    )
    max_other_message: int = Field(
        default=20,
        ge=1,
        le=10_000,
        description="MAX_MESSAGE of GVL_MSG: messages in each of its four lists, which nobody writes to a file, 1 to "
        "10 000; the original has 2000.",
    )


class DivisorDescription(Table):
    """In every how many ticks each namespace of the layer runs: `[layer.divisor]`."""

    axis: Annotated[int, Field(ge=1, le=1000)] = Field(default=1, description="MAIN_AXIS, 1 to 1000.")
    functions: Annotated[int, Field(ge=1, le=1000)] = Field(default=1, description="FUNCTIONS, 1 to 1000.")
    nci: Annotated[int, Field(ge=1, le=1000)] = Field(default=1, description="NCI, 1 to 1000.")
    cam: Annotated[int, Field(ge=1, le=1000)] = Field(default=1, description="CAM, 1 to 1000.")
    saw: Annotated[int, Field(ge=1, le=1000)] = Field(default=1, description="FLYING_SAW, 1 to 1000.")


class PhaseDescription(Table):
    """In which of these ticks, so that the load spreads: `[layer.phase]`; each less than its divisor."""

    axis: Annotated[int, Field(ge=0, le=999)] = Field(default=0, description="MAIN_AXIS, 0 to 999.")
    functions: Annotated[int, Field(ge=0, le=999)] = Field(default=0, description="FUNCTIONS, 0 to 999.")
    nci: Annotated[int, Field(ge=0, le=999)] = Field(default=0, description="NCI, 0 to 999.")
    cam: Annotated[int, Field(ge=0, le=999)] = Field(default=0, description="CAM, 0 to 999.")
    saw: Annotated[int, Field(ge=0, le=999)] = Field(default=0, description="FLYING_SAW, 0 to 999.")


class MapDescription(Table):
    """Objects that a controller reaches by byte images: `[layer.map.NAME]`."""

    group: Group = Field(description="What is mapped: axis, nci, cam, trigger (boxes and touch probes) or saw.")
    objects: Annotated[tuple[Object, ...] | None, NotEmpty] = Field(
        default=None,
        strict=False,  # TOML gives a list
        description="Indices from 1, for axis, cam and saw also names of axes, in the order of the images; default: "
        "all. Whatever no map holds is reached by symbol.",
    )
    selector: bool | None = Field(
        default=None,
        description="The map also holds the parameter selector; default: true for a map of all axes. Group axis alone.",
    )
    switches: bool = Field(
        default=False,
        description="The map also holds the limit switches of its axes, AxisLimitSwitches, which the original has no "
        "image of. Group axis alone.",
    )

    @model_validator(mode="after")
    def _of_axes_alone(self) -> "MapDescription":
        for asked, what in ((self.selector, "the parameter selector goes"), (self.switches, "limit switches go")):
            if asked and self.group != "axis":
                allowed = f'false: {what} with group "axis", not "{self.group}"'
                raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return self


class LayerDescription(SizesDescription):
    """The motion layer, Ctrl and State for all axes: `[layer]`. Without this table there is none."""

    nci: bool = Field(default=False, description="NCI: channels. Not in this version; their symbols are there.")
    cam: bool = Field(default=False, description="CAM: cams. Not in this version; their symbols are there.")
    xfc: bool = Field(
        default=False,
        description="XFC: touch probes and trigger boxes. Not in this version; their symbols are there.",
    )
    saw: bool = Field(default=False, description="SAW: flying saws. Not in this version; their symbols are there.")
    paths: Literal["windows", "bsd"] = Field(
        default="bsd", description="BSD: how NCI_DIR and LOG_DIR are written, which clients read; nothing else."
    )
    test: bool = Field(
        default=False,
        description="TEST: GVL_MSG_AXIS.MessageLevel begins as eMessageVerbose; default: the level of `[log]`, errors "
        "only without it.",
    )
    timeout: Duration = Field(
        default=5.0,
        description="How long an axis may take to enable or disable, greater than 0 (s); then it is an error.",
    )
    divisor: DivisorDescription = Field(
        default_factory=DivisorDescription, description="In every how many ticks each namespace runs."
    )
    phase: PhaseDescription = Field(default_factory=PhaseDescription, description="In which of these ticks.")
    map: dict[str, MapDescription] = Field(
        default_factory=dict,
        description="What controllers reach by byte images instead of symbols, by name. Images are called "
        "NAME_in.AxisCtrl, NAME_out.AxisState …; those of a map of all objects of its group "
        "MAPPING_AXIS_in.AxisCtrl ….",
    )

    @field_validator(*LATER)
    @classmethod
    def _is_not_built(cls, value: bool, info: ValidationInfo) -> bool:
        if value:
            what = LATER[str(info.field_name)]
            allowed = f"false: this version does not carry out {what}; their symbols are there and answer NOT_EXIST"
            raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return value


class ControlDescription(SizesDescription):
    """Ctrl and State of a motion layer in another machine: `[control]`. Programs use them as they use their own."""

    axes: Annotated[tuple[Text, ...], NotEmpty] = Field(
        strict=False,  # TOML gives a list
        description="Names of the axes there, in the order of the images; the first one has index 1.",
    )
    groups: Annotated[tuple[Group, ...], NotEmpty] = Field(
        default=("axis",),
        strict=False,  # TOML gives a list
        description="What is mapped there for this machine, as the group of a map.",
    )
    selector: bool = Field(default=True, description="The map there also holds the parameter selector.")
    switches: bool = Field(default=False, description="The map there also holds limit switches.")

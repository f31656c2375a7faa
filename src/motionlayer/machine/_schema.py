"""The JSON schema of the machine file, for editors.

It is the one of the models, so that messages, editors and checks cannot say different things. What spans several
tables, such as a group that names its axes, no schema can say: `motionlayer check` does.
"""

import copy
from typing import Any, Final

from pydantic import ConfigDict, Field

from motionlayer.machine._description import Description
from motionlayer.machine._module_description import ModuleDescription
from motionlayer.machine._names import SECTIONS

DRAFT: Final = "https://json-schema.org/draft/2020-12/schema"


def _axes_may_be_elsewhere(schema: dict[str, Any]) -> None:
    """Complete the JSON schema: axes of modules are axes too, and a control side commands those of another machine."""
    schema["anyOf"] = [{"required": [key]} for key in ("axis", "module", "control")]


class MachineFile(Description):
    """A machine file as it is written; modules are part of the tables once it has been read."""

    model_config = ConfigDict(json_schema_extra=_axes_may_be_elsewhere)

    module: tuple[ModuleDescription, ...] = Field(
        default=(),
        strict=False,  # TOML gives a list
        description="Files whose tables become part of this one, in this order.",
    )


def machine_schema() -> dict[str, Any]:
    """Return the schema (draft 2020-12) of a machine file; `x-unit` is the unit of a number."""
    return {"$schema": DRAFT, **_for_toml(MachineFile.model_json_schema()), "title": "motionlayer machine file"}


def module_schema() -> dict[str, Any]:
    """Return the schema (draft 2020-12) of a module file."""
    schema = machine_schema()
    kept = ("format", *SECTIONS, "module")
    schema["properties"] = {key: schema["properties"][key] for key in kept if key in schema["properties"]}
    del schema["anyOf"]
    return {
        **schema,
        "title": "motionlayer module file",
        "description": "A part of a machine, included by `[[module]]`.",
        "required": ["format"],
    }


def _is_noise(key: str, value: object) -> bool:
    """Tell a default of null, and the titles that pydantic makes of the names of keys."""
    return (key == "default" and value is None) or (key == "title" and isinstance(value, str))


def _for_toml(node: Any) -> Any:  # noqa: ANN401 - any JSON
    """Return a schema without null, which TOML does not have: what is left out is not there."""
    if isinstance(node, list):
        return [_for_toml(one) for one in node]
    if not isinstance(node, dict):
        return copy.copy(node)
    made = {key: _for_toml(value) for key, value in node.items() if not _is_noise(key, value)}
    options = [one for one in made.get("anyOf", []) if one != {"type": "null"}]
    if len(options) == 1:
        made = {**options[0], **{key: value for key, value in made.items() if key != "anyOf"}}
    return made

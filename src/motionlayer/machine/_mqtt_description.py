"""The table `[ads.mqtt]`: a broker by which ADS clients reach the server too."""

from typing import TYPE_CHECKING, Annotated, TypeAlias

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Table, Text

if TYPE_CHECKING:
    from motionlayer.connect.ads import Mqtt


def _prefix(text: str) -> str:
    if any(sign in text for sign in "+#\0") or not all(text.split("/")) or text.startswith("$"):
        allowed = "the beginning of MQTT topics: words with / between, without + and #, not beginning with $"
        raise PydanticCustomError("relation", "relation", {"allowed": allowed})
    return text


Prefix: TypeAlias = Annotated[str, AfterValidator(_prefix)]


class MqttDescription(Table):
    """A broker by which ADS clients reach the server too: `[ads.mqtt]`. Without this table TCP is the only way.

    A user and a password, where the broker asks for them, are taken from the environment.
    """

    broker: Text = Field(default="127.0.0.1", description="Host name or address of the broker.")
    port: int = Field(default=1883, ge=1, le=65_535, description="TCP port of the broker, 1 to 65 535.")
    network: Prefix = Field(
        default="VirtualAmsNetwork1",
        description="What all topics of the network begin with; its members use the same. In a network every NetId is "
        "there once, so `net_id` is best one of its own.",
    )

    def mqtt(self, name: str) -> "Mqtt":
        """Return the same for the server.

        Args:
            name: of the machine, which the other members of the network see.
        """
        from motionlayer.connect.ads import Mqtt  # noqa: PLC0415 - where a machine has [ads.mqtt]

        return Mqtt(self.broker, self.port, self.network, name)

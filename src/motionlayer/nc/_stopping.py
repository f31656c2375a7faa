"""`stopping`: motion that ends with a block."""

import contextlib
from collections.abc import AsyncIterator

from motionlayer.nc._axis import Axis


@contextlib.asynccontextmanager
async def stopping(*axes: Axis) -> AsyncIterator[None]:
    """Halt the axes when the block is left, however it is left, and wait until they rest.

    Cancelling a wait alone never stops motion; this does: `async with stopping(x, y): ...`.
    """
    try:
        yield
    finally:
        brakes = [axis.abandon() for axis in axes]
        for brake in brakes:
            if brake is not None:
                await brake.settled()

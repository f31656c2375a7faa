"""Keeps the run going for an hour, for clients that come and go."""

from motionlayer import RealTime, Simulation


async def main(run: Simulation | RealTime) -> None:
    await run.sleep(3600.0)

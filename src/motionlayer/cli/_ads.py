"""The ADS server of a run, and addresses of ADS servers on the command line."""

import click

from motionlayer.cli._options import Options
from motionlayer.machine import AdsDescription, Machine, MachineRun

FOREVER = 1e9
"""Seconds of a run that clients alone command: it goes on until somebody ends it."""


def ads_of(machine: Machine, options: Options) -> AdsDescription | bool:
    """Return the table `[ads]` with what the option says in its place."""
    table = machine.description.ads
    if options.ads is None:
        return table or False
    host, port = address(options.ads)
    changes = {"host": host, "port": port}
    given = table.model_dump() if table is not None else {}
    return AdsDescription.model_validate({**given, **{name: one for name, one in changes.items() if one is not None}})


def address(text: str) -> tuple[str | None, int | None]:
    """Return host and port of `HOST`, `PORT`, `:PORT`, `HOST:PORT` or `[HOST]:PORT`; None for what is not given.

    Raises:
        BadParameter: the port is none.
    """
    host, colon, port = text.rpartition(":")
    if not (colon or port.isdecimal()) or port.endswith("]"):
        return text.strip("[]") or None, None
    if not port.isdecimal() or int(port) > 65_535:
        raise click.BadParameter(f"{text!r}: the port must be 0 to 65535, as in 127.0.0.1:48898", param_hint="--ads")
    return host.strip("[]") or None, int(port)


def lines(run: MachineRun) -> list[str]:
    """Return where clients reach a run."""
    if not run.serves_ads:
        return []
    return [f"{run.ads.host}:{run.ads.port}, NetId {run.ads.net_id}, port 851"]

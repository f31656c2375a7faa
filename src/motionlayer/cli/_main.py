"""The group of all commands, and what becomes of errors that no command expects."""

import traceback
from typing import Any, NoReturn

import click

from motionlayer import __version__
from motionlayer.cli._bench import bench
from motionlayer.cli._check import check
from motionlayer.cli._error import error
from motionlayer.cli._exit import ExitCode, Stop, complain, exit_codes
from motionlayer.cli._export import export
from motionlayer.cli._new import new
from motionlayer.cli._plot import plot
from motionlayer.cli._replay import replay
from motionlayer.cli._run import run
from motionlayer.cli._schema import schema
from motionlayer.cli._soak import soak
from motionlayer.cli._symbols import symbols
from motionlayer.cli._verify import verify
from motionlayer.cli._watch import watch


class _Group(click.Group):
    """Commands whose every end has an exit code."""

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401 - as click has it
        try:
            return super().invoke(ctx)
        except Stop as stop:
            return _end(ctx, stop.code, str(stop))
        except KeyboardInterrupt:
            return _end(ctx, ExitCode.INTERRUPTED, "interrupted")
        except (click.ClickException, click.exceptions.Exit, click.Abort, BrokenPipeError):
            raise
        except Exception as error:  # noqa: BLE001 - whatever it is, it has an exit code
            if isinstance(error, ImportError) and "MOTIONLAYER_KERNELS" in str(error):
                return _end(ctx, ExitCode.USAGE, str(error))
            text = f"a fault of motionlayer itself; please report it with these lines:\n{traceback.format_exc()}"
            return _end(ctx, ExitCode.FAULT, text.rstrip())

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - as click has it
        # In the order in which they are used, not of the alphabet.
        return list(self.commands)


def _end(ctx: click.Context, code: ExitCode, message: str) -> NoReturn:
    complain(message)
    ctx.exit(code)


@click.group(cls=_Group, epilog=exit_codes(), context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="motionlayer")
def group() -> None:
    """Motion runtime: axes planned, sampled, recorded and checked."""


for _command in (new, check, run, verify, plot, replay, soak, symbols, watch, bench, schema, export, error):
    group.add_command(_command)


def main() -> None:
    """Run the command line and exit with an `ExitCode`."""
    group.main(prog_name="motionlayer")

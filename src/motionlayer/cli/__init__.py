"""The command `motionlayer`.

Each command has a file of its own that imports click and nothing else; what a command needs is imported when it
runs. So `--help` and completion load neither NumPy nor the validation library, and answer at once.

Results go to stdout, and so does what programs print; errors, notes and progress go to stderr. Nobody has to read
either to learn how it ended: every end has its own `ExitCode`. The wall clock is read here, for progress and for
the summary, and never reaches a run.
"""

from motionlayer.cli._exit import ExitCode
from motionlayer.cli._main import main

__all__ = ["ExitCode", "main"]

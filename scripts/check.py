"""Run every check: format, lint, types, import contracts, tests. `--all` takes the slow tests and all examples."""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = Path(sys.executable).parent


def steps(*, everything: bool) -> dict[str, list[str]]:
    """Return the commands by name, in order, the quick ones first."""
    selection = [] if everything else ["-m", "not slow", "--hypothesis-profile", "quick"]
    return {
        "format": [str(BIN / "ruff"), "format", "--check", "."],
        "lint": [str(BIN / "ruff"), "check", "."],
        "contracts": [str(BIN / "lint-imports")],
        "types": [str(BIN / "mypy")],
        "tests": [sys.executable, "-m", "pytest", "-q", "-n", "auto", "--dist", "worksteal", *selection],
    }


def environment() -> dict[str, str]:
    """Return the environment with bytecode allowed: hundreds of processes would compile every source anew without."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def main() -> int:
    """Run all steps even if one fails; return 1 if any did."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true", help="the slow tests too, and all examples of the random ones")
    failed = []
    for name, command in steps(everything=parser.parse_args().all).items():
        print(f"== {name}", flush=True)
        began = time.monotonic()
        if subprocess.run(command, cwd=ROOT, env=environment(), check=False).returncode:
            failed.append(name)
        print(f"-- {name}: {time.monotonic() - began:.1f} s", flush=True)
    print("FAILED: " + ", ".join(failed) if failed else "all checks passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

"""Write requirements.lock: every package the project and its tests need, pinned with hashes, for all platforms."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    """Resolve with uv, fetched into a throw-away environment by pip's own `--target`."""
    command = [
        sys.executable, "-m", "uv", "pip", "compile", "pyproject.toml", "--group", "dev",
        "--universal", "--python-version", "3.11", "--generate-hashes", "--no-header", "--no-emit-index-url",
        "--no-emit-find-links", "--quiet", "--output-file", "requirements.lock",
    ]  # fmt: skip
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "uv"], check=True)
    subprocess.run(command, check=True, cwd=ROOT)


if __name__ == "__main__":
    main()

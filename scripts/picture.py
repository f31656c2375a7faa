"""Take the picture for the README: the upper part of a page that `motionlayer run --plot` wrote.

python scripts/picture.py out/gantry.html docs/images/gantry.png
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from _png import shrink

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
WIDTH, HEIGHT = 1400, 1250
LONGEST = 120.0  # for the browser, s
STILL = "<style>.modebar { display: none; } body { overflow: hidden; }</style></head>"


def browser() -> str:
    """Return the browser to draw with.

    Raises:
        SystemExit: there is none.
    """
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        sys.exit(f"no browser on the PATH; install one of {', '.join(BROWSERS)}")
    return found


def draw(page: Path, picture: Path, size: tuple[int, int]) -> None:
    """Draw the upper part of a page, without its buttons and scroll bar."""
    with tempfile.TemporaryDirectory() as folder:
        still, drawn = Path(folder, "page.html"), Path(folder, "page.png")
        still.write_text(page.read_text(encoding="utf-8").replace("</head>", STILL, 1), encoding="utf-8")
        command = [
            browser(), "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--hide-scrollbars",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            f"--user-data-dir={folder}/profile", f"--window-size={size[0]},{size[1]}",
            "--virtual-time-budget=8000", f"--screenshot={drawn}", still.as_uri(),
        ]  # fmt: skip
        done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=LONGEST)
        if not drawn.exists():
            sys.exit(f"{command[0]} drew nothing:\n{done.stderr}")
        picture.parent.mkdir(parents=True, exist_ok=True)
        picture.write_bytes(shrink(drawn.read_bytes()))


def main() -> None:
    """Read the arguments and draw."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("page", type=Path, nargs="?", default=Path("out/gantry.html"))
    parser.add_argument("picture", type=Path, nargs="?", default=Path("docs/images/gantry.png"))
    parser.add_argument("--height", type=int, default=HEIGHT, help="px")
    given = parser.parse_args()
    if not given.page.is_file():
        sys.exit(f"{given.page}: no such page; `make demo` writes it")
    draw(given.page, given.picture, (WIDTH, given.height))
    print(f"{given.picture}: {given.picture.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()

"""Generated pages: written where they are not what the code says, or only compared."""

import argparse
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def current(purpose: str, script: str, folder: Path, pages: Mapping[str, str]) -> int:
    """Write the files that differ; with `--check` on the command line only name them.

    Args:
        purpose: of the script, for its help.
        script: path of it below the checkout, for the message.
        folder: of the pages; made where there is none.
        pages: texts by the names of their files.

    Returns:
        The exit code: 1 if a page differs and is not to be written.
    """
    parser = argparse.ArgumentParser(description=purpose)
    parser.add_argument("--check", action="store_true", help="compare only")
    check = parser.parse_args().check
    stale = {name: text for name, text in pages.items() if not _same(folder / name, text)}
    for name, text in stale.items():
        if not check:
            folder.mkdir(exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8")
        shown = (folder / name).relative_to(ROOT).as_posix()
        print(f"{shown}: " + (f"is not what the code says; run {script}" if check else "written"))
    return 1 if check and stale else 0


def _same(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text

"""``python -m uplift_urs`` is the program ``uplift``."""

import os
import subprocess
import sys

from ._program import find_program


def main() -> None:
    """Replace this process by the program."""
    program = os.fspath(find_program())
    if sys.platform == "win32":
        sys.exit(subprocess.run([program, *sys.argv[1:]]).returncode)
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()

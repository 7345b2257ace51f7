"""python3 -m hybridgv: the sub-commands of the program hybridgv, and hloc."""

from __future__ import annotations

import sys
from typing import List

from . import _core

_HELP = """Usage: python3 -m hybridgv COMMAND [OPTIONS]

Commands:
  image_registrator, localize   those of the program hybridgv
  hloc                          localizes query images by files of hloc; takes the options of hloc.localize_sfm
"""


def main(arguments: List[str]) -> int:
    """Runs a sub-command and returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        print(_HELP, end="", file=sys.stdout if arguments else sys.stderr)
        return 0 if arguments else 2
    try:
        if arguments[0] == "hloc":
            from . import hloc

            return hloc.run(arguments[1:])
        if not hasattr(_core, "run_program"):
            raise ValueError(f"{arguments[0]}: this module was built without the program")
        return _core.run_program(arguments[0], arguments[1:])
    except (OSError, ValueError, RuntimeError, ImportError) as error:
        print(f"hybridgv: {error}", file=sys.stderr)
        return 1


def run() -> int:
    """The program of a wheel."""
    return main(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(run())

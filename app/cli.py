"""What `deltalab` starts. It imports next to nothing, so that Ctrl-C is heeded from the first moment."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from app.errors import UserMistake

EXIT_MISTAKE = 2
EXIT_INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command line; returns the exit status. A user's mistake is one sentence on stderr."""
    # The matrices here are tiny: threads of the linear algebra library cost milliseconds and save nothing. It looks
    # at this when it is loaded, and worker processes inherit it.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        from app.commands import run

        run(list(sys.argv[1:] if arguments is None else arguments))
    except UserMistake as mistake:
        print(mistake, file=sys.stderr)
        return EXIT_MISTAKE
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    return 0

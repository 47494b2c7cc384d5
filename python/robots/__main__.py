"""The command: ``python -m robots --help``."""

import sys

from ._native import main

sys.exit(main(sys.argv[1:]))

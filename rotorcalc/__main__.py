"""`python -m rotorcalc`: see `rotorcalc.batch.command`."""

import sys

from rotorcalc.batch.command import main

if __name__ == "__main__":
    sys.exit(main())

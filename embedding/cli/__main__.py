"""`python -m embedding.cli` is the same as `embedding`."""

import sys

from embedding.cli import main

sys.exit(main())

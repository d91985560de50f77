"""How fast: ratios made in one run, so that they mean the same on every machine."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read once, when numpy loads OpenBLAS: as in a run

#!/bin/sh
# Makes benchmarks/peers/.venv with the peers that the benchmarks run beside this package: `sh benchmarks/peers/setup.sh`.
# Needs Python 3.11 and 400 MB; PYTHON names another interpreter that the wheels exist for.
set -eu
cd "$(dirname "$0")"
[ -x .venv/bin/python ] || "${PYTHON:-python3.11}" -m venv .venv
.venv/bin/python -m pip install --quiet --requirement requirements.txt

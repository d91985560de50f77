#!/bin/sh
# Makes .venv and installs the package into it: `sh setup.sh [EXTRA]`, EXTRA one of pictures, test, docs.
# On Debian and Ubuntu it also installs missing system packages, where it may (as root); elsewhere it names them.
set -eu
cd "$(dirname "$0")"
PATH="$PATH:/usr/sbin:/sbin"                                          # where ldconfig lives
extra="${1:-pictures}"
python="${PYTHON:-python3}"

has_library() { ldconfig -p 2>/dev/null | grep -q "$1"; }
missing=""
"$python" -c "import ensurepip" 2>/dev/null || missing="$missing python3-venv"
has_library libquadmath.so.0 || missing="$missing libquadmath0"       # OpenBLAS of the ngsolve wheel needs it
if [ "$extra" != docs ]; then                                          # off-screen pictures without a display
    has_library libEGL.so.1 || missing="$missing libegl1"
    [ -n "$(find /usr/lib -name 'swrast_dri.so' -print -quit 2>/dev/null)" ] || missing="$missing libgl1-mesa-dri"
fi
if [ -n "$missing" ]; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        apt-get update -qq
        # shellcheck disable=SC2086  # a list of packages
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
    else
        echo "setup.sh: please install these system packages first (Debian names):$missing" >&2
        exit 1
    fi
fi

[ -x .venv/bin/python ] || "$python" -m venv .venv
.venv/bin/python -m pip install --quiet --editable ".[$extra]"
.venv/bin/python -m compileall -q embedding problems                 # some Pythons are told not to keep what they compile

#!/usr/bin/env bash
# setup.sh VENV WHAT: a virtual environment with WHAT installed editable; says in one line what is missing.
set -euo pipefail
venv=$1 what=$2
fail() { echo "error: $1" >&2; exit 2; }

python=""
for name in python3 python3.14 python3.13 python3.12 python3.11; do
  if "$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then python=$name; break; fi
done
[ -n "$python" ] || fail "Python 3.11 or newer is missing: install it from python.org or your system's packages"
command -v cargo >/dev/null || fail "cargo is missing: install Rust by rustup (rustup.rs)"
said=$(cargo --version 2>&1) || fail "cargo does not run: $said"
command -v cc >/dev/null || fail "a linker (cc) is missing: install your system's C toolchain (Debian: apt-get install gcc)"
"$python" -c 'import venv, ensurepip' 2>/dev/null \
  || fail "$python has no venv: install it (Debian: apt-get install python3-venv)"

[ -x "$venv/bin/pip" ] || "$python" -m venv "$venv"
echo "  building antumbra (the first time takes some minutes, later seconds)" >&2
log=$venv/build.log
"$venv/bin/pip" install --quiet --disable-pip-version-check -c constraints.txt -e "$what" >"$log" 2>&1 \
  || { cat "$log" >&2; fail "the build failed; the lines above say where"; }

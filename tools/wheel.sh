#!/usr/bin/env bash
# wheel.sh [quick]: a wheel in dist/, audited. By default for Linux of glibc 2.17 and newer (manylinux2014, linked by zig
# where it can be had), in the `release` profile; `quick`: for this system, in the `demo` profile that is built already.
# Both give the same bits; the release profile is some percent faster and takes minutes to build.
set -euo pipefail
cd "$(dirname "$0")/.."
what=${1:-release}
venv=.venv-wheel
python=$([ -x .venv/bin/python ] && echo .venv/bin/python || echo python3)
[ -x $venv/bin/pip ] || "$python" -m venv $venv
pip() { $venv/bin/pip --quiet --disable-pip-version-check "$@"; }
pip install -c constraints.txt maturin abi3audit
flags=(--locked --out dist)
if [ "$what" = quick ]; then
  flags+=(--profile demo)
else
  flags+=(--release)
  if [ "$(uname -s)" = Linux ]; then
    if pip install -c constraints.txt ziglang auditwheel; then
      flags+=(--zig --compatibility manylinux2014)
    else
      echo "note: zig cannot be had: the wheel is for this system's glibc and newer" >&2
    fi
  fi
fi
rm -f dist/antumbra-*.whl
PATH="$PWD/$venv/bin:$PATH" maturin build "${flags[@]}"
[ "$what" = quick ] || [ ! -x $venv/bin/auditwheel ] || $venv/bin/auditwheel show dist/antumbra-*.whl
$venv/bin/abi3audit --strict --summary dist/antumbra-*.whl

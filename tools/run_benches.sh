#!/usr/bin/env bash
# Kernels by the bench library, then every race under benches/races against its peers.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo bench --locked
for race in benches/races/*.py; do
  [ -e "$race" ] || continue
  echo "== $race"
  .venv/bin/python "$race"
done

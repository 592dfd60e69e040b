#!/usr/bin/env bash
# Kernels by the bench library, then every race under benches/races against its peers; options go to the races.
# The peers live in .venv-bench (`make bench` sets it up). A run with --quick leaves no file under benches/results.
set -euo pipefail
cd "$(dirname "$0")/.."

export PYTHONPATH=benches
result=$(.venv-bench/bin/python -c 'import race; print(race.result_path())')
case " $* " in *" --quick "*) result=target/races-quick.json; rm -f "$result" ;; esac

PYO3_PYTHON=$PWD/.venv-bench/bin/python cargo bench --locked --profile demo --quiet -p antumbra-trace --bench kernels
for race in benches/races/*.py; do
  echo "== $race"
  .venv-bench/bin/python "$race" --result "$result" "$@"
done
.venv-bench/bin/python benches/table.py "$result"

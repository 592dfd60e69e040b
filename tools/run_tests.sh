#!/usr/bin/env bash
# Every test, Rust then Python, then one closing line with both counts. Exit code 1 if anything failed.
set -uo pipefail
cd "$(dirname "$0")/.."
log=$(mktemp); trap 'rm -f "$log"' EXIT
ok=0
# With --workspace the dependencies have the features that the installed core was built with: nothing is compiled twice.
cargo test --locked --profile demo --workspace --quiet 2>&1 | tee -a "$log" || ok=1
# Two at a time: most of a test is Python and a browser, which know one core. A file stays together, so do its pictures.
.venv/bin/python -m pytest -n 2 --dist loadfile 2>&1 | tee -a "$log" || ok=1
awk -v ok=$ok '
  /^test result:/ { passed += $4; failed += $6; skipped += $8 }
  /^([0-9]+ [a-z]+, )*[0-9]+ [a-z]+ in [0-9.]+s/ {
    for (i = 1; i < NF; i++) {
      if ($(i + 1) ~ /^passed/) passed += $i
      if ($(i + 1) ~ /^(failed|error)/) failed += $i
      if ($(i + 1) ~ /^skipped/) skipped += $i
    }
  }
  END {
    if (ok && !failed) print "error: a test program ended before its count"
    printf "%d passed, %d failed%s\n", passed, failed, skipped ? ", " skipped " skipped" : ""
  }' "$log"
exit $ok

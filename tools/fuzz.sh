#!/usr/bin/env bash
# Fuzzes every target of fuzz/targets.rs for so many seconds (300), two at a time; findings lie in fuzz/found.
# tools/fuzz.sh [SECONDS [TARGET ...]]
set -euo pipefail
cd "$(dirname "$0")/../fuzz"
seconds=${1:-300}; shift || true
targets=("$@")
if [ ${#targets[@]} = 0 ]; then mapfile -t targets < <(ls corpus); fi
host=$(rustc -vV | sed -n 's/^host: //p')
# Coverage for libFuzzer; what `cargo fuzz` sets, without its nightly compiler.
export RUSTFLAGS="--cfg fuzzing -Ccodegen-units=1 -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
-Cllvm-args=-sanitizer-coverage-trace-compares"
cargo build --locked --release --quiet --target "$host" --target-dir ../target/fuzz
binary=$PWD/../target/fuzz/$host/release/antumbra-fuzz
mkdir -p found ../target/fuzz/grown
# What is new goes into target/fuzz/grown; the corpus itself is only read.
one() {
  local grown=../target/fuzz/grown/$1 log=../target/fuzz/$1.log
  mkdir -p "$grown"
  ANTUMBRA_FUZZ=$1 "$binary" "$grown" "corpus/$1" -max_total_time="$2" -timeout=10 -rss_limit_mb=3000 \
    -max_len=16384 -artifact_prefix="found/$1-" >"$log" 2>&1 || { echo "$1: a finding, see fuzz/found and ${log#../}"; return 1; }
  echo "$1: $(tail -1 "$log")"
}
export -f one; export binary
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c "one {} $seconds"

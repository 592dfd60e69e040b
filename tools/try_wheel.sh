#!/usr/bin/env bash
# try_wheel.sh: installs the wheel of dist/ into a bare environment without Rust, looks whether every file of the package
# came along, and renders there: the same bits as the command of this repository's environment.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
bare=$(mktemp -d)
trap 'rm -rf "$bare"' EXIT
.venv/bin/python -m venv "$bare/venv"
# What a person without Rust has: no cargo, none of this repository's programs.
export PATH="$bare/venv/bin:/usr/bin:/bin"
unset PYTHONPATH CARGO_HOME RUSTUP_HOME
if command -v cargo >/dev/null || command -v rustc >/dev/null; then
  echo "note: Rust is in /usr/bin here: that the wheel needs none is not shown" >&2
fi
pip install --quiet --disable-pip-version-check -c constraints.txt dist/antumbra-*.whl
cd "$bare"
package=$(python -c 'import antumbra, pathlib; print(pathlib.Path(antumbra.__file__).parent)')
missing=$(git -C "$root" ls-files python/antumbra | sed 's|^python/antumbra/||' \
  | while read -r file; do [ -e "$package/$file" ] || echo "$file"; done)
[ -z "$missing" ] || { echo "error: the wheel lacks: $missing" >&2; exit 1; }
bits() { "$1" render cornell-box --size 96x72 --viewing-rays 8 --quiet -o "$bare/c.exr" | sed 's/.*same bits: //'; }
wheel=$(bits antumbra)
source=$(bits "$root/.venv/bin/antumbra")
[ -n "$wheel" ] && [ "$wheel" = "$source" ] || { echo "error: wheel $wheel, source $source" >&2; exit 1; }
echo "$(basename "$root"/dist/antumbra-*.whl): cornell-box without Rust, same bits as the source build: $wheel"

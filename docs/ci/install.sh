#!/usr/bin/env bash
# Installs the command `congruent` into FOLDER/bin: the binary of release VERSION in RELEASES, whose check sum is verified, or a build of
# the sources in SOURCE, by default those that this file is in.
#   VERSION=0.1.0 RELEASES=https://github.com/OWNER/congruent/releases/download docs/ci/install.sh FOLDER
set -euo pipefail

folder="$1"
source="${SOURCE:-$(cd "$(dirname "$0")/../.." && pwd)}"

target() {
  case "$(uname -s)-$(uname -m)" in
    Linux-x86_64) echo x86_64-unknown-linux-gnu ;;
    Linux-aarch64) echo aarch64-unknown-linux-gnu ;;
    Darwin-x86_64) echo x86_64-apple-darwin ;;
    Darwin-arm64) echo aarch64-apple-darwin ;;
    MINGW*-x86_64 | MSYS*-x86_64) echo x86_64-pc-windows-msvc ;;
    *) return 1 ;;
  esac
}

fetch() { curl --fail --silent --show-error --location --retry 3 --output "$1" "$RELEASES/v$VERSION/$1"; }

sum() { if command -v sha256sum >/dev/null; then sha256sum "$1"; else shasum --algorithm 256 "$1"; fi | cut -d ' ' -f 1; }

# Fails where there is no such release or no binary for this machine; a wrong check sum ends the script.
install_binary() {
  local archive="congruent-$(target).tar.gz" work
  case "$archive" in *windows*) archive="${archive%.tar.gz}.zip" ;; congruent-.tar.gz) return 1 ;; esac
  work="$(mktemp -d)"
  cd "$work"
  fetch "$archive" && fetch "$archive.sha256" || return 1
  if [ "$(sum "$archive")" != "$(cut -d ' ' -f 1 "$archive.sha256")" ]; then
    echo "$archive is not what its check sum says" >&2
    exit 3
  fi
  mkdir -p "$folder/bin"
  case "$archive" in
    *.zip) unzip -q -o "$archive" -d "$folder/bin" ;;
    *) tar --extract --gzip --file "$archive" --directory "$folder/bin" ;;
  esac
}

if [ -n "${VERSION:-}" ] && [ -n "${RELEASES:-}" ] && (install_binary); then
  exit 0
elif [ "$?" = 3 ]; then
  exit 1
fi
echo "no binary of congruent ${VERSION:-} for this machine: it is built" >&2
cargo install --locked --path "$source/crates/cli" --root "$folder"

#!/usr/bin/env bash
# Makes the pictures of pages here, report_check.png, report_pick.png and report_wrong_convention.png, with the program that is
# built and a Chromium that is installed: `docs/images/make_pages.sh` from the root of the repository.
set -euo pipefail
cd "$(dirname "$0")/../.."
congruent=${CARGO_TARGET_DIR:-target}/release/congruent
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || command -v chrome) ||
  { echo "no Chromium is installed" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A page as a picture of this height.
picture() { # PAGE HEIGHT NAME
  "$browser" --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --hide-scrollbars --user-data-dir="$work/profile" \
    --virtual-time-budget=5000 --window-size="1240,$2" --screenshot="$PWD/docs/images/$3" "file://$1" 2>"$work/log" ||
    { cat "$work/log" >&2; exit 1; }
}

"$congruent" check robots/ur5e/wrong_convention.toml --html "$work/check.html" >"$work/check.txt" || test $? = 1
"$congruent" run scenarios/ur5e_pick.toml --out "$work/out" >"$work/run.txt"
"$congruent" run scenarios/ur5e_wrong_convention.toml --out "$work/out" >"$work/run.txt"
picture "$work/check.html" 900 report_check.png
picture "$work/out/ur5e_pick/report.html" 1240 report_pick.png
picture "$work/out/ur5e_wrong_convention/report.html" 1000 report_wrong_convention.png

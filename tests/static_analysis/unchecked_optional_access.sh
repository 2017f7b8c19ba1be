#!/usr/bin/env bash
# Reports each access to a std::optional that may be empty, in the folders of the engine that read files.
# Files are untrusted, and such an access is undefined behaviour.
#   unchecked_optional_access.sh [INCLUDE_FOLDER...]    # of the libraries that the engine includes
# Without clang-tidy, exits with 77, which CTest shows as skipped. With CI=true that is an error.
set -euo pipefail
cd "$(dirname "$0")/../.."

tidy=clang-tidy-19  # 14 does not have this check, and 16 crashes in it
folders=(batch doctor io json recipe run)

if ! command -v $tidy >/dev/null; then
  echo "There is no $tidy. Install it with tools/setup/install-packages --clang." >&2
  [ "${CI:-}" != true ] || exit 1
  exit 77
fi
includes=()
# Unlike -isystem, -idirafter may repeat /usr/include.
for folder in "$@"; do includes+=(-idirafter "$folder"); done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
for folder in "${folders[@]}"; do
  # As one unit, a folder takes a tenth of the time of its files.
  printf "#include \"$PWD/%s\"\n" engine/lapwing/"$folder"/*.cpp >"$work/$folder.cpp"
  $tidy --quiet --config='{}' --checks='-*,bugprone-unchecked-optional-access' \
    --warnings-as-errors='*' --header-filter="lapwing/($(IFS='|'; echo "${folders[*]}"))/" \
    "$work/$folder.cpp" -- -std=c++20 -I engine "${includes[@]}" || status=1
done
exit $status

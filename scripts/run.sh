# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up a bare machine, builds, and makes the main example's pictures and numbers:
#   sh scripts/run.sh
. "$(dirname -- "$0")/setup.sh"

example=examples/03_laying.lua
output=out/laying

root=$(root_of "$0") && cd -- "$root" || exit 1
need build run
build_all . || exit 1
stage "running $example"
build/softworld "$example" || {
  status=$?
  echo "$example failed (exit status $status); its words are above."
  exit "$status"
}
stage "done; pictures and numbers are in $root/$output:"
found=
for file in "$output"/*; do
  [ -e "$file" ] || continue
  found=yes
  printf '  %8s  %s\n' "$(du -h -- "$file" | cut -f1)" "$file"
done
if [ -z "$found" ]; then
  echo "  nothing: $example wrote no file there"
  exit 1
fi

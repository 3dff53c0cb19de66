# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up a bare machine, builds, and runs all tests. The last line is
# "N passed, N failed"; the exit status is 0 if none failed:
#   sh scripts/test.sh [paths and options of scripts/spec.lua]
. "$(dirname -- "$0")/setup.sh"

root=$(root_of "$0") && cd -- "$root" || exit 1
need build run test
build_all . || {
  echo "0 passed, 1 failed"
  exit 1
}
stage "testing"
# Not through make, which would print another line after the last one.
exec build/softworld scripts/spec.lua "$@"

# SPDX-License-Identifier: GPL-3.0-or-later
# One command from a bare machine to all tests; the last line is
# "N passed, N failed" and the exit status says the same:
#   sh scripts/test.sh [paths and options of scripts/spec.lua]
. "$(dirname -- "$0")/setup.sh"

root=$(root_of "$0") && cd -- "$root" || exit 1
need build run test
build_all . || {
  echo "0 passed, 1 failed"
  exit 1
}
stage "testing"
# Not through make: it would print its own line after the closing one.
exec build/softworld scripts/spec.lua "$@"

# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the missing packages to build, run, test and lint. Run it, or source
# it (as run.sh and test.sh do) for root_of, stage and need.
#
#   sh scripts/setup.sh          packages to build and run
#   sh scripts/setup.sh --test   also packages for the tests
#   sh scripts/setup.sh --lint   also packages for `make lint` and `make format`
#   sh scripts/setup.sh --manual packages to build, run and `make manual`
#
# It uses POSIX sh and the base system only: a bare Debian 12 has no make, sudo,
# curl, python3 or pkg-config. It downloads nothing if nothing is missing.

# Rows of "set package". This is the only place where packages are named.
packages() {
  cat <<'LIST'
build gcc              # the compiler
build make             # reads the Makefile
build libc6-dev        # C headers; gcc only recommends them
build pkg-config       # finds the flags of the libraries
build lua5.4           # stock interpreter; named, or other Lua packages bring in Lua 5.2
build liblua5.4-dev    # the host program is linked to it
build libgsl-dev       # steppers, splines, fits, eigenvalues
build libnlopt-dev     # minimisers of studies
build libccd-dev       # distance and overlap of convex hulls
build libassimp-dev    # reads STL, OBJ, PLY and glTF meshes
build libqhull-dev     # convex hulls of point sets
build libsuitesparse-dev # order in which to eliminate sparse matrices
build libreadline-dev  # the interactive prompt
build zlib1g-dev       # makes the frames in a player small
build libcivetweb-dev  # serves the live view to browsers of this machine
build esbuild          # bundles the player's page
build libjs-three      # draws in it
build libjs-dygraphs   # charts in it
build fonts-dejavu-core # letters in pictures
run   gnuplot-nox      # charts
run   povray           # ray-traced pictures
run   ffmpeg           # films
manual cmark-gfm       # Markdown to HTML, for make manual
test  cmark-gfm        # for the spec of make manual
test  lua-busted       # the test framework
test  lua-check        # luacheck, for make lint
test  lua-filesystem   # directories, for the spec runner
test  chromium         # opens the player in specs
test  chromium-driver  # and lets them use it
test  lua-socket       # specs talk to it
test  lua-dkjson       # in JSON
test  slurmctld        # a cluster of one machine, for specs of studies
test  slurmd           # its node
test  slurm-client     # and sbatch, squeue, scancel
test  munge            # by which they know one another
lint  clang-tidy       # checks the C code
lint  clang-format     # make format
LIST
}

# Prints the directory above scripts/, for any current directory and CDPATH.
root_of() {
  CDPATH='' cd -- "$(dirname -- "$1")/.." && pwd -P
}

started=$(date +%s)

# Prints a line for a stage, with the seconds since the start.
stage() {
  printf '[%3d s] %s\n' "$(($(date +%s) - started))" "$*"
}

# Prints the given packages that are not installed, one per line.
missing() {
  have=" $(dpkg-query -W -f='${Package}=${db:Status-Status} ' "$@" 2>/dev/null) "
  for package in "$@"; do
    case $have in
      *" $package=installed "*) ;;
      *) echo "$package" ;;
    esac
  done
}

# Runs a command of apt and shows its progress in a few lines; the whole output goes to $log.
# The exit status is that of the command; `echo` passes it through the pipe.
condensed() {
  {
    "$@" 2>&1
    echo "exit-status $?"
  } | awk -v log_file="$log" '
    $1 == "exit-status" { status = $2; next }
    { print >> log_file; fflush(log_file) }
    /^Get:/ { if (++got % 50 == 0) tell(got " packages fetched") }
    /^Unpacking / { if (++unpacked % 50 == 0) tell(unpacked " packages unpacked") }
    /^Setting up / { if (++set % 50 == 0) tell(set " packages set up") }
    function tell(text) { print "        " text; fflush() }
    END { exit status }'
}

give_up() {
  echo
  echo "$1"
  echo "Install these packages as root, then start this again:"
  echo
  echo "  ${2}apt-get update && ${2}apt-get install -y --no-install-recommends $3"
  exit 1
}

# need SET...: installs the missing packages of these sets, or prints what to install.
need() {
  if [ -n "${SOFTWORLD_SKIP_SETUP:-}" ]; then return 0; fi # the libraries are not Debian's
  wanted=$(packages | while read -r set package _; do
    for s in "$@"; do [ "$s" = "$set" ] && echo "$package"; done
  done)
  # Names contain no blanks. Splitting into words is intended, here and below; so is the echo
  # that joins lines.
  # shellcheck disable=SC2086,SC2116
  if command -v dpkg-query >/dev/null 2>&1; then
    lacking=$(missing $wanted)
  else
    give_up "This is not a Debian system (no dpkg-query). The names below are those of Debian 12; \
with their counterparts installed, set SOFTWORLD_SKIP_SETUP=1." "" "$(echo $wanted)"
  fi
  if [ -z "$lacking" ]; then return 0; fi
  # shellcheck disable=SC2086,SC2116
  lacking=$(echo $lacking)
  # Alone, lua-busted accepts any Lua; with lua5.4 in the same call it uses 5.4.
  case " $lacking " in
    *" lua5.4 "*) ;;
    *" lua-"*) lacking="$lacking lua5.4" ;;
  esac

  if [ "$(id -u)" = 0 ]; then
    as_root=
  elif command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
    as_root=sudo
  else
    prefix=
    if command -v sudo >/dev/null 2>&1; then prefix='sudo '; fi
    give_up "Some packages are missing, and installing them needs root (or sudo)." "$prefix" "$lacking"
  fi

  stage "installing: $lacking"
  log=$(mktemp "${TMPDIR:-/tmp}/softworld-setup.XXXXXX") || exit 1
  # Error-Mode: without it apt-get reports success even if it reached no server.
  apt="$as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -o DPkg::Lock::Timeout=300"
  # shellcheck disable=SC2086
  if ! condensed $apt -qq -o APT::Update::Error-Mode=any update; then
    stage "apt-get update failed; trying with the package lists at hand. Its words:"
    sed 's/^/        /' "$log" | tail -n 6
  fi
  # shellcheck disable=SC2086
  if ! condensed $apt -q -y -o Dpkg::Use-Pty=0 install --no-install-recommends $lacking; then
    echo
    tail -n 12 "$log" | sed 's/^/        /'
    echo "        (all of it: $log)"
    give_up "apt-get could not install what is missing: is there a network, and are the sources in \
/etc/apt right?" "${as_root:+sudo }" "$lacking"
  fi
  rm -f -- "$log"
  # shellcheck disable=SC2086
  lacking=$(missing $lacking)
  if [ -n "$lacking" ]; then give_up "Still missing after apt-get install." "" "$lacking"; fi
}

# build_all ROOT: builds build/softworld and the module for stock Lua.
build_all() {
  stage "building (make)"
  make -s -C "$1" -j "$(nproc)" || {
    echo "The build failed; the compiler's words are above."
    return 1
  }
}

case ${0##*/} in
  setup.sh)
    case ${1:-} in
      '') need build run ;;
      --test) need build run test ;;
      --lint) need build run test lint ;;
      --manual) need build run manual ;;
      *)
        sed -n '2,8s/^# \{0,1\}//p' "$0"
        exit 2
        ;;
    esac
    stage "set up: nothing is missing"
    ;;
esac

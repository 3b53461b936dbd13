#!/usr/bin/env bash
# setup/prepare.sh program|tests: installs the packages that are missing, then configures and builds
# build/release: the program alone, or everything with warnings as errors. Called by ./nlcwfs and
# ./run-tests; prints to standard error only, so that the program's standard output stays clean.
# NLCWFS_SKIP_PACKAGES=1 goes on without looking at the distribution's packages.
set -euo pipefail
exec >&2
mode=$1
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
build=build/release
program=$build/studies/nlcwfs

say() { echo "nlcwfs: $*"; }
fail() {
  say "$@"
  exit 1
}

wanted_lines() {
  local last='# optional'
  grep -qsx 'ID=debian' /etc/os-release || last='# tests on Debian'
  [ "$mode" = tests ] || last='# tests'
  sed -e "/^$last\$/,\$d" -e '/^#/d' setup/packages.txt
}

explain_libraries() {
  cat <<END
Where the libraries are in a place of your own, tell CMake, and go on without the package check:
    NLCWFS_SKIP_PACKAGES=1 CMAKE_PREFIX_PATH=/opt/x:/opt/y $([ "$mode" = program ] && echo "./nlcwfs ..." || echo ./run-tests)
END
}

optional_lines() { sed '1,/^# optional$/d' setup/packages.txt; }

# Those of the lines that it is given.
install_packages() {
  local wanted present missing log=build/packages.log as_root=()
  wanted=$(sed 's/ .*//' <<<"$1")
  # shellcheck disable=SC2086
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' || true)
  missing=$(comm -23 <(sort <<<"$wanted") <(sort <<<"$present") | xargs)
  [ "$missing" ] || return 0

  if [ "$(id -u)" != 0 ]; then
    # sudo may ask for a password where there is a terminal to ask at, and only there.
    if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
      as_root=(sudo)
    else
      say "packages are missing that only root can install (with sudo or su), once:"
      echo "    apt-get install $missing"
      explain_libraries
      exit 1
    fi
  fi
  say "installing $(wc -w <<<"$missing") package(s): $missing"
  apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300 "$@" \
      </dev/null >>$log 2>&1 9>&-
  }
  : >$log
  # The package lists are fetched only where they are absent or too old to install from.
  # shellcheck disable=SC2086
  apt_get install --no-install-recommends $missing ||
    { apt_get update && apt_get install --no-install-recommends $missing; } || {
    tail -n 20 $log
    say "the packages could not be installed; the above is the end of $PWD/$log"
    explain_libraries
    exit 1
  }
}

configure() {
  if ! cmake --preset release "$@" >build/configure.log 2>&1; then
    cat build/configure.log
    say "CMake could not configure the build; it needs:"
    wanted_lines | sed 's/^[^#]*#/   /'
    explain_libraries
    exit 1
  fi
}

up_to_date() {
  [[ -f $build/build.ninja && $(cmake --build $build --target nlcwfs -- -n 2>&1) == *"no work to do"* ]]
}

if ! mkdir -p build 2>/dev/null || [ ! -w build ]; then
  # Somebody else's checkout: what they have built can still be run.
  [[ $mode == program && -x $program ]] && exit 0
  fail "$PWD cannot be written to, and the build goes to its folder build: work in a copy of your own"
fi
exec 9>build/.lock
flock 9  # one build at a time, however many commands start at once

if [ -f $build/CMakeCache.txt ] &&
  ! [ "$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' $build/CMakeCache.txt)" -ef . ]; then
  say "the checkout has moved: building anew"
  rm -r $build
fi
[[ $mode == program ]] && up_to_date && exit 0

if [[ ${NLCWFS_SKIP_PACKAGES:-0} == 0 ]] && command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  install_packages "$(wanted_lines)"
  if [ "$mode" = tests ]; then
    (install_packages "$(optional_lines)") || say "going on without these"
  fi
fi
if ! command -v cmake >/dev/null; then
  say "CMake is not installed; building needs:"
  wanted_lines | sed 's/^[^#]*#/   /'
  explain_libraries
  exit 1
fi
if [ "$mode" = tests ]; then
  configure -DNLCWFS_WARNINGS_AS_ERRORS=ON -DNLCWFS_BUILD_BENCHMARKS=ON
  target=all
else
  [ -f $build/build.ninja ] || configure -DNLCWFS_BUILD_TESTS=OFF
  target=nlcwfs
fi
if [ -x $program ]; then say "building what has changed"; else say "building; the first time takes a few minutes"; fi
cmake --build $build --target $target || fail "the build failed; the error is above"

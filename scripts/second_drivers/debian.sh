# shellcheck shell=bash
# Packages of Debian, from the mirror this machine uses, of suites other than the machine's own. Nothing is installed.

# The mirror of this machine, from apt's sources in either format.
mirror() {
  sed -n 's/^URIs: *\([^ ]*\).*/\1/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -n 1 | grep . ||
    sed -n 's/^deb \(\[[^]]*\] *\)\{0,1\}\([^ ]*\) .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null | head -n 1 | grep .
}

# use_suites FOLDER SUITE...: the lists of these suites, in FOLDER; apt_there then is apt-get with them, and without the
# packages that are installed here. A suite `src:NAME` is one of sources.
use_suites() {
  local suite kind uri keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  apt_folder=$1
  shift
  command -v apt-get >/dev/null || return 1
  uri=$(mirror) || return 1
  mkdir -p "$apt_folder/lists/partial" "$apt_folder/cache/archives/partial"
  : >"$apt_folder/sources.list"
  : >"$apt_folder/installed"
  for suite in "$@"; do
    kind=deb
    [ "${suite#src:}" = "$suite" ] || kind=deb-src
    echo "$kind [signed-by=$keyring] $uri ${suite#src:} main" >>"$apt_folder/sources.list"
  done
  apt_there update
}
apt_there() {
  apt-get -o "Dir::Etc::SourceList=$apt_folder/sources.list" -o Dir::Etc::SourceParts=/dev/null -o "Dir::State::Lists=$apt_folder/lists" \
    -o "Dir::State::status=$apt_folder/installed" -o "Dir::Cache=$apt_folder/cache" -o APT::Sandbox::User=root "$@"
}

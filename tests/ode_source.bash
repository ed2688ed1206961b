# Sourced by what needs the source of the installed ODE, for which Debian has no package.

# ode_version: that of the installed package.
ode_version() { dpkg-query -W -f='${source:Version}' libode-dev; }

# fetch_ode_source FOLDER: to FOLDER/source/ode-*/, by `apt-get source` with lists of its own: the system's are left alone.
fetch_ode_source() {
  local folder=$1 apt=$1/apt release
  mkdir -p "$apt/lists/partial" "$apt/archives/partial" "$folder/source"
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $release main" >"$apt/sources.list"
  # Without the user that apt downloads as when it is root, who may not write here.
  local options=(-q -o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=/dev/null -o "Dir::State::lists=$apt/lists"
    -o "Dir::Cache=$apt" -o "Dir::Cache::archives=$apt/archives" -o "APT::Sandbox::User=$(id -un)")
  apt-get "${options[@]}" update
  (cd "$folder/source" && apt-get "${options[@]}" source --only-source "ode=$(ode_version)")
}

# copy_clean_root FOLDER [RELEASE]: puts a Debian of a release, by default this machine's, into a folder, with the usual build tools,
# and without our packages or their dependencies. To be sourced; needs root, for debootstrap. The folder is made once and kept in
# build/packages/clean or clean-RELEASE; remove that folder for a new one.
copy_clean_root() {
  local clean=$PWD/build/packages/clean${2:+-$2} release=${2:-}
  if [[ ! -d $clean ]]; then
    echo "== a clean root =="
    rm -rf "$clean.new"
    mkdir -p "$(dirname "$clean")"
    release=${release:-$(. /etc/os-release && echo "$VERSION_CODENAME")}
    debootstrap --variant=minbase --include=cmake,g++,make,pkg-config "$release" "$clean.new" http://deb.debian.org/debian \
      >"$clean.log" || { tail "$clean.log" >&2 && exit 1; }
    mv "$clean.new" "$clean"
  fi
  rm -rf "$1"
  cp -a "$clean" "$1"
}

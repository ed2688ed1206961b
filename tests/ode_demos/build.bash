# Sourced from the root of the repository. Builds ODE's demos unchanged, without a window, into build/ode_demos/NAME, with our class
# available in place of spheres and boxes (replaced.h). Their source is the installed package's (tests/ode_source.bash).
. tests/ode_source.bash
demos=$PWD/build/ode_demos

# build_demos NAME...
build_demos() {
  local headers=(-Iinclude -Ibuild/release/include) compiler=${CXX:-c++} demo source ode libraries
  [[ -d $demos/fetched ]] || { rm -rf "$demos" && fetch_ode_source "$demos" && mkdir "$demos/fetched"; }
  source=$(echo "$demos"/source/ode-*/)
  cmake --preset release >/dev/null
  cmake --build --preset release --target supernormal >/dev/null
  read -ra ode <<<"$(pkg-config --cflags ode)"
  read -ra libraries <<<"$(pkg-config --libs ode)"
  "$compiler" -std=c++20 -O2 "${headers[@]}" "${ode[@]}" -idirafter "$source/include" -c tests/ode_demos/headless.cpp -o "$demos/headless.o"
  for demo in "$@"; do
    "$compiler" -O2 -w "${ode[@]}" -include tests/ode_demos/replaced.h -idirafter "$source/include" "$source/ode/demo/demo_$demo.cpp" \
      "$demos/headless.o" -o "$demos/$demo" -Lbuild/release/lib -lsupernormal "${libraries[@]}" \
      "-Wl,-rpath,$PWD/build/release/lib"
  done
}

# Sourced. only_ode FOLDER: makes a folder in which pkg-config finds ODE and nothing else, neither Eigen nor toml++.
only_ode() {
  mkdir -p "$1"
  cp "$(pkg-config --variable=pcfiledir ode)/ode.pc" "$1/"
}

# Sourced by what needs the source of the installed ODE, for which Debian has no package.

# ode_version: the version of the installed package.
ode_version() { dpkg-query -W -f='${source:Version}' libode-dev; }

# fetch_ode_source FOLDER: to FOLDER/source/ode-*/.
fetch_ode_source() { "$(dirname "${BASH_SOURCE[0]}")/../.ci/fetch-source" "$1" ode "$(ode_version)"; }

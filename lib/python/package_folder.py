"""Prints the package folder of this interpreter below PREFIX, or of an interpreter installed in PREFIX.

    package_folder.py PREFIX
"""

import pathlib
import site
import sys

prefix = pathlib.Path(sys.argv[1])
# /usr/local is below /usr, but is a separate prefix.
below = [path.relative_to(prefix) for path in map(pathlib.Path, site.getsitepackages()) if path.is_relative_to(prefix)]
of_prefix = [path for path in below if path.parts[0].startswith("lib")]
version = f"python{sys.version_info[0]}.{sys.version_info[1]}"
print(of_prefix[0] if of_prefix else f"lib/{version}/site-packages")

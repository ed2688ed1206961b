"""The files of a checkout, for tests of its texts."""
import re
import subprocess


def list_files(root):
    """What git has, with new files that it does not ignore. Where there is no git, as in an unpacked archive, all files but what is built."""
    if (root / ".git").exists():
        command = ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    else:
        names = (path.relative_to(root).as_posix() for path in root.rglob("*"))
        names = [name for name in names if not re.match(r"build|out/|\.git/", name)]
    return sorted({name for name in names if (root / name).is_file()})


def list_products(root):
    """The names of all products, also of those that are not there."""
    recipe = (root / "samples/CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^foreach\(product ([\w ]+)\)", recipe, re.M)[1].split()

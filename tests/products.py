#!/usr/bin/env python3
"""Fails if a product takes from another one, or the library from a product: products.py FOLDER.

A product X is samples/X and tests/X; what products share is samples/common and tests/support. explain_pair and benchmarks are one product
here: both take samples/benchmarks/literature.

  * A product includes its own headers, those of include/, of samples/common and of tests/support.
  * Its CMakeLists.txt names its own targets, those that are shared, and those of the library without its objects; another product's only
    inside if(TARGET ...).
  * The library (lib, include, the other folders of tests) takes nothing of samples/ but samples/common/stdout_check.c.
  * The top of the checkout has the names of TOP and dotfiles alone.
"""
import collections
import pathlib
import posixpath
import re
import sys

from checkout import list_files, list_products

TOP = {"lib", "include", "samples", "tests", "CMakeLists.txt", "CMakePresets.json"}
TOP |= {"README.md", "LICENSE", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff"}
FOR_ALL = "samples/common/stdout_check.c"
# A function that makes a target: what its name becomes.
MAKERS = {
    "add_library": "{}",
    "add_executable": "{}",
    "add_custom_target": "{}",
    "supernormal_add_doctest": "{}",
    "supernormal_add_fuzzer": "{}_fuzzer",
    "supernormal_add_host": "host_{}",
}
QUOTED = r'"(?:\\.|[^"\\])*"'
LIBRARY_OBJECTS = re.compile(r"supernormal_(core|ode|effects|stepper)_objects")


class Tree:
    def __init__(self, root):
        self.root = root
        self.names = set(list_files(root))
        self.sources = sorted(name for name in self.names if re.search(r"\.(c|h|cpp|hpp)$", name))
        self.recipes = sorted(name for name in self.names if posixpath.basename(name) == "CMakeLists.txt")
        self.products = list_products(root)
        # Where a product's includes begin: its two folders, and those inside that are CMake's include directories.
        self.roots = collections.defaultdict(list, {"library": ["lib"], "support": ["lib"]})
        for product in self.products:
            self.roots[self.owner(f"samples/{product}/")] += [f"samples/{product}", f"tests/{product}"]
        for recipe in self.recipes:
            folder = posixpath.dirname(recipe)
            self.roots[self.owner(recipe)].append(folder)
            for _, command, arguments in commands_of(self.text(recipe)):
                if command == "target_include_directories":
                    self.roots[self.owner(recipe)] += [posixpath.join(folder, word) for word in arguments.split() if re.fullmatch(r"[a-z_/]+", word)]
        self.by_end = collections.defaultdict(list)  # the headers with this name, and those with this folder and name, ...
        for name in self.sources:
            parts = name.split("/")
            for start in range(len(parts)):
                self.by_end["/".join(parts[start:])].append(name)

    def text(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def owner(self, name):
        """The product of a file; "common", "support", "lib" for what only the library may include, or "library" for the rest of it."""
        first, second = (name.split("/") + [""])[:2]
        if first == "samples" or (first == "tests" and (second in self.products or second == "common")):
            return "benchmarks" if second == "explain_pair" else second
        if first == "tests" and second == "support":
            return "support"
        return "lib" if first == "lib" else "library"

    def find_header(self, source, text):
        """The file that an include names, or None for a header of others: beside the source, in the roots of its product, in those of all,
        or anywhere else."""
        owner = self.owner(source)
        for folder in [posixpath.dirname(source), *self.roots[owner], "samples", "tests", "include"]:
            name = posixpath.normpath(posixpath.join(folder, text))
            if name in self.names:
                return name
        return next(iter(sorted(self.by_end[text], key=lambda name: self.owner(name) == owner)), None)


def is_product(owner):
    return owner not in ("lib", "library", "support")


def refused_includes(tree):
    for source in tree.sources:
        owner = tree.owner(source)
        for line, text in enumerate(tree.text(source).splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', text)
            header = tree.find_header(source, match[1]) if match else None
            if not header:
                continue
            theirs = tree.owner(header)
            if not is_product(owner):
                if is_product(theirs):
                    yield f"{source}:{line}: the library includes {header} of a product"
            elif theirs == "lib":
                yield f"{source}:{line}: a product includes {header} of the library's insides"
            elif theirs == "library" and not header.startswith("include/"):
                yield f"{source}:{line}: a product includes {header} of the library's tests; tests/support is for all"
            elif is_product(theirs) and theirs not in (owner, "common"):
                yield f"{source}:{line}: {owner} includes {header} of another product"


def commands_of(text):
    """The commands of a CMakeLists.txt: line, name, arguments."""
    text = re.sub(rf"({QUOTED})|#[^\n]*", lambda match: match[1] or "", text)
    for match in re.finditer(r"^[ \t]*(\w+)[ \t]*\(", text, re.M):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        yield text.count("\n", 0, match.start()) + 1, match[1], text[match.end() : end - 1]


def targets_of(text):
    loops = {}
    for _, command, arguments in commands_of(text):
        words = arguments.split()
        if command == "foreach" and words:
            loops[f"${{{words[0]}}}"] = words[1:]
        elif command in MAKERS and words:
            for name in loops.get(words[0], [words[0]]):
                if re.fullmatch(r"\w+", name):
                    yield MAKERS[command].format(name)


def refused_targets(tree):
    owners = {target: tree.owner(name) for name in tree.recipes for target in targets_of(tree.text(name)) if is_product(tree.owner(name))}
    for recipe in tree.recipes:
        owner = tree.owner(recipe)
        if recipe == "samples/CMakeLists.txt" or not (is_product(owner) or recipe.startswith(("lib/", "tests/"))):
            continue
        guards = []  # of the conditions around a command, the targets that exist there
        for line, command, arguments in commands_of(tree.text(recipe)):
            if command in ("if", "elseif", "else"):
                if command != "if":
                    guards.pop()
                guards.append(set(re.findall(r"(?<!NOT )\bTARGET\s+(\S+?)\)*(?=\s|$)", arguments)))
                continue
            if command == "endif":
                guards.pop()
                continue
            words = re.sub(QUOTED, " ", arguments).split() + re.findall(r"\$<TARGET_\w+:(\w+)", arguments)
            for word in words:
                theirs = owners.get(word, owner)
                if is_product(owner) and LIBRARY_OBJECTS.fullmatch(word):
                    yield f"{recipe}:{line}: a product names {word}; it links supernormal::core or supernormal::supernormal"
                elif theirs == owner or (theirs == "common" and is_product(owner)):
                    continue
                elif not any(word in names for names in guards):
                    yield f"{recipe}:{line}: {owner} names the target {word} of {theirs}, outside if(TARGET {word})"
            if not is_product(owner):
                for path in re.findall(r"samples/[\w./]+", arguments):
                    if path != FOR_ALL:
                        yield f"{recipe}:{line}: the library takes {path} of a product"


def refused_at_the_top(tree):
    for name in sorted({name.split("/")[0] for name in tree.names}):
        if name not in TOP and not name.startswith("."):
            yield f"{name}: the top of the checkout has no place for it"


def main():
    tree = Tree(pathlib.Path(sys.argv[1]).resolve())
    if len(tree.sources) < 300:
        sys.exit(f"only {len(tree.sources)} files of C and C++: has the layout changed?")
    refused = [*refused_includes(tree), *refused_targets(tree), *refused_at_the_top(tree)]
    if refused:
        sys.exit("\n".join(refused))
    print(f"{len(tree.sources)} files and {len(tree.recipes)} CMakeLists.txt of the library and of {len(tree.products)} products keep apart")


if __name__ == "__main__":
    main()

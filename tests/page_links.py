#!/usr/bin/env python3
"""Fails if a page of the repository links to a missing file or heading: page_links.py FOLDER.

Links into a product that is not there (samples/X, tests/X) are left out: each product may be deleted without the others."""
import os
import pathlib
import re
import sys

from checkout import list_files, list_products


def anchors(page):
    """The anchors of a page's headings, as GitHub and GitLab make them."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M), re.M):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-"))
    return found


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = [name for name in list_files(root) if name.endswith(".md")]
    missing = {f"{top}/{product}" for product in list_products(root) for top in ("samples", "tests") if not (root / top / product).exists()}
    links, left_out, broken = 0, 0, []
    for name in pages:
        page = root / name
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", target):
                continue
            links += 1
            path, _, anchor = target.partition("#")
            file = (page.parent / path) if path else page
            if "/".join(os.path.relpath(os.path.abspath(file), root).split(os.sep)[:2]) in missing:
                left_out += 1
                continue
            if not file.exists() or (anchor and file.suffix == ".md" and anchor not in anchors(file)):
                broken.append(f"{name}: {target}")
    if links < 100:
        sys.exit(f"only {links} links in {len(pages)} pages: has the layout changed?")
    if broken:
        sys.exit("\n".join(broken))
    print(f"{links} links in {len(pages)} pages; {left_out} of them into products that are not here are left out")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on a relative link, or its anchor, that leads nowhere, in any Markdown file that git knows, and
on a page below docs/ that a source file names and that is not there."""

import os
import re
import subprocess
import sys
import unicodedata
from pathlib import Path

FENCE = re.compile(r"^(```|~~~).*?^\1[^\n]*$|^(?: {4}|\t)[^\n]*$", re.M | re.S)
SPAN = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^\s)>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$", re.M)
FOREIGN = re.compile(r"[a-z][a-z0-9+.-]*:|//", re.I)
PAGE = re.compile(r"(?<![\w/])docs/[\w/-]+\.(?:md|csv)\b")
SOURCES = ("*.cpp", "*.hpp", "*.h", "*.py", "*.yaml", "*.txt", "*.cmake", "*.in", "dev", "Doxyfile")


def blank(pattern, text):
    """`text` without what matches; line breaks stay."""
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def anchors(text):
    """The anchors that GitHub gives to the headings of a page."""
    found = {}
    for title in HEADING.findall(FENCE.sub("", text)):
        title = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", title).lower()
        kept = (c for c in title if c in "-_ " or unicodedata.category(c)[0] in "LNM")
        slug = "".join(kept).replace(" ", "-")
        count = found[slug] = found.get(slug, -1) + 1
        if count:
            found[f"{slug}-{count}"] = 0
    return set(found)


def check_page(root, page, text):
    """What is wrong with one Markdown file; `page` is its path from the root."""
    bare = blank(SPAN, blank(FENCE, text))
    for match in LINK.finditer(bare):
        target, _, anchor = match[1].partition("#")
        if FOREIGN.match(target):
            continue
        line = bare.count("\n", 0, match.start()) + 1
        file = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
        if file.startswith("..") or not (root / file).exists():
            yield f"{page}:{line}: no such file: {match[1]}"
        elif anchor and file.endswith(".md"):
            if anchor not in anchors((root / file).read_text(encoding="utf-8")):
                yield f"{page}:{line}: no such heading: {match[1]}"


def check_source(root, name, text):
    """The pages that one source file names and that are not there."""
    for line, words in enumerate(text.splitlines(), 1):
        for page in PAGE.findall(words):
            if not (root / page).exists():
                yield f"{name}:{line}: no such file: {page}"


def tracked(root, patterns):
    """The files that git knows, paths from the root."""
    listed = subprocess.run(["git", "ls-files", "-z", "--", *patterns], cwd=root, check=True,
                            capture_output=True, text=True).stdout
    return [name for name in listed.split("\0") if name and (root / name).is_file()]


def check(root):
    """All complaints about the tree at `root`."""
    root = Path(root)
    complaints = []
    for page in tracked(root, ["*.md"]):
        complaints += check_page(root, page, (root / page).read_text(encoding="utf-8"))
    for name in tracked(root, SOURCES):
        complaints += check_source(root, name, (root / name).read_text(encoding="utf-8"))
    return complaints


if __name__ == "__main__":
    found = check(Path(__file__).resolve().parent.parent)
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)

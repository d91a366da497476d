#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails where a file states another version than CMakeLists.txt, or other authors than NOTICE.

The version stands in CMakeLists.txt. The program, the libraries, the Python package, the manual and the Debian
packages are built from it; CITATION.cff and CHANGELOG.md have to repeat it, all other files leave it out.
"""

import json
import re
import sys
from pathlib import Path

PROJECT = re.compile(r"^project\(microswarm VERSION (\d+\.\d+\.\d+)\b", re.M)
RELEASE = re.compile(r"^## \[(.*?)\](?: - (\S+))?$", re.M)
OWNER = re.compile(r"^Copyright \d{4} (.+)$", re.M)


def complaints_of(cmake, citation, changelog, notice, package, doxyfile):
    """What is wrong with the texts of the files that are named so."""
    found = PROJECT.search(cmake)
    if not found:
        return ["CMakeLists.txt: no project(microswarm VERSION a.b.c"]
    version, wrong = found[1], []

    def must_be(where, what, is_, must):
        if is_ != must:
            wrong.append(f"{where}: {what} is {is_}, must be {must}")

    def cited(key):
        line = re.search(rf"^{key}: *(.*?) *$", citation, re.M)
        return line and line[1].strip('"')

    releases = RELEASE.findall(changelog)
    must_be("CHANGELOG.md", "the first heading", releases[0][0] if releases else None, "Unreleased")
    newest, day = releases[1] if len(releases) > 1 else (None, None)
    must_be("CHANGELOG.md", "the newest release", newest, version)
    must_be("CITATION.cff", "version", cited("version"), version)
    must_be("CITATION.cff", "date-released", cited("date-released"), day)

    owner = OWNER.search(notice)
    authors = owner and owner[1]
    author = re.search(r"^authors:\n\s*- name: *(.*?) *$", citation, re.M)
    must_be("CITATION.cff", "the first author", author and author[1], authors)
    package = json.loads(package)
    must_be("web/package.json", "author", package.get("author"), authors)
    must_be("web/package.json", "version", package.get("version", version), version)
    number = re.search(r"^PROJECT_NUMBER *= *(.*?) *$", doxyfile, re.M)
    must_be("docs/Doxyfile", "PROJECT_NUMBER", number and number[1], "$(MICROSWARM_VERSION)")
    return wrong


def check(root):
    """All complaints about the tree at `root`."""
    names = ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md", "NOTICE", "web/package.json", "docs/Doxyfile")
    return complaints_of(*((Path(root) / name).read_text(encoding="utf-8") for name in names))


if __name__ == "__main__":
    complaints = check(Path(__file__).resolve().parent.parent)
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)

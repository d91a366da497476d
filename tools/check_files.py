#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on a source file without its licence line, a header without #pragma once, a long file."""

import sys
from pathlib import Path

LICENCE = "SPDX-License-Identifier: Apache-2.0"
LONGEST = 450  # lines; a file is one reader's sitting
FOLDERS = ["src", "apps", "tests", "tools", "cmake", "scripts", "web/src", ".ci"]
PATTERNS = ["*.cpp", "*.hpp", "*.in", "*.cmake", "CMakeLists.txt", "*.py", "*.ts"]


def sources(root):
    """Every source file below `root`, scripts included."""
    for folder in FOLDERS:
        for pattern in PATTERNS:
            yield from sorted((root / folder).rglob(pattern))
    yield from (path for path in (root / "CMakeLists.txt", root / "dev", root / ".ci/run")
                if path.is_file())


def check_text(name, text):
    """What is wrong with one file."""
    lines = text.splitlines()
    licence_line = 1 if lines and lines[0].startswith("#!") else 0
    if LICENCE not in "".join(lines[licence_line:licence_line + 1]):
        yield f"{name}:{licence_line + 1}: no line '{LICENCE}'"
    if name.endswith(".hpp") and "#pragma once" not in lines[:3]:
        yield f"{name}:2: no #pragma once"
    if len(lines) > LONGEST:
        yield f"{name}:{len(lines)}: longer than {LONGEST} lines"


def check(root):
    """All complaints about the tree at `root`."""
    root = Path(root)
    return [complaint for path in sources(root)
            for complaint in check_text(path.relative_to(root).as_posix(),
                                        path.read_text(encoding="utf-8"))]


if __name__ == "__main__":
    complaints = check(Path(__file__).resolve().parent.parent)
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)

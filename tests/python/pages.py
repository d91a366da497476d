# SPDX-License-Identifier: Apache-2.0
"""What stands on the pages of the documentation: their fenced blocks, and their lines for a shell, which are indented by four spaces."""

import dataclasses
import re

from conftest import ROOT

PAGES = ["README.md", "CONTRIBUTING.md", "SECURITY.md", *sorted(str(page.relative_to(ROOT)) for page in (ROOT / "docs").rglob("*.md"))]
PART = re.compile(r"^```([^\n`]*)\n(.*?)^```$|(?<=\n\n)((?: {4}[^\n]+\n)+)", flags=re.M | re.S)


@dataclasses.dataclass
class Block:
    """A block of a page: its language ("shell" if it is indented), where it begins, and the paragraph that stands before it."""

    page: str
    line: int
    language: str
    text: str
    before: str

    def __str__(self):
        return f"{self.page}:{self.line} ({self.language})"


def blocks_of(page):
    """All blocks of a page, in order."""
    text = (ROOT / page).read_text(encoding="utf-8")
    for found in PART.finditer(text):
        before = text[: found.start()]
        language, inside = ("shell", re.sub(r"^ {4}", "", found[3], flags=re.M)) if found[3] else (found[1], found[2])
        yield Block(page, before.count("\n") + 1, language, inside, before.rstrip().rpartition("\n\n")[2])


def lines_of(block):
    """Commands of a block for a shell; a backslash continues a line."""
    return [line for line in re.sub(r"\\\n +", " ", block.text).splitlines() if line]

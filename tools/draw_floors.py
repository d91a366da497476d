#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/pictures/floors.svg from the floors that CMakeLists.txt lists, and their comments.

    tools/draw_floors.py            draws it
    tools/draw_floors.py --check    complains where the picture shows something else
"""

import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "pictures" / "floors.svg"
FLOOR = re.compile(r"^\s*add_subdirectory\(src/microswarm/(\w+)\)(?:\s*# (.*))?$", re.M)
ABOVE = [("apps", "the command-line tool, and the benches with their peers")]
# Fill and edge of the boxes up to and with this floor, and what they have in common.
GROUPS = [
    ("navigation", "#dbe9f6", "#2f5d8a", "the algorithms"),
    ("experiment", "#fbeedb", "#96631d", "the loop: a scenario runs without any device"),
    ("vision", "#e6f2e3", "#3f7a3a", "devices; navigation, actuation and vision never see each other"),
    ("reproduce", "#f6e0e0", "#8a3434", "rigs and results"),
    ("apps", "#eee7f5", "#63478c", "programs"),
]
ROW, BOX, TOP, WIDTH = 46, 38, 56, 900


def drawn(floors):
    """The picture of (name, words), lowest first, as SVG."""
    height = TOP + ROW * len(floors) + 16
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="DejaVu Sans, Verdana, sans-serif" role="img" aria-label="The floors of microswarm">',
        "<!-- SPDX-License-Identifier: Apache-2.0; drawn by tools/draw_floors.py -->",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
        '<text x="40" y="36" font-size="16" fill="#222">A file includes its own floor and what stands '
        "below it, never above.</text>",
    ]
    group = 0
    for level, (name, words) in enumerate(floors):
        last, fill, edge, common = GROUPS[group]
        y = height - 16 - ROW * (level + 1)
        lines.append(f'<rect x="40" y="{y}" width="820" height="{BOX}" rx="6" fill="{fill}" '
                     f'stroke="{edge}" stroke-width="1.3"/>')
        lines.append(f'<text x="56" y="{y + 25}" font-size="17" font-weight="bold" fill="{edge}">'
                     f"{escape(name)}</text>")
        lines.append(f'<text x="205" y="{y + 25}" font-size="14" fill="#333">{escape(words)}</text>')
        if name == last:
            lines.append(f'<text x="850" y="{y + 13}" font-size="10" text-anchor="end" fill="{edge}">'
                         f"{escape(common)}</text>")
            group = min(group + 1, len(GROUPS) - 1)
    return "\n".join([*lines, "</svg>"]) + "\n"


def main():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    svg = drawn([(name, words) for name, words in FLOOR.findall(text)] + ABOVE)
    if "--check" not in sys.argv[1:]:
        PICTURE.write_text(svg, encoding="utf-8")
    elif PICTURE.read_text(encoding="utf-8") != svg:
        sys.exit(f"{PICTURE}: not as CMakeLists.txt has it; run tools/draw_floors.py")


if __name__ == "__main__":
    main()

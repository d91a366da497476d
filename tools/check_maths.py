#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on calls of the C library's transcendental functions, whose last bits depend on CPU and version.

What results depend on goes through src/microswarm/core/maths/maths.hpp; the length of a vector is norm().
Functions that IEEE 754 defines to the bit (sqrt, fma, floor, remainder …) are the standard library's.
"""

import re
import sys
from pathlib import Path

HOME = ("src/microswarm/core/maths/maths.", "src/microswarm/core/maths/plain_sleef.")
NAMES = ("sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log "
         "log2 log10 log1p pow hypot cbrt erf erfc lgamma tgamma")
# Of the standard library alone: algorithms that differ from one library to the next, or call those.
STANDARD = NAMES + (" polar arg uniform_real_distribution uniform_int_distribution normal_distribution"
                    " bernoulli_distribution exponential_distribution")
KNOWN = "|".join(NAMES.split())
QUALIFIED = re.compile(rf"(?<![\w:])(?:std|cv|)::({'|'.join(STANDARD.split())})[fl]?\b(?!\s*::)")
PLAIN = re.compile(rf"(?<![\w:.>~])({KNOWN})[fl]?\(")
BEFORE = re.compile(r"(\w+>*[&*]*)\s+$")  # a type: it is declared here
COMMENTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)


def blank(match):
    """As many lines as before."""
    return "\n" * match.group().count("\n")


def check_text(name, text):
    """What is wrong with one file."""
    for number, line in enumerate(COMMENTS.sub(blank, text).split("\n"), start=1):
        found = QUALIFIED.search(line)
        if not found:
            found = next((call for call in PLAIN.finditer(line) if is_call(line[:call.start()])), None)
        if found:
            yield f"{name}:{number}: '{found.group(1)}' has other bits on other CPUs: core/maths/maths.hpp"


def is_call(before):
    """Whether what stands before a name and its parenthesis leaves it a call."""
    word = BEFORE.search(before)
    return not word or word.group(1) in ("return", "else", "case", "co_return")


def check(root):
    """All complaints about the tree at `root`."""
    root = Path(root)
    files = sorted(path for folder in ("src", "apps") for path in (root / folder).rglob("*.[ch]pp"))
    return [complaint for path in files
            if not (name := path.relative_to(root).as_posix()).startswith(HOME)
            for complaint in check_text(name, path.read_text(encoding="utf-8"))]


if __name__ == "__main__":
    complaints = check(Path(__file__).resolve().parent.parent)
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)

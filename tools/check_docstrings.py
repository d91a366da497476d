#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on a class, struct, enum or function in a public header without a docstring.

Looked at are declarations at namespace scope in src/**/*.hpp. A docstring `///` stands just before
its declaration and covers what follows it without a blank line between, so that one sentence may
serve a family of overloads. Forward declarations, variables, aliases, concepts, specialisations and
namespaces called detail need none.
"""

import re
import sys
from pathlib import Path

# Comments, string and character literals, and preprocessor lines: blanked out, line by line. A
# quote after a digit separates digits.
NOISE = re.compile(
    r"//[^\n]*|/\*.*?\*/"
    r'|R"(?P<tag>\w*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
    r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",
    re.DOTALL | re.MULTILINE,
)
NAMESPACE = re.compile(r"(?:inline\s+)?namespace\b\s*(?P<name>[\w:]*)$")
TYPE = re.compile(r"(?:class|struct|union|enum(?:\s+class|\s+struct)?)\b")
EXEMPT = re.compile(r"(?:using|typedef|static_assert|extern\s+template|template\s*<\s*>|concept)\b"
                    r"|template\s*<\s*>")


def blank(text):
    """`text` with comments, literals and preprocessor lines as spaces; line breaks stay."""
    return NOISE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def without_template_heads(declaration):
    """The declaration after its `template <...>` heads and `requires` on them in parentheses."""
    while match := re.match(r"template\s*<", declaration):
        depth, end = 1, match.end()
        while depth and end < len(declaration):
            depth += {"<": 1, ">": -1}.get(declaration[end], 0)
            end += 1
        declaration = declaration[end:].lstrip()
    return declaration


def needs_docstring(declaration, has_body):
    """Whether this declaration, up to its `;` or `{`, is a type's or function's public face."""
    if EXEMPT.match(declaration):
        return False
    declaration = without_template_heads(declaration)
    if EXEMPT.match(declaration):
        return False
    if TYPE.match(declaration):
        return has_body
    declaration = re.sub(r"\boperator\s*\S+?\s*(?=\()", "operator_", declaration)
    head, paren, _ = declaration.partition("(")
    return bool(paren) and "=" not in head and not re.search(r"\w\s*::\s*~?\w+\s*$", head)


def declarations(code):
    """(first line, last line, text, has body) of what stands at namespace scope in blanked code."""
    hidden = 0  # depth of braces inside a namespace that needs no docstrings
    namespaces = []
    position = start = parentheses = 0
    while position < len(code):
        char = code[position]
        parentheses += {"(": 1, ")": -1}.get(char, 0)
        if char == "}" and not parentheses and namespaces:
            hidden -= namespaces.pop()
            start = position + 1
        elif char in ";{" and not parentheses:
            text = code[start:position].strip()
            first = code.count("\n", 0, position - len(code[start:position].lstrip())) + 1
            if char == "{" and (match := NAMESPACE.match(text)):
                namespaces.append(match["name"] == "detail")
                hidden += namespaces[-1]
            else:
                has_body = char == "{"
                position = end_of_declaration(code, position)
                if text and not hidden:
                    yield first, code.count("\n", 0, position) + 1, text, has_body
            start = position + 1
        position += 1


def end_of_declaration(code, position):
    """Where the declaration ends whose first `;` or `{` is at `position`."""
    depth = 0
    while position < len(code):
        depth += {"{": 1, "}": -1}.get(code[position], 0)
        if depth == 0:
            following = re.compile(r"\s*;").match(code, position + 1)
            return following.end() - 1 if code[position] == "}" and following else position
        position += 1
    return position


def check_text(text):
    """[(line, declaration)] of what lacks its docstring in the text of a header."""
    lines = text.splitlines()
    missing = []
    covered_to = 0  # last line that a docstring covers, declarations without blank lines between
    for first, last, declaration, has_body in declarations(blank(text)):
        documented = lines[first - 2].lstrip().startswith("///") if first > 1 else False
        documented = documented or "///<" in lines[last - 1] or first - 1 <= covered_to
        if documented:
            covered_to = last
        elif needs_docstring(declaration, has_body):
            missing.append((first, " ".join(declaration.split())))
    return missing


def check(root):
    """All complaints about the public headers below `root`."""
    complaints = []
    for path in sorted((Path(root) / "src").rglob("*.hpp")):
        for line, declaration in check_text(path.read_text(encoding="utf-8")):
            file = path.relative_to(root).as_posix()
            complaints.append(f"{file}:{line}: no docstring: {declaration[:70]}")
    return complaints


if __name__ == "__main__":
    found = check(Path(__file__).resolve().parent.parent)
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)

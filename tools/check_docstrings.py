#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on a class, struct, enum or function in a header without a docstring, on phrases that are no plain English
in a comment or a message, and on a command-line option in a text of the library.

Docstrings: declarations at namespace scope in the headers of src, apps and bindings. A docstring `///` stands just
before its declaration and covers the declarations up to the next blank line, so that one sentence may serve a
family of overloads. Forward declarations, variables, aliases, concepts, specialisations and namespaces called
detail need none. A docstring in front of a blank line belongs to nothing and is refused.

Phrases: comments of C++, C and TypeScript in src, apps, bindings and web/src, and docstrings of the Python package.
PHRASES lists them, each with the words to use in its place. IN_TEXTS of them hold for texts with a blank in string
literals of src, apps, bindings and the Python package, too: messages, notes, help.

Options: string literals of src name no "--option", since Python, C, MATLAB and the lab show the library's texts, too.
The library says what is missing; apps/support/option_names.cpp adds the option.
"""

import ast
import io
import re
import sys
import tokenize
from pathlib import Path

FOLDERS = ("src", "apps", "bindings")

# What a comment must not say, and what to say in its place.
PHRASES = [(re.compile(pattern, re.I), hint) for pattern, hint in (
    (r"\bone's own\b", "'your own', 'user-supplied' or 'separate'"),
    (r"\bfor ever\b|\bfor good\b", "'indefinitely' or 'permanently'"),
    (r"\bbut for\b", "'except'"),
    (r"\b(what|who|where)ever\b", "'any', 'for any' or 'independent of'"),
    (r"\btold\b", "'given', 'sent' or 'reported'"),
    (r"\btells?\b", "'returns', 'says' or 'reports'; 'returns whether'"),
    (r"\bgo(es|ing)? on\b", "'continues'"),
    (r"\bbears?\b", "the noun: 'limits', 'withstands'"),
    (r"\banew\b", "'again', 'newly' or 'by each'"),
    (r"\bseldom\b", "'rarely'"),
    (r"\b(the|its) present\b", "'the current'"),
    (r"\bforese(e|es|en|eing)\b", "'predict'"),
    (r"\bso many (seconds|times|ticks)\b", "the name of the parameter"),
    (r"\bof (its|their|your|his|the caller's) own\b", "'its own X' or 'a separate X'"),
)]
# Those that messages must not say either.
IN_TEXTS = [(pattern, hint) for pattern, hint in PHRASES if pattern.pattern in (
    r"\bone's own\b", r"\bfor ever\b|\bfor good\b", r"\bbut for\b", r"\b(what|who|where)ever\b", r"\btold\b",
    r"\btells?\b", r"\banew\b", r"\bseldom\b", r"\bforese(e|es|en|eing)\b", r"\bso many (seconds|times|ticks)\b",
)]
OPTION = re.compile(r"--[a-z]")
# How a docstring must not begin: it names what a thing is, or what a function does.
OPENING = re.compile(r"(What|Where|How)\b")
OPENING_HINT = "a noun or a verb: 'Result of', 'Position of', 'Number of', 'Returns'"

# Comments, string and character literals, and preprocessor lines: blanked out, line by line. A
# quote after a digit separates digits.
NOISE = re.compile(
    r"//[^\n]*|/\*.*?\*/"
    r'|R"(?P<tag>\w*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
    r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",
    re.DOTALL | re.MULTILINE,
)
COMMENT = re.compile(
    r'(?P<comment>//[^\n]*|/\*.*?\*/)'
    r'|R"(?P<tag>\w*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|`(?:\\.|[^`\\])*`",
    re.DOTALL,
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


def orphans(text):
    """Lines of the last lines of docstrings that stand before a blank line."""
    lines = text.splitlines()
    return [number for number, (line, following) in enumerate(zip(lines, [*lines[1:], ""]), 1)
            if re.match(r"\s*///(?!<)", line) and not following.strip()]


def comments(text):
    """[(line, whether it is a docstring, text)] of the comments of C++, C or TypeScript; those on successive lines
    are one."""
    joined = []
    ended = None  # the line on which a comment that may continue ended
    for match in COMMENT.finditer(text):
        if not match["comment"]:
            continue
        first = text.count("\n", 0, match.start()) + 1
        alone = not text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        marks, words = re.match(r"(//[/<]*|/\*\**)(.*)", match["comment"], re.S).groups()
        words = " ".join(word.strip("*/ ") for word in words.split("\n")).strip()
        if alone and ended == first - 1 and joined[-1][3] == marks:
            joined[-1] = (*joined[-1][:2], f"{joined[-1][2]} {words}", marks)
        else:
            joined.append((first, marks in ("///", "///<", "/**"), words, marks))
        ended = first + match["comment"].count("\n") if alone else None
    return [found[:3] for found in joined]


LITERAL = re.compile(r'R"(?P<tag>\w*)\((?P<raw>.*?)\)(?P=tag)"|"(?P<plain>(?:\\.|[^"\\\n])*)"', re.S)


def literals(text):
    """[(line, text)] of the string literals of C++ or C; adjacent ones are one."""
    found = []
    ended = 0
    for match in COMMENT.finditer(text):
        literal = LITERAL.fullmatch(match[0])
        if not literal:
            continue
        words = literal["plain"] if literal["raw"] is None else literal["raw"]
        if found and not text[ended:match.start()].strip():
            found[-1] = (found[-1][0], found[-1][1] + words)
        else:
            found.append((text.count("\n", 0, match.start()) + 1, words))
        ended = match.end()
    return found


def python_literals(text):
    """The same of a Python module, without the expressions of f-strings. Docstrings are among them."""
    return [(node.lineno, node.value) for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.Constant) and isinstance(node.value, str)]


def docstrings(text):
    """The same of a Python module: its docstrings, and its comments."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            found.append((node.body[0].lineno, True, " ".join(ast.get_docstring(node).split())))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            found.append((token.start[0], False, token.string.lstrip("# ")))
    return sorted(found)


def phrases(found):
    """[(line, what is wrong)] of comments as of comments() or docstrings()."""
    for line, is_docstring, words in found:
        words = re.sub(r"`[^`]*`", "`", words)  # names
        if is_docstring and OPENING.match(words):
            yield line, f"a docstring begins with '{words.split()[0]}': begin with {OPENING_HINT}"
        for pattern, hint in PHRASES:
            for match in pattern.finditer(words):
                yield line, f"'{match[0]}' in a comment: say {hint}"


def bad_texts(found):
    """[(line, what is wrong)] of literals: phrases in those that are texts, with a blank in them."""
    for line, words in found:
        for pattern, hint in IN_TEXTS if " " in words.strip() else ():
            for match in pattern.finditer(words):
                yield line, f"'{match[0]}' in a text: say {hint}"


def options(found):
    """[(line, what is wrong)] of literals that name options of the command line."""
    for line, words in found:
        for match in OPTION.finditer(words):
            option = re.match(r"[-\w]+", words[match.start():])[0]
            yield line, f"'{option}' in a text of the library: name the thing, see apps/support/option_names.cpp"


def check(root):
    """All complaints about the tree at `root`."""
    root = Path(root)
    complaints = []

    def complain(path, line, what):
        complaints.append(f"{path.relative_to(root).as_posix()}:{line}: {what}")

    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.hpp")):
            text = path.read_text(encoding="utf-8")
            for line, declaration in check_text(text):
                complain(path, line, f"no docstring: {declaration[:70]}")
            for line in orphans(text):
                complain(path, line, "a docstring of nothing: a blank line follows")
    for folder in (*FOLDERS, "web/src"):
        for path in sorted((root / folder).rglob("*.*")):
            if path.suffix in (".hpp", ".cpp", ".h", ".c", ".ts"):
                text = path.read_text(encoding="utf-8")
                for line, what in phrases(comments(text)):
                    complain(path, line, what)
                for line, what in bad_texts(literals(text) if path.suffix != ".ts" else ()):
                    complain(path, line, what)
                for line, what in options(literals(text) if folder == "src" else ()):
                    complain(path, line, what)
    for path in sorted((root / "bindings/python").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for line, what in phrases(docstrings(text)):
            complain(path, line, what)
        for line, what in bad_texts(python_literals(text)):
            complain(path, line, what)
    return complaints


if __name__ == "__main__":
    found = check(Path(__file__).resolve().parent.parent)
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)

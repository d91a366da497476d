#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows which changes of a source no test notices.

    tools/mutate.py src/microswarm/navigation/radar/safety_filter.cpp
    tools/mutate.py FILE navigation_test navigator_laws_test --lines 20-60 --count 15
    tools/mutate.py FILE --list

Each mutant of FILE changes one expression: an operator, a constant, a condition, a dropped term or
statement, min for max, an early return. It is killed if a test of the named programs fails; by default
they are those of the file's floor. A survivor is a missing test, or means the same. Only a copy of the
tree in build/mutate is changed. It is built as a release; floors that were ever asked for are compiled
file by file and less optimised.
"""

import argparse
import dataclasses
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutate"
TREE = WORK / "tree"
BUILD = TREE / "build" / "release"  # as below a tree of its own: then ccache knows what it compiles
OPTIONS = ["--preset", "release", "-DMICROSWARM_BENCH=OFF", "-DMICROSWARM_LAB=OFF"]
ROUNDING = 1e-4  # a constant below it is there for rounding: no test needs it

HIDDEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\''
    r"|^[ \t]*#(?:\\\n|[^\n])*|\bstatic_assert\b[^;]*;|\bassert\([^;]*;|(?:\.|->)reserve\([^;]*;", re.S | re.M)
OPERATORS = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "==",
             "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
             "&&": "||", "||": "&&"}
OPERATOR = re.compile(r"(?<=\s)(" + "|".join(
    re.escape(word) for word in sorted(OPERATORS, key=len, reverse=True)) + r")(?=\s)")
NOT = re.compile(r"!(?=[\w(*])")
MINUS = re.compile(r"(?<=[(\[{,=?:\s])-(?=[\w(])")
EXTREME = re.compile(r"\b(?:min|max)(?=\(|<\w+>\()")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.'])")
CONDITION = re.compile(r"\b(if|while) \(")
ANSWER = re.compile(r"\breturn (true|false);")
STATEMENT = re.compile(
    r"(?:[;{})]|\belse)\s+((?:\w+(?:\.|->|::))*\w+(?:\[[^]\n]*\])?(?: [-+*/|&]?= [^;{}]*|\([^;{}]*\)))(?=;)")
NOT_DROPPED = re.compile(r"(return|throw|delete|co_\w+)\b")
FUNCTION = re.compile(r"^(?!namespace|class|struct|enum|using|extern|template|constexpr|const |//)"
                      r"(\w[^;{}#()]*)\([^;{}]*\)(?: const)?(?: noexcept)? \{(?=\n)", re.M)


@dataclasses.dataclass(frozen=True, order=True)
class Mutant:
    """text[start:end] becomes `new`."""

    start: int
    end: int
    new: str
    kind: str


def masked(text):
    """The text with comments, strings and preprocessor lines blank, at the same places."""
    return HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def closing(code, start):
    """Where the bracket at `start` is closed; the text's end if nowhere."""
    depth = 0
    for i in range(start, len(code)):
        depth += (code[i] in "([{") - (code[i] in ")]}")
        if depth == 0:
            return i
    return len(code)


def balanced(code):
    return all(code.count(a) == code.count(b) for a, b in ("()", "[]", "{}"))


def term_end(code, start, ends):
    """Where the operand that begins at `start` ends: at one of `ends` outside of its brackets."""
    i = start
    while i < len(code):
        if code[i] in "([{":
            i = closing(code, i)
        elif code[i] in ")]};," or OPERATOR.match(code, i) and code[i:].split(maxsplit=1)[0] in ends:
            break
        elif code[i] in "?:" and code[i - 1] == " ":
            break
        i += 1
    return len(code[:i].rstrip())


def of_operators(code):
    sums = {"+", "-", "<", "<=", ">", ">=", "==", "!=", "&&", "||"}
    for found in OPERATOR.finditer(code):
        word = found[0]
        yield Mutant(found.start(), found.end(), OPERATORS[word], "operator")
        if word not in ("+", "-", "&&", "||"):
            continue
        ends = sums if word in "+-" else {"||"} if word == "||" else {"&&", "||"}
        after = found.end() + len(code[found.end():]) - len(code[found.end():].lstrip())
        start = len(code[:found.start()].rstrip())
        yield Mutant(start, term_end(code, after, ends), "", "term")
    for found in NOT.finditer(code):
        yield Mutant(found.start(), found.end(), "", "operator")
    for found in MINUS.finditer(code):
        yield Mutant(found.start(), found.end(), "", "operator")
    for found in EXTREME.finditer(code):
        yield Mutant(found.start(), found.end(), {"min": "max", "max": "min"}[found[0]], "extreme")


def of_constants(code):
    for found in NUMBER.finditer(code):
        line = code[code.rfind("\n", 0, found.start()) + 1:found.start()]
        if line.count("[") > line.count("]") or re.search(r"\bcase $|\w<[^<>;()]*$", line):
            continue
        value = float(found[0]) if re.search(r"[.e]", found[0]) else int(found[0])
        if value == 0:
            yield Mutant(found.start(), found.end(), repr(value + 1), "constant")
        elif value >= ROUNDING:
            yield Mutant(found.start(), found.end(), repr(0 * value), "constant")
            yield Mutant(found.start(), found.end(), repr(2 * value), "constant")


def of_statements(code):
    for found in CONDITION.finditer(code):
        end = closing(code, found.end() - 1)
        inside = code[found.end():end]
        if ";" in inside or re.search(r" = ", inside):
            continue
        for word in ("false",) if found[1] == "while" else ("true", "false"):
            yield Mutant(found.end(), end, word, "condition")
    for found in ANSWER.finditer(code):
        yield Mutant(found.start(1), found.end(1), "false" if found[1] == "true" else "true", "return")
    for found in STATEMENT.finditer(code):
        if balanced(found[1]) and not NOT_DROPPED.match(found[1]):
            yield Mutant(found.start(1), found.end(1), "", "statement")
    for found in FUNCTION.finditer(code):
        words = found[1].split()
        if len(words) < 2:  # a constructor
            continue
        early = "return;" if words[-2] == "void" else "return {};"
        yield Mutant(found.end(), found.end(), f" {early}", "early return")


def mutants(text):
    """Every mutant of a C++ source, in its order."""
    code = masked(text)
    return sorted({*of_operators(code), *of_constants(code), *of_statements(code)})


def line_of(text, place):
    return text.count("\n", 0, place) + 1


def described(text, mutant):
    """The change in words: from what to what, on one line."""
    if mutant.start == mutant.end:
        head = text[text.rfind("\n", 0, mutant.start) + 1:mutant.start]
        return f"{head.strip()} +{mutant.new}"
    first = max(text.rfind("\n", 0, mutant.start) + 1, mutant.start - 24)
    last = text.find("\n", mutant.end)
    last = min(len(text) if last < 0 else last, mutant.end + 24)
    before, old, after = text[first:mutant.start], text[mutant.start:mutant.end], text[mutant.end:last]
    return re.sub(r"\s+", " ", f"{before}[{old} → {mutant.new}]{after}").strip()


def chosen(text, found, options):
    """Those mutants that the options ask for."""
    if options.lines:
        first, _, last = options.lines.partition("-")
        lines = range(int(first), int(last or first) + 1)
        found = [mutant for mutant in found if line_of(text, mutant.start) in lines]
    if options.only:
        found = [mutant for mutant in found if mutant.kind in options.only.split(",")]
    if options.match:
        found = [mutant for mutant in found if options.match in described(text, mutant)]
    if options.count and options.count < len(found):
        found = sorted(random.Random(options.seed).sample(found, options.count))
    return found


def files_of_tree():
    """{name: content} of all that git does not ignore."""
    listed = subprocess.run(["git", "ls-files", "-coz", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    return {name: (ROOT / name).read_bytes() for name in listed if name and (ROOT / name).is_file()}


def compiled_alone(files, file):
    """The same files; the floor of `file`, and those of earlier calls, compile each source alone."""
    known = WORK / "floors.txt"
    floors = set(known.read_text(encoding="utf-8").split()) if known.exists() else set()
    found = re.match(r"src/microswarm/(\w+)/", file)
    floors |= {found[1]} if found else set()
    known.parent.mkdir(parents=True, exist_ok=True)
    known.write_text("\n".join(sorted(floors)), encoding="utf-8")
    lists = {f"src/microswarm/{floor}/CMakeLists.txt": floor for floor in floors}
    return files | {
        name: files[name] + (f"set_target_properties(microswarm_{floor} PROPERTIES UNITY_BUILD OFF)\n"
                             f"target_compile_options(microswarm_{floor} PRIVATE -O1)\n").encode()
        for name, floor in lists.items() if name in files}


def write_tree(files, to):
    """Makes `to` hold these files and no others but those that are built. Writes what differs."""
    for top in to.glob("*"):
        for path in [] if top == to / "build" else [top, *top.rglob("*")]:
            if path.is_file() and path.relative_to(to).as_posix() not in files:
                path.unlink()
    for name, content in files.items():
        target = to / name
        if target.is_file() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        target.chmod((ROOT / name).stat().st_mode)


def run(command, limit=None, **more):
    """Its exit code, None if it took longer than `limit` seconds, and what it printed."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", start_new_session=True, **more) as process:
        try:
            said = process.communicate(timeout=limit)[0]
            return process.returncode, said
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return None, process.communicate()[0]
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise


def build(targets, jobs):
    environment = os.environ | {"CCACHE_BASEDIR": str(TREE), "CCACHE_NOHASHDIR": "1"}
    return run(["ninja", "-C", str(BUILD), "-j", str(jobs), *targets], env=environment)


class Builder:
    """Turns a change of a source into the test programs: compiles, packs and links, nothing else. A
    header needs a whole build."""

    def __init__(self, file, targets):
        self.commands, self.object = [["ninja", "-C", str(BUILD), *targets]], None
        code, said = run(["ninja", "-C", str(BUILD), "-t", "commands", *targets])
        lines = said.splitlines()
        compiled = [line for line in lines if line.endswith(f" -c {TREE / file}")]
        if code != 0 or not compiled:
            return
        self.object = re.search(r" -o (\S+) -c ", compiled[0])[1]
        packed = [line for line in lines if f" {self.object} " in line and line not in compiled]
        linked = [part for line in lines for part in line.split(" && ")
                  if any(f" -o bin/{target} " in part for target in targets)]
        self.commands = [["sh", "-c", line] for line in (*compiled, *packed, *linked)]
        self.same = self.compiled()

    def compiled(self):
        """What the compiler makes of it; None if it refuses."""
        if run(self.commands[0], cwd=BUILD, env=os.environ | {"CCACHE_DISABLE": "1"})[0] != 0:
            return None
        return (BUILD / self.object).read_bytes() if self.object else b""

    def build(self):
        """"built", "no build", or "the same": the compiler makes the same code of it."""
        made = self.compiled()
        if made is None:
            return "no build"
        if self.object and made == self.same:
            return "the same"
        done = all(run(command, cwd=BUILD)[0] == 0 for command in self.commands[1:])
        return "built" if done else "no build"


class Tests:
    """The test programs of some targets, without those of their tests that are slow."""

    def __init__(self, targets, slow, pattern):
        self.programs = []
        separator = ":" if "-" in pattern else "-"
        for target in targets:
            program = BUILD / "bin" / target
            tests, seconds = self.measured(program, pattern)
            left_out = [(name, taken) for name, taken in tests if taken > slow]
            seconds -= sum(taken for _, taken in left_out)
            without = ":".join(name for name, _ in left_out)
            self.programs.append((target, [str(program), "--gtest_fail_fast", "--gtest_brief=1",
                                           f"--gtest_filter={pattern}{separator if without else ''}{without}"],
                                  10 + 5 * seconds))
            print(f"{target}: {seconds:.1f} s" + "".join(
                f"; without {name}, {taken:.1f} s" for name, taken in left_out), flush=True)

    @staticmethod
    def measured(program, pattern):
        """The tests and the seconds that each took, and the sum; kept for a program that is the same."""
        known = WORK / f"{program.name}.json"
        key = [hashlib.sha256(program.read_bytes()).hexdigest(), pattern]
        if known.exists() and (kept := json.loads(known.read_text(encoding="utf-8")))[0] == key:
            return kept[1:]
        report = WORK / f"{program.name}.xml"
        code, said = run([str(program), f"--gtest_filter={pattern}", f"--gtest_output=xml:{report}"])
        if code != 0:
            sys.exit(f"{said[-2000:]}\n{program.name}: fails without a change")
        root = xml.etree.ElementTree.parse(report).getroot()
        kept = [key, [(f"{test.get('classname')}.{test.get('name')}", float(test.get("time")))
                      for test in root.iter("testcase")], float(root.get("time"))]
        known.write_text(json.dumps(kept), encoding="utf-8")
        return kept[1:]

    def killer(self):
        """The first test that fails, or None."""
        for target, command, limit in self.programs:
            code, said = run(command, limit)
            if code is None:
                return f"{target}: time limit of {limit:.0f} s"
            if code != 0:
                failed = re.search(r"\[  FAILED  \] (\S+?)[,\s]", said)
                return f"{target}: {failed[1] if failed else f'ends with {code}'}"
        return None


def default_targets(file):
    found = re.match(r"src/microswarm/(\w+)/", file)
    return [f"{found[1]}_test"] if found else []


def try_all(file, text, found, targets, options):
    """Prints a line a mutant; returns how many were killed, survived and did not compile."""
    copy = TREE / file
    tests = Tests(targets, options.slow, options.filter)
    builder = Builder(file, targets)
    count = {"killed": 0, "SURVIVED": 0, "no build": 0, "the same": 0}
    try:
        for mutant in found:
            copy.write_text(text[:mutant.start] + mutant.new + text[mutant.end:], encoding="utf-8")
            fate, killer = builder.build(), None
            if fate == "built":
                killer = tests.killer()
                fate = "killed" if killer else "SURVIVED"
            count[fate] += 1
            print(f"{fate:8}  {file}:{line_of(text, mutant.start)}  {mutant.kind}: {described(text, mutant)}"
                  f"{'   by ' + killer if killer else ''}", flush=True)
    finally:
        copy.write_text(text, encoding="utf-8")
    return count


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="./dev mutate", description=__doc__.splitlines()[0])
    parser.add_argument("file", help="source to change, from the project's root")
    parser.add_argument("targets", nargs="*", metavar="target", help="test programs; default: of its floor")
    parser.add_argument("--lines", metavar="A-B", help="only changes in these lines")
    parser.add_argument("--only", metavar="KINDS", help="of operator, term, constant, extreme, condition, "
                        "return, statement, early return; separated by commas")
    parser.add_argument("--match", metavar="TEXT", help="only changes whose description has this text")
    parser.add_argument("--count", type=int, help="so many of them, chosen by the seed")
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    parser.add_argument("--filter", default="*", help="tests to run, a pattern of GoogleTest; default *")
    parser.add_argument("--slow", type=float, default=3, metavar="SECONDS",
                        help="tests that take longer are left out and named; default 3")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build; default %(default)s")
    parser.add_argument("--list", action="store_true", help="print the changes, build nothing")
    options = parser.parse_args(arguments)
    path = Path(options.file).resolve()
    if not path.is_file() or not path.is_relative_to(ROOT):
        parser.error(f"{options.file}: no file of this tree")
    options.file = path.relative_to(ROOT).as_posix()
    options.targets = options.targets or default_targets(options.file)
    if not options.targets:
        parser.error(f"{options.file}: name the test program")
    return options


def main(arguments=None):
    options = parsed(arguments)
    text = (ROOT / options.file).read_text(encoding="utf-8")
    found = chosen(text, mutants(text), options)
    if options.list:
        for mutant in found:
            print(f"{options.file}:{line_of(text, mutant.start)}  {mutant.kind}: {described(text, mutant)}")
        return 0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(130))
    write_tree(compiled_alone(files_of_tree(), options.file), TREE)
    linker = ["-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld"] if shutil.which("ld.lld") else []
    code, said = run(["cmake", *OPTIONS, *linker], cwd=TREE)
    if code == 0:
        code, said = build(options.targets, options.jobs)
    if code != 0:
        sys.exit(f"{said[-4000:]}\n./dev mutate: the tree does not build without a change")
    count = try_all(options.file, text, found, options.targets, options)
    killed, tried = count["killed"], count["killed"] + count["SURVIVED"]
    print(f"{options.file}: {killed} of {tried} killed, {100 * killed / max(tried, 1):.0f} %; "
          f"{count['no build']} did not compile, {count['the same']} are the same code")
    return 1 if count["SURVIVED"] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)

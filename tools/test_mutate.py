# SPDX-License-Identifier: Apache-2.0
"""Tests of mutate.py."""
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import mutate


class Mutate(unittest.TestCase):
    def changed(self, text, *kinds):
        return [text[:m.start] + m.new + text[m.end:] for m in mutate.mutants(text) if m.kind in kinds]

    def test_operators_and_terms(self):
        self.assertEqual(["x = a;", "x = a - b * -c;", "x = a + b / -c;", "x = a + b * c;"],
                         self.changed("x = a + b * -c;", "operator", "term"))
        self.assertEqual(["y = f(a >= b && !c);", "y = f(a < b);", "y = f(a < b || !c);", "y = f(a < b && c);"],
                         self.changed("y = f(a < b && !c);", "operator", "term"))
        self.assertEqual(["z = std::max(a, b);"], self.changed("z = std::min(a, b);", "extreme"))

    def test_a_term_ends_with_its_sum(self):
        self.assertEqual(["f(a, g(d - e));", "f(a + b * (c), g(d - e));", "f(a + b * (c - 1), g(d));"],
                         self.changed("f(a + b * (c - 1), g(d - e));", "term"))

    def test_constants(self):
        self.assertEqual(["x = 0.0 * y[0];", "x = 1.0 * y[0];"], self.changed("x = 0.5 * y[0];", "constant"))
        self.assertEqual(["int k = 1;"], self.changed("int k = 0;", "constant"))
        self.assertEqual([], self.changed("x = 1e-9; std::array<int, 3> a; case 4:", "constant"))

    def test_what_is_no_code_is_left_alone(self):
        self.assertEqual([], mutate.mutants(
            '// a + b < 1\n/* a * b */\n#include <a>\n#define A (1 + 2)\nf("a + 1");\n'
            "static_assert(a < b);\nassert(a == 1);\nstd::vector<Vec2> x;\nvoid f(const T& a, U* b);\n"))

    def test_conditions_and_answers(self):
        self.assertEqual(["  if (false) return true;", "  if (true) return true;", "  if (a(b)) return false;"],
                         self.changed("  if (a(b)) return true;", "condition", "return"))
        self.assertEqual(["while (false) f();"], self.changed("while (g()) f();", "condition"))
        self.assertEqual([], self.changed("if (const auto* a = f()) g();", "condition"))

    def test_statements_and_functions(self):
        text = "int f(int a) {\n  b_ = a;\n  c.push(a);\n  v.reserve(a);\n  return a;\n}\n"
        self.assertEqual(["  b_ = a;\n", "  c.push(a);\n"],
                         [line + "\n" for line in text.splitlines()
                          if any(line not in new.splitlines() for new in self.changed(text, "statement"))])
        self.assertEqual([], self.changed("x = y &&\n    is(a) &&\n    is(b);", "statement"))
        self.assertEqual([text.replace("{\n", "{ return {};\n")], self.changed(text, "early return"))
        self.assertEqual(["void A::f() const { return;\n}\n"],
                         self.changed("void A::f() const {\n}\n", "early return"))
        self.assertEqual([], self.changed("A::A(int b) {\n}\n", "early return"))

    def test_only_a_copy_is_changed_and_it_is_restored_whatever_happens(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder)
            (tree / "a.cpp").write_text("x = 1 + 2;", encoding="utf-8")
            seen = []

            def interrupted(*_, **__):
                seen.append((tree / "a.cpp").read_text(encoding="utf-8"))
                raise KeyboardInterrupt

            text = (tree / "a.cpp").read_text(encoding="utf-8")
            builder = mock.Mock(build=interrupted)
            with mock.patch.multiple(mutate, TREE=tree, Tests=mock.Mock(),
                                     Builder=mock.Mock(return_value=builder)):
                with self.assertRaises(KeyboardInterrupt):
                    mutate.try_all("a.cpp", text, mutate.mutants(text), [], mock.Mock())
            self.assertEqual(["x = 0 + 2;"], seen)
            self.assertEqual(text, (tree / "a.cpp").read_text(encoding="utf-8"))

    def test_the_copy_is_the_tree_and_what_was_built(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder)
            for name in ("build/a.o", "gone/b.cpp"):
                (copy / name).parent.mkdir(parents=True)
                (copy / name).write_bytes(b"old")
            mutate.write_tree({"dev": b"new"}, copy)
            self.assertEqual(["build/a.o", "dev"], sorted(
                path.relative_to(copy).as_posix() for path in copy.rglob("*") if path.is_file()))

# SPDX-License-Identifier: Apache-2.0
"""The checks complain about what they are for, and about nothing else."""

import tempfile
import unittest
from pathlib import Path

import check_docstrings
import check_files
import check_includes


class Includes(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check_includes.check(folder)

    def test_lower_floors_and_foreign_headers_are_welcome(self):
        self.assertEqual([], self.check({
            "src/microswarm/core/a.hpp": "#include <vector>\n",
            "src/microswarm/world/b.hpp": '#include "microswarm/core/a.hpp"\n#include "json.hpp"\n',
            "tests/world/b_test.cpp": '#include "microswarm/world/b.hpp"\n',
        }))

    def test_climbing_include(self):
        self.assertEqual(
            ["src/microswarm/core/a.hpp:2: src/microswarm/core climbs to src/microswarm/world"],
            self.check({
                "src/microswarm/core/a.hpp": '\n#include "microswarm/world/b.hpp"\n',
                "src/microswarm/world/b.hpp": "",
            }))

    def test_climbing_by_relative_path_and_to_the_tests(self):
        self.assertEqual(
            ["src/microswarm/core/a.cpp:1: src/microswarm/core climbs to src/microswarm/world",
             "src/microswarm/core/a.cpp:2: src/microswarm/core climbs to tests"],
            self.check({
                "src/microswarm/core/a.cpp": '#include "../world/b.hpp"\n#include "tests/c.hpp"\n',
                "src/microswarm/world/b.hpp": "",
                "tests/c.hpp": "",
            }))

    def test_floors_that_stay_apart(self):
        self.assertEqual(
            ["src/microswarm/vision/a.hpp:1: src/microswarm/vision and "
             "src/microswarm/navigation stay apart"],
            self.check({
                "src/microswarm/vision/a.hpp": '#include "microswarm/navigation/b.hpp"\n',
                "src/microswarm/navigation/b.hpp": "",
            }))

    def test_cycle(self):
        complaints = self.check({
            "src/microswarm/core/a.hpp": '#include "microswarm/core/b.hpp"\n',
            "src/microswarm/core/b.hpp": '#include "microswarm/core/c.hpp"\n',
            "src/microswarm/core/c.hpp": '#include "microswarm/core/a.hpp"\n',
        })
        self.assertEqual(1, len(complaints))
        self.assertIn("src/microswarm/core/c.hpp:1: cycle", complaints[0])


class Docstrings(unittest.TestCase):
    def lines(self, text):
        return [line for line, _ in check_docstrings.check_text(text)]

    def test_missing(self):
        self.assertEqual([2, 4, 6, 9], self.lines(
            "namespace microswarm {\n"
            "struct Plain {\n  int member(int);  };\n"
            "enum class Colour { red, green };\n\n"
            "template <class T = std::vector<int>>\nT f(T a = {}, int b = g(1));\n\n"
            "inline bool operator==(A, B) { return true; }\n"
            "}\n"))

    def test_present_and_shared_until_the_next_blank_line(self):
        self.assertEqual([9], self.lines(
            "namespace microswarm {\n"
            "/// Both of them.\n"
            "int f(int) {\n  return 1;\n}\n"
            "int f(double);\n"
            "int trailing();  ///< said here\n"
            "\n"
            "int f(char);\n"
            "}\n"))

    def test_exempt(self):
        self.assertEqual([], self.lines(
            "namespace microswarm {\n"
            "class Forward;\n"
            "inline constexpr double limit = square(2);\n"
            "using Callback = std::function<void(int)>;\n"
            "template <class T>\nconcept Small = requires(T t) { t.x(); };\n"
            "template <>\nstruct Traits<int> { };\n"
            "inline void Forward::step(int a) { a++; }\n"
            "// int commented_out();\n"
            "#define MACRO(x) f(x);\n"
            'constexpr char text[] = "int f();";\n'
            "namespace detail {\nint hidden();\n}\n"
            "}\n"))


class Files(unittest.TestCase):
    def test_complaints(self):
        self.assertEqual([], list(check_files.check_text(
            "a.hpp", f"// {check_files.LICENCE}\n#pragma once\n")))
        self.assertEqual([], list(check_files.check_text(
            "dev", f"#!/bin/bash\n# {check_files.LICENCE}\n")))
        self.assertEqual(3, len(list(check_files.check_text("a.hpp", "int x;\n" * 500))))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
"""The check of docstrings, texts and options complains about what it is for, and about nothing else."""

import unittest

import check_docstrings


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

    def test_a_docstring_of_nothing(self):
        self.assertEqual([2, 7], check_docstrings.orphans(
            "/// One,\n/// two.\n\n// A comment.\n\nint x;  ///< said here\n    /// At the end."))

    def test_comments_on_successive_lines_are_one(self):
        self.assertEqual(
            [(1, True, "A first and a second line."), (3, False, "a comment"), (4, False, "another one"),
             (5, True, "of x"), (6, True, "of y"), (7, True, "In C, of two lines.")],
            check_docstrings.comments(
                "/// A first\n/// and a second line.\n// a comment\nf(); // another one\n"
                "int x;  ///< of x\nint y;  ///< of y\n/** In C,\n *  of two lines. */\n"
                'const char* s = "// none";\n'))

    def test_phrases(self):
        def words(text):
            return [(line, what.split("'")[1]) for line, what in check_docstrings.phrases(text)]

        found = words(check_docstrings.comments(
            "/// What comes of it.\nint f();\n\n// It goes\n// on for ever.\nint x;  ///< where it is, told\n"
            "/// What\n/// remains.\nint g();\n// What is plain in an ordinary comment.\n"
            "/// The path, but for its end.\n/// `whatever` is a name.\nint h();\n"))
        self.assertEqual([(1, "What"), (4, "for ever"), (4, "goes on"), (6, "told"), (7, "What"), (11, "but for")],
                         found)
        self.assertEqual([(1, "seldom"), (3, "How"), (5, "anew")], words(check_docstrings.docstrings(
            '"""A module, seldom used."""\ndef f():\n    """How it is.\n\n    Well."""  # anew\n')))

    def test_texts(self):
        found = check_docstrings.literals(
            'f("the file tells", // "a comment tells"\n  "told", \'"\');\n'
            'throw InputError("goes on as "\n    "the file tells");\nR"(seldom\ntold one)";\n')
        self.assertEqual([(1, "the file tells"), (2, "told"), (3, "goes on as the file tells"), (5, "seldom\ntold one")],
                         found)
        self.assertEqual([(1, "tells"), (3, "tells"), (5, "told"), (5, "seldom")],
                         [(line, what.split("'")[1]) for line, what in check_docstrings.bad_texts(found)])
        found = check_docstrings.python_literals('"""Told."""\nx = f"{told(y)} is told {z}"\n')
        self.assertEqual([(2, "told")],
                         [(line, what.split("'")[1]) for line, what in check_docstrings.bad_texts(found)])

    def test_options(self):
        found = check_docstrings.literals(
            'fail("give um_per_px (--um-per-px)");  // --set\nf("a -- b", "--", "x --"\n "--out");\n')
        self.assertEqual([(1, "--um-per-px"), (2, "--out")],
                         [(line, what.split("'")[1]) for line, what in check_docstrings.options(found)])

    def test_every_phrase_has_a_hint(self):
        for pattern, hint in check_docstrings.PHRASES:
            self.assertTrue(hint, pattern.pattern)
            self.assertFalse(any(other.search(hint) for other, _ in check_docstrings.PHRASES), hint)

# SPDX-License-Identifier: Apache-2.0
"""The checks complain about what they are for, and about nothing else."""

import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import check_files
import check_includes
import check_links
import check_maths
import check_rows
import check_version
import figures_page
import man_pages
import merge_units
import reference
import safety_page


class MergedUnits(unittest.TestCase):
    def test_libraries_are_merged_with_the_options_of_all(self):
        def command(file, options):
            return {"directory": "/b", "file": file, "command": f"c++ {options} -o x.o -c {file}"}

        library = [command("/b/a.cxx", "-fPIC -DA -isystem /x"), command("/b/b.cxx", "-fPIC -isystem /y -DA")]
        others = [command("/b/p.cxx", "-fPIE"), command("/b/m.cxx", "-fPIC -Dm_EXPORTS"), command("/s/c.cpp", "-fPIC")]
        self.assertEqual(library, [c for c in library + others if merge_units.is_library(c)])
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "units_0.cpp"
            merged = merge_units.merge(library, file)
            self.assertEqual('#include "/b/a.cxx"\n#include "/b/b.cxx"\n', file.read_text(encoding="utf-8"))
        self.assertEqual(f"c++ -fPIC -DA -isystem /x -isystem /y -c {file}", merged["command"])


class Includes(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            floors = Path(__file__).resolve().parent.parent / "CMakeLists.txt"
            shutil.copy(floors, folder)
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

    def test_cycle_of_folders(self):
        complaints = self.check({
            "src/microswarm/world/map/a.hpp": '#include "microswarm/world/body/b.hpp"\n',
            "src/microswarm/world/map/c.hpp": "",
            "src/microswarm/world/body/b.hpp": "",
            "src/microswarm/world/body/d.hpp": '\n#include "microswarm/world/map/c.hpp"\n',
        })
        self.assertEqual(1, len(complaints))
        self.assertIn("cycle src/microswarm/world/", complaints[0])

    def test_an_algorithm_among_parameters(self):
        self.assertEqual(["src/microswarm/navigation/a_params.hpp:1: "
                          "src/microswarm/navigation/b.hpp is more than parameters"], self.check({
            "src/microswarm/navigation/a_params.hpp":
                '#include "microswarm/navigation/b.hpp"\n#include "microswarm/core/c.hpp"\n',
            "src/microswarm/navigation/b.hpp": "",
            "src/microswarm/core/c.hpp": "",
        }))


class Files(unittest.TestCase):
    def test_complaints(self):
        self.assertEqual([], list(check_files.check_text(
            "a.hpp", f"// {check_files.LICENCE}\n#pragma once\n")))
        self.assertEqual([], list(check_files.check_text(
            "dev", f"#!/bin/bash\n# {check_files.LICENCE}\n")))
        self.assertEqual(3, len(list(check_files.check_text("a.hpp", "int x;\n" * 500))))


class Links(unittest.TestCase):
    def check(self, text, page="pages/how-to/a.md"):
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "pages/b.md"
            other.parent.mkdir()
            other.write_text("# One, two\n## `x`: D-RRT*\n## `x`: D-RRT*\n```\n# no\n```\n",
                             encoding="utf-8")
            return list(check_links.check_page(Path(folder), page, text))

    def test_links_that_lead_somewhere(self):
        self.assertEqual([], self.check(
            "[a](../b.md) [b](../b.md#one-two) ![c](<../b.md> \"b\")\n"
            "[e](../b.md#x-d-rrt-1) [f](https://a.b/c#d) [g](mailto:a@b)\n"
            "`[h](h.md)`\n```\n[i](i.md)\n```\n\n    [j](j.md)\n"))
        self.assertEqual([], self.check("[d](#one-two)", "pages/b.md"))

    def test_broken_links(self):
        self.assertEqual(
            ["pages/how-to/a.md:1: no such file: b.md",
             "pages/how-to/a.md:2: no such heading: ../b.md#two",
             "pages/how-to/a.md:2: no such heading: ../b.md#no",
             "pages/how-to/a.md:3: no such file: ../../../b.md"],
            self.check("[a](b.md)\n[b](../b.md#two) [c](../b.md#no)\n[d\ne](../../../b.md)"))

    def test_pages_that_sources_name(self):
        root, gone = Path(__file__).resolve().parent.parent, "docs/" + "nowhere.md"
        self.assertEqual([f"a.hpp:2: no such file: {gone}"], list(check_links.check_source(
            root, "a.hpp", f"// docs/index.md\n// {gone}, see build/{gone}\n")))


class Maths(unittest.TestCase):
    def lines(self, text):
        return [int(found.split(":")[1]) for found in check_maths.check_text("a.cpp", text)]

    def test_calls_of_the_c_library(self):
        self.assertEqual([1, 2, 3, 4, 5, 6, 7, 8, 9], self.lines(
            "double a = std::sin(x);\n"
            "double b = 2 * cos(x) + 1;\n"
            "return exp(x);\n"
            "auto f = &std::log;\n"
            "float g = ::atan2f(y, x);\n"
            "cv::log(even, even);\n"
            "std::normal_distribution<double> noise;\n"
            "x = y > hypot(a, b);\n"
            "f(a, pow(b, 2));\n"))

    def test_exempt(self):
        self.assertEqual([], self.lines(
            "double a = maths::sin(x) + std::sqrt(std::abs(y)) + std::fma(a, b, c);\n"
            "// std::sin(x)\n"
            'throw Error("std::sin(x)");  /* cos(x)\n tan(x) */\n'
            "CommandLog& log();\n"
            "std::vector<int> log(int a);\n"
            "std::string LogWriter::log(int a) const;\n"
            "session.log().add(x);\n"
            "std::log_wrapper::f(x); is_log(x); Eigen::exp_of(x);\n"))


class Version(unittest.TestCase):
    TEXTS = {
        "cmake": "cmake_minimum_required(VERSION 3.25)\nproject(microswarm VERSION 1.2.3 LANGUAGES C)\n",
        "citation": "cff-version: 1.2.0\nauthors:\n  - name: the authors\nversion: 1.2.3\ndate-released: 2026-01-02\n",
        "changelog": "# Changelog\n\n## [Unreleased]\n\n## [1.2.3] - 2026-01-02\n\n## [1.2.2] - 2025-01-02\n",
        "notice": "a\nCopyright 2026 the authors\n",
        "package": '{"name": "a", "author": "the authors"}',
        "doxyfile": "PROJECT_NUMBER = $(MICROSWARM_VERSION)\n",
    }

    def complaints(self, **texts):
        return check_version.complaints_of(**{**self.TEXTS, **texts})

    def test_one_version_and_one_owner(self):
        self.assertEqual([], self.complaints())

    def test_every_place_is_looked_at(self):
        for name, now, then in (("cmake", "1.2.3", "1.2.4"), ("cmake", "project", "# project"),
                                ("citation", "version: 1.2.3", "version: 1.2.2"),
                                ("citation", "2026-01-02", "2026-01-03"),
                                ("citation", "the authors", "others"),
                                ("changelog", "[1.2.3]", "[1.2.4]"),
                                ("changelog", "## [Unreleased]\n", ""), ("notice", "the authors", "others"),
                                ("package", "the authors", "others"),
                                ("package", '"a"', '"a", "version": "1.2.2"'),
                                ("doxyfile", "$(MICROSWARM_VERSION)", "1.2.3")):
            self.assertTrue(self.complaints(**{name: self.TEXTS[name].replace(now, then)}), (name, then))


class Rows(unittest.TestCase):
    def row(self, quantity="q", **values):
        return {"figure": "fig1", "quantity": quantity, "unit": "µm", "paper": 2.0, "aim": 2.2,
                "ok": True, "ours": 2.0} | values

    def test_near_is_the_same(self):
        self.assertEqual([], list(check_rows.differences(
            [self.row(ours=2.03), self.row("r", unit="%", ours=0.9)],
            [self.row(), self.row("r", unit="%", ours=0.0)])))

    def test_another_value_aim_or_verdict(self):
        self.assertEqual(
            ["fig1: q: aim is 3.0, stored is 2.2", "fig1: q: ok is False, stored is True",
             "fig1: q: ours is 2.1, stored is 2.0"],
            sorted(check_rows.differences([self.row(ours=2.1, aim=3.0, ok=False)], [self.row()])))

    def test_nothing_is_no_zero(self):
        self.assertEqual(["fig1: q: ours is None, stored is 0.0"],
                         list(check_rows.differences([self.row(ours=None)], [self.row(ours=0.0)])))

    def test_missing_and_new_rows(self):
        self.assertEqual(
            ["fig1: new: was measured but is not stored",
             "fig1: old: is stored but was not measured"],
            sorted(check_rows.differences([self.row("new")], [self.row("old")])))

    def test_times_are_only_looked_for(self):
        stored = check_rows.renewed([self.row(), self.row("time", ours=1.0)],
                                    [self.row(), self.row("time", ours=1.5)])
        self.assertEqual([], list(check_rows.differences(
            [self.row(), self.row("time", ours=9.0, ok=False)], stored)))
        self.assertEqual(2.0, stored[0]["ours"])

    def test_a_row_without_an_aim_says_why(self):
        self.assertEqual(["fig1: q: has no aim and does not say why"],
                         list(check_rows.faults_of([self.row(aim=None)])))
        self.assertEqual([], list(check_rows.faults_of([self.row(aim=None, note="only drawn")])))

    def test_two_rows_of_one_name(self):
        self.assertEqual(["fig1: q: there are two such rows"],
                         list(check_rows.faults_of([self.row(), self.row()])))


class FiguresPage(unittest.TestCase):
    def test_rows_with_a_published_value(self):
        row = {"figure": "fig1", "quantity": "|q|", "unit": "µm", "paper": 2.0, "aim": 2.2, "ok": True,
               "ours": 12345.6}
        time = row | {"quantity": "time"}
        text = figures_page.section("drrt", figures_page.published(
            [row, row | {"paper": None}, time, row | {"unit": "1", "aim": None, "ok": None, "ours": 0.123456}],
            [row, time | {"varies": True, "ours": None}]))
        self.assertIn("2 rows; of 1 that can be judged, 1 are met.", text)
        self.assertTrue(text.endswith(
            "| --- |\n| fig1 | \\|q\\| | 2 µm | 12,346 µm | 2.2 | yes |\n"
            "| fig1 | \\|q\\| | 2 | 0.1235 | – | – |\n"), text)


class Reference(unittest.TestCase):
    @staticmethod
    def option(*names, **more):
        return {"names": list(names), "value": "", "words": [], "default": "off", "required": False,
                "repeatable": False, "needs": [], "excludes": [], "doc": "Where"} | more

    def test_options_become_rows(self):
        self.assertEqual(
            ["| `-h,--help` | Where |\n",
             "| `--rig FILE` | Where. Required. Not with `--trials`, `--jobs`. |\n",
             "| `--to NAME` | Where \\| how (repeatable) (default: a \\| b). Needs `--out`. |\n",
             "| `kind` | Where (default: a). One of `a`, `b`. |\n",
             "| `out FILE` | Where |\n"],
            [reference.option_row(each) for each in (
                self.option("-h", "--help"),
                self.option("--rig", value="FILE", required=True, default="required",
                            excludes=["--trials", "--jobs"]),
                self.option("--to", value="NAME", doc="Where | how", repeatable=True,
                            default="a | b", needs=["--out"]),
                self.option("kind", value="KIND", words=["a", "b"], default="a"),
                self.option("out", value="FILE", default="none"))])

    def test_a_command_becomes_a_section_and_a_page(self):
        command = {"name": "go", "doc": "Goes.", "arguments": [self.option("to", value="FILE")],
                   "options": [self.option("-h", "--help"), self.option("--far")],
                   "example": "  m go b \\\n      --far", "commands": []}
        self.assertEqual(
            "### go\n\nGoes.\n\n    microswarm go [OPTIONS] [to]\n\n| | |\n|---|---|\n| `to FILE` | Where |\n"
            "| `--far` | Where |\n\nExample:\n\n    m go b \\\n        --far\n\n",
            reference.command_section([], command))
        root = {"name": "m", "doc": "All.", "arguments": [], "options": [], "commands": [command],
                "footer": "See.\nExit codes: 0 good;\n1 bad."}
        pages = dict(man_pages.pages([], root, "head"))
        self.assertEqual(["m", "m-go"], list(pages))
        for part in ("\\fBm\\fR [OPTIONS] SUBCOMMAND\n", "\\fBm\\-go\\fR(1)\nGoes.\n",
                     '.SH "EXIT STATUS"\n0 good; 1 bad.\n'):
            self.assertIn(part, pages["m"])
        for part in ("m\\-go \\- Goes\n", "\\fBm go\\fR [OPTIONS] [to]\n", ".TP\n\\fB\\-\\-far\\fR\nWhere.\n",
                     "m go b \\e\n    \\-\\-far\n", '.SH "SEE ALSO"\n\\fBm\\fR(1)\n'):
            self.assertIn(part, pages["m-go"])

    def test_keys_become_tables(self):
        def key(name, doc, **more):
            return {"key": name, "unit": "", "default": "", "range": "", "words": [], "doc": doc, "keys": [],
                    "types": []} | more

        keys = [key("a_um", "One.", unit="µm", default="1.2345678", range="0..1"),
                key("b", "Two.", default="required",
                    keys=[key("c", "Three.", default="x", words=["x", "y"]),
                          key("f", "Six.", default="true", words=["true", "false"])]),
                key("d", "Four.", default="x",
                    types=[{"type": "x", "keys": [key("e", "Five.", unit="s", default="none")]},
                           {"type": "y", "keys": []}])]
        text = reference.Page().of("rig", keys)
        for row in ("- [b](#rig-b)\n- [d](#rig-d): [x](#d-x), [y](#d-y)\n",
                    "| `a_um` | µm | `1.23457` | 0 … 1 | One. |\n",
                    "### rig: `b`\n\nTwo.\n\n", "| `b.c` |  | `x` | `x`, `y` | Three. |\n",
                    "| `b.f` |  | `true` |  | Six. |\n",
                    "#### `d`: `x`\n\n", "| `e` | s |  |  | Five. |\n", "#### `d`: `y`\n\nNo keys.\n"):
            self.assertIn(row, text)


class SafetyPage(unittest.TestCase):
    @staticmethod
    def row(course="open", navigator="radar", avoidable="1"):
        return {"course": course, "navigator": navigator, "worlds": "1000",
                "contacts_a_run": "0.002", "avoidable_a_run": "0.001",
                "worlds_avoidable": avoidable, "worlds_arrived": "1000",
                "slowness_median": "", "delta_mean": "0.0213", "turning_median_deg": "123.4"}

    def test_tables_are_printed_between_their_marks(self):
        page = "a\n<!-- safety: open -->\nold\n<!-- end -->\nb\n"
        text, missing = safety_page.printed(page, [self.row(), self.row(course="walls")])
        self.assertEqual([], missing)
        self.assertIn("| radar | 1,000 | 0.002 | 0.001 | 0.1 (0.0177–0.564) | 100 (99.6–100) | – |",
                      text)
        self.assertNotIn("old", text)
        self.assertEqual((text, []), safety_page.printed(text, [self.row()]))

    def test_a_table_without_rows(self):
        page = "<!-- safety: fast -->\n<!-- end -->"
        self.assertEqual(["fast"], safety_page.printed(page, [self.row()])[1])

    def test_taken_rows_replace_those_of_their_name(self):
        rows = safety_page.taken([self.row(), self.row(navigator="safe_interval")],
                                 [self.row(avoidable="3")])
        self.assertEqual(["3", "1"], [row["worlds_avoidable"] for row in rows])

    def test_what_is_no_whole_campaign_is_refused(self):
        def refused(row):
            with self.assertRaises(SystemExit) as caught:
                safety_page.whole("f.csv", [row] if row else [], ["open"])
            return str(caught.exception)

        whole = {**self.row(), "extent": "full"}
        self.assertEqual([self.row()], safety_page.whole("f.csv", [dict(whole)], ["open"]))
        self.assertEqual("f.csv: has no rows", refused(None))
        self.assertIn("f.csv:2: no table of a campaign", refused({"a": "b"}))
        self.assertIn("f.csv:2: no table of a campaign", refused({**whole, None: ["more"]}))
        self.assertIn("not of a whole campaign: quick", refused({**whole, "extent": "quick"}))
        self.assertIn("no table of that course", refused({**whole, "course": "sea"}))
        for bad in ("many", "-5", "1_0", "1001"):
            self.assertIn("f.csv:2: open, radar: worlds_arrived", refused({**whole, "worlds_arrived": bad}))
        self.assertIn("delta_mean is 'nan'", refused({**whole, "delta_mean": "nan"}))
        self.assertIn("must be a name", refused({**whole, "navigator": "a | b"}))
        self.assertIn("no table of a campaign", refused(dict(reversed(whole.items()))))
        with self.assertRaises(SystemExit):
            safety_page.whole("f.csv", [dict(whole), dict(whole)], ["open"])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# The mutation run can fail: a test that checks nothing lets every mutant live, a good test kills
# them, and the list of equivalent mutants must be true.
#   in   the C++ compiler as the only argument
# SPDX-License-Identifier: Apache-2.0
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import equivalent_list  # noqa: E402
import mutate  # noqa: E402
import operators  # noqa: E402
import targets  # noqa: E402
from source_text import Source  # noqa: E402

TOY = """#include "toy/toy.hpp"
// A comment with a < b and 7.
bool is_low(int value) {
  if (value < kLimit) return true;
  return false;
}
"""
HEADER = "#pragma once\nconstexpr int kLimit = 3;\nbool is_low(int value);\n"
AROUND = '#pragma once\n#include "toy/toy.hpp"\n'
TEST = '#include "toy/toy.hpp"\nint main() { return %s ? 0 : 1; }\n'
BLIND = TEST % "true"
GOOD = TEST % "is_low(2) && !is_low(3) && !is_low(4)"
WITHOUT_BOUNDARY = TEST % "is_low(1) && !is_low(5)"
ENTRY = "boundary toy/toy.cpp\n- if (value < kLimit) return true;\n+ %s\n= For the test.\n"
TARGETS = """[toy]
sources = ["toy/toy.cpp"]
headers = ["toy/toy.hpp"]
tests = ["toy/toy_test.cpp"]
support = []
"""
LIVING = "if (value <= kLimit) return true;"
compiler = "c++"


def texts(family, code, enums=None, path="x.cpp"):
    source = Source(path, code)
    found = operators.FAMILIES[family](source, enums or {})
    return [code[:start] + other + code[end:] for start, end, other in found]


class Families(unittest.TestCase):
    def expect(self, family, code, *wanted, enums=None):
        self.assertEqual(sorted(texts(family, code, enums)), sorted(wanted))

    def test_each_changes_what_it_names(self):
        self.expect("relational", "x = a < b; ", "x = a >= b; ")
        self.expect("boundary", "x = a < b; ", "x = a <= b; ")
        self.expect("arithmetic", "x = a % b; ", "x = a * b; ")
        self.expect("sign", "x = -b; ", "x = b; ")
        self.expect("logical", "x = a && !b; ", "x = a || !b; ", "x = a && b; ")
        self.expect("constant", "x = 1u; ", "x = 2u; ", "x = 0u; ", "x = (-1u); ")
        self.expect("constant", "x = 0.5; ", *(f"x = {n}; " for n in ("1.5", "(-0.5)", "0.0")))
        self.expect("boolean", "x = true; ", "x = false; ")
        self.expect("extreme", "x = std::min(a, b); ", "x = std::max(a, b); ")
        self.expect("extreme", "x = std::abs(a); ", "x = (a); ")
        self.expect("index", "x = a[i]; ", "x = a[(i) + 1]; ", "x = a[(i) - 1]; ")
        self.expect("order", "x{E::kA, E::kB, E::kC}; ", "x{E::kB, E::kA, E::kC}; ",
                    "x{E::kA, E::kC, E::kB}; ")  # fmt: skip
        self.expect("enumerator", "using enum E; x = kB; ", "using enum E; x = kA; ",
                    enums={"E": ["kA", "kB"]})  # fmt: skip
        self.expect("enumerator", "x = E::kB; ", "x = E::kC; ", "x = E::kA; ",
                    enums={"E": ["kA", "kB", "kC"]})  # fmt: skip

    def test_conditions(self):
        self.expect("condition", "if (a) b(); ", "if (!(a)) b(); ")
        self.expect("condition", "return a == b ? c : d; ", "return !(a == b) ? c : d; ")
        self.expect("condition", "for (;a;) b(); ", "for (;!(a);) b(); ")

    def test_statements_and_returns(self):
        self.expect("statement", "void f() { int a = 1; g(a); return; } ",
                    "void f() { int a = 1; ; return; } ")  # fmt: skip
        self.expect("statement", "void f() { if (a) { ++b; } else c = d; } ",
                    "void f() { ; } ", "void f() { if (a) { ; } else c = d; } ",
                    "void f() { if (a) { ++b; } else ; } ")  # fmt: skip
        self.expect("statement", "void f() { switch (a) { case 1: break; default: break; } } ",
                    "void f() { switch (a) { case 1: ; default: break; } } ")  # fmt: skip
        self.expect("statement", "void f() { CHECK(a == b); g(a); } ",
                    "void f() { CHECK(a == b); ; } ")  # fmt: skip
        self.expect("return", "int f() { return a + b; } ", "int f() { return {}; } ")
        self.expect("return", "int f() { return 0; } E g() { return E::kA; } ",
                    enums={"E": ["kA", "kB"]})  # fmt: skip

    def test_typescript(self):
        code = "const f = (x: number) => { if (x !== /[<1]/g) a ??= `1 < ${x}`; return E.b; }; "
        self.assertEqual(
            texts("relational", code, path="x.ts"), [code.replace("!==", "===")])  # fmt: skip
        self.assertEqual(texts("constant", code, path="x.ts"), [])
        self.assertEqual(texts("arithmetic", "let a: T | null = b | c; ", path="x.ts"),
                         ["let a: T | null = b & c; "])  # fmt: skip
        self.assertEqual(texts("return", code, path="x.ts"), [code.replace("E.b", "undefined")])
        source = Source("x.ts", "export const enum E {\n  a = 0,\n  b = 1,\n}\n")
        enums = operators.enumerations(source)
        self.assertEqual(enums, {"E": ["a", "b"]})
        self.assertEqual(texts("enumerator", code, enums, "x.ts"), [code.replace("E.b", "E.a")])

    def test_ranges(self):
        self.expect("range_end", "for (int i = 0; i < n; ++i) f(i); ",
                    "for (int i = 0 + 1; i < n; ++i) f(i); ",
                    "for (int i = 0; i < n - 1; ++i) f(i); ",
                    "for (int i = 0; i < n + 1; ++i) f(i); ")  # fmt: skip

    def test_what_is_no_code_stays(self):
        for family in operators.FAMILIES:
            self.expect(family, '// a < 1\n#define A (1 < 2)\nstd::array<T> a{"1 < 2", \'1\'};\n')

    def test_enumerations_are_read(self):
        source = Source("x.hpp", "enum class E : char { kA, kB = 4, kC };\n")
        self.assertEqual(operators.enumerations(source), {"E": ["kA", "kB", "kC"]})


class Runs(unittest.TestCase):
    def run_on(self, test, listed="", more=()):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "toy").mkdir()
            files = {"toy/toy.cpp": TOY, "toy/toy.hpp": HEADER, "toy/toy_test.cpp": test,
                     "toy/around.hpp": AROUND, "toy.txt": listed,
                     "targets.toml": TARGETS}  # fmt: skip
            for name, text in files.items():
                (root / name).write_text(text)
            out, error = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
                code = mutate.main(
                    ["--root", folder, "--targets", str(root / "targets.toml"),
                     "--compile", f"{compiler} -std=c++20 -O0 -w -I.",
                     "--equivalent", folder, *more])  # fmt: skip
            return code, out.getvalue(), error.getvalue()

    def test_a_good_test_kills_every_mutant(self):
        code, out, error = self.run_on(GOOD)
        self.assertEqual((code, error), (0, ""), out)
        self.assertNotIn(": survived", out)

    def test_a_blind_test_lets_every_mutant_live(self):
        code, out, _ = self.run_on(BLIND)
        self.assertEqual(code, 1)
        self.assertEqual(out.count(": survived"), int(out.split("\nall ")[1].split()[0]))
        self.assertIn("toy/toy.cpp:4:13: survived", out)
        self.assertIn("toy/toy.hpp:2:24: survived", out)

    def test_a_header_reached_through_another_is_mutated_all_the_same(self):
        code, out, _ = self.run_on('#include "toy/around.hpp"\n' + BLIND)
        self.assertEqual(code, 1)
        self.assertIn("toy/toy.hpp:2:24: survived", out)

    def test_a_file_of_which_no_mutant_compiles_is_an_error(self):
        held = 'static_assert(kLimit == 3 && sizeof(&is_low) > 0);\n'
        code, _, error = self.run_on(BLIND.replace("int main", held + "int main"))
        self.assertEqual(code, 2)
        self.assertIn("no mutant of toy/toy.hpp compiles", error)

    def test_a_survivor_is_named_unless_it_is_listed(self):
        code, out, _ = self.run_on(WITHOUT_BOUNDARY)
        self.assertEqual(code, 1)
        self.assertIn(LIVING, out)
        known = [block for block in out.split("\n\n") if ": survived" in block]
        listed = "\n".join("\n".join(b.splitlines()[-3:]) + "\n= A reason.\n" for b in known)
        code, out, error = self.run_on(WITHOUT_BOUNDARY, listed)
        self.assertEqual((code, error), (0, ""), out)

    def test_a_listed_mutant_that_dies_or_is_gone_is_an_error(self):
        code, out, _ = self.run_on(GOOD, ENTRY % LIVING)
        self.assertEqual(code, 1)
        self.assertIn("listed as equivalent, but killed", out)
        code, out, _ = self.run_on(GOOD, ENTRY % "if (value == kLimit) return true;")
        self.assertEqual(code, 1)
        self.assertIn("there is no such mutant", out)

    def test_tests_that_fail_by_themselves_say_nothing_about_mutants(self):
        code, _, error = self.run_on(TEST % "false")
        self.assertEqual(code, 2)
        self.assertIn("fail without any mutation", error)

    def test_an_interrupted_run_goes_on_where_it_stood(self):
        with tempfile.NamedTemporaryFile("r") as state:
            self.run_on(WITHOUT_BOUNDARY, more=("--state", state.name))
            noticed = state.read().splitlines()
            self.assertTrue(noticed and all(" killed" in n or " did" in n for n in noticed))
            # What was noticed is believed, though this test would notice nothing; the rest is not.
            code, out, _ = self.run_on(BLIND, more=("--state", state.name))
        self.assertEqual(code, 1)
        total = int(out.split("\nall ")[1].split()[0])
        self.assertEqual(out.count(": survived"), total - len(noticed))

    def test_a_target_that_names_no_file_or_a_strange_key_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "targets.toml"
            for text in ("[a]\nsources = ['gone.cpp']\ntests = ['gone.cpp']\n",
                         "[a]\nsources = ['targets.toml']\ntests = ['targets.toml']\nfast = 1\n",
                         "[a]\nsources = ['targets.toml']\n"):  # fmt: skip
                path.write_text(text)
                with self.assertRaises((ValueError, TypeError)):
                    targets.read(path, path.parent, path.parent)

    def test_an_entry_without_a_reason_is_refused(self):
        with self.assertRaises(ValueError):
            equivalent_list.read("boundary toy.cpp\n- a\n+ b\n", "list.txt")


if __name__ == "__main__":
    compiler = sys.argv.pop(1) if len(sys.argv) > 1 else compiler
    unittest.main()

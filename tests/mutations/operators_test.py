#!/usr/bin/env python3
"""The mutations would prove nothing if they changed comments or nothing at all."""

import unittest

import operators


class Mutants(unittest.TestCase):
    def texts(self, text):
        return {mutant.apply(text) for mutant in operators.mutants_of("a.cc", text)}

    def test_each_changes_the_text(self):
        text = "double F(double a) { return a * 2.0 + std::sin(a) - 0.5; }\nbool G(int a) { return a < 3 && a == 1; }\n"
        texts = self.texts(text)
        self.assertGreaterEqual(len(texts), 8)
        self.assertNotIn(text, texts)

    def test_sum_becomes_difference(self):
        self.assertIn("int a = b - c(d);", self.texts("int a = b + c(d);"))

    def test_last_term_is_dropped(self):
        self.assertIn("int a = b;", self.texts("int a = b - c.d();"))

    def test_comments_strings_and_templates_stay(self):
        self.assertEqual(self.texts('// a + b\nstd::vector<int> v;  /* a < b */\nF("a + b", *p);\n'), set())

    def test_line_of_a_mutant(self):
        self.assertEqual([m.line for m in operators.mutants_of("a.cc", "\n\nint a = b == c;\n")], [3])


if __name__ == "__main__":
    unittest.main()

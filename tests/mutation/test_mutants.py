"""What is taken for a place where code can be wrong, and what is not."""

import collections
import unittest

import mutants
import published


class Places(unittest.TestCase):
    def found(self, source):
        return [(mutant.operator, mutant.column, mutant.before, mutant.after) for mutant in mutants.mutants_of("a.cpp", source)]

    def test_each_kind_of_operator(self):
        self.assertEqual([("arithmetic", 2, "+", "-"), ("arithmetic", 6, "*", "/")], self.found("a + b * c;"))
        self.assertEqual([("comparison", 2, "<", "<="), ("logical", 6, "&&", "||"), ("comparison", 11, "!=", "==")], self.found("a < b && c != d;"))
        self.assertEqual([("assignment", 4, "+=", "-=")], self.found("sum += x;"))
        self.assertEqual([("negation", 4, "!", "")], self.found("if (!done) go();"))
        self.assertEqual([("arithmetic", 12, "*", "/"), ("sign", 7, "-", ""), ("sign", 14, "-", "")], self.found("return -arm * -b;"))
        self.assertEqual([("constant", 4, "0.5", "1.5"), ("constant", 10, "2", "3")], self.found("f(a[0.5], 2u);"))

    def test_what_is_no_operator(self):
        for source in ("std::vector<double> a;", "const int* p, *q;", "auto&& x", "// a + b", '"a + b 1"', "#include <a/b.hpp>", "Vec2 x2;", "1e-12",
                       "'+'", 'R"(a + 1)"', "/* a\n + b */", "p->x()", "++i, --k", "template <int N = 2>"):
            self.assertEqual([], self.found(source), source)

    def test_only_one_place_of_one_line_changes(self):
        source = "a + b;\nc + d + e;\nf;"
        last = mutants.mutants_of("a.cpp", source)[-1]
        self.assertEqual("a + b;\nc + d - e;\nf;", last.applied(source))
        self.assertEqual(last.key, mutants.mutants_of("a.cpp", "\n  " + source.split("\n")[1])[-1].key)

    def test_next_is_the_folder_of_which_fewest_are_judged(self):
        judged = collections.Counter(a=2)
        order = []
        for mutant in mutants.in_turns({"a": [1, 2], "b": [3, 4, 5, 6], "c": []}, judged):
            order.append(mutant)
            judged["a" if mutant < 3 else "b"] += mutant != 4  # which does not compile
        self.assertEqual([3, 4, 5, 1, 6, 2], order)


class TakenUp(unittest.TestCase):
    source = "f();\n  a = b + c + d;\nx * y;"

    def place(self, **row):
        found = published.taken_up({"file": "a.cpp", "line": "7", **row}, self.source)
        return found and (found.line, found.column)

    def test_moved_line_is_known_by_its_text_and_the_column_in_it(self):
        self.assertEqual((3, 2), self.place(code="x * y;", change="* → /", column="3"))
        self.assertIsNone(self.place(code="x * z;", change="* → /", column="3"))
        self.assertIsNone(self.place(code="x * y;", change="/ → *", column="3"))
        self.assertEqual((2, 8), self.place(code="a = b + c + d;", change="+ → -", column="7"))
        self.assertEqual((2, 12), self.place(code="a = b + c + d;", change="+ → -", column="11"))
        self.assertIsNone(self.place(code="a = b + c + d;", change="+ → -", column="8"))


if __name__ == "__main__":
    unittest.main()

"""Small mistakes that a programmer could make, as changes of one place of a C++ text.

A place is found in the text without comments and strings, so a mutant always changes the program.
"""

import dataclasses
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "architecture"))
import source  # noqa: E402

# Name of the mistake, what is looked for, what stands there instead. Operators between spaces only: `vector<int>` and
# `*pointer` are no places.
MISTAKES = (
    ("sum becomes difference", r'(?<=[\w)\]]) \+ (?=[\w(])', " - "),
    ("difference becomes sum", r'(?<=[\w)\]]) - (?=[\w(])', " + "),
    ("product becomes quotient", r'(?<=[\w)\]]) \* (?=[\w(])', " / "),
    ("quotient becomes product", r'(?<=[\w)\]]) / (?=[\w(])', " * "),
    ("added becomes subtracted", r' \+= ', " -= "),
    ("subtracted becomes added", r' -= ', " += "),
    ("below becomes at most", r'(?<=[\w)\]]) < (?=[\w(-])', " <= "),
    ("above becomes at least", r'(?<=[\w)\]]) > (?=[\w(-])', " >= "),
    ("at most becomes below", r' <= ', " < "),
    ("at least becomes above", r' >= ', " > "),
    ("equal becomes different", r' == ', " != "),
    ("and becomes or", r' && ', " || "),
    ("sign dropped", r'(?<=[(,=] )-(?=[\w(])|(?<=\()-(?=[a-zA-Z_(])|(?<=return )-(?=[\w(])', ""),
    ("last term dropped", r'(?<=[\w)\]]) [+-] [\w.()\[\]:>-]+(?=;)', ""),
    ("half becomes one", r'\b0\.5\b', "1.0"),
    ("two becomes one", r'\b2\.0\b', "1.0"),
    ("one becomes zero", r'(?<=[ (,])1\.0\b', "0.0"),
    ("sine becomes cosine", r'\bstd::sin\(', "std::cos("),
    ("cosine becomes sine", r'\bstd::cos\(', "std::sin("),
    ("transpose dropped", r'\.transpose\(\)', ""),
)


@dataclasses.dataclass(frozen=True)
class Mutant:
    path: str
    line: int
    mistake: str
    begin: int
    end: int
    instead: str

    def apply(self, text):
        return text[:self.begin] + self.instead + text[self.end:]


def mutants_of(path, text):
    """Every mutant of one file, by place."""
    code = source.blank(text)
    found = [Mutant(path, code.count("\n", 0, match.start()) + 1, mistake, match.start(), match.end(), instead)
             for mistake, pattern, instead in MISTAKES for match in re.finditer(pattern, code)]
    return sorted(found, key=lambda mutant: (mutant.begin, mutant.mistake))

"""Reads C++ as text: what it includes and where its functions begin and end.

No parser: comments, strings and preprocessor lines are blanked (lines keep their numbers), then braces are counted.
A block is a function when it opens at namespace or class scope after a parameter list. Lambdas and local classes
count to the function they stand in; a lambda that a constant holds is a function of its own.
"""

import dataclasses
import re

_NOT_CODE = re.compile(
    r'//(?:\\\n|[^\n])*'                                         # comment to the end of the line
    r'|/\*.*?\*/'                                                # block comment
    r'|(?:u8|[uUL])?R"(?P<tag>[^()\\\s]{0,16})\(.*?\)(?P=tag)"'  # raw string
    r'|"(?:\\.|[^"\\\n])*"'                                      # string
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'",                     # character; the one in 1'000 is part of a number
    re.DOTALL)
_COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)
_DIRECTIVE = re.compile(r'^[ \t]*#(?:\\\n|[^\n])*', re.MULTILINE)
_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)
_NOISE = re.compile(r'\b(?:public|protected|private)\s*:(?!:)|\[\[.*?\]\]|\balignas\s*\([^)]*\)', re.DOTALL)
_OPERATOR = re.compile(r'\boperator\s*(?:\(\s*\)|\[\s*\]|[^\w\s(]+)')
_SCOPE = re.compile(r'(?:inline\s+|static\s+|typedef\s+)*(?:namespace|class|struct|union|enum|extern)\b')
_AFTER_PARAMETERS = ("const", "noexcept", "override", "final", "try", "mutable")
_TEST_MACRO = re.compile(r'(?:TYPED_)?TEST(?:_[FP])?|RC_GTEST_\w+')


@dataclasses.dataclass
class Function:
    name: str
    line: int   # where its head begins, from 1
    lines: int  # from head to closing brace, both counted


def _spaces(match):
    return re.sub(r'[^\n]', ' ', match.group())


def blank(text):
    """`text` with comments, strings and preprocessor lines as spaces; line breaks stay."""
    return _DIRECTIVE.sub(_spaces, _NOT_CODE.sub(_spaces, text))


def includes(text):
    """(line, path) of every #include that is not in a comment."""
    code = _COMMENT.sub(_spaces, text)
    return [(code.count("\n", 0, m.start()) + 1, m.group(1)) for m in _INCLUDE.finditer(code)]


def functions(text):
    """Every function of the file, in order."""
    code, found = blank(text), []
    begin, position, depth = 0, 0, 0
    while (match := re.compile(r'[(){};]').search(code, position)) is not None:
        char, position = match.group(), match.end()
        depth += {"(": 1, ")": -1}.get(char, 0)
        if char in "()" or depth > 0:
            continue  # a brace between parentheses belongs to an argument
        if char != "{":
            begin = position
            continue
        head = _plain(code[begin:match.start()])
        if _opens_scope(head):
            begin = position
            continue
        position = _closing(code, match.start()) + 1
        if _is_function(head) and not _initialises_member(head):
            found.append(_function(code, begin, match.start(), position))
            begin = position
    return found


def _closing(code, opening):
    depth = 0
    for match in re.compile(r'[{}]').finditer(code, opening):
        depth += 1 if match.group() == "{" else -1
        if depth == 0:
            return match.start()
    return len(code) - 1


def _plain(head):
    """The shape of a block's head: parameter lists as (), nothing of templates, braces and attributes."""
    head = _OPERATOR.sub("operator_", _NOISE.sub(" ", head)).replace("->", " ")
    for inside, mark in ((r'\([^()]*\)', "\x01"), (r'\{[^{}]*\}', " "), (r'<[^<>;]*>', " ")):
        while re.search(inside, head):
            head = re.sub(inside, mark, head)
    return re.sub(r'\btemplate\b', ' ', head).replace("\x01", "()").strip()


def _opens_scope(head):
    return bool(_SCOPE.match(head)) and "()" not in re.split(r'(?<!:):(?!:)', head)[0]


def _is_function(head):
    if "()" not in head:
        return bool(re.search(r'=\s*\[[^\]]*\]$', head))
    return "=" not in head.split("()")[0] or bool(re.search(r'\]\s*\(\)', head))


def _initialises_member(head):
    """Whether the block after `head` initialises a member: `Foo(int a) : a_{a}, b_` and not the body."""
    in_list = re.search(r'\(\)[\w\s()]*(?<!:):(?!:)', head)
    last = re.search(r'([A-Za-z_]\w*)$', head)
    return bool(in_list and last) and last.group(1) not in _AFTER_PARAMETERS


def _function(code, begin, opening, end):
    head = _NOISE.sub(_spaces, code[begin:opening])
    start = begin + len(head) - len(head.lstrip())
    first = code.count("\n", 0, start) + 1
    return Function(_name(head), first, code.count("\n", 0, end) + 2 - first)


def _name(head):
    match = re.search(r'((?:~?\w+(?:<[^()]*>)?\s*::\s*)*(?:operator\s*(?:\(\s*\)|[^\s\w(]+|\w+)|~?\w+))\s*\(([^()]*)', head)
    if match is None:
        return "(lambda)"
    name, arguments = match.group(1), " ".join(match.group(2).split())
    return f"{name}({arguments})" if _TEST_MACRO.fullmatch(name) else name

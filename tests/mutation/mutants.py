"""Finds places of C++ sources where a small change makes a different program, and writes sources that hold all of them, switched off.

A mutant replaces an expression by another one that also compiles: an operator by its neighbor, a number by a near one, a condition by its opposite,
and a call whose result nobody uses by nothing.
"""

import dataclasses
import random
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from itertools import repeat
from pathlib import Path

sys.path.append("/usr/lib/python3/dist-packages")  # Debian's package, for any Python.
from clang import cindex  # noqa: E402

Kind = cindex.CursorKind
TypeKind = cindex.TypeKind

OPERATORS = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
    "+": "-", "-": "+", "*": "/", "/": "*", "%": "*", "&&": "||", "||": "&&", "&": "|", "|": "&",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "&=": "|=", "|=": "&=",
}  # fmt: skip
NUMBERS = {
    TypeKind.BOOL, TypeKind.CHAR_U, TypeKind.UCHAR, TypeKind.USHORT, TypeKind.UINT, TypeKind.ULONG, TypeKind.ULONGLONG, TypeKind.CHAR_S,
    TypeKind.SCHAR, TypeKind.SHORT, TypeKind.INT, TypeKind.LONG, TypeKind.LONGLONG, TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE,
}  # fmt: skip
REALS = {TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE}
LIMITS = {"<", "<=", ">", ">="}
# What the compiler evaluates, or what is no code.
CONSTANT = {
    Kind.STATIC_ASSERT, Kind.ENUM_CONSTANT_DECL, Kind.CASE_STMT, Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.ALIGNED_ATTR,
    Kind.TYPE_ALIAS_DECL, Kind.TYPEDEF_DECL, Kind.PARM_DECL,
}  # fmt: skip
FUNCTIONS = {
    Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.DESTRUCTOR, Kind.CONVERSION_FUNCTION, Kind.FUNCTION_TEMPLATE, Kind.LAMBDA_EXPR,
}  # fmt: skip
STATEMENTS = {
    Kind.COMPOUND_STMT, Kind.IF_STMT, Kind.FOR_STMT, Kind.CXX_FOR_RANGE_STMT, Kind.WHILE_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT,
}  # fmt: skip
CONDITIONAL = {Kind.IF_STMT, Kind.WHILE_STMT, Kind.CONDITIONAL_OPERATOR}


@dataclasses.dataclass(frozen=True)
class Mutant:
    """The bytes of a file from `begin` up to `end`, and what takes their place."""

    path: str
    line: int
    column: int
    begin: int
    end: int
    original: str
    changed: str
    # Whether only the limit itself changes sides, between numbers that are equal by chance alone.
    is_limit_of_reals: bool = dataclasses.field(default=False, compare=False)

    def __str__(self):
        def short(text):
            text = " ".join(text.split())
            return text if len(text) <= 60 else text[:57] + "..."

        change = f"`{short(self.changed)}`" if self.changed else "nothing"
        return f"{self.path}:{self.line}:{self.column}: `{short(self.original)}` becomes {change}"

    def switched(self, number):
        """The source text in which the mutant can be switched on."""
        on = f"isocnc_mutation::is_on({number})"
        if not self.changed:
            return f"({on} ? static_cast<void>(0) : static_cast<void>({self.original}))"
        if self.changed == f"!({self.original})":
            return f"({on} != static_cast<bool>({self.original}))"
        return f"({on} ? ({self.changed}) : ({self.original}))"


def is_number(cursor):
    return cursor.type.get_canonical().kind in NUMBERS


def changed_number(text):
    """Another number of the same type; none where it is not known."""
    if re.fullmatch(r"\d+[uUlLzZ]*", text):
        digits = re.match(r"\d+", text).group()
        return f"{int(digits) + 1}{text[len(digits):]}" if not re.match(r"0\d", digits) else None
    if re.fullmatch(r"(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?[fF]?", text):
        is_zero = float(text.rstrip("fF")) == 0
        one = "1.0F" if text[-1] in "fF" else "1.0"
        return one if is_zero else f"{text} * {one.replace('1.0', '1.5')}"
    return None


class Finder:
    """All mutants of a file."""

    def __init__(self, root, path, arguments):
        self.path = path
        self.source = (root / path).read_bytes()
        self.found = []
        unit = cindex.Index.create().parse(str(root / path), args=["-xc++", *arguments])
        for cursor in unit.cursor.get_children():
            if cursor.location.file and Path(cursor.location.file.name) == root / path:
                self.visit(cursor, None, False)

    def text(self, begin, end):
        return self.source[begin:end].decode()

    def extent(self, cursor):
        """Where a cursor is in this file; none if a macro made it."""
        begin, end = cursor.extent.start, cursor.extent.end
        if not begin.file or not end.file or end.offset <= begin.offset:
            return None
        return begin.offset, end.offset

    def add(self, begin, end, changed, is_limit_of_reals=False):
        before = self.source[:begin]
        self.found.append(
            Mutant(
                path=self.path,
                line=before.count(b"\n") + 1,
                column=begin - (before.rfind(b"\n") + 1) + 1,
                begin=begin,
                end=end,
                original=self.text(begin, end),
                changed=changed,
                is_limit_of_reals=is_limit_of_reals,
            )
        )

    def is_constant(self, cursor):
        if cursor.kind in CONSTANT:
            return True
        if cursor.kind in (Kind.VAR_DECL, Kind.FIELD_DECL, Kind.IF_STMT):
            extent = self.extent(cursor)
            first = self.text(*extent).split("=", 1)[0].split("{", 1)[0] if extent else ""
            return bool(re.search(r"\b(constexpr|constinit)\b", first)) or cursor.is_bitfield()
        return False

    def visit(self, cursor, parent, is_in_function):
        if self.is_constant(cursor):
            if cursor.kind in (Kind.CASE_STMT, Kind.IF_STMT):  # What follows the label or condition is code.
                for child in list(cursor.get_children())[1:]:
                    self.visit(child, cursor, is_in_function)
            return
        is_in_function = is_in_function or cursor.kind in FUNCTIONS
        extent = self.extent(cursor)
        if is_in_function and extent:
            self.note(cursor, parent, *extent)
        for child in cursor.get_children():
            self.visit(child, cursor, is_in_function)

    def note(self, cursor, parent, begin, end):
        children = list(cursor.get_children())
        if cursor.kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR) and len(children) == 2:
            self.note_operator(children, begin, end)
        elif cursor.kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            changed = changed_number(self.text(begin, end))
            is_argument = self.source[begin - 1 : begin] == b"<" or self.source[end : end + 1] == b">"  # Of a template.
            if changed and not is_argument:
                self.add(begin, end, changed)
        elif cursor.kind == Kind.CXX_BOOL_LITERAL_EXPR:
            self.add(begin, end, {"true": "false", "false": "true"}[self.text(begin, end)])
        elif cursor.kind in CONDITIONAL and children and children[0].kind.is_expression():
            condition = self.extent(children[0])
            if condition:
                self.add(*condition, f"!({self.text(*condition)})")
        elif cursor.kind == Kind.CALL_EXPR and parent and parent.kind in STATEMENTS:
            if self.source[end : end + 1] == b";":
                self.add(begin, end, "")

    def note_operator(self, children, begin, end):
        left, right = (self.extent(child) for child in children)
        if not left or not right or not all(is_number(child) for child in children):
            return
        between = self.text(left[1], right[0])
        operator = between.strip()
        if operator in OPERATORS:
            are_real = any(child.type.get_canonical().kind in REALS for child in children)
            changed = self.text(*left) + between.replace(operator, OPERATORS[operator]) + self.text(*right)
            self.add(begin, end, changed, are_real and operator in LIMITS)


def mutants_of(root, path, arguments):
    unique = {(each.begin, each.end, each.changed): each for each in Finder(root, path, arguments).found}
    return sorted(unique.values(), key=lambda each: (each.begin, each.end, each.changed))


def find(root, paths, arguments, jobs):
    """All mutants of these files, in order."""
    with ProcessPoolExecutor(jobs) as pool:
        return [mutant for those in pool.map(mutants_of, repeat(root), paths, repeat(arguments)) for mutant in those]


def sample(mutants, count, seed):
    """Of them, so many at most, none within another one, in order. The same seed takes the same ones."""
    shuffled = list(mutants)
    random.Random(seed).shuffle(shuffled)
    taken = []
    by_file = {}
    for mutant in shuffled:
        if len(taken) == count:
            break
        others = by_file.setdefault(mutant.path, [])
        if all(mutant.end <= other.begin or other.end <= mutant.begin for other in others):
            others.append(mutant)
            taken.append(mutant)
    return sorted(taken, key=lambda each: (each.path, each.begin))


def write(source, path, mutants):
    """Writes a file with all of these mutants of it, by number; its lines keep their numbers."""
    result = source
    for number, mutant in sorted(mutants.items(), key=lambda each: -each[1].begin):
        result = result[: mutant.begin] + mutant.switched(number).encode() + result[mutant.end :]
    path.write_bytes(b'#include "tests/mutation/mutant.h"\n#line 1\n' + result)


def those_that_compile(root, copy, mutants, compiler, jobs):
    """Writes the files with the mutants into a copy, and returns those that the compiler takes: where it refuses a line, without all of its mutants."""
    by_file = {}
    for number, mutant in enumerate(mutants):
        by_file.setdefault(mutant.path, {})[number] = mutant

    def settle(item):
        path, those = item
        source = (root / path).read_bytes()
        while True:
            write(source, copy / path, those)
            run = subprocess.run([*compiler, "-fsyntax-only", path], cwd=copy, capture_output=True, text=True, check=False)
            if run.returncode == 0 or not those:
                return those
            refused = {int(line) for line in re.findall(rf"^{re.escape(path)}:(\d+):\d+: (?:fatal )?error", run.stderr, re.MULTILINE)}
            kept = {
                number: mutant
                for number, mutant in those.items()
                if not refused.intersection(range(mutant.line, mutant.line + mutant.original.count("\n") + 1))
            }
            if len(kept) == len(those):
                print(f"mutate: {path} does not compile, so that none of its {len(those)} mutants is tried", file=sys.stderr)
                kept = {}
            those = kept

    with ThreadPoolExecutor(jobs) as pool:
        settled = list(pool.map(settle, by_file.items()))
    return {number: mutant for those in settled for number, mutant in those.items()}

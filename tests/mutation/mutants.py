"""Where the sources can be wrong by one operator, and which of these places a seed draws."""

import dataclasses
import random
import re

# Code that is mutated: numbers and verdicts come from it.
folders = {
    "engines/grain": ["engines/grain/**/*.[ch]pp"],
    "engines/box2d": ["engines/box2d/**/*.[ch]pp"],
    "averaging": ["averaging/**/*.[ch]pp"],
    "oracle": ["oracle/**/*.[ch]pp"],
    "stability": ["stability/**/*.[ch]pp"],
    "adapters": ["adapters/motion.cpp"],
    "cases": ["cases/**/*.[ch]pp"],
    "studies": ["studies/**/*.[ch]pp"],
}

# Binary operators stand between spaces, as clang-format sets them: brackets of templates, pointers and references do not.
swapped = {
    "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*"},
    "comparison": {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="},
    "logical": {"&&": "||", "||": "&&"},
    "assignment": {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="},
}
kind_of = {operator: kind for kind, pairs in swapped.items() for operator in pairs}
binary = re.compile(r"(?<= )(\+=|-=|\*=|/=|==|!=|<=|>=|&&|\|\||[-+*/<>])(?= )")
# A sign or a "not" in front of a value.
prefix = re.compile(r"(?:(?<=[(\[{])|(?<=[=,?:&|<>] )|(?<=return )|(?<=^)|(?<=\s))([-!])(?=[\w(*])")
number = re.compile(r"(?<![\w.])(?<!e-)(\d+(?:\.\d+)?)(?=[ufl]?(?![\w.]))")

hidden = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
# Directives, declarations without arithmetic, and progress messages.
passed_over = re.compile(r"^\s*(#|template|using |namespace |static_assert|extern |friend )|progress_?\.|\bsay\(|\boperator\b")
# Default value of a member, which its maker sets anyway.
default_value = re.compile(r"^\s+(?!constexpr|static|inline|return)[\w:<>, ]+ \w+ = [-\w.]+;")


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str
    line: int  # from 1
    column: int  # from 0
    operator: str
    before: str
    after: str
    text: str  # the whole line as it is

    @property
    def key(self):
        """The same place of the same line, however far the line has moved."""
        return (self.file, self.text.strip(), self.column - len(self.text) + len(self.text.lstrip()), self.before, self.after)

    def applied(self, source):
        lines = source.split("\n")
        line = lines[self.line - 1]
        end = self.column + len(self.before)
        assert line[self.column : end] == self.before
        lines[self.line - 1] = line[: self.column] + self.after + line[end:]
        return "\n".join(lines)

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column + 1} {self.before} → {self.after or 'nothing'}"


def code_of(source):
    """The source with comments, strings and characters blanked out, of the same length."""
    return hidden.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)


def one_more(text):
    return f"{float(text) + 1.0}" if "." in text else str(int(text) + 1)


def mutants_of(file, source):
    """All mutants of a file, in order."""
    found = []
    for number_of_line, (line, code) in enumerate(zip(source.split("\n"), code_of(source).split("\n"), strict=True), 1):
        if passed_over.search(code) or (file.endswith(".hpp") and default_value.search(code)):
            continue

        def add(match, operator, after, number_of_line=number_of_line, line=line):
            found.append(Mutant(file, number_of_line, match.start(1), operator, match[1], after, line))

        for match in binary.finditer(code):
            add(match, kind_of[match[1]], swapped[kind_of[match[1]]][match[1]])
        for match in prefix.finditer(code):
            add(match, "negation" if match[1] == "!" else "sign", "")
        for match in number.finditer(code):
            add(match, "constant", one_more(match[1]))
    return found


def drawn(project, seed):
    """All mutants of each folder, in an order that the seed draws."""
    queues = {}
    for folder, patterns in folders.items():
        files = sorted(path for pattern in patterns for path in project.glob(pattern))
        queues[folder] = [mutant for path in files for mutant in mutants_of(str(path.relative_to(project)), path.read_text())]
        random.Random(seed).shuffle(queues[folder])
    return queues


def in_turns(queues, judged):
    """The next mutant of the folder of which fewest are judged, asked anew for each."""
    left = {folder: list(queue) for folder, queue in queues.items() if queue}
    while left:
        folder = min(left, key=lambda folder: judged[folder])
        yield left[folder].pop(0)
        if not left[folder]:
            del left[folder]


def folder_of(file):
    return next(folder for folder in folders if file.startswith(folder + "/"))

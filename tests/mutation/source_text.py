# The text of one C++ or TypeScript file as tokens with places: no comments, no preprocessor lines,
# brackets in pairs. No compiler, it relies on clang-format and prettier: a binary operator has a
# space on both sides, the bracket of a template and the sign of a number have not.
# SPDX-License-Identifier: Apache-2.0
import bisect
import re
from dataclasses import dataclass

WORD, NUMBER, TEXT, OPERATOR = "word", "number", "text", "operator"

PATTERN = re.compile(
    r"""
    (?P<skip>   \s+ | //[^\n]* | /\*.*?\*/ | (?m:^)[ \t]*\#(?:[^\n]*\\\n)*[^\n]* )
  | (?P<text>   R"(?P<mark>[^(]*)\(.*?\)(?P=mark)" | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*'
                | `(?:\\.|[^`\\])*` | /(?![ =/])(?:\\.|[^/\\\n])+/[a-z]* )
  | (?P<number> \.?[0-9](?:[0-9a-zA-Z_.']|(?<=[eEpP])[+-])* )
  | (?P<word>   [A-Za-z_]\w* )
  | (?P<operator> === | !== | => | \?\? | \?\. | <=> | <<= | >>= | \.\.\. | ->\* | :: | -> | \+\+
                | -- | && | \|\| | << | >> | [<>=!+\-*/%&|^]= | . )
    """,
    re.VERBOSE | re.DOTALL,
)
OPENING = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True)
class Token:
    kind: str
    text: str
    start: int
    end: int


class Source:
    def __init__(self, path, text):
        self.path = path
        self.text = text
        self.is_typescript = path.endswith((".ts", ".tsx"))
        self.tokens = list(self._read())
        self.partner = {}  # of each bracket, by the token's number
        self.around = []  # of each token: the bracket that it stands in, or None
        self._pair()
        self.checks = self._static_asserts()
        self._line_starts = [0] + [i + 1 for i, c in enumerate(text) if c == "\n"]

    def _read(self):
        at = 0
        while at < len(self.text):
            found = PATTERN.match(self.text, at)
            for kind in (WORD, NUMBER, TEXT, OPERATOR):
                if found.group(kind) is not None:
                    yield Token(kind, found.group(), at, found.end())
            at = found.end()

    def _pair(self):
        opened = []
        for i, token in enumerate(self.tokens):
            if token.kind == OPERATOR and token.text in OPENING.values() and opened:
                self.partner[i] = opened.pop()
                self.partner[self.partner[i]] = i
            self.around.append(opened[-1] if opened else None)
            if token.kind == OPERATOR and token.text in OPENING:
                opened.append(i)
        if opened:
            raise ValueError(f"{self.path}: a bracket stays open")

    # What only the compiler judges is no behaviour that a test could see.
    def _static_asserts(self):
        spans = []
        for i, token in enumerate(self.tokens):
            if token.text == "static_assert":
                spans.append((i, self.partner[i + 1]))
        return spans

    def is_mutable(self, i):
        return not any(first <= i <= last for first, last in self.checks)

    def is_(self, i, *texts):
        return 0 <= i < len(self.tokens) and self.tokens[i].text in texts

    def is_spaced(self, i):
        token = self.tokens[i]
        return self.text[token.start - 1].isspace() and self.text[token.end].isspace()

    # From the first character of token `first` to the last of token `last`.
    def span(self, first, last):
        return self.tokens[first].start, self.tokens[last].end

    # The next of `texts` from token i on, over whole brackets; None where the bracket ends before.
    def find(self, i, *texts):
        while i < len(self.tokens):
            if self.is_(i, *texts):
                return i
            if self.is_(i, *OPENING.values()):
                return None
            i = (self.partner[i] if self.is_(i, *OPENING) else i) + 1
        return None

    # Line and column of a character, both from 1.
    def place(self, at):
        line = bisect.bisect_right(self._line_starts, at)
        return line, at - self._line_starts[line - 1] + 1

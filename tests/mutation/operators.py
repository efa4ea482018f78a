# The families of mutation operators. Each takes a Source and yields (start, end, replacement): the
# characters [start, end) of its text become the replacement. The choice of families follows the
# mutation tests of opendbc's safety code.
# SPDX-License-Identifier: Apache-2.0
import re

from source_text import NUMBER, OPERATOR, WORD

OPPOSITE = {"==": "!=", "!=": "==", "===": "!==", "!==": "===", "<": ">=", ">=": "<", ">": "<=",
            "<=": ">"}  # fmt: skip
BOUNDARY = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
ARITHMETIC = {
    "+": "-", "-": "+", "*": "/", "/": "*", "%": "*", "<<": ">>", ">>": "<<", "&": "|", "|": "&",
    "^": "&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "|=": "&=", "&=": "|=",
}  # fmt: skip
LOGICAL = {"&&": "||", "||": "&&"}
EXTREME = {"min": "max", "max": "min", "fmin": "fmax", "fmax": "fmin", "any_of": "all_of",
           "all_of": "any_of"}  # fmt: skip
ENDS = {"front": "back", "back": "front", "begin": "end", "end": "begin", "first": "last"}
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="}
INTEGER = re.compile(r"(0[xX][0-9a-fA-F]+|[0-9]+)([uUlLzZ]*)$")


# `T | null` is a type, which is gone when the program runs.
def is_type(source, i):
    return source.is_typescript and source.is_(i + 1, "null", "undefined")


def swapped(source, table):
    for i, token in enumerate(source.tokens):
        if token.kind != OPERATOR or is_type(source, i) and token.text == "|":
            continue
        if token.text in table and source.is_spaced(i):
            yield token.start, token.end, table[token.text]


def relational(source, _):
    yield from swapped(source, OPPOSITE)


def boundary(source, _):
    yield from swapped(source, BOUNDARY)


def arithmetic(source, _):
    yield from swapped(source, ARITHMETIC)
    for token in source.tokens:
        if token.text in ("++", "--"):
            yield token.start, token.end, "--" if token.text == "++" else "++"


def sign(source, _):
    for i, token in enumerate(source.tokens):
        if token.text == "-" and not source.text[token.end].isspace():
            yield token.start, token.end, ""


def logical(source, _):
    yield from swapped(source, LOGICAL)
    for token in source.tokens:
        if token.text == "!":
            yield token.start, token.end, ""


# The first token of the condition before the question mark at i.
def ternary_start(source, i):
    while True:
        before = i - 1
        if source.is_(before, ")", "]", "}"):
            i = source.partner[before]
        elif source.is_(before, "(", "[", "{", ",", ";", "return", ":", "?", *ASSIGNMENTS):
            return i
        else:
            i = before


def condition(source, _):
    for i, token in enumerate(source.tokens):
        first = last = None
        if token.text in ("if", "while"):
            opening = i + 1 if source.is_(i + 1, "(") else i + 2  # if constexpr (
            last = source.partner[opening] - 1
            first = opening + 1
            semicolon = source.find(first, ";")
            first = first if semicolon is None else semicolon + 1
        elif token.text == "for" and source.find(i + 2, ";"):
            first = source.find(i + 2, ";") + 1
            last = source.find(first, ";") - 1
        elif token.text == "?" and source.is_spaced(i):
            first, last = ternary_start(source, i), i - 1
        if first is not None:
            start, end = source.span(first, last)
            yield start, end, f"!({source.text[start:end]})"


def numbers(text):
    plain = text.replace("'", "")
    found = INTEGER.match(plain)
    if found:
        value, suffix = int(found.group(1), 0), found.group(2)
        return [f"{n}{suffix}" for n in (value + 1, value - 1, -value, 0) if n != value]
    value = float(plain.rstrip("fFlL")) if not plain.startswith("0x") else float.fromhex(plain)
    return [repr(n) for n in (value + 1.0, value - 1.0, -value, 0.0) if n != value]


def constant(source, _):
    for token in source.tokens:
        if token.kind == NUMBER:
            for other in dict.fromkeys(numbers(token.text)):
                yield token.start, token.end, f"({other})" if other.startswith("-") else other


def boolean(source, _):
    for token in source.tokens:
        if token.text in ("true", "false"):
            yield token.start, token.end, "false" if token.text == "true" else "true"


def extreme(source, _):
    for i, token in enumerate(source.tokens):
        if token.kind != WORD or not source.is_(i + 1, "("):
            continue
        if token.text in EXTREME:
            yield token.start, token.end, EXTREME[token.text]
        if token.text in ("abs", "fabs"):
            first = i - 2 if source.is_(i - 1, "::", ".") else i
            yield source.tokens[first].start, token.end, ""


def is_body(source, brace):
    if brace is None or not source.is_(brace, "{"):
        return False
    if source.is_(brace - 1, ")", "else", "do", "const", "noexcept", "mutable", "override", "=>"):
        return True
    return source.is_(brace - 1, ";", "{", "}", ":") and is_body(source, source.around[brace])


def statement_end(source, i):
    if source.is_(i, "{"):
        return source.partner[i]
    if not source.is_(i, "if", "for", "while"):
        return source.find(i, ";")
    opening = source.find(i, "(")
    end = statement_end(source, source.partner[opening] + 1)
    if source.is_(i, "if") and source.is_(end + 1, "else"):
        end = statement_end(source, end + 2)
    return end


# An assignment, an increment or a call, not a declaration.
def is_expression(source, i):
    if source.is_(i, "++", "--", "*", "(", "static_cast"):
        return True
    if source.tokens[i].kind != WORD or source.is_(i, "return", "case", "default", "using", "else"):
        return False
    while i < len(source.tokens):
        if source.is_(i, *ASSIGNMENTS, ";", "++", "--"):
            return True
        if source.is_(i, "(", "["):
            i = source.partner[i] + 1
        elif source.is_(i, ".", "->", "::"):
            i += 2
        elif source.tokens[i].kind == WORD and (
            source.is_(i + 1, ".", "->", "::", "(", "[", "++", "--", *ASSIGNMENTS)
        ):
            i += 1
        else:
            return False
    return False


def begins_statement(source, i):
    if not is_body(source, source.around[i]):
        return False
    if source.is_(i - 1, ";", "{", "}", "else", ":"):
        return True
    if not source.is_(i - 1, ")"):
        return False
    opening = source.partner[i - 1]
    return source.is_(opening - 1, "if", "for", "while")


# The last `break` of a switch leaves nothing out.
def ends_switch(source, i):
    if not (source.is_(i, "break") and source.is_(i + 2, "}")):
        return False
    brace = source.around[i]
    return source.is_(brace - 1, ")") and source.is_(source.partner[brace - 1] - 1, "switch")


# Without a CHECK nothing changes for a caller who keeps the contract.
def statement(source, _):
    for i, token in enumerate(source.tokens):
        if not begins_statement(source, i) or ends_switch(source, i) or token.text == "CHECK":
            continue
        whole = token.text in ("if", "for", "while", "continue", "break")
        if whole or is_expression(source, i):
            yield *source.span(i, statement_end(source, i)), ";"


# `return {};` changes nothing where an empty value is returned already.
def returned(source, enums):
    nothing = "undefined" if source.is_typescript else "{}"
    empty = {"{}", "false", "0", "0.0", "nullptr", "undefined"}
    empty |= {f"{enum}::{names[0]}" for enum, names in enums.items() if names}
    for i, token in enumerate(source.tokens):
        if token.text != "return" or source.is_(i + 1, ";"):
            continue
        start, end = source.span(i + 1, source.find(i, ";") - 1)
        if source.text[start:end] not in empty:
            yield start, end, nothing


# What `using enum NAME` makes known without its name; a name of two enumerations is left alone.
def bare_enumerators(source, enums):
    known = {}
    for i, token in enumerate(source.tokens):
        if token.text == "enum" and source.is_(i - 1, "using"):
            last = source.find(i, ";") - 1
            for name in enums.get(source.tokens[last].text, []):
                known[name] = None if name in known else enums[source.tokens[last].text]
    return {name: names for name, names in known.items() if names}


# `enums` holds the enumerators of each enumeration, in their order.
def enumerator(source, enums):
    bare = bare_enumerators(source, enums)
    for i, token in enumerate(source.tokens):
        own, names = token, bare.get(token.text)
        if names and source.is_(i - 1, "::", "."):
            continue
        if not names:
            names = enums.get(token.text)
            if not names or not source.is_(i + 1, "::", "."):
                continue
            own = source.tokens[i + 2]
            if own.text not in names:
                continue
        following = names[(names.index(own.text) + 1) % len(names)]
        for other in dict.fromkeys((following, names[0])):
            if other != own.text:
                yield own.start, own.end, other


# The elements of the list in a brace, as (first token, last token) each.
def elements(source, brace):
    first = brace + 1
    while first < source.partner[brace]:
        comma = source.find(first, ",")
        last = (source.partner[brace] if comma is None else comma) - 1
        if last >= first:
            yield first, last
        first = last + 2


# Neighbours of a list of qualified names change places: such a list is an order.
def order(source, _):
    for brace, token in enumerate(source.tokens):
        if token.text != "{" or is_body(source, brace):
            continue
        listed = list(elements(source, brace))
        texts = [[t.text for t in source.tokens[a : b + 1]] for a, b in listed]
        if any(len(t) < 3 or "::" not in t or t[:-1] != texts[0][:-1] for t in texts):
            continue
        for (a, b), (c, d) in zip(listed, listed[1:]):
            start, end = source.span(a, d)
            one, other = source.span(a, b), source.span(c, d)
            between = source.text[one[1] : other[0]]
            yield start, end, source.text[slice(*other)] + between + source.text[slice(*one)]


def range_end(source, _):
    for i, token in enumerate(source.tokens):
        if token.kind == WORD and token.text in ENDS and source.is_(i + 1, "("):
            yield token.start, token.end, ENDS[token.text]
        if token.text != "for" or source.find(i + 2, ";") is None:
            continue
        first = source.find(i + 2, ";")
        second = source.find(first + 1, ";")
        equals = source.find(i + 2, "=", ";")
        if source.is_(equals, "="):
            start, end = source.span(equals + 1, first - 1)
            yield start, end, f"{source.text[start:end]} + 1"
        start, end = source.span(first + 1, second - 1)
        yield start, end, f"{source.text[start:end]} - 1"
        yield start, end, f"{source.text[start:end]} + 1"


def index(source, _):
    for i, token in enumerate(source.tokens):
        follows = i > 0 and (source.tokens[i - 1].kind == WORD or source.is_(i - 1, "]", ")"))
        if token.text != "[" or not follows or source.is_(i - 1, "return"):
            continue
        start, end = source.span(i + 1, source.partner[i] - 1)
        if start < end:
            yield start, end, f"({source.text[start:end]}) + 1"
            yield start, end, f"({source.text[start:end]}) - 1"


FAMILIES = {
    "relational": relational, "boundary": boundary, "arithmetic": arithmetic, "sign": sign,
    "logical": logical, "condition": condition, "constant": constant, "boolean": boolean,
    "extreme": extreme, "statement": statement, "return": returned, "enumerator": enumerator,
    "order": order, "range_end": range_end, "index": index,
}  # fmt: skip


# enum class NAME : TYPE { kA, kB = 1, ... } -> {"NAME": ["kA", "kB", ...]}
def enumerations(source):
    found = {}
    for i, token in enumerate(source.tokens):
        if token.text != "enum" or not (source.is_(i + 1, "class") or source.is_typescript):
            continue
        opening = source.find(i, "{", ";")
        if not source.is_(opening, "{"):
            continue
        names = [
            source.tokens[j].text
            for j in range(opening + 1, source.partner[opening])
            if source.tokens[j].kind == WORD and source.is_(j - 1, "{", ",")
        ]
        found[source.tokens[i + (1 if source.is_typescript else 2)].text] = names
    return found

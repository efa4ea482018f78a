"""Documents near the limits of a JSON schema, and whether the schema accepts them.

    schema_cases.py SCHEMA DOCUMENT...   every value of the documents changed, one at a time, to
                                         the limits that the schema states and just beyond, every
                                         word that it lists and one that it does not, every key
                                         left out and one added
    schema_cases.py --as-is SCHEMA DOCUMENT...   the documents as they are

Prints one JSON list of {"change", "text", "valid", "why"}; the text is YAML. Ends with an error
if a document is not valid, or if the documents together miss a key of the schema.
"""

import copy
import json
import sys

import jsonschema
import yaml

WORD = "no_such_word"


class Cases:
    def __init__(self, schema):
        jsonschema.Draft202012Validator.check_schema(schema)
        self.schema = schema
        self.validator = jsonschema.Draft202012Validator(schema)
        self.reached = set()
        self.out = []

    def add(self, change, document):
        error = jsonschema.exceptions.best_match(self.validator.iter_errors(document))
        why = f"{error.json_path}: {error.message}" if error else ""
        text = json.dumps(document)
        self.out.append({"change": change, "text": text, "valid": error is None, "why": why})
        return error

    def rules(self, schema, value):
        """The parts of the schema that apply to the value, without references."""
        if schema is True or schema is False:
            return []
        out = [schema]
        if "$ref" in schema:
            target = self.schema
            for name in schema["$ref"].removeprefix("#/").split("/"):
                target = target[name]
            out += self.rules(target, value)
        for part in schema.get("allOf", []):
            out += self.rules(part, value)
        if "if" in schema:
            condition = self.validator.evolve(schema=schema["if"])
            branch = "then" if condition.is_valid(value) else "else"
            out += self.rules(schema.get(branch, {}), value)
        return out

    def walk(self, document, path, rules):
        """Changes the value at the path, and those within it."""
        value = document
        for step in path:
            value = value[step]
        name = "/".join(str(step) for step in path)

        def changed(what, new):
            other = copy.deepcopy(document)
            at = other
            for step in path[:-1]:
                at = at[step]
            at[path[-1]] = new
            self.add(f"{name}: {what}", other)

        if path:
            for new in self.neighbours(value, rules):
                changed(json.dumps(new)[:60], new)
        if isinstance(value, dict):
            self.walk_mapping(document, path, value, rules)
        elif isinstance(value, list):
            for i, item in enumerate(value):
                inner = []
                for rule in rules:
                    inner += self.rules(rule.get("items", {}), item)
                self.walk(document, path + [i], inner)

    def neighbours(self, value, rules):
        if isinstance(value, (dict, list)):
            yield 3
        whole = any(rule.get("type") == "integer" for rule in rules)
        for rule in rules:
            for key, sign in (("minimum", -1), ("maximum", 1)):
                if key in rule:
                    limit = rule[key]
                    yield limit
                    yield limit + sign * (1 if whole else max(1e-6, abs(limit) * 1e-6))
            if rule.get("type") in ("number", "integer"):
                yield WORD
            if rule.get("type") == "integer":
                yield value + 0.5
            if "enum" in rule:
                yield from rule["enum"]
                yield WORD
            if "const" in rule:
                yield rule["const"] + 1
            if "minLength" in rule:
                yield ""
            if "pattern" in rule:
                yield "no/name"
            if rule.get("minItems", 0) > 0:
                yield value[: rule["minItems"] - 1]
            if "maxItems" in rule:
                yield value[:1] * rule["maxItems"]
                yield value[:1] * (rule["maxItems"] + 1)

    def walk_mapping(self, document, path, value, rules):
        name = "/".join(str(step) for step in path)

        def with_mapping(change):
            other = copy.deepcopy(document)
            at = other
            for step in path:
                at = at[step]
            change(at)
            return other

        self.add(f"{name}: {WORD} added", with_mapping(lambda at: at.update({WORD: 1})))
        for key in value:
            self.add(f"{name}: without {key}", with_mapping(lambda at: at.pop(key)))
            inner = []
            for rule in rules:
                part = rule.get("properties", {}).get(key)
                if part is None or part is False:
                    continue
                self.reached.add((id(rule), key))
                inner += self.rules(part, value[key])
            self.walk(document, path + [key], inner)

    def unreached(self, schema, place="#"):
        """The keys of the schema that no document has."""
        if isinstance(schema, list):
            for i, part in enumerate(schema):
                yield from self.unreached(part, f"{place}/{i}")
        if not isinstance(schema, dict):
            return
        for key, part in schema.items():
            if key == "properties":
                for name, rule in part.items():
                    if rule is not False and (id(schema), name) not in self.reached:
                        yield f"{place}/{name}"
            if key not in ("if", "enum"):
                yield from self.unreached(part, f"{place}/{key}")


def main(args):
    as_is = args[0] == "--as-is"
    schema, *files = args[1:] if as_is else args
    with open(schema, encoding="utf-8") as file:
        cases = Cases(json.load(file))
    for name in files:
        with open(name, encoding="utf-8") as file:
            document = yaml.safe_load(file)
        error = cases.add(f"{name}: as it is", document)
        if error:
            sys.exit(f"{name}: {error.json_path}: {error.message}")
        if not as_is:
            cases.walk(document, [], cases.rules(cases.schema, document))
    missed = [] if as_is else list(cases.unreached(cases.schema))
    if missed:
        sys.exit("no document has: " + ", ".join(missed))
    json.dump(cases.out, sys.stdout)


main(sys.argv[1:])

"""Compares a JSON Schema with what is expected of it: reads {"schema", "documents": [{"document", "valid"}]}, prints what
does not agree."""

import json
import sys

import jsonschema


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        task = json.load(file)
    validator = jsonschema.Draft7Validator
    validator.check_schema(task["schema"])
    for entry in task["documents"]:
        if validator(task["schema"]).is_valid(entry["document"]) != entry["valid"]:
            print("should be", "valid:" if entry["valid"] else "invalid:", json.dumps(entry["document"]))
    print(len(task["documents"]), "documents")


main()

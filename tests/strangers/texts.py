"""Python's own parsers read TOML and JSON. Usage: texts.py FILE..."""
import json
import sys
import tomllib

for path in sys.argv[1:]:
    try:
        with open(path, "rb") as file:
            (tomllib if path.endswith(".toml") else json).load(file)
    except ValueError as error:
        sys.exit(f"{path}: {error}")

"""Python's own TOML parser reads the file."""
import sys
import tomllib

with open(sys.argv[1], "rb") as file:
    tomllib.load(file)

"""The schema of a spec, read by an independent validator: specs that the program accepts are valid, those that it refuses for their form are not.

Arguments: the program, and specs that it accepts."""

import json
import subprocess
import sys
import tomllib

from jsonschema import Draft7Validator

tool, *specs = sys.argv[1:]
schema = json.loads(subprocess.run([tool, "schema"], capture_output=True, check=True).stdout)
Draft7Validator.check_schema(schema)
validator = Draft7Validator(schema)

for path in specs:
    with open(path, "rb") as file:
        faults = [f"{path}: {fault.json_path}: {fault.message}" for fault in validator.iter_errors(tomllib.load(file))]
    assert not faults, "\n".join(faults)

PLAIN = """schema = 1
name = "x"
[star]
points = 5
inner_radius = "50 mm"
tube_width = "30 mm"
tip_angle = "30 deg"
"""


def verdicts(text):
    """Whether the program accepts a spec, and whether it is valid by the schema."""
    program = subprocess.run([tool, "check", "-q", "-"], input=text.encode(), capture_output=True)
    return program.returncode == 0, validator.is_valid(tomllib.loads(text))


# Every way to write a value that both take, and slips that both refuse.
for value in ['"50 mm"', '"5cm"', '" 50  mm "', '"0.05 m"', '"5e1 mm"', '"+50. mm"', '"2 in"', '"50000 µm"', '"50000 um"']:
    found = verdicts(PLAIN.replace('"50 mm"', value))
    assert found == (True, True), (value, found)
for old, new in [
    ('"50 mm"', "50"),
    ('"50 mm"', '"50"'),
    ('"50 mm"', '"50,5 mm"'),
    ('"50 mm"', '"50 kPa"'),
    ('"50 mm"', '"mm"'),
    ('"50 mm"', '"nan mm"'),
    ('"50 mm"', "true"),
    ('"30 deg"', '"30 degrees"'),
    ("points = 5", "points = 2"),
    ("points = 5", "points = 5.5"),
    ("points = 5", 'points = "5"'),
    ("points = 5\n", ""),
    ("tip_angle", "tip_angel"),
    ("[star]", "[stars]"),
    ("schema = 1", "schema = 2"),
    ('name = "x"\n', ""),
    ('name = "x"', "name = 5"),
]:
    assert old in PLAIN, old
    found = verdicts(PLAIN.replace(old, new))
    assert found == (False, False), (new, found)
for more in [
    "[accuracy]\nmodel = \"best\"\n",
    "[fabric]\npoisson_ratio = 0.6\n",
    "[load]\nfriction = 0\n",
    "[inlet]\nnone = \"yes\"\n",
    "[stack]\nstar = 5\n",
    "[[stack.star]]\ninner_radius = \"45 mm\"\n",
    "[mask]\nbed = \"220 mm\"\n",
    "[load]\npressure = \"37 mm\"\n",
]:
    found = verdicts(PLAIN + more)
    assert found == (False, False), (more, found)
print(f"schema: {len(specs)} specs valid, every slip refused by both")

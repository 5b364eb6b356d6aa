"""Reads a study's Parquet with pyarrow, and holds it to the CSV of the same study, cell by cell."""

import csv
import json
import math
import sys

import pyarrow.parquet as parquet

path, beside = sys.argv[1:]
table = parquet.read_table(path)
with open(beside, newline="") as file:
    header, *rows = csv.reader(file)
assert table.column_names == header, (table.column_names, header)
assert table.num_rows == len(rows), (table.num_rows, len(rows))
notes = json.loads(table.schema.metadata[b"stargrip-cam.columns"])
assert [note["name"] for note in notes] == header and all(note["about"] for note in notes)
assert len(table.schema.metadata[b"stargrip-cam.study"]) == 64
kinds = set()
for k, name in enumerate(header):
    kind = str(table.schema.field(name).type)
    kinds.add(kind)
    for cell, found in zip((row[k] for row in rows), table.column(name).to_pylist()):
        if cell == "":
            assert found is None, (name, found)
        elif kind == "string":
            assert found == cell, (name, found, cell)
        elif kind == "int64":
            assert found == int(cell), (name, found, cell)
        else:
            assert math.isclose(found, float(cell), rel_tol=6e-9), (name, found, cell)
assert kinds == {"int64", "double", "string"}, kinds

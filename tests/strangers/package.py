#!/usr/bin/env python3
"""Reads a package for Bambu Lab's printers by Python's own readers of ZIP, MD5 and XML. Usage: package.py DIRECTORY.

From the parts at fixed places it must lead to one program with its MD5, and that is the plain program beside it.
"""
import hashlib
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

directory = Path(sys.argv[1])
packages = sorted(directory.glob("*.gcode.3mf"))
assert packages, f"no package in {directory}"
for path in packages:
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None, path
        assert all(entry.compress_type == zipfile.ZIP_STORED for entry in archive.infolist()), path
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}, path
        part = {name: archive.read(name) for name in archive.namelist()}
    trees = {name: ElementTree.fromstring(text) for name, text in part.items() if not name.endswith((".gcode", ".md5"))}
    targets = [node.get("Target").lstrip("/") for name in ("_rels/.rels", "Metadata/_rels/model_settings.config.rels") for node in trees[name]]
    model, program = targets
    assert trees[model].tag.endswith("}model"), path
    named = [node.get("value") for node in trees["Metadata/model_settings.config"].iter("metadata") if node.get("key") == "gcode_file"]
    assert named == [program], (path, named)
    assert part[program + ".md5"].decode() == hashlib.md5(part[program]).hexdigest().upper(), path
    assert part[program] == path.with_suffix("").read_bytes(), f"{path} differs from the program beside it"

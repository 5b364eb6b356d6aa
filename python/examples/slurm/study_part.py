"""Computes one part of a study and writes it as Parquet: python study_part.py SPEC STUDY DIR K N. An existing part is left out."""

from __future__ import annotations

import argparse
from pathlib import Path

import stargrip_cam as sg


def main() -> None:
    """Reads the arguments, and computes the part unless it exists."""
    parser = argparse.ArgumentParser(description="One part of a study.")
    parser.add_argument("spec", type=Path, help="the spec around which values are varied")
    parser.add_argument("study", type=Path, help="the study file")
    parser.add_argument("directory", type=Path, help="the directory of parts")
    parser.add_argument("part", type=int, help="the number of the part, from 1")
    parser.add_argument("parts", type=int, help="the number of all parts")
    parser.add_argument("--threads", type=int, default=1)
    args = parser.parse_args()
    path = args.directory / f"part-{args.part:0{len(str(args.parts))}}-of-{args.parts}.parquet"
    if path.exists():
        return
    args.directory.mkdir(parents=True, exist_ok=True)
    part = (args.part, args.parts)
    sg.sweep_to_parquet(path, sg.Spec.from_toml(args.spec), study=args.study.read_text(), part=part, threads=args.threads)


if __name__ == "__main__":
    main()

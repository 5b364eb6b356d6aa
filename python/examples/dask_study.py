"""A study on a Dask cluster: split into parts, computed by whoever is there, and the same to the last bit however it was split.

On this machine:

    python dask_study.py star.toml --vary "star.points=3,4,5" --vary "star.tube_width=10 mm..40 mm/3001" --output study.npz

On machines that you reach by SSH or through Slurm, start a scheduler and workers there as Dask's own pages say (`dask ssh`,
`dask_jobqueue.SLURMCluster`), each with this package installed and with one thread a worker, and name the scheduler:

    python dask_study.py star.toml --vary ... --scheduler tcp://head:8786 --parts 1000 --output study.npz

A worker that dies, or is killed by its queue, costs the part it was at: Dask gives it to another one.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import Any

import numpy as np
from dask.distributed import Client, LocalCluster
from numpy.typing import NDArray

import stargrip_cam as sg

Columns = dict[str, NDArray[Any]]
Vary = Mapping[str, str]


def rows(spec: sg.Spec, vary: Vary, part: int, parts: int) -> Columns:
    """The rows of one part, by one thread: the task of a worker."""
    return sg.sweep(spec, dict(vary), part=(part, parts), threads=1)


def study(client: Client, spec: sg.Spec, vary: Vary, parts: int) -> Columns:
    """All rows in order, computed by the workers of `client` in `parts` parts."""
    tasks = [client.submit(rows, spec, vary, part, parts, pure=False) for part in range(1, parts + 1)]
    pieces = client.gather(tasks)
    # A study of fewer rows than parts has empty parts.
    return {name: np.concatenate([piece[name] for piece in pieces if piece]) for name in next(filter(None, pieces))}


def main() -> None:
    """Reads the arguments, computes the study and writes it."""
    parser = argparse.ArgumentParser(description="A study on a Dask cluster.")
    parser.add_argument("spec", help="the spec around which values are varied")
    parser.add_argument("--vary", action="append", required=True, metavar="KEY=VALUES", help="the last runs fastest")
    parser.add_argument("--scheduler", help="address of a running scheduler; default: a cluster on this machine")
    parser.add_argument("--workers", type=int, help="workers on this machine; default: one a core")
    parser.add_argument("--parts", type=int, default=64)
    parser.add_argument("--output", required=True, metavar="FILE.npz")
    args = parser.parse_args()
    vary = dict(text.split("=", 1) for text in args.vary)
    spec = sg.Spec.from_toml(args.spec)
    cluster = args.scheduler or LocalCluster(n_workers=args.workers, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        columns = study(client, spec, vary, args.parts)
    # Words as fixed-width text, so that the file loads without pickle.
    plain = {name: column.astype(str) if column.dtype == object else column for name, column in columns.items()}
    np.savez_compressed(args.output, **plain)  # type: ignore[arg-type]
    print(f"{len(columns['row'])} rows in {args.output}")


if __name__ == "__main__":
    main()

"""Sweeps as Parquet files, by pyarrow."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, Callable

from stargrip_cam import _native
from stargrip_cam._progress import Line

PIECE = 1 << 20
"""Rows in memory at a time."""
GROUP = 1 << 16
"""Rows of a row group."""


def sweep_to_parquet(
    path: str | os.PathLike[str],
    spec: _native.Spec,
    vary: Mapping[str, str | Sequence[Any]] | None = None,
    *,
    study: str | None = None,
    outputs: Sequence[str] | None = None,
    part: tuple[int, int] | None = None,
    threads: int | None = None,
    progress: bool | Callable[[float, str], object] | None = None,
) -> None:
    """Computes the sweep of `spec`, and writes it to `path` as Parquet. Needs pyarrow. `vary`, `study`, `outputs`, `part`,
    `threads` and `progress` are those of `sweep`.

    A number that is unknown is null. The file's metadata has under `stargrip-cam.columns` the unit and the meaning of each column, and
    under `stargrip-cam.study` the fingerprint of the study. The file appears when it is complete; memory does not grow with the sweep.

    Raises ImportError without pyarrow, and the exceptions of `sweep`.
    """
    try:
        import pyarrow  # type: ignore[import-untyped]
        from pyarrow import parquet
    except ImportError as error:
        raise ImportError("Parquet needs pyarrow: pip install 'stargrip-cam[parquet]'") from error
    rows, fingerprint, columns = _native.sweep_columns(spec, vary, study=study, outputs=outputs)
    about = [{"name": name, "unit": unit, "about": text} for name, unit, text in columns]
    notes = {"stargrip-cam.study": fingerprint, "stargrip-cam.columns": json.dumps(about)}
    k, n = part or (1, 1)
    pieces = max(1, -(-rows // (n * PIECE)))
    line = Line() if progress is True else progress or None
    target = os.fspath(path)
    partial = f"{target}.{os.getpid()}.partial"
    writer = None
    try:
        for piece in range(pieces):
            told = None if line is None else _share(line, piece, pieces)
            own = ((k - 1) * pieces + piece + 1, n * pieces)
            found = _native.sweep(spec, vary, study=study, outputs=outputs, part=own, threads=threads, progress=told)
            kinds = {name: pyarrow.string() if values.dtype == object else None for name, values in found.items()}
            arrays = {name: pyarrow.array(values, kinds[name], from_pandas=True) for name, values in found.items()}
            table = pyarrow.table(arrays).replace_schema_metadata(notes)
            if writer is None:
                # Results are seldom equal: a dictionary of them only costs time. Axes and texts have one.
                repeated = [name for name, kind in kinds.items() if kind is not None or "." in name]
                writer = parquet.ParquetWriter(partial, table.schema, use_dictionary=repeated)
            writer.write_table(table, row_group_size=GROUP)
        assert writer is not None
        writer.close()
        os.replace(partial, target)
    finally:
        if writer is not None:
            writer.close()
        if os.path.exists(partial):
            os.remove(partial)


def _share(line: Callable[[float, str], object], piece: int, pieces: int) -> Callable[[float, str], object]:
    return lambda part, what: line((piece + part) / pieces, what)

//! Rows of a slow study that are done, kept in a file beside the one that they are for until that is whole: after a kill only the rows
//! that were being computed are computed again.
//!
//! Its first line names the study, and every other is a row: the hash of the rest, a space, and the row's cells as JSON. A line that a
//! killed process has torn is cut off.

use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::cli::escape::shown;
use crate::digest::sha256;
use crate::forecast::study::{RowBatch, Study, checkpoint};

/// The rows that are kept, and the file that keeps them, which nobody else writes meanwhile.
pub(super) struct Checkpoint {
    file: File,
    rows: BTreeMap<usize, RowBatch>,
}

/// The file that keeps the rows of `path`: "study.rows" of "study.csv".
pub(super) fn beside(path: &Path) -> PathBuf {
    path.with_extension("rows")
}

/// Removes the file that kept the rows of `path`, which is whole.
pub(super) fn drop_beside(path: &Path) {
    // Where it stays, the next run finds a file of its own study, and has nothing left to compute.
    let _ = fs::remove_file(beside(path));
}

impl Checkpoint {
    /// Opens the file `path`, or begins it.
    ///
    /// # Errors
    /// If it cannot be read or written, is not of this study, or another process writes it.
    pub(super) fn open(path: &Path, study: &Study) -> io::Result<Self> {
        let mut file = File::options().read(true).write(true).create(true).truncate(false).open(path)?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(io::Error::other(format!(
                "another process is computing the rows of {}",
                shown(path)
            )));
        }
        let head = format!("rows of study {}\n", study.fingerprint());
        let mut bytes = Vec::new();
        let _ = file.read_to_end(&mut bytes)?;
        let mut rows = BTreeMap::new();
        let mut whole = 0;
        if bytes.starts_with(head.as_bytes()) {
            whole = head.len();
            for line in bytes[whole..].split_inclusive(|byte| *byte == b'\n') {
                let Some(batch) = row(line, study) else { break };
                whole += line.len();
                let _ = rows.insert(batch.rows.start, batch);
            }
        } else if !head.as_bytes().starts_with(&bytes) {
            let text = format!("{} is not of this study: delete it, or choose another place", shown(path));
            return Err(io::Error::other(text));
        }
        file.set_len(u64::try_from(whole).unwrap_or(0))?;
        let _ = file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            file.write_all(head.as_bytes())?;
        }
        Ok(Self { file, rows })
    }

    /// Whether row `row` is kept.
    pub(super) fn has(&self, row: usize) -> bool {
        self.rows.contains_key(&row)
    }

    /// Keeps a batch of one row, whatever happens next.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn keep(&mut self, batch: RowBatch) -> io::Result<()> {
        let cells = serde_json::to_string(&checkpoint::cells(&batch))?;
        self.file.write_all(format!("{} {cells}\n", sha256(&cells)).as_bytes())?;
        self.file.sync_data()?;
        let _ = self.rows.insert(batch.rows.start, batch);
        Ok(())
    }

    /// Takes row `row` out of what is kept here; the file still has it.
    pub(super) fn take(&mut self, row: usize) -> Option<RowBatch> {
        self.rows.remove(&row)
    }
}

/// The row of a line; `None` if it is torn.
fn row(line: &[u8], study: &Study) -> Option<RowBatch> {
    let line = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (hash, cells) = line.split_once(' ')?;
    if sha256(cells) != hash {
        return None;
    }
    checkpoint::batch(study.columns(), serde_json::from_str(cells).ok()?)
}

//! Which unknown is which row of the system, and where each product of two unknowns lies in its matrix.

use crate::shell::assembly::kinks::Kink;
use crate::shell::assembly::sheet::{Beyond, Sheet};
use crate::shell::assembly::supports::Supports;

/// Number of a coordinate that is not an unknown.
pub(crate) const NONE: u32 = u32::MAX;
/// Unknowns that the energy of one triangle couples: its corners', its neighbours' far corners', its edges'.
pub(crate) const LOCAL: usize = 21;
/// Unknowns that the energy of one kink couples.
pub(crate) const KINK: usize = 12;
/// Pairs of them, each once.
const PAIRS: usize = pairs_of(LOCAL);
const KINK_PAIRS: usize = pairs_of(KINK);

const fn pairs_of(unknowns: usize) -> usize {
    unknowns * (unknowns + 1) / 2
}

/// The numbers of the unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Numbering {
    /// Unknowns of each point, along each of its axes.
    pub(crate) points: Vec<[u32; 3]>,
    /// Unknown of each edge's xi.
    pub(crate) edges: Vec<u32>,
    /// Number of unknowns.
    pub(crate) count: usize,
}

impl Numbering {
    /// Numbers the unknowns in the sheet's order of elimination.
    pub(crate) fn new(sheet: &Sheet, supports: &Supports) -> Self {
        let mut leaning = vec![false; sheet.edge_count];
        for piece in &sheet.pieces {
            for (edge, lean) in piece.edges.iter().zip(piece.lean) {
                leaning[*edge] |= lean != 0.0;
            }
        }
        let mut numbering = Self {
            points: vec![[NONE; 3]; supports.holds.len()],
            edges: vec![NONE; sheet.edge_count],
            count: 0,
        };
        let mut next = 0;
        for node in &sheet.order {
            let point = supports.holds.get(*node).map(|hold| &hold.fixed);
            let edge = node.wrapping_sub(supports.holds.len());
            let numbers: &mut [u32] = match point {
                Some(_) => &mut numbering.points[*node],
                None => std::slice::from_mut(&mut numbering.edges[edge]),
            };
            let fixed =
                point.map_or([!leaning.get(edge).is_some_and(|leans| *leans), true, true], |fixed| *fixed);
            for (number, _) in numbers.iter_mut().zip(fixed).filter(|(_, is_fixed)| !is_fixed) {
                *number = next;
                next += 1;
            }
        }
        numbering.count = next as usize;
        numbering
    }

    /// The unknowns of a kink: three of each corner.
    fn of_kink(&self, kink: &Kink) -> [u32; KINK] {
        let mut local = [NONE; KINK];
        for (numbers, corner) in local.chunks_exact_mut(3).zip(kink.corners) {
            numbers.copy_from_slice(&self.points[corner]);
        }
        local
    }

    /// The unknowns of triangle `t` in their local order: corners, far corners, edges.
    pub(crate) fn of_piece(&self, sheet: &Sheet, t: usize) -> [u32; LOCAL] {
        let piece = &sheet.pieces[t];
        let mut local = [NONE; LOCAL];
        for i in 0..3 {
            local[3 * i..3 * i + 3].copy_from_slice(&self.points[piece.corners[i]]);
            if let Beyond::Neighbour { corner, .. } = piece.beyond[i] {
                local[9 + 3 * i..12 + 3 * i].copy_from_slice(&self.points[corner]);
            }
            local[18 + i] = self.edges[piece.edges[i]];
        }
        local
    }
}

/// The lower triangle of the system's matrix, by columns, and where the sums over triangles put their products.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    pub(crate) starts: Vec<u32>,
    pub(crate) rows: Vec<u32>,
    /// For each triangle the places of its pairs; unused pairs go to the place after the last.
    pub(crate) places: Vec<[u32; PAIRS]>,
    /// Positions for each kink.
    pub(crate) kinks: Vec<[u32; KINK_PAIRS]>,
    /// For each point the places of its pairs of axes 00, 10, 11, 20, 21, 22.
    pub(crate) point_places: Vec<[u32; 6]>,
}

impl Pattern {
    pub(crate) fn new(sheet: &Sheet, numbering: &Numbering) -> Self {
        // The unknowns of each piece and kink are paired, and the pairs are sorted into columns without doubles. Then
        // every pair looks up its place in its column, so that assembling needs no search. Pairs with a held unknown
        // go to one place behind the matrix.
        let locals: Vec<[u32; LOCAL]> =
            (0..sheet.pieces.len()).map(|t| numbering.of_piece(sheet, t)).collect();
        let mut columns: Vec<Vec<u32>> = vec![Vec::new(); numbering.count];
        let kinks: Vec<[u32; KINK]> = sheet.kinks.iter().map(|kink| numbering.of_kink(kink)).collect();
        let of_kinks = kinks.iter().flat_map(|local| pairs(local));
        let coupled = locals.iter().flat_map(|local| pairs(local)).chain(of_kinks);
        for (row, column) in coupled.filter(|pair| pair.0 != NONE) {
            columns[column as usize].push(row);
        }
        let mut starts = vec![0];
        let mut rows = Vec::new();
        for column in &mut columns {
            column.sort_unstable();
            column.dedup();
            rows.append(column);
            starts.push(u32::try_from(rows.len()).unwrap_or(NONE));
        }
        let end = u32::try_from(rows.len()).unwrap_or(NONE);
        let place = |(row, column): (u32, u32)| {
            if row == NONE {
                return end;
            }
            let start = starts[column as usize];
            let column = &rows[start as usize..starts[column as usize + 1] as usize];
            column.binary_search(&row).map_or(end, |at| start + u32::try_from(at).unwrap_or(0))
        };
        let places = locals.iter().map(|local| collect(pairs(local).map(place))).collect();
        let point_places =
            numbering.points.iter().map(|numbers| collect(pairs(numbers).map(place))).collect();
        let kinks = kinks.iter().map(|local| collect(pairs(local).map(place))).collect();
        Self { starts, rows, places, kinks, point_places }
    }
}

fn collect<const N: usize>(mut items: impl Iterator<Item = u32>) -> [u32; N] {
    std::array::from_fn(|_| items.next().unwrap_or(NONE))
}

/// Row and column in the lower triangle of every pair of `local` unknowns, row by row; `NONE` twice where one of them is not.
fn pairs(local: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..local.len()).flat_map(move |i| {
        (0..=i).map(move |j| {
            let (a, b) = (local[i], local[j]);
            if a == NONE || b == NONE { (NONE, NONE) } else { (a.max(b), a.min(b)) }
        })
    })
}

//! Access to the rows of a body in the tangent.

use std::iter::once;

use crate::linalg::BandRows;

pub(super) fn rows_of_parts<'a>(
    parts: &[(usize, usize)],
    rows: BandRows<'a>,
) -> impl Iterator<Item = BandRows<'a>> {
    let cuts = parts.iter().map(|(_, row)| Some(*row)).chain(once(None));
    cuts.scan(Some(rows), |left, cut| {
        let rows = left.take()?;
        let Some(cut) = cut else { return Some(rows) };
        let (part, rest) = rows.split_at(cut);
        *left = Some(rest);
        Some(part)
    })
}

pub(super) struct Places<'a> {
    pub(super) degrees_of_freedom: &'a [[usize; 3]],
    pub(super) consecutive: &'a [Option<usize>],
    pub(super) order: usize,
    pub(super) unknowns: usize,
}

impl Places<'_> {
    pub(super) fn add_block(&self, rows: &mut BandRows<'_>, first: usize, block: &[f64]) {
        let width = 3 * self.order;
        let at_hand = rows.rows();
        if let Some(start) = self.consecutive[first]
            && at_hand.start <= start
            && start + width <= at_hand.end
        {
            return rows.add_block(start, width, block);
        }
        let degrees = self.degrees_of_freedom[first..first + self.order].as_flattened();
        for (values, row) in block.chunks_exact(width).zip(degrees) {
            if at_hand.contains(row) {
                for (&column, &value) in degrees.iter().zip(values) {
                    if column < self.unknowns {
                        rows.add(*row, column, value);
                    }
                }
            }
        }
    }
}

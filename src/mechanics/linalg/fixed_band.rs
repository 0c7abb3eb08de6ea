//! Elimination and substitution without row exchanges. The half-bandwidth is a compile-time constant for common beams.

use pulp::Simd;

use super::elimination::{PANEL, PanelFactors, is_small, subtract};

/// Eliminates the columns of a panel from the rows below, if earlier row exchanges have created no additional nonzero entries.
/// Returns false without any change of the matrix if the panel needs row exchanges.
#[inline(always)]
pub(super) fn eliminate_panel<
    S: Simd,
    const REACH: usize,
    const WIDTH: usize,
    const STRIDE: usize,
>(
    simd: S,
    rows: &mut [[f64; STRIDE]],
    sizes: &[f64],
) -> bool {
    let centre = REACH + PANEL - 1;
    let Some((panel, rows_below)) = rows.split_first_chunk_mut::<PANEL>() else {
        return false;
    };
    let Some(rows_below) = rows_below.first_chunk_mut::<REACH>() else {
        return false;
    };
    let mut heads = [[0.0; PANEL]; PANEL];
    for (row, entries) in heads.iter_mut().enumerate() {
        entries.copy_from_slice(&panel[row][centre - row..][..PANEL]);
    }
    let Some((sizes, sizes_below)) = sizes.split_first_chunk::<PANEL>() else {
        return false;
    };
    let Some(sizes_below) = sizes_below.first_chunk::<REACH>() else {
        return false;
    };
    let PanelFactors { factors, inverses, is_stable } = PanelFactors::of(heads, sizes);

    let [[_, u01, u02, u03], [_, _, u12, u13], [_, _, _, u23], _] = factors;
    let mut before = [[0.0; PANEL]; REACH];
    let mut are_small = is_stable;
    for (index, (row, before)) in rows_below.iter_mut().zip(&mut before).enumerate() {
        let head = &mut row[REACH - 1 - index..][..PANEL];
        before.copy_from_slice(head);
        let l0 = head[0] * inverses[0];
        let l1 = (head[1] - l0 * u01) * inverses[1];
        let l2 = (head[2] - l0 * u02 - l1 * u12) * inverses[2];
        let l3 = (head[3] - l0 * u03 - l1 * u13 - l2 * u23) * inverses[3];
        // The values are written, and later read, one by one, because reading a vector that was written in several pieces would stall the processor.
        (head[0], head[1], head[2], head[3]) = (l0, l1, l2, l3);
        let size = sizes_below[index];
        are_small &=
            [l0, l1, l2, l3].iter().zip(sizes).all(|(l, pivot)| is_small(*l, *pivot, size));
    }
    if !are_small {
        for (index, (row, before)) in rows_below.iter_mut().zip(&before).enumerate() {
            row[REACH - 1 - index..][..PANEL].copy_from_slice(before);
        }
        return false;
    }

    for (index, row) in panel.iter_mut().enumerate() {
        row[centre - index..][..PANEL].copy_from_slice(&factors[index]);
        row[centre] = inverses[index];
    }
    let [row0, row1, row2, row3] = panel;
    let behind0 = &row0[centre + PANEL..][..WIDTH];
    let behind1 = &mut row1[centre + PANEL - 1..][..WIDTH];
    subtract(simd, [factors[1][0]], [behind0], behind1);
    let behind2 = &mut row2[centre + PANEL - 2..][..WIDTH];
    subtract(simd, [factors[2][0], factors[2][1]], [behind0, behind1], behind2);
    let behind3 = &mut row3[centre + PANEL - 3..][..WIDTH];
    let [l0, l1, l2, _] = factors[3];
    subtract(simd, [l0, l1, l2], [behind0, behind1, behind2], behind3);
    for (index, row) in rows_below.iter_mut().enumerate() {
        let (head, tail) = row[REACH - 1 - index..][..PANEL + WIDTH].split_at_mut(PANEL);
        let multipliers = [head[0], head[1], head[2], head[3]];
        subtract(simd, multipliers, [behind0, behind1, behind2, behind3], tail);
    }
    true
}

#[inline(always)]
pub(super) fn substitute_forward<const REACH: usize, const STRIDE: usize>(
    panel: &[[f64; STRIDE]; PANEL],
    rows_below: &[[f64; STRIDE]; REACH],
    known: &mut [f64; PANEL],
    unknown: &mut [f64; REACH],
) {
    let centre = REACH + PANEL - 1;
    for (index, row) in panel.iter().enumerate().skip(1) {
        for column in 0..index {
            known[index] -= row[centre - index + column] * known[column];
        }
    }
    for (index, (row, entry)) in rows_below.iter().zip(unknown).enumerate() {
        for (column, known) in known.iter().enumerate() {
            *entry -= row[REACH - 1 - index + column] * known;
        }
    }
}

#[inline(always)]
pub(super) fn substitute_backward<const REACH: usize, const STRIDE: usize>(
    row: &[f64; STRIDE],
    right: f64,
    behind: &[f64; REACH],
) -> f64 {
    let centre = REACH + PANEL - 1;
    let mut rest = right;
    for at in (0..REACH).rev() {
        rest -= row[centre + 1 + at] * behind[at];
    }
    rest * row[centre]
}

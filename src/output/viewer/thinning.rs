//! Selection of the rows of a long history that a chart shows.

const MOST_ROWS: usize = 3000;

/// Indices of the rows that are kept. A short history is kept completely.
/// A long history is divided into pieces. Of each piece, the first row and the rows with the smallest and largest value of every column are kept.
/// The last row of the history is also kept.
pub fn rows_to_keep(rows: usize, columns: &[&[f64]]) -> Vec<usize> {
    if rows <= MOST_ROWS {
        return (0..rows).collect();
    }
    let pieces = (MOST_ROWS / (2 * columns.len() + 1)).max(1);
    let mut kept = vec![rows - 1];
    for piece in 0..pieces {
        let range = piece * rows / pieces..(piece + 1) * rows / pieces;
        kept.push(range.start);
        for column in columns {
            let by = |a: &usize, b: &usize| column[*a].total_cmp(&column[*b]);
            kept.extend(range.clone().min_by(by));
            kept.extend(range.clone().max_by(by));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinned_histories_keep_peaks_and_short_ones_are_unchanged() {
        assert_eq!(rows_to_keep(3, &[&[1.0, 2.0, 3.0]]), [0, 1, 2]);
        let mut column = vec![0.0; 100_000];
        column[54_321] = 1.0;
        column[54_323] = -1.0;
        let kept = rows_to_keep(column.len(), &[&column]);
        assert!(kept.len() <= MOST_ROWS + 1 && kept.is_sorted());
        assert!([0, 54_321, 54_323, 99_999].iter().all(|row| kept.contains(row)));
    }
}

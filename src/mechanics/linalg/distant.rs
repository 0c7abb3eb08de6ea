//! Dense blocks of entries that may lie outside the band, for couplings that change during a simulation.

#[derive(Debug, Clone, Default)]
pub(super) struct DistantBlocks {
    unknowns: Vec<usize>,
    ends: Vec<usize>,
    entries: Vec<f64>,
}

impl DistantBlocks {
    pub(super) fn clear(&mut self) {
        self.unknowns.clear();
        self.ends.clear();
        self.entries.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub(super) fn add(&mut self, unknowns: &[usize], entries: impl Iterator<Item = f64>) {
        self.unknowns.extend(unknowns);
        self.ends.push(self.unknowns.len());
        self.entries.extend(entries);
    }

    pub(super) fn groups(&self) -> impl Iterator<Item = &[usize]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| &self.unknowns[start..end])
    }

    /// Row, column and value of all entries. The caller must add up values for the same row and column.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let pairs = self.groups().flat_map(|group| {
            group.iter().flat_map(move |&row| group.iter().map(move |&column| (row, column)))
        });
        pairs.zip(&self.entries).map(|((row, column), &value)| (row, column, value))
    }
}

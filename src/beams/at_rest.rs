//! How a span at rest resists small movements, taken apart: what it is that section forces and moments resist, and how a section force
//! pulls at what turns.
//!
//! ```text
//! δΓ = Λᵀ δg - J (Γ + e1) δω        δκ = δω'        the rows B, with the stiffness w C and w EI
//! K_g = p qᵀ + q pᵀ      p·δ = w (Λ J N·δg - ½ g·ΛN δω)      q·δ = δω
//! ```
//!
//! `K = Bᵀ C B + K_g`: added up, the large first part hides by its rounding what is soft in it.

/// The rows of one span. They have an entry for each component of each of its control points, in that order.
#[derive(Debug, Clone, Default)]
pub struct SpanAtRest {
    /// The first of its control points.
    pub first: usize,
    /// Row after row: a strain or curvature by movements [1/length; shear by rotation: -; curvature by rotation: 1/length].
    pub strains: Vec<f64>,
    /// The stiffness of each, times the length it stands for [force·length, force·length³].
    pub stiffness: Vec<f64>,
    /// `p` and `q`, pair after pair [force; force·length for rotations, -].
    pub twists: Vec<f64>,
    /// How much of the section force of each pair rounding may have made [-].
    pub doubts: Vec<f64>,
}

impl SpanAtRest {
    /// Begins with the rows of another span.
    pub(super) fn begin(&mut self, first: usize) {
        self.first = first;
        self.strains.clear();
        self.stiffness.clear();
        self.twists.clear();
        self.doubts.clear();
    }

    /// Adds a row: for each control point by x, y and rotation.
    pub(super) fn add_strain<const N: usize>(&mut self, stiffness: f64, row: [[f64; 3]; N]) {
        self.strains.extend(row.as_flattened());
        self.stiffness.push(stiffness);
    }

    /// Adds a pair of rows.
    pub(super) fn add_twist<const N: usize>(
        &mut self,
        doubt: f64,
        p: [[f64; 3]; N],
        q: [[f64; 3]; N],
    ) {
        self.twists.extend(p.as_flattened());
        self.twists.extend(q.as_flattened());
        self.doubts.push(doubt);
    }
}

//! How a span at rest resists small movements, taken apart: what it is that section forces and moments resist, and how a section force
//! pulls at what turns.
//!
//! ```text
//! δΓ = Λᵀ δg - J (Γ + e1) δω        δκ = δω'        the rows B, with the stiffness w C and w EI
//! K_g = p qᵀ + q pᵀ      p·δ = w (Λ J N·δg - ½ g·ΛN δω)      q·δ = δω
//! ```
//!
//! `K = Bᵀ C B + K_g`: added up, the large first part hides by its rounding what is soft in it.

/// A strain of a beam by its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrainKind {
    /// Stretching along the axis.
    Axial,
    /// Shear across the axis.
    Shear,
    /// Bending: a change of the curvature.
    Bending,
}

/// How one span of a beam resists small movements at rest: rows with an entry for each component (x, y, rotation) of each of its control points.
#[derive(Debug, Clone, Default)]
pub struct SpanStiffness {
    /// The index of the first control point of the span.
    pub first: usize,
    /// The rows of the span, one after another: a strain or curvature by movements [1/length; shear by rotation: -; curvature by rotation: 1/length].
    pub strains: Vec<f64>,
    /// The stiffness of each strain or curvature of the span, times the length it stands for [force·length, force·length³].
    pub stiffness: Vec<f64>,
    /// The kind of strain of each row of a beam; none for what is not a beam.
    pub kinds: Vec<StrainKind>,
    /// The pairs of rows `p` and `q` by which section forces resist turning, one after another [force; force·length for rotations, -].
    pub twists: Vec<f64>,
    /// How much of the section force of each pair of rows rounding may have made [-].
    pub doubts: Vec<f64>,
}

impl SpanStiffness {
    /// Begins with the rows of another span, whose first control point is `first`.
    pub fn begin(&mut self, first: usize) {
        self.first = first;
        self.strains.clear();
        self.stiffness.clear();
        self.kinds.clear();
        self.twists.clear();
        self.doubts.clear();
    }

    /// Adds a row of a strain or curvature: its derivative by x, y and rotation of each control point of the span.
    pub(super) fn add_strain<const N: usize>(
        &mut self,
        kind: StrainKind,
        stiffness: f64,
        row: [[f64; 3]; N],
    ) {
        self.strains.extend(row.as_flattened());
        self.stiffness.push(stiffness);
        self.kinds.push(kind);
    }

    /// Adds a pair of rows, `p` and `q`, by which a section force resists turning.
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

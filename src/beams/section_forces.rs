//! Section forces at any place of a beam: known at quadrature points, interpolated between them.
//!
//! Axial and shear strain are known at the points for `Γ`, the curvature at those for `κ`, and with them the section forces. Between them, on
//! each run of spans that join smoothly, `N`, `Q` and `M` are the polynomial through the nearest points, as many on either side:
//!
//! ```text
//! f(ξ) = Σ_k f(ξ_k) Π_{j≠k} (ξ - ξ_j)/(ξ_k - ξ_j)        over the p + 1 nearest points, or p + 2 where p is even
//! ```
//!
//! At a quadrature point that is the value there; it is continuous within a run, and of order `p + 1` in the length of a span. Runs know nothing
//! of each other: where they meet, at a joint or a node of Lagrange elements, both have a value, and near their ends the polynomial of the
//! last points is continued.

use super::{BeamError, Mesh};

/// What a cross section transmits, and how it is strained by that.
///
/// In the frame of the section, whose first axis is its normal: these are forces of the part of the beam that follows on the part before.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SectionForces {
    /// `N`, along the normal of the section: positive in tension [force].
    pub axial: f64,
    /// `Q`, across the normal, positive to its left [force].
    pub shear: f64,
    /// `M`, positive counter-clockwise [force·length].
    pub moment: f64,
    /// `Γ1` [-]
    pub axial_strain: f64,
    /// `Γ2` [-]
    pub shear_strain: f64,
    /// `κ`, the change of curvature since drawn [1/length].
    pub curvature: f64,
}

/// A place of a beam among its quadrature points: by which shares of their values section forces are interpolated there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SectionPlace {
    pub(super) of_force: Vec<Share>,
    pub(super) of_moment: Vec<Share>,
}

/// The share of a quadrature point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Share {
    /// The span, and the point among those of the span.
    pub(super) span: usize,
    pub(super) point: usize,
    pub(super) weight: f64,
}

/// The quadrature points of a beam in the order of the parameter of its mesh, run by run.
#[derive(Debug, Clone)]
pub struct SectionPoints {
    runs: Vec<Run>,
    /// The most points that a polynomial goes through.
    most: usize,
}

/// Spans that join smoothly.
#[derive(Debug, Clone)]
struct Run {
    end: f64,
    /// Where its spans begin, and its end.
    breaks: Vec<f64>,
    of_force: Vec<PointAt>,
    of_moment: Vec<PointAt>,
}

/// A quadrature point: its parameter, its span, and which of the points of the span it is.
#[derive(Debug, Clone, Copy)]
struct PointAt {
    xi: f64,
    span: usize,
    point: usize,
}

impl SectionPoints {
    /// The quadrature points of a beam on a mesh.
    ///
    /// # Errors
    /// When the mesh has no quadrature.
    pub fn of(mesh: &Mesh) -> Result<Self, BeamError> {
        let numbered: Vec<_> = mesh.quadrature_spans()?.into_iter().enumerate().collect();
        let mut runs = Vec::new();
        for spans in numbered.chunk_by(|(_, a), (_, b)| mesh.is_smooth(&a.span, &b.span)) {
            let (mut of_force, mut of_moment) = (Vec::new(), Vec::new());
            for (index, quadrature) in spans {
                let at = |(point, xi)| PointAt { xi, span: *index, point };
                let force = quadrature.force_rule.iter().map(|(xi, _)| *xi);
                of_force.extend(force.enumerate().map(at));
                let rule = quadrature.moment_rule()?;
                let span = quadrature.span;
                let moment = rule.iter_on(span.start, span.end).map(|(xi, _)| xi);
                of_moment.extend(moment.enumerate().map(at));
            }
            let starts = spans.iter().map(|(_, quadrature)| quadrature.span.start);
            let end = spans[spans.len() - 1].1.span.end;
            let breaks = starts.chain([end]).collect();
            runs.push(Run { end, breaks, of_force, of_moment });
        }
        // As many points on either side of a place: an even number.
        Ok(Self { runs, most: (mesh.basis().degree() + 1).next_multiple_of(2) })
    }

    /// The place at a parameter of the mesh; where two runs meet, on the one that begins there.
    pub fn at(&self, xi: f64) -> SectionPlace {
        let run = self.runs.partition_point(|run| run.end <= xi).min(self.runs.len() - 1);
        self.on(&self.runs[run], xi)
    }

    /// Places along the whole beam, with their parameters: so many in each span besides the knots. Where two runs meet there are two, the first
    /// on the run that ends.
    pub fn along(&self, within: usize) -> Vec<(f64, SectionPlace)> {
        let pieces = (within + 1) as f64;
        let of_run = |run: &Run| {
            let inside = |pair: &[f64]| {
                let (start, end) = (pair[0], pair[1]);
                (0..=within).map(move |i| start + (end - start) * i as f64 / pieces)
            };
            let parameters = run.breaks.windows(2).flat_map(inside).chain([run.end]);
            parameters.map(|xi| (xi, self.on(run, xi))).collect::<Vec<_>>()
        };
        self.runs.iter().flat_map(of_run).collect()
    }

    fn on(&self, run: &Run, xi: f64) -> SectionPlace {
        SectionPlace {
            of_force: shares(&run.of_force, self.most, xi),
            of_moment: shares(&run.of_moment, self.most, xi),
        }
    }
}

/// The shares of the nearest points in the polynomial through them, half of them on either side where there are as many.
fn shares(points: &[PointAt], most: usize, xi: f64) -> Vec<Share> {
    let count = most.min(points.len());
    let next = points.partition_point(|point| point.xi <= xi);
    let first = next.saturating_sub(count / 2).min(points.len() - count);
    let nearest = &points[first..first + count];
    let weight = |at: f64| {
        let others = nearest.iter().filter(|other| other.xi != at);
        others.map(|other| (xi - other.xi) / (at - other.xi)).product()
    };
    let share = |at: &PointAt| Share { span: at.span, point: at.point, weight: weight(at.xi) };
    nearest.iter().map(share).collect()
}

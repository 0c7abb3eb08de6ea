//! Section at any parameter of the axis of a beam.

use crate::beams::{BeamError, Mesh, Section, SectionVariation};
use crate::geometry::{GaussRule, Span, Vec2};

const POINTS: usize = 8;

pub(in crate::beams) struct SectionsOnAxis<'a> {
    variation: &'a SectionVariation,
    mesh: &'a Mesh,
    control_points: &'a [Vec2],
    rule: GaussRule,
    /// Arc lengths at the starts of the spans, followed by the total length [length].
    starts: Vec<f64>,
    length: f64,
}

impl<'a> SectionsOnAxis<'a> {
    pub(in crate::beams) fn new(
        variation: &'a SectionVariation,
        mesh: &'a Mesh,
        control_points: &'a [Vec2],
    ) -> Result<Self, BeamError> {
        let rule = GaussRule::new(POINTS)?;
        let mut along =
            Self { variation, mesh, control_points, rule, starts: Vec::new(), length: 0.0 };
        if let SectionVariation::Uniform(_) = variation {
            return Ok(along);
        }
        for span in mesh.basis().spans() {
            along.starts.push(along.length);
            along.length += along.within(&span, span.end);
        }
        Ok(along)
    }

    fn within(&self, span: &Span, xi: f64) -> f64 {
        let speed = |at: f64| {
            self.mesh.basis().evaluate_in(span, at).combine(1, self.control_points).norm()
        };
        self.rule.iter_on(span.start, xi).map(|(at, weight)| weight * speed(at)).sum()
    }

    pub(in crate::beams) fn at(&self, index: usize, span: &Span, xi: f64) -> Section {
        match self.variation {
            SectionVariation::Uniform(section) => *section,
            tapered => tapered.at((self.starts[index] + self.within(span, xi)) / self.length),
        }
    }
}

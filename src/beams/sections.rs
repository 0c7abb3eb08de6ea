//! Which section each quadrature point of a beam has: that of the beam, or one of its own.

use std::fmt::Debug;

use super::dynamics::Movement;
use super::{BeamError, Mesh, Profile, Section};
use crate::geometry::{GaussRule, Span, Vec2};

/// Points by which arc lengths within a span are measured.
const POINTS: usize = 8;

/// The sections of the quadrature points of a span, a type for each way in which they are known: the points of a uniform beam share one and
/// nothing is looked up.
pub(super) trait Sections: Clone + Debug + Send + Sync {
    /// What is summed up of a product of two functions: the length, and the inertia where that is not proportional to it.
    type Entry: Entry;
    /// The section at a place between points.
    type Blend: Blend;

    /// The sections at the points for `Γ` and at those for `κ`.
    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self;

    /// That of a point for `Γ`.
    fn of_force<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    /// That of a point for `κ`.
    fn of_moment<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    /// The masses of control points, from their lengths where the section is the same, or as they were weighed.
    fn masses(uniform: &Section, lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64>;
}

/// An integral of a product of two functions along a beam.
pub(super) trait Entry: Copy + Default + Debug + Send + Sync {
    /// Adds a product times its weight [length], where the beam has a section.
    fn add(&mut self, product: f64, section: &Section);

    /// That of the product itself [length].
    fn length(self) -> f64;

    /// A factor times the inertia that belongs to it.
    fn inertia(self, factor: f64, uniform: &Section) -> Movement;
}

/// The section at a place between points, by shares that add up to one.
pub(super) trait Blend: Default {
    /// Adds a share of the section of a point.
    fn add(&mut self, section: &Section, share: f64);

    /// What the sections of the points have come to.
    fn section<'a>(&'a self, uniform: &'a Section) -> &'a Section;
}

impl Blend for () {
    fn add(&mut self, _section: &Section, _share: f64) {}

    fn section<'a>(&'a self, uniform: &'a Section) -> &'a Section {
        uniform
    }
}

/// The sum of shares of sections.
#[derive(Debug, Default)]
pub(super) struct Blended(Section);

impl Blend for Blended {
    fn add(&mut self, section: &Section, share: f64) {
        self.0 = self.0.plus(section, share);
    }

    fn section<'a>(&'a self, _uniform: &'a Section) -> &'a Section {
        &self.0
    }
}

/// All points have the section of the beam.
#[derive(Debug, Clone)]
pub(super) struct Same;

impl Sections for Same {
    type Entry = f64;
    type Blend = ();

    fn new(_at_force: Vec<Section>, _at_moment: Vec<Section>) -> Self {
        Self
    }

    #[inline(always)]
    fn of_force<'a>(&'a self, uniform: &'a Section, _point: usize) -> &'a Section {
        uniform
    }

    #[inline(always)]
    fn of_moment<'a>(&'a self, uniform: &'a Section, _point: usize) -> &'a Section {
        uniform
    }

    fn masses(uniform: &Section, lengths: Vec<f64>, _weighed: Vec<f64>) -> Vec<f64> {
        lengths.into_iter().map(|length| length * uniform.mass_per_length).collect()
    }
}

impl Entry for f64 {
    fn add(&mut self, product: f64, _section: &Section) {
        *self += product;
    }

    fn length(self) -> f64 {
        self
    }

    #[inline]
    fn inertia(self, factor: f64, uniform: &Section) -> Movement {
        let entry = factor * self;
        let (mass, rotary) = (entry * uniform.mass_per_length, entry * uniform.rotary_inertia);
        [mass, mass, rotary]
    }
}

/// Each point has its own.
#[derive(Debug, Clone)]
pub(super) struct Own {
    at_force: Vec<Section>,
    at_moment: Vec<Section>,
}

impl Sections for Own {
    type Entry = Weighed;
    type Blend = Blended;

    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self {
        Self { at_force, at_moment }
    }

    #[inline(always)]
    fn of_force<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_force[point]
    }

    #[inline(always)]
    fn of_moment<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_moment[point]
    }

    fn masses(_uniform: &Section, _lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64> {
        weighed
    }
}

/// Length, mass and rotary inertia of a product of two functions.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Weighed {
    length: f64,
    mass: f64,
    rotary: f64,
}

impl Entry for Weighed {
    fn add(&mut self, product: f64, section: &Section) {
        self.length += product;
        self.mass += product * section.mass_per_length;
        self.rotary += product * section.rotary_inertia;
    }

    fn length(self) -> f64 {
        self.length
    }

    #[inline]
    fn inertia(self, factor: f64, _uniform: &Section) -> Movement {
        let (mass, rotary) = (factor * self.mass, factor * self.rotary);
        [mass, mass, rotary]
    }
}

/// A profile laid along the axis that control points draw on a mesh.
pub(super) struct Laid<'a> {
    profile: &'a Profile,
    mesh: &'a Mesh,
    control_points: &'a [Vec2],
    rule: GaussRule,
    /// The arc length at which each span starts, and that of all [length].
    starts: Vec<f64>,
    length: f64,
}

impl<'a> Laid<'a> {
    /// Lays a profile along an axis.
    pub(super) fn new(
        profile: &'a Profile,
        mesh: &'a Mesh,
        control_points: &'a [Vec2],
    ) -> Result<Self, BeamError> {
        let rule = GaussRule::new(POINTS)?;
        let mut laid =
            Self { profile, mesh, control_points, rule, starts: Vec::new(), length: 0.0 };
        if let Profile::Uniform(_) = profile {
            return Ok(laid);
        }
        for span in mesh.basis().spans() {
            laid.starts.push(laid.length);
            laid.length += laid.within(&span, span.end);
        }
        Ok(laid)
    }

    /// The arc length from the start of a span to a parameter in it [length].
    fn within(&self, span: &Span, xi: f64) -> f64 {
        let speed = |at: f64| {
            self.mesh.basis().evaluate_in(span, at).combine(1, self.control_points).norm()
        };
        self.rule.iter_on(span.start, xi).map(|(at, weight)| weight * speed(at)).sum()
    }

    /// The section at a parameter in a span, by the number of that.
    pub(super) fn at(&self, index: usize, span: &Span, xi: f64) -> Section {
        match self.profile {
            Profile::Uniform(section) => *section,
            tapered => tapered.at((self.starts[index] + self.within(span, xi)) / self.length),
        }
    }
}
